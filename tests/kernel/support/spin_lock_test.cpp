// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/kernel/support/spin_lock.h>

namespace {

// More threads than most machines have cores, so that one is stopped with the lock now and then.
TEST(SpinLock, LetsOneThreadInAtATime) {
    constexpr std::size_t threads = 8;
    constexpr std::size_t turns = 20000;
    trisect::detail::SpinLock lock;
    std::size_t count = 0;
    {
        std::vector<std::jthread> all;
        for (std::size_t i = 0; i < threads; ++i)
            all.emplace_back([&] {
                for (std::size_t k = 0; k < turns; ++k) {
                    const std::lock_guard guard(lock);
                    ++count;
                }
            });
    }
    EXPECT_EQ(count, threads * turns);
}

}  // namespace
