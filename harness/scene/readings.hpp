// The two readings of each paper: `paper` is what the paper prints, with the fewest repairs; `pelage` is what
// pelage does by default. The files readings/PAPER.toml hold both.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scene/scene.hpp"

namespace pelage {

inline constexpr std::array<std::string_view, 2> reading_names{"paper", "pelage"};

/// A scene key that a paper's text determines.
struct ReadingKey {
  std::string name;           ///< name of the scene key
  std::string paper, pelage;  ///< its values in the two readings, as TOML
  std::string section;        ///< section of the paper, and its equation or algorithm
};

struct PaperReading {
  std::string letter;  ///< S, W, D or B (docs/glossary.md)
  std::string paper;   ///< key of the paper, such as silva2010-wet-fur
  bool first_light;    ///< only the first light of the scene counts, with the intensity 1
  std::vector<ReadingKey> keys;
};

/// Returns the readings of all papers. Throws InputError if a file is missing or invalid.
const std::vector<PaperReading>& paper_readings();

/// Returns the readings of the paper whose method draws the scene: D if a pipeline draws strands, B with a
/// mass-spring topology, W with the shading model wet, and S otherwise. pipeline: "" for that of the scene.
const PaperReading& reading_of(const Scene& scene, std::string_view pipeline);

/// Leaves only the first light of the scene, with the intensity 1, if the paper has one light.
void read_lights(Scene& scene, const PaperReading& reading);

/// Gives the lights and the keys of the paper the values of the reading `paper`. The reading `pelage` changes
/// nothing, because keys that a scene does not set have its values. Throws InputError for another name.
void apply_reading(Scene& scene, std::string_view reading, const PaperReading& paper);

}  // namespace pelage
