// Progress of long work on stderr: one bar on a terminal, plain lines elsewhere.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace pelage {

/// "4:05", "1:02:09".
std::string clock_text(double seconds);

class Progress {
 public:
  /// `total` pieces of work. The bar is drawn only when stderr is a terminal.
  explicit Progress(std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void start(const std::string& name);     ///< the piece now in hand
  void note(const std::string& line);      ///< a line that stays
  void finish(const std::string& result);  ///< the piece is done; `result` is shown where there is no bar
  void skip(std::size_t pieces);           ///< done before

 private:
  void draw() const;
  void clear() const;

  std::size_t total_, done_ = 0, worked_ = 0;
  bool terminal_;
  std::string name_;
  std::chrono::steady_clock::time_point from_ = std::chrono::steady_clock::now();
};

}  // namespace pelage
