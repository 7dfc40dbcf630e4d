// SPDX-License-Identifier: Apache-2.0
//
// SpinLock: a lock for a handful of steps, whose threads do not sleep.
#pragma once

#include <atomic>
#include <thread>

namespace trisect::detail {

/// For std::lock_guard. Who waits looks again and again, and after some hundred looks lets other
/// threads run in between: to sleep and to be woken takes a hundred times as long as what is done
/// under such a lock. Not recursive, not fair. In a line of the cache of its own, so that looking
/// for it does not slow down work beside it.
class alignas(64) SpinLock {
public:
    void lock() {
        for (int looks = 0; taken_.test_and_set(std::memory_order_acquire);) {
            while (taken_.test(std::memory_order_relaxed))
                if (++looks > most_looks) std::this_thread::yield();
        }
    }
    void unlock() { taken_.clear(std::memory_order_release); }

private:
    static constexpr int most_looks = 256;  // before others may run
    std::atomic_flag taken_;
};

}  // namespace trisect::detail
