// SPDX-License-Identifier: Apache-2.0
//
// StopScope: cancellation and limits of what the current thread does.
//
// A file may be large, a mesh may be made to be slow, and a formula may have more cells than fit.
// Whatever takes long looks at the scope of its thread instead of taking options, so that functions
// in between need not pass anything on:
//
//     std::atomic<bool> cancel = false;   // set by another thread
//     const StopScope scope({.cancel = &cancel, .max_work = 100'000'000});
//     const Solid solid = Solid::from_mesh(read_mesh(path));
//     const PolygonMesh mesh = evaluate(solid - tool).to_mesh();
//
// Work is counted, not timed: the same calls hit the same limit everywhere. One unit is about a
// facet, an edge or a pair of triangles that is looked at. Of evaluate() it is a cell that is
// visited, or a pair of polygons that is compared in a leaf. Nothing changes when a call is
// stopped: operands stay as they were, and no part of a result is handed out.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <string>

#include <trisect/kernel/error.h>

namespace trisect {

class StopScope;

namespace detail {
inline constinit thread_local StopScope* stop_scope_of_thread = nullptr;
// How many locks of solids this thread holds (support/work_lock.h).
inline constinit thread_local int locks_of_thread = 0;
}  // namespace detail

/// Asked now and then whether to go on, by the thread that began the scope, from within what takes
/// long. For programs whose events only that thread may look at: interpreters, user interfaces.
class StopAttendant {
public:
    virtual ~StopAttendant() = default;
    /// False stops as a flag does. Asked at every eighth look of the thread, which may be some
    /// hundred nanoseconds or some milliseconds later, and after each long step. Work on other
    /// threads goes on meanwhile: set a flag as well to stop that soon.
    /// \param holds_locks  whether the thread is within something that other calls may wait for:
    /// what is done here must then not call the library, nor wait for another thread that does
    [[nodiscard]] virtual bool goes_on(bool holds_locks) noexcept = 0;
};

struct StopLimits {
    /// Set by another thread to stop; may be null.
    const std::atomic<bool>* cancel = nullptr;
    /// Units of work of all calls in the scope together; 0: no limit. evaluate() does work that is
    /// limited on the calling thread alone.
    std::uint64_t max_work = 0;
    /// Bytes that lists and results of one evaluate() may hold at once, operands and scratch memory
    /// not counted; 0: no limit. Several threads hold more at once than one.
    std::uint64_t max_memory = 0;
    StopAttendant* attendant = nullptr;  ///< may be null
};

/// Scopes nest: what stops the outer one stops the inner one too, work counts in both, and the
/// smallest limit holds. To be ended in the thread that began it, in the reverse order. evaluate()
/// keeps the limits on all its threads, and so do trees of results that are made later, by the
/// first call that needs them: under the scope of that call. Of other calls, work that they give to
/// other threads is not counted.
class StopScope {
public:
    explicit StopScope(const StopLimits& limits)
        : outer_(detail::stop_scope_of_thread), limits_(limits) {
        detail::stop_scope_of_thread = this;
    }
    /// \param cancel set by another thread to stop; may be null
    explicit StopScope(const std::atomic<bool>* cancel)
        : StopScope(StopLimits{cancel, 0, 0, nullptr}) {}
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;
    ~StopScope() { detail::stop_scope_of_thread = outer_; }

    /// Units counted so far.
    [[nodiscard]] std::uint64_t work() const { return work_; }

    /// Counts units of work in this scope and those around it, whatever their limits.
    void count(std::uint64_t units) noexcept {
        for (StopScope* s = this; s != nullptr; s = s->outer_) s->work_ += units;
    }
    /// The same. \throw CancelledError, LimitError
    void add(std::uint64_t units) {
        count(units);
        for (const StopScope* s = this; s != nullptr; s = s->outer_) {
            if (s->is_stopped(units >= long_step)) throw CancelledError();
            if (s->limits_.max_work != 0 && s->work_ > s->limits_.max_work)
                throw_spent(s->limits_.max_work);
        }
    }
    /// After a long step: looks at the flags and at attendants, at once. Counts nothing.
    /// \throw CancelledError
    void end_step() const {
        for (const StopScope* s = this; s != nullptr; s = s->outer_)
            if (s->is_stopped(true)) throw CancelledError();
    }
    /// Looks at the flags of this scope and those around it; other threads may call it, too, and
    /// ask no attendant.
    /// \throw CancelledError
    void check_flags() const {
        for (const StopScope* s = this; s != nullptr; s = s->outer_)
            if (s->is_stopped()) throw CancelledError();
    }

    /// What this scope and those around it have left.
    struct WorkLeft {
        std::uint64_t units = std::numeric_limits<std::uint64_t>::max();
        std::uint64_t max_work = 0;  ///< of the scope that has the least left; 0: no limit
    };
    [[nodiscard]] WorkLeft work_left() const {
        WorkLeft left;
        for (const StopScope* s = this; s != nullptr; s = s->outer_) {
            const std::uint64_t most = s->limits_.max_work;
            if (most == 0) continue;
            const std::uint64_t units = most - std::min(most, s->work_);
            if (left.max_work == 0 || units < left.units) left = {units, most};
        }
        return left;
    }
    /// The smallest limit of memory of this scope and those around it; 0: none.
    [[nodiscard]] std::uint64_t max_memory() const {
        std::uint64_t least = 0;
        for (const StopScope* s = this; s != nullptr; s = s->outer_) {
            const std::uint64_t most = s->limits_.max_memory;
            if (most != 0 && (least == 0 || most < least)) least = most;
        }
        return least;
    }

    [[noreturn]] static void throw_spent(std::uint64_t max_work) {
        throw LimitError("the work budget of " + std::to_string(max_work) + " is spent");
    }

private:
    /// Units of work after which an attendant need not wait for its eighth look.
    static constexpr std::uint64_t long_step = 4096;

    [[nodiscard]] bool is_stopped(bool after_long_step = false) const {
        if (limits_.cancel != nullptr && limits_.cancel->load(std::memory_order_relaxed))
            return true;
        return limits_.attendant != nullptr && !attendant_goes_on(after_long_step);
    }
    [[nodiscard]] bool attendant_goes_on(bool after_long_step) const {
        if (owner_ != &detail::stop_scope_of_thread) return true;  // another thread
        const bool is_due = ++looks_ % 8 == 0 || after_long_step;
        return !is_due || limits_.attendant->goes_on(detail::locks_of_thread > 0);
    }

    StopScope* outer_;
    StopLimits limits_;
    /// The variable of the thread that began this; its address stands for the thread.
    StopScope* const* owner_ = &detail::stop_scope_of_thread;
    mutable std::uint32_t looks_ = 0;  // of the owner only
    mutable std::uint64_t work_ = 0;   // also of scopes that are constants
};

namespace detail {

/// To be called between steps and in loops, by whatever takes long. One comparison where there is
/// no scope. \throw CancelledError, LimitError
inline void check_stop(std::uint64_t units = 1) {
    if (stop_scope_of_thread != nullptr) stop_scope_of_thread->add(units);
}

/// To be called after a step that takes milliseconds and looked at nothing on its way.
/// \throw CancelledError
inline void end_step() {
    if (stop_scope_of_thread != nullptr) stop_scope_of_thread->end_step();
}

/// \throw CancelledError when a flag of the scope is set; null has none.
inline void check_flags(const StopScope* scope) {
    if (scope != nullptr) scope->check_flags();
}

}  // namespace detail

}  // namespace trisect
