// Estimates how long `pelage reproduce` takes, from the lengths of an earlier run.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace pelage {

/// Returns how much fixed work all cores of this machine do per second. Takes 0.3 s.
double machine_speed();

/// The lengths of steps of `pelage reproduce`, by preset and experiment, with the speed of the machine that
/// took them. A run writes them into DIR/lengths.csv; experiments/papers/lengths.csv is such a file.
class Lengths {
 public:
  /// Reads the file, which may be absent. Throws InputError for a malformed line.
  explicit Lengths(const std::filesystem::path& file);

  /// Returns the estimated length of the step on a machine of this speed, in s. If the file does not name the
  /// step, the estimate is 5 s per case.
  double of(const std::string& preset, const std::string& experiment, std::size_t cases, double speed) const;

 private:
  struct Length {
    double seconds, speed;
  };
  std::map<std::pair<std::string, std::string>, Length> known_;  // preset and experiment -> its length
};

/// Returns the file experiments/papers/lengths.csv of this installation; it may not exist.
std::filesystem::path shipped_lengths();

/// Appends the length of a whole step to the file. Throws InputError if it cannot be written.
void add_length(const std::filesystem::path& file, const std::string& preset, const std::string& experiment,
                double seconds, double speed);

/// Returns "1 h 52 min", "12 min" or "40 s".
std::string length_text(double seconds);

}  // namespace pelage
