// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/ordered_parts.h>
#include <trisect/kernel/support/thread_pool.h>

namespace trisect::detail {
namespace {

TEST(OrderedParts, AreUsedInTheirOrderByTheCallingThread) {
    for (const std::uint32_t threads : {1U, 2U, 4U})
        in_arena(threads, [&] {
            for (const std::size_t count : {0U, 1U, 2U, 7U, 500U}) {
                std::vector<std::size_t> made(count);
                std::vector<std::size_t> used;
                const auto caller = std::this_thread::get_id();
                for_each_in_order(
                    count, threads, [&](std::size_t part) { made[part] = part * part + 1; },
                    [&](std::size_t part) {
                        EXPECT_EQ(std::this_thread::get_id(), caller);
                        EXPECT_EQ(made[part], part * part + 1);
                        used.push_back(part);
                    });
                ASSERT_EQ(used.size(), count);
                for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(used[i], i);
            }
        });
}

TEST(OrderedParts, TheFirstFailureLeavesAndNoLaterPartIsUsed) {
    for (const bool in_use : {false, true})
        in_arena(4, [&] {
            std::vector<std::size_t> used;
            const auto fail = [](std::size_t part) {
                if (part == 20 || part == 31) throw std::runtime_error(std::to_string(part));
            };
            try {
                for_each_in_order(
                    64, 4, [&](std::size_t part) { in_use ? void() : fail(part); },
                    [&](std::size_t part) {
                        if (in_use) fail(part);
                        used.push_back(part);
                    });
                FAIL();
            } catch (const std::runtime_error& failure) {
                EXPECT_STREQ(failure.what(), "20");
            }
            EXPECT_EQ(used.size(), 20U);
        });
}

TEST(OrderedParts, AreNotBegunAnyMoreWhenCancelled) {
    std::atomic<bool> stop{false};
    const StopScope scope(StopLimits{&stop});
    std::atomic<int> made{0};
    const auto run = [&] {
        for_each_in_order(
            1000, 2,
            [&](std::size_t) {
                if (++made == 10) stop = true;
            },
            [](std::size_t) {});
    };
    EXPECT_THROW(in_arena(2, run), CancelledError);
    EXPECT_LT(made, 1000);
}

}  // namespace
}  // namespace trisect::detail
