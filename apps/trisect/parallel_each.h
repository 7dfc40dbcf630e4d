// SPDX-License-Identifier: Apache-2.0
//
// Independent pieces of work on all threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::app {

/// Calls work(i) for i from 0 to count - 1, in any order and at the same time, under `limits`,
/// which are those of the calling thread's scope. Throws what the failure with the smallest i
/// throws; after a failure those with larger i are stopped, or not begun. Limited work is counted
/// by one thread, so that its limit is hit in the same place everywhere.
template <class Work>
void for_each_in_parallel(std::size_t count, const StopLimits& limits, const Work& work) {
    if (limits.max_work != 0) {
        for (std::size_t i = 0; i < count; ++i) work(i);
        return;
    }
    std::vector<std::atomic<bool>> needless(count);
    detail::ParallelParts(count, 0, 1).for_each([&](std::size_t, std::size_t i, std::size_t end) {
        const StopScope scope(limits);
        for (; i < end; ++i) {
            const StopScope own(&needless[i]);
            try {
                work(i);
            } catch (...) {
                for (std::size_t later = i + 1; later < count; ++later) needless[later] = true;
                throw;
            }
        }
    });
}

}  // namespace trisect::app
