// SPDX-License-Identifier: Apache-2.0
//
// PerThread: one object for each thread, made at its first use.
#pragma once

#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace trisect::detail {

/// An access takes a lock, so there should be one a task. What oneTBB has for this loads its
/// allocator, 0.6 MB of a process, and an operation on one thread never needs that.
template <class T>
class PerThread {
public:
    /// The calling thread's own; make() gives a unique_ptr<T> if it has none yet. The reference is
    /// good as long as *this. A thread that ended leaves its T to be iterated over, and perhaps to
    /// a new thread of the same id.
    template <class Make>
    T& local(const Make& make) {
        const std::thread::id id = std::this_thread::get_id();
        const std::lock_guard lock(mutex_);
        for (const auto& [owner, value] : values_)
            if (owner == id) return *value;
        return *values_.emplace_back(id, make()).second;
    }

    /// Calls each(T&) for all, in the order in which they were made. Not while threads use it.
    template <class Each>
    void for_each(const Each& each) {
        for (const auto& [owner, value] : values_) each(*value);
    }

private:
    std::mutex mutex_;
    std::vector<std::pair<std::thread::id, std::unique_ptr<T>>> values_;
};

}  // namespace trisect::detail
