// SPDX-License-Identifier: Apache-2.0
//
// What one question took, cut by cut.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "instructions.h"

/// The counters of a chain, and the window of cuts in which parts are written.
struct ChainCounters {
    Instructions instructions;
    CallgrindParts parts;
    int cut = 0;
};

/// Of a processor's time that this thread gets: others may share the machine.
template <class Work>
[[nodiscard]] double milliseconds_of(const Work& work) {
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

class Series {
public:
    explicit Series(std::string name) : name_(std::move(name)) {}

    template <class Work>
    void add(const ChainCounters& counters, const Work& work) {
        const double before = counters.instructions.now();
        add_milliseconds(milliseconds_of(
            [&] { counters.parts.count(name_ + " " + std::to_string(counters.cut), work); }));
        instructions_.push_back(counters.instructions.now() - before);
    }
    void add_milliseconds(double t) { milliseconds_.push_back(t); }

    static void print_head() {
        std::puts(
            "\n| first after a cut | mean ms | 99 % | worst | 10^3 instructions, first 20 | last "
            "20 |");
        std::puts("|---|---:|---:|---:|---:|---:|");
    }
    void print() const {
        if (milliseconds_.empty()) return;
        std::vector<double> sorted = milliseconds_;
        std::ranges::sort(sorted);
        const std::size_t n = sorted.size();
        const std::size_t counted = instructions_.size();
        const std::size_t window = std::min<std::size_t>(counted, 20);
        std::printf("| %s | %.3f | %.3f | %.3f | %.0f | %.0f |\n", name_.c_str(),
                    mean(milliseconds_, 0, n), sorted[n * 99 / 100], sorted[n - 1],
                    mean(instructions_, 0, window) / 1000,
                    mean(instructions_, counted - window, counted) / 1000);
    }

private:
    static double mean(const std::vector<double>& v, std::size_t first, std::size_t end) {
        double sum = 0;
        for (std::size_t i = first; i < end; ++i) sum += v[i];
        return end == first ? 0 : sum / static_cast<double>(end - first);
    }
    std::string name_;
    std::vector<double> milliseconds_;
    std::vector<double> instructions_;
};
