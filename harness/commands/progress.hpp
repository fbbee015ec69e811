// Shows the progress of a long computation on stderr: as a bar if stderr is a terminal, otherwise as one line
// per finished item of work.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace pelage {

/// Returns a duration as minutes and seconds, "4:05", or with hours, "1:02:09".
std::string clock_text(double seconds);

class Progress {
 public:
  /// `total` is the number of items of work. The bar is drawn only if stderr is a terminal.
  explicit Progress(std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void start(const std::string& name);  ///< starts the item of work `name`
  void note(const std::string& line);   ///< prints a line above the bar
  /// Ends the current item of work. If stderr is not a terminal, also prints a line with `result`.
  void finish(const std::string& result);
  void skip(std::size_t pieces);  ///< counts `pieces` items as finished; an earlier run finished them

 private:
  void draw() const;
  void clear() const;

  std::size_t total_, done_ = 0, worked_ = 0;
  bool terminal_;
  std::string name_;
  std::chrono::steady_clock::time_point from_ = std::chrono::steady_clock::now();
};

}  // namespace pelage
