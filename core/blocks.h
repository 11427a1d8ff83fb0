#pragma once
// Work cut into numbered blocks, done on any number of threads and committed in the order of the numbers, so that the
// result does not depend on the threads.

#include <atomic>
#include <cstddef>
#include <functional>

namespace grimaldi {

/// Calls work(block, thread) for block = 0 … count−1 on `threads` threads (0 = all processors; thread = 0 … threads−1),
/// in no stated order. If calls throw, the exception of the smallest block number that threw is rethrown when all
/// threads have ended; blocks not yet begun are then left out. `stop`, if given and true, leaves out the blocks not yet
/// begun too. The blocks begun are always 0 … n−1 for some n, and each of them is ended, so the block that wins is the
/// same on any number of threads. The calling thread is thread 0; if the system grants fewer threads, fewer are used.
void for_each_block(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t block, unsigned thread)>& work,
                    const std::atomic<bool>* stop = nullptr);

/// The number of threads that 0 stands for.
unsigned hardware_threads();

}  // namespace grimaldi
