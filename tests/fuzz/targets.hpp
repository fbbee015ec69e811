// The fuzz targets. Each function passes untrusted bytes to one parser. A parser may refuse the bytes with an
// InputError. Any other exception, a failed expect() and a report of a sanitizer are errors. The folder
// tests/fuzz/corpus/TARGET contains inputs of the target: examples, and all inputs with which the fuzzer has
// found an error.
//
// scripts/fuzz.sh runs the targets with libFuzzer (CMake preset fuzz). replay_test.cpp runs the targets on
// the inputs in tests/fuzz/corpus in every build.
#pragma once
#include <array>
#include <string_view>

namespace pelage::fuzz {

void archive(std::string_view bytes);     ///< a member of a tar.gz archive of meshes
void cached(std::string_view bytes);      ///< content of a mesh cache file; cached() adds title and checksum
void claims(std::string_view bytes);      ///< a file of claims
void experiment(std::string_view bytes);  ///< an experiment file
void gltf(std::string_view bytes);        ///< glTF, text or binary
void journal(std::string_view bytes);     ///< a journal (rows of results); journal() adds the checksums
void mesh(std::string_view bytes, std::string_view format);  ///< OBJ, OFF, PLY, STL or 3DS
void models(std::string_view bytes);                         ///< a file such as experiments/models.toml
void options(std::string_view bytes);                        ///< values of command-line options
void picture(std::string_view bytes);    ///< a picture file; the first byte selects its format
void proc_stat(std::string_view bytes);  ///< the first line of /proc/stat, which contains CPU times
void scene(std::string_view bytes);      ///< a scene file
void set(std::string_view bytes);        ///< the value of the command-line option --set
void strands(std::string_view bytes, std::string_view format);  ///< HAIR or the lines of OBJ
void tuning(std::string_view bytes);                            ///< a tuning file

struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
};

inline constexpr std::array<Target, 20> targets{
    {{"3ds", [](std::string_view bytes) { mesh(bytes, "3ds"); }},
     {"archive", archive},
     {"cached", cached},
     {"claims", claims},
     {"experiment", experiment},
     {"gltf", gltf},
     {"hair", [](std::string_view bytes) { strands(bytes, "hair"); }},
     {"journal", journal},
     {"models", models},
     {"obj", [](std::string_view bytes) { mesh(bytes, "obj"); }},
     {"obj_lines", [](std::string_view bytes) { strands(bytes, "obj"); }},
     {"off", [](std::string_view bytes) { mesh(bytes, "off"); }},
     {"options", options},
     {"picture", picture},
     {"ply", [](std::string_view bytes) { mesh(bytes, "ply"); }},
     {"proc_stat", proc_stat},
     {"scene", scene},
     {"set", set},
     {"stl", [](std::string_view bytes) { mesh(bytes, "stl"); }},
     {"tuning", tuning}}};

}  // namespace pelage::fuzz
