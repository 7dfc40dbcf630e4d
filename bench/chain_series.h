// SPDX-License-Identifier: Apache-2.0
//
// What one question took, cut by cut, and the series of all questions of a chain.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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
    void add_milliseconds(double t) {
        if (next_ == milliseconds_.size()) milliseconds_.push_back(HUGE_VAL);
        milliseconds_[next_] = std::min(milliseconds_[next_], t);
        ++next_;
    }
    /// The same cuts once more: what is kept of each is the least, as the machine disturbs some
    /// cuts of every run, and what the work itself takes is in all of them.
    void again() {
        next_ = 0;
        instructions_.clear();
    }

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
    std::size_t next_ = 0;
    std::vector<double> milliseconds_;
    std::vector<double> instructions_;
};

struct ChainSeries {
    Series cut{"the cut"};
    Series index{"BrepIndex"};
    Series locate{"locate"};
    Series ray{"first_facet"};
    Series nearest{"distance"};
    Series interfere{"interfere"};
    Series aside{"boundary_distance, beside the cut"};
    Series rim{"boundary_distance, the rim equally near"};
    Series replace{"query.replace_a"};
    Series query_relation{"query.relation after it"};
    Series interfere_again{"interfere again"};

    [[nodiscard]] std::array<Series*, 11> all() {
        return {&cut,     &index,          &locate,         &ray,
                &nearest, &interfere,      &aside,          &rim,
                &replace, &query_relation, &interfere_again};
    }
};
