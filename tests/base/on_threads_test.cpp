// Every index is worked on once, however many threads there are.
#include "base/on_threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace gearlash::on_threads_test {
namespace {

TEST(OnThreads, EveryIndexOnce) {
  for (const std::size_t threads : {0U, 1U, 2U, 7U}) {
    std::vector<std::atomic<int>> times(1000);
    on_threads(threads, times.size(), [&](std::size_t i) { ++times[i]; });
    for (const std::atomic<int>& count : times) EXPECT_EQ(count, 1);
  }
}

TEST(OnThreads, WithinOneAnother) {
  std::atomic<int> count = 0;
  on_threads(0, 10, [&](std::size_t) { on_threads(0, 10, [&](std::size_t) { ++count; }); });
  EXPECT_EQ(count, 100);
}

TEST(OnThreads, WhatIsThrownIsThrownOn) {
  for (const std::size_t threads : {1U, 4U}) {
    EXPECT_THROW(on_threads(threads, 10,
                            [](std::size_t i) {
                              if (i == 5) throw std::runtime_error("five");
                            }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace gearlash::on_threads_test
