// SPDX-License-Identifier: Apache-2.0
//
// The library looks at its StopScope while it works. Every eighth look of the calling thread comes
// here, and twenty times a second it takes Python's lock, lets Python run the handlers of signals
// that have arrived, and calls `progress`. So the main thread need not hand its work to another one
// to stay interruptible. While the thread holds a lock of the library, code in Python might wait
// for that lock: only Ctrl-C is looked at then.

#include <algorithm>
#include <vector>

#include <pybind11/stl.h>

#include "bind.h"
#include "run.h"

namespace trisect::python {

namespace {

// Of the `with` blocks that this thread is in, the outermost first.
thread_local std::vector<CallLimits> limits_stack;

const CallLimits no_limits{};

// A `with` block; one object may be entered several times.
struct Limits {
    std::optional<std::uint32_t> threads;
    std::uint64_t max_work = 0;
    std::uint64_t max_memory = 0;
    py::object progress;
};

std::uint64_t smaller_limit(std::uint64_t a, std::uint64_t b) {
    return a == 0 ? b : b == 0 ? a : std::min(a, b);
}

void enter(const Limits& own) {
    CallLimits all = limits_of_thread();
    if (own.threads) all.threads = *own.threads;
    all.max_work = smaller_limit(all.max_work, own.max_work);
    all.max_memory = smaller_limit(all.max_memory, own.max_memory);
    if (!own.progress.is_none()) all.progress = own.progress;
    limits_stack.push_back(std::move(all));
}

}  // namespace

const CallLimits& limits_of_thread() {
    return limits_stack.empty() ? no_limits : limits_stack.back();
}

bool PythonAttendant::goes_on(bool holds_locks) noexcept {
    ++looks_;
    if (stops_) return false;
    if (is_busy_) return true;  // asked by a call that `progress` made
    const Clock::time_point now = Clock::now();
    if (now < next_) return true;
    is_busy_ = true;
    const py::gil_scoped_acquire acquire;
    try {
        if (holds_locks ? is_interrupted() : !ask_python(now)) stops_ = true;
    } catch (py::error_already_set& e) {
        failure_.emplace(std::move(e));
        stops_ = true;
    } catch (...) {
        stops_ = true;
    }
    next_ = Clock::now() + period;
    is_busy_ = false;
    return !stops_;
}

// Whether Ctrl-C came and ends what goes on, as it does where the program has no handler for it.
bool PythonAttendant::is_interrupted() {
    if (PyOS_InterruptOccurred() == 0) return false;
    const py::module_ signals = py::module_::import("signal");
    if (!signals.attr("getsignal")(signals.attr("SIGINT"))
             .is(signals.attr("default_int_handler"))) {
        PyErr_SetInterrupt();  // for later
        return false;
    }
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
}

bool PythonAttendant::ask_python(Clock::time_point now) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!limits_.progress) return true;
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    const py::object answer = limits_.progress(seconds, 8 * looks_);
    return !(py::isinstance<py::bool_>(answer) && !answer.cast<bool>());
}

void bind_limits(py::module_& m) {
    py::class_<Limits>(m, "limits", R"(Limits and progress of the calls in a ``with`` block.

Blocks nest: the smallest limits hold. They are those of one thread.

Parameters
----------
threads : int, optional
    How many threads one call may use; 0, the default, is one for every processor.
    Results do not depend on it.
max_work : int, optional
    Units of work of one call, about a facet or a pair of triangles each; 0 is no limit.
    Work is counted, not timed, so the same call meets the same limit everywhere.
max_memory : int, optional
    Bytes that lists and results of one boolean may hold at once; 0 is no limit.
progress : callable, optional
    Called as ``progress(seconds, steps)`` some twenty times a second by the thread that
    works, with the time since the call began and the number of steps done by this thread;
    less often while something is made that other threads may wait for.
    How many there will be is not known. What it raises ends the call; so does returning False,
    with `CancelledError`.

Raises
------
LimitError
    From calls in the block, when a limit is reached. Operands stay as they were.

Examples
--------
>>> with trisect.limits(threads=1, max_work=10**9):
...     part = plate - hole
)")
        .def(py::init([](std::optional<std::uint32_t> threads, std::uint64_t max_work,
                         std::uint64_t max_memory, py::object progress) {
                 if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
                     throw py::type_error("progress must be callable as progress(seconds, steps)");
                 return Limits{threads, max_work, max_memory, std::move(progress)};
             }),
             py::kw_only(), py::arg("threads") = py::none(), py::arg("max_work") = 0,
             py::arg("max_memory") = 0, py::arg("progress") = py::none())
        .def("__enter__",
             [](py::object self) {
                 enter(self.cast<const Limits&>());
                 return self;
             })
        .def("__exit__", [](const Limits&, const py::args&) { limits_stack.pop_back(); });
}

}  // namespace trisect::python
