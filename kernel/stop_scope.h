// SPDX-License-Identifier: Apache-2.0
//
// StopScope: cancellation and a work limit for the current thread.
//
// Evaluation of booleans has options for both. Reading, import, validation and assembly are linear
// or nearly so, but a file may be large and a mesh may be made to be slow. They look at the scope
// of their thread instead of taking an option each, so that functions in between need not pass
// anything on:
//
//     std::atomic<bool> cancel = false;   // set by another thread
//     const StopScope scope(&cancel, 100'000'000);
//     const Solid solid = Solid::from_mesh(read_mesh(path));
//     const PolygonMesh mesh = solid.to_mesh();
//
// Work is counted, not timed: the same input hits the same limit everywhere. One unit is about a
// facet, an edge or a pair of triangles that is looked at. Nothing changes when a call is stopped:
// operands stay as they were, and no part of a result is handed out.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include <trisect/kernel/error.h>

namespace trisect {

class StopScope;

namespace detail {
inline constinit thread_local StopScope* stop_scope_of_thread = nullptr;
}

/// Scopes nest: what stops the outer one stops the inner one too. To be ended in the thread that
/// began it, in the reverse order. Work that a call gives to other threads is not counted;
/// evaluate() counts by its own options and takes the flag of the scope when it was given none.
class StopScope {
public:
    /// \param cancel set by another thread to stop; may be null
    /// \param max_work units of work; 0 means no limit
    explicit StopScope(const std::atomic<bool>* cancel, std::uint64_t max_work = 0)
        : outer_(detail::stop_scope_of_thread), cancel_(cancel), max_work_(max_work) {
        detail::stop_scope_of_thread = this;
    }
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;
    ~StopScope() { detail::stop_scope_of_thread = outer_; }

    /// Units counted so far.
    [[nodiscard]] std::uint64_t work() const { return work_; }

    /// \throw CancelledError, LimitError
    void add(std::uint64_t units) {
        work_ += units;
        if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) throw CancelledError();
        if (max_work_ != 0 && work_ > max_work_)
            throw LimitError("the work budget of " + std::to_string(max_work_) + " is spent");
        if (outer_ != nullptr) outer_->add(units);
    }
    /// The flag of this scope, or of the next one around it that has one.
    [[nodiscard]] const std::atomic<bool>* cancel() const {
        return cancel_ != nullptr || outer_ == nullptr ? cancel_ : outer_->cancel();
    }

private:
    StopScope* outer_;
    const std::atomic<bool>* cancel_;
    std::uint64_t max_work_;
    std::uint64_t work_ = 0;
};

namespace detail {

/// To be called between steps and in loops, by whatever takes long. One comparison where there is
/// no scope. \throw CancelledError, LimitError
inline void check_stop(std::uint64_t units = 1) {
    if (stop_scope_of_thread != nullptr) stop_scope_of_thread->add(units);
}

/// The flag of this thread's scope, or null.
[[nodiscard]] inline const std::atomic<bool>* cancel_of_thread() {
    return stop_scope_of_thread == nullptr ? nullptr : stop_scope_of_thread->cancel();
}

/// \throw CancelledError when the flag is set; null is never set.
inline void check_flag(const std::atomic<bool>* cancel) {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) throw CancelledError();
}

}  // namespace detail

}  // namespace trisect
