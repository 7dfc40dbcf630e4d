// SPDX-License-Identifier: Apache-2.0
//
// Tables and charts of comparisons.

#include <algorithm>

#include <fmt/format.h>

#include "bar_chart.h"
#include "comparison.h"

namespace scenes {

namespace {

double micro(double seconds, std::size_t frames) {
    return 1e6 * seconds / static_cast<double>(std::max<std::size_t>(frames, 1));
}
double per_frame(std::uint64_t n, std::size_t frames) {
    return static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(frames, 1));
}

}  // namespace

std::string table_of(const Comparison& c) {
    std::string out =
        "| structure | question | build ms | bytes | depth | Nu | Nbv | Np | closest | exact | F "
        "predicted "
        "us "
        "| F measured us |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const StructureCost& s : c.structures)
        for (const QuestionCost& q : s.questions)
            out += fmt::format(
                "| {} | {} | {:.2f} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {} | "
                "{:.2f} "
                "|\n",
                s.name, to_string(q.question), 1e3 * s.build.seconds, s.build.bytes, s.build.depth,
                per_frame(q.counters.updates, c.frames),
                per_frame(q.counters.volume_tests, c.frames),
                per_frame(q.counters.primitive_tests, c.frames),
                per_frame(q.counters.closest_tests, c.frames),
                per_frame(q.counters.exact_tests, c.frames),
                q.predicted > 0 ? fmt::format("{:.2f}", micro(q.predicted, c.frames)) : "-",
                micro(q.measured, c.frames));
    return out;
}

std::string chart_of(const Comparison& c, const std::string& title) {
    BarChart chart{title,
                   "us",
                   "measured, microseconds a frame",
                   "predicted by F = Nu Cu + Nbv Cbv + Np Cp",
                   {}};
    for (const StructureCost& s : c.structures)
        for (std::size_t k = 0; k < s.questions.size(); ++k) {
            const QuestionCost& q = s.questions[k];
            if (k == chart.panels.size()) chart.panels.push_back({to_string(q.question), {}});
            chart.panels[k].bars.push_back(
                {s.name, micro(q.measured, c.frames), micro(q.predicted, c.frames)});
        }
    return svg_of(chart);
}

}  // namespace scenes
