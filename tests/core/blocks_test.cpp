#include "core/blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace grimaldi {
namespace {

class Blocks : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Threads, Blocks, testing::Values(0u, 1u, 2u, 7u));

TEST_P(Blocks, EveryBlockIsDoneOnce) {
  for (const std::size_t count : {0u, 1u, 3u, 1000u}) {
    std::vector<int> done(count, 0);  // each place is written by one block only
    std::atomic<bool> number_too_large{false};
    const unsigned threads = GetParam() == 0 ? hardware_threads() : GetParam();
    for_each_block(count, GetParam(), [&](std::size_t block, unsigned thread) {
      ++done[block];
      if (thread >= threads) number_too_large = true;
    });
    EXPECT_EQ(done, std::vector<int>(count, 1));
    EXPECT_FALSE(number_too_large);
  }
}

TEST_P(Blocks, AThreadNumberIsNeverInUseTwiceAtOnce) {
  std::array<std::atomic<int>, 64> busy{};
  std::atomic<bool> clash{false};
  for_each_block(500, GetParam(), [&](std::size_t, unsigned thread) {
    if (busy.at(thread).fetch_add(1) != 0) clash = true;
    std::this_thread::yield();
    busy.at(thread).fetch_sub(1);
  });
  EXPECT_FALSE(clash);
}

TEST_P(Blocks, TheSmallestBlockThatThrowsWins) {
  for (int round = 0; round < 20; ++round) {
    std::mutex mutex;
    std::set<std::size_t> begun;
    try {
      for_each_block(1000, GetParam(), [&](std::size_t block, unsigned) {
        {
          const std::lock_guard lock(mutex);
          begun.insert(block);
        }
        if (block == 40) std::this_thread::sleep_for(std::chrono::microseconds(300));  // the later ones throw first
        if (block >= 40) throw std::runtime_error(std::to_string(block));
      });
      FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "40");
    }
    // The blocks begun are 0 … n−1, and after a failure a thread begins none: n ≤ 41 + the other threads.
    EXPECT_EQ(*begun.rbegin() + 1, begun.size());
    EXPECT_LE(begun.size(), 41u + std::max(GetParam(), hardware_threads()));
  }
}

TEST_P(Blocks, StopLeavesOutWhatIsNotBegun) {
  std::atomic<bool> stop{true};
  std::atomic<int> done{0};
  for_each_block(
      100, GetParam(), [&](std::size_t, unsigned) { ++done; }, &stop);
  EXPECT_EQ(done, 0);
  stop = false;
  for_each_block(
      100000, GetParam(),
      [&](std::size_t block, unsigned) {
        ++done;
        if (block == 10) stop = true;
      },
      &stop);
  EXPECT_GE(done, 11);  // 0 … 10 were begun
  EXPECT_LT(done, 100000);
}

TEST(BlocksAlone, AtLeastOneProcessor) {
  EXPECT_GE(hardware_threads(), 1u);
}

TEST(BlocksAlone, MayBeNested) {
  std::atomic<int> sum{0};
  for_each_block(4, 2, [&](std::size_t, unsigned) { for_each_block(5, 2, [&](std::size_t, unsigned) { ++sum; }); });
  EXPECT_EQ(sum, 20);
}

}  // namespace
}  // namespace grimaldi
