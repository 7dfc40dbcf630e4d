// SPDX-License-Identifier: Apache-2.0
//
// Diagnostics: numbers of what the calls of one thread did.
//
//     const Diagnostics<EvaluateCounters> diagnostics;
//     const Solid part = evaluate(plate - pocket);
//     std::cout << diagnostics.counters().cells;
//
// Counted is what the thread itself does; calls that share work among threads and say so add the
// work of all of them at their end. A call that fails may add less than it did. There is one
// struct of counters for each kind of call: PredicateCounters (counters.h), EvaluateCounters
// (bsp/expression.h), and those of interference.
//
// Counting is per thread, so that it costs one increment and needs no synchronisation.
#pragma once

namespace trisect {

namespace detail {

/// All that the thread has counted since it began.
template <class Counters>
inline constinit thread_local Counters counters_of_thread{};

}  // namespace detail

/// Counts from its construction on. Any number of them may live at once. To be used in the thread
/// that made it.
template <class Counters>
class Diagnostics {
public:
    Diagnostics() : before_(detail::counters_of_thread<Counters>) {}

    [[nodiscard]] Counters counters() const {
        Counters made = detail::counters_of_thread<Counters>;
        made -= before_;
        return made;
    }

private:
    Counters before_;
};

}  // namespace trisect
