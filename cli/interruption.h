#pragma once
// Ctrl-C and SIGTERM.

#include <atomic>

namespace grimaldi {

/// Catches SIGINT and SIGTERM while it lives; one at a time. Before `begin_run` a signal ends the program at once (exit
/// 1: nothing is written yet); after it, the first signal sets the flag and the second kills.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  void begin_run();
  const std::atomic<bool>* flag() const;
  bool happened() const { return flag()->load(); }
};

}  // namespace grimaldi
