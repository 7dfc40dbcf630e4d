// SPDX-License-Identifier: Apache-2.0
//
// Locks that are held while something takes long.
//
// What runs under one looks at the StopScope of its thread, and so comes to the attendant of an
// interpreter. If that called the library from there, the thread might wait for a lock of its own.
#pragma once

#include <mutex>
#include <utility>

#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

/// While it lives, attendants hear that this thread holds locks.
class HeldLock {
public:
    HeldLock() noexcept { ++locks_of_thread; }
    HeldLock(const HeldLock&) = delete;
    HeldLock& operator=(const HeldLock&) = delete;
    ~HeldLock() { --locks_of_thread; }
};

class WorkLock {
public:
    explicit WorkLock(std::mutex& mutex) : lock_(mutex) {}

private:
    std::lock_guard<std::mutex> lock_;
    HeldLock held_;
};

/// std::call_once, for what takes long.
template <class F>
void work_once(std::once_flag& flag, F&& f) {
    std::call_once(flag, [&] {
        const HeldLock held;
        std::forward<F>(f)();
    });
}

}  // namespace trisect::detail
