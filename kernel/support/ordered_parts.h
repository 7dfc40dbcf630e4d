// SPDX-License-Identifier: Apache-2.0
//
// Pipelines of two stages: parts made by several threads, used by one in their order.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/thread_pool.h>

namespace trisect::detail {

/// Calls make(part) for each of `count` parts on any of `threads` threads, 0 meaning as many as
/// there are here, and use(part) on the calling thread, in the order of the parts, once it is made.
/// Where the next part is not made the calling thread makes others. Throws what the first part that
/// fails throws; no later one is used. CancelledError when the StopScope of the calling thread was
/// cancelled before a part was begun.
template <class Make, class Use>
void for_each_in_order(std::size_t count, std::uint32_t threads, const Make& make, const Use& use) {
    enum State : int { Waiting, Begun, Made };
    const auto states = std::make_unique<std::atomic<int>[]>(count);
    FirstFailure failure;
    const StopScope* const scope = stop_scope_of_thread;
    // False where another thread has begun it.
    const auto begin = [&](std::size_t part) {
        int waiting = Waiting;
        if (!states[part].compare_exchange_strong(waiting, Begun)) return false;
        failure.guard(2 * part, [&] {
            check_flags(scope);
            make(part);
        });
        states[part].store(Made, std::memory_order_release);
        states[part].notify_one();
        return true;
    };
    isolated([&] {
        TaskGroup group;
        const std::size_t others =
            std::min(threads != 0 ? std::size_t{threads} : threads_here(), count);
        const auto begin_all = [&] {
            for (std::size_t part = 0; part < count; ++part) static_cast<void>(begin(part));
        };
        for (std::size_t i = 1; i < others; ++i) group.run(begin_all);
        for (std::size_t part = 0; part < count; ++part) {
            static_cast<void>(begin(part));
            for (std::size_t next = part + 1; next < count && states[part].load() != Made; ++next)
                static_cast<void>(begin(next));
            states[part].wait(Begun, std::memory_order_acquire);
            failure.guard(2 * part + 1, [&] { use(part); });
        }
        group.wait();
    });
    failure.rethrow();
}

}  // namespace trisect::detail
