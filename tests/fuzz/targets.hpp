// The fuzz targets. Each function passes untrusted bytes to one parser. A parser may refuse them with
// InputError. Any other exception, a failed expect() and a report of a sanitizer are findings.
// tests/fuzz/corpus/TARGET contains inputs of each target: examples, and the inputs of all findings so far.
//
// scripts/fuzz.sh runs the targets with libFuzzer (CMake preset fuzz). replay_test.cpp runs them on the
// corpus in every build.
#pragma once
#include <array>
#include <string_view>

namespace pelage::fuzz {

void archive(std::string_view bytes);     ///< a member of a tar.gz archive of meshes
void cached(std::string_view bytes);      ///< a mesh of the cache on disk, without title and checksum
void claims(std::string_view bytes);      ///< a file of claims
void experiment(std::string_view bytes);  ///< an experiment file
void gltf(std::string_view bytes);        ///< a glTF file, as far as pelage itself reads it
void journal(std::string_view bytes);     ///< a journal; the target adds a checksum to lines in braces
void models(std::string_view bytes);      ///< a file of models such as experiments/models.toml
void obj(std::string_view bytes);
void off(std::string_view bytes);
void options(std::string_view bytes);  ///< the values of options: thresholds, shards, devices, filters
void picture(std::string_view bytes);  ///< the first byte selects the format, the others are the file
void ply(std::string_view bytes);
void proc_stat(std::string_view bytes);  ///< the first line of /proc/stat
void scene(std::string_view bytes);      ///< a scene file
void set(std::string_view bytes);        ///< a value of the option --set
void stl(std::string_view bytes);
void tuning(std::string_view bytes);  ///< a tuning file

struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
};

inline constexpr std::array<Target, 17> targets{{{"archive", archive},
                                                 {"cached", cached},
                                                 {"claims", claims},
                                                 {"experiment", experiment},
                                                 {"gltf", gltf},
                                                 {"journal", journal},
                                                 {"models", models},
                                                 {"obj", obj},
                                                 {"off", off},
                                                 {"options", options},
                                                 {"picture", picture},
                                                 {"ply", ply},
                                                 {"proc_stat", proc_stat},
                                                 {"scene", scene},
                                                 {"set", set},
                                                 {"stl", stl},
                                                 {"tuning", tuning}}};

}  // namespace pelage::fuzz
