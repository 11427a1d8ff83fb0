#include "cli/interruption.h"

#include <unistd.h>

#include <csignal>

namespace grimaldi {
namespace {

// A handler sees nothing but globals; lock-free atomics are safe in it.
std::atomic<bool> stop{false};
std::atomic<bool> running{false};
static_assert(std::atomic<bool>::is_always_lock_free);

struct sigaction old_interrupt, old_terminate;

}  // namespace

extern "C" {
static void on_signal(int) {
  if (!running.load()) {
    constexpr char message[] = "error: interrupted\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof message - 1);
    _exit(1);
  }
  stop.store(true);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}
}

Interruption::Interruption() {
  stop.store(false);
  running.store(false);
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;  // a write that is under way goes on
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &old_interrupt);
  sigaction(SIGTERM, &action, &old_terminate);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &old_interrupt, nullptr);
  sigaction(SIGTERM, &old_terminate, nullptr);
}

void Interruption::begin_run() { running.store(true); }

const std::atomic<bool>* Interruption::flag() const { return &stop; }

}  // namespace grimaldi
