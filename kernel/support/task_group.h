// SPDX-License-Identifier: Apache-2.0
//
// Tasks that always run, and the first failure among them.
//
// A tbb::task_group is bound to the group around it: when that one is cancelled, tasks of the inner
// group that were not yet started never run, and wait() says so by a return value. Results that
// such a task should have written are then missing. The groups here are bound to nothing, neither
// to groups of ours nor to one of the caller, so each task runs once. Work that need not be done
// any more after a failure looks at a SharedFailure instead.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <type_traits>

#include <trisect/kernel/support/handover.h>
#include <trisect/kernel/support/thread_pool.h>

namespace trisect::detail {

/// Of several failures the one with the lowest number, which is what a loop would have met. Safe to
/// use from many threads.
class FirstFailure {
public:
    /// Calls work(); keeps what it throws. Does nothing after a failure with a lower number.
    template <class Work>
    void guard(std::size_t number, const Work& work) {
        if (number > number_.load(std::memory_order_relaxed)) return;
        try {
            work();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (number > number_.load(std::memory_order_relaxed)) return;
            number_.store(number, std::memory_order_relaxed);
            failure_ = std::current_exception();
        }
    }
    /// To be called when all work has ended.
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    std::atomic<std::size_t> number_{std::numeric_limits<std::size_t>::max()};
    std::mutex mutex_;
    std::exception_ptr failure_;
};

/// What branches of a recursion throw when another one has failed. Never leaves the recursion.
struct Abandoned {};

/// The first failure, by time, of a recursion with branches on several threads; the other branches
/// end early. The exception that leaves the recursion is the first one: a limit stays a limit, also
/// where it made other branches end. Safe to use from many threads.
class SharedFailure {
public:
    /// Calls work(); keeps what it throws if it is the first.
    template <class Work>
    void guard(const Work& work) {
        try {
            work();
        } catch (const Abandoned&) {  // the first failure is kept already
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
            failed_.store(true, std::memory_order_release);
        }
    }
    /// \throw Abandoned when some branch has failed.
    void check() const {
        if (failed_.load(std::memory_order_relaxed)) throw Abandoned();
    }
    /// To be called when all branches have ended, at the root. \throw the first failure, if any
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    std::atomic<bool> failed_{false};
    std::mutex mutex_;
    std::exception_ptr failure_;
};

/// Tasks on other threads. Each runs exactly once, before wait() returns. Tasks must not throw.
class TaskGroup {
public:
    TaskGroup() = default;
    TaskGroup(const TaskGroup&) = delete;
    TaskGroup& operator=(const TaskGroup&) = delete;

    template <class Task>
    void run(const Task& task) {
        start_.give();
        try {
            tasks_.run(Start<Task>{this, task});
        } catch (const std::runtime_error&) {
            // oneTBB could not start one more thread. The task was queued before it tried, and
            // runs on a thread that there is, at the latest in wait().
        }
    }
    void wait() {
        tasks_.wait();
        end_.take();
    }

private:
    // The sanitizer does not see that oneTBB orders the making of a task and its start, so what
    // reads the task's own members is not looked at.
    template <class Task>
    struct Start {
        static_assert(std::is_trivially_copyable_v<Task>, "a task holds references");
        TaskGroup* group;
        Task task;
        TRISECT_NOT_BY_THREAD_SANITIZER void operator()() const { group->perform(Task(task)); }
    };
    template <class Task>
    void perform(const Task& task) {
        start_.take();
        task();
        end_.give();
    }

    Handover start_;
    Handover end_;
    PooledTasks tasks_;
};

/// Calls first() and second(), at the same time if another thread is free; the calling thread does
/// second(). While it waits it may do other work of its arena. Both must not throw.
template <class First, class Second>
void fork_join(const First& first, const Second& second) {
    TaskGroup group;
    group.run([&] { first(); });
    second();
    group.wait();
}

/// Calls first() and second(), at the same time if another thread is free; the calling thread does
/// second(), and no work of others while it waits. Throws what first() throws, else what second()
/// throws.
template <class First, class Second>
void both_at_once(const First& first, const Second& second) {
    FirstFailure failure;
    isolated(
        [&] { fork_join([&] { failure.guard(0, first); }, [&] { failure.guard(1, second); }); });
    failure.rethrow();
}

}  // namespace trisect::detail
