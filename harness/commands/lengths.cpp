#include "harness/commands/lengths.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>

#include "harness/base/numbers.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/parallel.hpp"
#include "harness/table/render.hpp"

namespace pelage {

namespace fs = std::filesystem;

double machine_speed() {
  using Clock = std::chrono::steady_clock;
  constexpr double seconds = 0.3;
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  std::atomic<std::uint64_t> rounds{0};
  std::atomic<double> result{0};  // keeps the compiler from removing the work
  for_each_index(std::thread::hardware_concurrency(), [&](std::size_t) {
    double x = 1;
    while (Clock::now() < end) {
      for (int i = 0; i < 10000; ++i) x = 0.5 * x + std::sqrt(x + i);
      ++rounds;
    }
    result = x;
  });
  return double(rounds) / seconds;
}

Lengths::Lengths(const fs::path& file) {
  std::ifstream stream(file);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    std::istringstream fields(line);
    std::string preset, experiment, seconds, speed;
    std::getline(fields, preset, ',');
    std::getline(fields, experiment, ',');
    std::getline(fields, seconds, ',');
    std::getline(fields, speed, ',');
    const auto length = double_of(seconds), own = double_of(speed);
    if (!length || !own || *own <= 0)
      throw InputError(fmt::format("{}:{}: must be PRESET,EXPERIMENT,SECONDS,SPEED", file.string(), number));
    known_[{preset, experiment}] = {*length, *own};
  }
}

double Lengths::of(const std::string& preset, const std::string& experiment, std::size_t cases,
                   double speed) const {
  constexpr double usual = 5;  // s per case
  const auto found = known_.find({preset, experiment});
  return found == known_.end() ? usual * double(cases) : found->second.seconds * found->second.speed / speed;
}

fs::path shipped_lengths() {
  const std::vector<fs::path> files = experiment_files();
  return files.empty() ? fs::path() : files.front().parent_path() / "papers" / "lengths.csv";
}

void add_length(const fs::path& file, const std::string& preset, const std::string& experiment,
                double seconds, double speed) {
  std::ofstream stream(file, std::ios::app);
  stream << csv_line({preset, experiment, fmt::format("{:.1f}", seconds), fmt::format("{:.0f}", speed)});
  if (!stream.flush()) throw InputError(fmt::format("{}: cannot be written", file.string()));
}

std::string length_text(double seconds) {
  const auto minutes = std::lround(seconds / 60);
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  return minutes < 60 ? fmt::format("{} min", minutes)
                      : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace pelage
