#pragma once
// Time on the wall and of the processors.

#include <chrono>
#include <ctime>

namespace grimaldi {

/// Seconds since it was made: on the wall, and of the processors that this program used.
class Stopwatch {
 public:
  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(); }
  double processor() const { return double(std::clock() - processor_) / CLOCKS_PER_SEC; }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t processor_ = std::clock();
};

}  // namespace grimaldi
