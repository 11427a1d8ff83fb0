#include "core/blocks.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace grimaldi {

unsigned hardware_threads() {
  return std::max(1u, std::thread::hardware_concurrency());
}

void for_each_block(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t block, unsigned thread)>& work,
                    const std::atomic<bool>* stop) {
  if (count == 0) return;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;  // guards the two below
  std::exception_ptr failure;
  std::size_t failed_block = std::numeric_limits<std::size_t>::max();

  // The flags are read before a number is taken, and a number taken is always done: so the blocks begun are 0 … n−1 for
  // some n, and the smallest block that throws is the same for any number of threads.
  const auto run = [&](unsigned thread) noexcept {
    while (!failed.load(std::memory_order_relaxed) && !(stop != nullptr && stop->load(std::memory_order_relaxed))) {
      const std::size_t block = next.fetch_add(1, std::memory_order_relaxed);
      if (block >= count) return;
      try {
        work(block, thread);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (block < failed_block) {
          failed_block = block;
          failure = std::current_exception();
        }
        failed.store(true, std::memory_order_relaxed);
      }
    }
  };

  const std::size_t wanted = std::min<std::size_t>(threads == 0 ? hardware_threads() : threads, count);
  {
    std::vector<std::jthread> workers;  // the calling thread is number 0
    workers.reserve(wanted - 1);
    for (unsigned thread = 1; thread < wanted; ++thread) {
      try {
        workers.emplace_back([&run, thread] { run(thread); });
      } catch (const std::system_error&) {
        break;  // the system grants no more threads: those that run do all the blocks
      }
    }
    run(0);
  }  // joins
  if (failure) std::rethrow_exception(failure);
}

}  // namespace grimaldi
