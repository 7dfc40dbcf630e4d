// SPDX-License-Identifier: Apache-2.0
//
// Memory that is given comes back to the same thread, and no more than two of it.

#include <trisect/kernel/support/spares.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

namespace {

struct Array {
    std::vector<int> values;
    [[nodiscard]] std::size_t bytes() const { return values.capacity() * sizeof(int); }
};
using Spares = trisect::detail::Spares<Array>;

Array with_room(std::size_t room) {
    Array a;
    a.values.reserve(room);
    return a;
}

TEST(Spares, ComeBackLastFirst) {
    EXPECT_EQ(Spares::take().values.capacity(), 0U);
    Spares::give(with_room(10));
    Spares::give(with_room(20));
    Spares::give(with_room(30));  // no room for it
    EXPECT_EQ(Spares::take().values.capacity(), 20U);
    EXPECT_EQ(Spares::take().values.capacity(), 10U);
    EXPECT_EQ(Spares::take().values.capacity(), 0U);
}

TEST(Spares, StayWithTheirThread) {
    Spares::give(with_room(10));
    std::thread([] {
        EXPECT_EQ(Spares::take().values.capacity(), 0U);
        Spares::give(with_room(20));
    }).join();
    EXPECT_EQ(Spares::take().values.capacity(), 10U);
}

TEST(Spares, AreGivenBackAtTheEndOfAScope) {
    std::thread([] {
        {
            trisect::detail::Spare<Array> spare;
            spare->values.reserve(10);
        }
        {
            trisect::detail::Spare<Array> again;
            EXPECT_EQ((*again).values.capacity(), 10U);
            again->values.reserve(1U << 19U);  // more than is kept
        }
        EXPECT_EQ(Spares::take().values.capacity(), 0U);
    }).join();
}

// Destroyed after what the thread keeps, like an object with static lifetime.
struct Late {
    ~Late() {
        EXPECT_EQ(Spares::take().values.capacity(), 0U);
        Spares::give(with_room(10));
    }
};

TEST(Spares, KeepNothingWhenTheThreadEnds) {
    std::thread([] {
        static thread_local Late late;  // made first, destroyed last
        (void)&late;
        Spares::give(with_room(20));
    }).join();
}

}  // namespace
