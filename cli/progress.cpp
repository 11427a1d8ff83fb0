#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace grimaldi {

void Progress::show(const std::string& stage, double share) {
  const int percent = std::isfinite(share) ? static_cast<int>(100 * std::clamp(share, 0.0, 1.0)) : 0;
  const bool new_stage = stage != stage_;
  if (terminal_) {
    const auto now = std::chrono::steady_clock::now();
    if (!new_stage && (percent == percent_ || now - last_ < std::chrono::milliseconds(100))) return;
    fmt::print(stderr, "\r\033[K{} {} %", stage, percent);  // back to the first column, rest of the line erased
    last_ = now;
    line_there_ = true;
  } else {
    if (!new_stage && percent / 10 == percent_ / 10) return;
    fmt::print(stderr, "{} {} %\n", stage, percent);
  }
  std::fflush(stderr);
  stage_ = stage;
  percent_ = percent;
}

void Progress::clear() {
  if (line_there_) fmt::print(stderr, "\r\033[K");
  line_there_ = false;
  std::fflush(stderr);
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

}  // namespace grimaldi
