// SPDX-License-Identifier: Apache-2.0
//
// One value for each thread that asks: the same one again, none shared, all seen afterwards.

#include <trisect/kernel/support/per_thread.h>

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace {

using trisect::detail::PerThread;

const auto zero = [] { return std::make_unique<int>(0); };

TEST(PerThread, SameThreadGetsItsOwnAgain) {
    PerThread<int> values;
    int& mine = values.local(zero);
    for (int i = 0; i < 5; ++i) ++values.local(zero);
    EXPECT_EQ(&mine, &values.local(zero));
    EXPECT_EQ(mine, 5);
}

TEST(PerThread, ThreadsAtTheSameTimeShareNothing) {
    constexpr int threads = 8;
    constexpr int rounds = 1000;
    PerThread<int> values;
    std::vector<std::thread> started;
    for (int t = 0; t < threads; ++t)
        started.emplace_back([&] {
            for (int i = 0; i < rounds; ++i) ++values.local(zero);
        });
    for (std::thread& t : started) t.join();
    int sum = 0;
    int count = 0;
    values.for_each([&](const int& v) {
        sum += v;
        ++count;
        EXPECT_EQ(v % rounds, 0);  // a thread that starts late may take over what another one left
    });
    EXPECT_EQ(sum, threads * rounds);
    EXPECT_LE(count, threads);
}

}  // namespace
