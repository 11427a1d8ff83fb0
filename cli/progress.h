#pragma once
// How far a run is, on stderr.

#include <chrono>
#include <string>

namespace grimaldi {

/// On a terminal one line is rewritten, at most ten times a second; elsewhere a line is printed at the beginning of
/// each stage and every 10 %.
class Progress {
 public:
  explicit Progress(bool terminal) : terminal_(terminal) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` of the stage done, 0 … 1.
  void show(const std::string& stage, double share);
  /// Takes the line away from the terminal.
  void clear();

 private:
  bool terminal_;
  bool line_there_ = false;
  std::string stage_;
  int percent_ = -1;
  std::chrono::steady_clock::time_point last_{};
};

/// True if stderr is a terminal.
bool stderr_is_terminal();

}  // namespace grimaldi
