// SPDX-License-Identifier: Apache-2.0
//
// An operator new that counts, and that can be made to fail. Linked into a program, it replaces the
// global one. What C libraries get from malloc goes on undisturbed.
#pragma once

#include <cstdint>

namespace trisect::test {

/// Allocations of this thread, from its construction on: the n-th one (0 is the first) throws
/// std::bad_alloc, all others succeed. Other threads, such as those of oneTBB, are left alone. One
/// object at a time.
class FailingAllocation {
public:
    explicit FailingAllocation(std::int64_t n);
    FailingAllocation(const FailingAllocation&) = delete;
    FailingAllocation& operator=(const FailingAllocation&) = delete;
    ~FailingAllocation();

    /// Whether the allocation that fails was reached.
    [[nodiscard]] bool has_failed() const;
};

/// The same for the allocations of all threads together.
class FailingAllocationAnywhere {
public:
    explicit FailingAllocationAnywhere(std::int64_t n);
    FailingAllocationAnywhere(const FailingAllocationAnywhere&) = delete;
    FailingAllocationAnywhere& operator=(const FailingAllocationAnywhere&) = delete;
    ~FailingAllocationAnywhere();
};

/// Blocks that this thread has got from operator new less those that it has given back. Blocks that
/// travel between threads count where they were made, and where they end.
[[nodiscard]] std::int64_t live_blocks();

/// The blocks of all threads that are not given back, and all that were ever asked for.
[[nodiscard]] std::int64_t live_blocks_anywhere();
[[nodiscard]] std::int64_t allocations_anywhere();

}  // namespace trisect::test
