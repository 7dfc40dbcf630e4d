// SPDX-License-Identifier: Apache-2.0
//
// Threads of oneTBB, or the calling thread alone.
// With concurrent_map.h the only header that includes oneTBB. Where TRISECT_WITHOUT_TBB is defined,
// all work is done by the calling thread, in the order of the calls. Results are the
// same.
#pragma once

#include <cstddef>
#include <cstdint>

#ifdef TRISECT_WITHOUT_TBB

namespace trisect::detail {

inline constexpr bool has_threads = false;

class PooledTasks {
public:
    template <class Task>
    void run(const Task& task) {
        task();
    }
    void wait() {}
};

[[nodiscard]] inline std::size_t threads_here() { return 1; }
[[nodiscard]] inline std::size_t threads_of_machine() { return 1; }
[[nodiscard]] inline std::size_t stack_of_a_thread() { return 0; }

template <class Work>
auto isolated(const Work& work) {
    return work();
}

template <class Work>
auto in_arena(std::uint32_t /*threads*/, const Work& work) {
    return work();
}

class ThreadLimit {
public:
    explicit ThreadLimit(std::size_t /*threads*/) {}
};

}  // namespace trisect::detail

#else

#include <algorithm>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

namespace trisect::detail {

inline constexpr bool has_threads = true;

/// Tasks that are bound to no group around them (task_group.h says why).
class PooledTasks {
public:
    /// \throw std::runtime_error where a thread could not be started; the task runs all the same.
    template <class Task>
    void run(const Task& task) {
        group_.run(task);
    }
    void wait() { group_.wait(); }

private:
    tbb::task_group_context context_{tbb::task_group_context::isolated};
    tbb::task_group group_{context_};
};

/// How many threads may work at once here, at most.
[[nodiscard]] inline std::size_t threads_here() {
    return std::min(
        static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}
[[nodiscard]] inline std::size_t threads_of_machine() {
    return static_cast<std::size_t>(tbb::info::default_concurrency());
}
/// In bytes.
[[nodiscard]] inline std::size_t stack_of_a_thread() {
    return tbb::global_control::active_value(tbb::global_control::thread_stack_size);
}

/// Returns work(); while it waits for tasks, the calling thread does none of others.
template <class Work>
auto isolated(const Work& work) {
    return tbb::this_task_arena::isolate(work);
}

/// Returns work(), done by that many threads at most; 0: as many as the machine has.
template <class Work>
auto in_arena(std::uint32_t threads, const Work& work) {
    tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
    return arena.execute(work);
}

/// At most so many threads work in the whole process while the object lives.
class ThreadLimit {
public:
    explicit ThreadLimit(std::size_t threads)
        : control_(tbb::global_control::max_allowed_parallelism, threads) {}

private:
    tbb::global_control control_;
};

}  // namespace trisect::detail

#endif
