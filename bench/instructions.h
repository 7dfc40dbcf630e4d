// SPDX-License-Identifier: Apache-2.0
//
// Instructions of parts of a program, where something counts them.
//
// The processor, if the system lets this thread read its counters; or callgrind, under which the
// program then runs: each part is written to a file of its own.
#pragma once

#include <cstdint>
#include <string>

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#define TRISECT_HAS_CALLGRIND 1
#endif

/// Instructions of this thread in user space; 0 where the machine does not count them.
class Instructions {
public:
    Instructions() {
        perf_event_attr a{};
        a.type = PERF_TYPE_HARDWARE;
        a.size = sizeof a;
        a.config = PERF_COUNT_HW_INSTRUCTIONS;
        a.exclude_kernel = 1;
        a.exclude_hv = 1;
        file_ = static_cast<int>(syscall(SYS_perf_event_open, &a, 0, -1, -1, 0));
    }
    ~Instructions() {
        if (file_ >= 0) close(file_);
    }
    Instructions(const Instructions&) = delete;
    Instructions& operator=(const Instructions&) = delete;
    [[nodiscard]] double now() const {
        std::uint64_t count = 0;
        if (file_ < 0 || read(file_, &count, sizeof count) != sizeof count) return 0;
        return static_cast<double>(count);
    }

private:
    int file_ = -1;
};

/// Parts of a program that runs under `valgrind --tool=callgrind --instr-atstart=no
/// --collect-atstart=no`. Does nothing elsewhere.
class CallgrindParts {
public:
    [[nodiscard]] static bool is_compiled_in() {
#if defined(TRISECT_HAS_CALLGRIND)
        return true;
#else
        return false;
#endif
    }
    /// Only between these is anything counted; between them the program is fifty times as slow.
    void begin() {
        if (counting_) return;
        counting_ = true;
#if defined(TRISECT_HAS_CALLGRIND)
        CALLGRIND_START_INSTRUMENTATION;
#endif
    }
    void end() {
        if (!counting_) return;
        counting_ = false;
#if defined(TRISECT_HAS_CALLGRIND)
        CALLGRIND_STOP_INSTRUMENTATION;
#endif
    }
    template <class Work>
    void count(const std::string& label, const Work& work) const {
        if (!counting_) return work();
#if defined(TRISECT_HAS_CALLGRIND)
        CALLGRIND_TOGGLE_COLLECT;
#endif
        work();
#if defined(TRISECT_HAS_CALLGRIND)
        CALLGRIND_TOGGLE_COLLECT;
        CALLGRIND_DUMP_STATS_AT(label.c_str());
#endif
    }

private:
    bool counting_ = false;
};
