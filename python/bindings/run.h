// SPDX-License-Identifier: Apache-2.0
//
// Calls into the library without Python's lock, with signals, progress and limits.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include <pybind11/pybind11.h>

#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::python {

namespace py = pybind11;

/// What a `with limits(...)` block sets for the calls of its thread.
struct CallLimits {
    std::uint32_t threads = 0;
    std::uint64_t max_work = 0;
    std::uint64_t max_memory = 0;
    py::object progress;  // null or callable
};

/// Those of this thread; never null.
[[nodiscard]] const CallLimits& limits_of_thread();

/// Lets Python look at signals and call `progress` from within a call of the library.
class PythonAttendant final : public StopAttendant {
public:
    /// \pre the lock is held, here and in the destructor
    explicit PythonAttendant(const CallLimits& limits)
        : limits_(limits), begin_(Clock::now()), next_(begin_ + period) {}
    PythonAttendant(const PythonAttendant&) = delete;
    PythonAttendant& operator=(const PythonAttendant&) = delete;
    ~PythonAttendant() override = default;

    [[nodiscard]] bool goes_on(bool holds_locks) noexcept override;
    [[nodiscard]] const std::atomic<bool>& stops() const { return stops_; }
    /// What a handler of a signal or `progress` raised, if anything.
    void rethrow() {
        if (failure_) throw std::move(*failure_);
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds period{50};

    [[nodiscard]] bool ask_python(Clock::time_point now);
    [[nodiscard]] bool is_interrupted();

    const CallLimits& limits_;
    Clock::time_point begin_;
    Clock::time_point next_;
    std::uint64_t looks_ = 0;
    bool is_busy_ = false;
    std::atomic<bool> stops_{false};
    std::optional<py::error_already_set> failure_;
};

/// Returns f() without Python's lock. Ctrl-C, and `progress` returning False, end it with their
/// exception. \pre f touches no Python object
template <class F>
auto run(F&& f) -> std::invoke_result_t<F> {
    const CallLimits limits = limits_of_thread();
    PythonAttendant attendant(limits);
    try {
        const py::gil_scoped_release release;
        const StopScope scope({&attendant.stops(), limits.max_work, limits.max_memory, &attendant});
        return std::forward<F>(f)();
    } catch (const CancelledError&) {
        attendant.rethrow();
        throw;
    }
}

/// run(), for calls that take threads: f(threads).
template <class F>
auto run_on_threads(F&& f) -> std::invoke_result_t<F, std::uint32_t> {
    const std::uint32_t threads = limits_of_thread().threads;
    return run([&] { return std::forward<F>(f)(threads); });
}

}  // namespace trisect::python
