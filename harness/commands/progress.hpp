// Progress of a long computation on stderr: a bar on a terminal, otherwise one line per finished piece of
// work.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace pelage {

/// Returns a duration as minutes and seconds, "4:05", or with hours, "1:02:09".
std::string clock_text(double seconds);

class Progress {
 public:
  /// `total` is the number of pieces of work. The bar is drawn only if stderr is a terminal.
  explicit Progress(std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void start(const std::string& name);     ///< begins the piece `name`
  void note(const std::string& line);      ///< prints a line above the bar
  void finish(const std::string& result);  ///< ends the piece; without a bar, prints `result`
  void skip(std::size_t pieces);           ///< counts pieces that an earlier run finished

 private:
  void draw() const;
  void clear() const;

  std::size_t total_, done_ = 0, worked_ = 0;
  bool terminal_;
  std::string name_;
  std::chrono::steady_clock::time_point from_ = std::chrono::steady_clock::now();
};

}  // namespace pelage
