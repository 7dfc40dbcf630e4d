// SPDX-License-Identifier: Apache-2.0
//
// ccd_table: all queries of the files in $TRISECT_MODELS/ccd, the table of bench/results/ccd.md.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <vector>

#include <trisect/kernel/diagnostics.h>

#include "../tests/bsp/interference/motion/ccd_file.h"

namespace {

using Clock = std::chrono::steady_clock;

struct Row {
    std::size_t queries = 0;
    std::size_t positive = 0;
    std::size_t agree = 0;
    double microseconds = 0;  // per query
    trisect::MotionCounters counters;
};

Row run(const ccd::File& file, int rounds) {
    Row row;
    const trisect::Diagnostics<trisect::MotionCounters> diagnostics;
    for (const ccd::Query& q : file.queries) {
        ++row.queries;
        row.positive += q.is_contact ? 1U : 0U;
        row.agree += ccd::first_contact(file, q).has_value() == q.is_contact ? 1U : 0U;
    }
    row.counters = diagnostics.counters();
    std::vector<double> times;
    for (int i = 0; i < rounds; ++i) {
        const auto start = Clock::now();
        for (const ccd::Query& q : file.queries) (void)ccd::first_contact(file, q);
        times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    std::nth_element(times.begin(), times.begin() + rounds / 2, times.end());
    row.microseconds =
        times[static_cast<std::size_t>(rounds / 2)] / static_cast<double>(row.queries);
    return row;
}

void print(const char* name, const Row& r) {
    std::printf("| %s | %zu | %zu | %zu | %.1f | %llu | %llu | %llu |\n", name, r.queries,
                r.positive, r.agree, r.microseconds,
                static_cast<unsigned long long>(r.counters.filtered),
                static_cast<unsigned long long>(r.counters.exact),
                static_cast<unsigned long long>(r.counters.coplanar));
}

}  // namespace

int main() try {
    const auto files = ccd::find_files();
    if (files.empty()) {
        std::fputs("ccd_table: no folder ccd in $TRISECT_MODELS\n", stderr);
        return 1;
    }
    std::puts("| file | queries | positive | agree | us/query | filtered | exact | coplanar |");
    std::puts("|---|---:|---:|---:|---:|---:|---:|---:|");
    Row all;
    for (const auto& path : files) {
        const ccd::File file = ccd::read_file(path);
        const Row r = run(file, 21);
        print(file.name.c_str(), r);
        all.microseconds = (all.microseconds * static_cast<double>(all.queries) +
                            r.microseconds * static_cast<double>(r.queries)) /
                           static_cast<double>(all.queries + r.queries);
        all.queries += r.queries;
        all.positive += r.positive;
        all.agree += r.agree;
        all.counters += r.counters;
    }
    print("all", all);
    return all.agree == all.queries ? 0 : 1;
} catch (const std::exception& e) {
    std::fprintf(stderr, "ccd_table: %s\n", e.what());
    return 1;
}
