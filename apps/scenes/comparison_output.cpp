// SPDX-License-Identifier: Apache-2.0
//
// Tables and charts of comparisons. Bars are on a logarithmic scale of microseconds a frame, since
// structures differ by factors of a hundred.

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "comparison.h"

namespace scenes {

namespace {

double micro(double seconds, std::size_t frames) {
    return 1e6 * seconds / static_cast<double>(std::max<std::size_t>(frames, 1));
}
double per_frame(std::uint64_t n, std::size_t frames) {
    return static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(frames, 1));
}

std::string short_number(double v) {
    return v < 100 ? fmt::format("{:.3g}", v) : fmt::format("{:.0f}", v);
}

struct Scale {
    double from;  // decades
    double to;
    double left;
    double width;
    [[nodiscard]] double operator()(double v) const {
        return left +
               width * std::clamp((std::log10(std::max(v, 1e-9)) - from) / (to - from), 0.0, 1.0);
    }
};

constexpr const char* predicted_color = "#4c78a8";
constexpr const char* light_color = "#b8cce0";

}  // namespace

std::string table_of(const Comparison& c) {
    std::string out =
        "| structure | question | build ms | bytes | depth | Nu | Nbv | Np | exact | F predicted "
        "us "
        "| F measured us |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const StructureCost& s : c.structures)
        for (const QuestionCost& q : s.questions)
            out += fmt::format(
                "| {} | {} | {:.2f} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {} | {:.2f} "
                "|\n",
                s.name, to_string(q.question), 1e3 * s.build.seconds, s.build.bytes, s.build.depth,
                per_frame(q.counters.updates, c.frames),
                per_frame(q.counters.volume_tests, c.frames),
                per_frame(q.counters.primitive_tests, c.frames),
                per_frame(q.counters.exact_tests, c.frames),
                q.predicted > 0 ? fmt::format("{:.2f}", micro(q.predicted, c.frames)) : "-",
                micro(q.measured, c.frames));
    return out;
}

std::string chart_of(const Comparison& c, const std::string& title) {
    constexpr double row = 20;
    constexpr double left = 150;
    constexpr double width = 560;
    constexpr double panel_gap = 46;
    double low = 1e300;
    double high = 0;
    std::size_t questions = 0;
    for (const StructureCost& s : c.structures) {
        questions = std::max(questions, s.questions.size());
        for (const QuestionCost& q : s.questions)
            for (const double t : {q.measured, q.predicted})
                if (t > 0) {
                    low = std::min(low, micro(t, c.frames));
                    high = std::max(high, micro(t, c.frames));
                }
    }
    const Scale x{std::floor(std::log10(low) - 0.2), std::ceil(std::log10(high) + 0.01), left,
                  width};
    const double panel = static_cast<double>(c.structures.size()) * row + panel_gap;
    const double height = 50 + static_cast<double>(questions) * panel + 30;
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"760\" height=\"{0:.0f}\" viewBox=\"0 0 "
        "760 "
        "{0:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n<title>{1}</title>\n<rect "
        "width=\"760\" height=\"{0:.0f}\" fill=\"#ffffff\"/>\n<text x=\"16\" y=\"24\" "
        "font-size=\"15\" font-weight=\"bold\" fill=\"#222\">{1}</text>\n",
        height, title);
    for (std::size_t k = 0; k < questions; ++k) {
        const double top = 50 + static_cast<double>(k) * panel;
        const double bottom = top + 14 + static_cast<double>(c.structures.size()) * row;
        out += fmt::format(
            "<text x=\"16\" y=\"{:.0f}\" font-weight=\"bold\" fill=\"#222\">{}</text>\n", top + 4,
            to_string(c.structures.front().questions[k].question));
        for (double d = x.from; d <= x.to; ++d) {
            const double v = std::pow(10, d);
            out += fmt::format(
                "<line x1=\"{0:.1f}\" y1=\"{1:.0f}\" x2=\"{0:.1f}\" y2=\"{2:.0f}\" "
                "stroke=\"#dddddd\"/>\n<text x=\"{0:.1f}\" y=\"{3:.0f}\" text-anchor=\"middle\" "
                "font-size=\"10\" fill=\"#666\">{4:g} us</text>\n",
                x(v), top + 10, bottom, bottom + 13, v);
        }
        double y = top + 14;
        for (const StructureCost& s : c.structures) {
            const QuestionCost& q = s.questions[k];
            out += fmt::format(
                "<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\" fill=\"#222\">{}</text>\n",
                left - 8, y + 13, s.name);
            const double end = x(micro(q.measured, c.frames));
            out += fmt::format(
                "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"12\" fill=\"{}\"/>\n",
                left, y + 3, end - left, light_color);
            if (q.predicted > 0) {
                const double p = x(micro(q.predicted, c.frames));
                out += fmt::format(
                    "<path d=\"M{0:.1f} {1:.1f}v16\" stroke=\"{2}\" stroke-width=\"3\"/>\n", p,
                    y + 1, predicted_color);
            }
            out += fmt::format(
                "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"10\" fill=\"#444\">{}</text>\n",
                std::max(end, q.predicted > 0 ? x(micro(q.predicted, c.frames)) : end) + 5, y + 13,
                short_number(micro(q.measured, c.frames)));
            y += row;
        }
    }
    out += fmt::format(
        "<rect x=\"16\" y=\"{0:.0f}\" width=\"14\" height=\"10\" fill=\"{1}\"/><text x=\"36\" "
        "y=\"{2:.0f}\" fill=\"#444\">measured, microseconds a frame</text>\n<path d=\"M260 "
        "{0:.0f}v10\" stroke=\"{3}\" stroke-width=\"3\"/><text x=\"268\" y=\"{2:.0f}\" "
        "fill=\"#444\">predicted by F = Nu Cu + Nbv Cbv + Np Cp</text>\n</svg>\n",
        height - 22, light_color, height - 13, predicted_color);
    return out;
}

}  // namespace scenes
