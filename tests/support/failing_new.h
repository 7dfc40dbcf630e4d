// SPDX-License-Identifier: Apache-2.0
//
// An operator new that can be made to fail. Linked into a test program, it replaces the global one.
//
// Only allocations of the thread that asks are counted: the threads of oneTBB, and what C libraries
// get from malloc, go on undisturbed.
#pragma once

#include <cstdint>

namespace trisect::test {

/// Allocations of this thread, from its construction on: the n-th one (0 is the first) throws
/// std::bad_alloc, all others succeed. One object at a time.
class FailingAllocation {
public:
    explicit FailingAllocation(std::int64_t n);
    FailingAllocation(const FailingAllocation&) = delete;
    FailingAllocation& operator=(const FailingAllocation&) = delete;
    ~FailingAllocation();

    /// Whether the allocation that fails was reached.
    [[nodiscard]] bool has_failed() const;
};

/// Blocks that this thread has got from operator new and nobody has given back. Blocks that travel
/// between threads count where they were made, and where they end.
[[nodiscard]] std::int64_t live_blocks();

}  // namespace trisect::test
