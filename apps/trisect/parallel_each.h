// SPDX-License-Identifier: Apache-2.0
//
// Independent pieces of work on all threads.
#pragma once

#include <tbb/parallel_for.h>

#include <atomic>
#include <cstddef>
#include <exception>
#include <vector>

#include <trisect/kernel/stop_scope.h>

namespace trisect::app {

/// Calls work(i) for i from 0 to count - 1, in any order and at the same time, under `stop`. All
/// are called, whether others fail or not; then the failure with the smallest i is thrown.
template <class Work>
void for_each_in_parallel(std::size_t count, const std::atomic<bool>& stop, const Work& work) {
    std::vector<std::exception_ptr> failures(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const StopScope scope(&stop);
        try {
            work(i);
        } catch (...) {
            failures[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

}  // namespace trisect::app
