// SPDX-License-Identifier: Apache-2.0
//
// The scale is logarithmic since structures differ by factors of a hundred.

#include "bar_chart.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace scenes {

namespace {

constexpr double row_height = 20;
constexpr double left = 150;
constexpr double width = 560;
constexpr double panel_gap = 46;
constexpr const char* mark_color = "#4c78a8";
constexpr const char* bar_color = "#b8cce0";

std::string short_number(double v) {
    return v < 100 ? fmt::format("{:.3g}", v) : fmt::format("{:.0f}", v);
}

// Decades from left to right.
struct Scale {
    double from;
    double to;
    [[nodiscard]] double operator()(double v) const {
        const double part = (std::log10(std::max(v, 1e-9)) - from) / (to - from);
        return left + width * std::clamp(part, 0.0, 1.0);
    }
};

Scale scale_of(const BarChart& chart) {
    double low = HUGE_VAL;
    double high = 0;
    for (const BarPanel& panel : chart.panels)
        for (const Bar& bar : panel.bars)
            for (const double v : {bar.value, bar.mark})
                if (v > 0) {
                    low = std::min(low, v);
                    high = std::max(high, v);
                }
    return {std::floor(std::log10(low) - 0.2), std::ceil(std::log10(high) + 0.01)};
}

class Drawing {
public:
    Drawing(const BarChart& chart, double height) : chart_(chart), scale_(scale_of(chart)) {
        add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"760\" height=\"{0:.0f}\" "
            "viewBox=\"0 0 760 {0:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
            "<title>{1}</title>\n<rect width=\"760\" height=\"{0:.0f}\" fill=\"#ffffff\"/>\n"
            "<text x=\"16\" y=\"24\" font-size=\"15\" font-weight=\"bold\" "
            "fill=\"#222\">{1}</text>\n",
            height, chart.title);
    }

    void panel(const BarPanel& panel, double top) {
        const double bottom = top + 14 + static_cast<double>(panel.bars.size()) * row_height;
        add("<text x=\"16\" y=\"{:.0f}\" font-weight=\"bold\" fill=\"#222\">{}</text>\n", top + 4,
            panel.title);
        for (double d = scale_.from; d <= scale_.to; ++d) {
            const double v = std::pow(10, d);
            add("<line x1=\"{0:.1f}\" y1=\"{1:.0f}\" x2=\"{0:.1f}\" y2=\"{2:.0f}\" "
                "stroke=\"#dddddd\"/>\n<text x=\"{0:.1f}\" y=\"{3:.0f}\" text-anchor=\"middle\" "
                "font-size=\"10\" fill=\"#666\">{4:g} {5}</text>\n",
                scale_(v), top + 10, bottom, bottom + 13, v, chart_.unit);
        }
        for (std::size_t i = 0; i < panel.bars.size(); ++i)
            bar(panel.bars[i], top + 14 + row_height * static_cast<double>(i));
    }

    [[nodiscard]] std::string finished(double height) && {
        add("<rect x=\"16\" y=\"{0:.0f}\" width=\"14\" height=\"10\" fill=\"{1}\"/><text x=\"36\" "
            "y=\"{2:.0f}\" fill=\"#444\">{3}</text>\n",
            height - 22, bar_color, height - 13, chart_.bars_mean);
        if (!chart_.marks_mean.empty())
            add("<path d=\"M260 {0:.0f}v10\" stroke=\"{1}\" stroke-width=\"3\"/><text x=\"268\" "
                "y=\"{2:.0f}\" fill=\"#444\">{3}</text>\n",
                height - 22, mark_color, height - 13, chart_.marks_mean);
        return std::move(out_) + "</svg>\n";
    }

private:
    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    }

    void bar(const Bar& bar, double y) {
        add("<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\" fill=\"#222\">{}</text>\n",
            left - 8, y + 13, bar.name);
        const double end = scale_(bar.value);
        double right = end;
        add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"12\" fill=\"{}\"/>\n", left,
            y + 3, end - left, bar_color);
        if (bar.mark > 0) {
            right = std::max(right, scale_(bar.mark));
            add("<path d=\"M{0:.1f} {1:.1f}v16\" stroke=\"{2}\" stroke-width=\"3\"/>\n",
                scale_(bar.mark), y + 1, mark_color);
        }
        add("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"10\" fill=\"#444\">{}</text>\n", right + 5,
            y + 13, short_number(bar.value));
    }

    const BarChart& chart_;
    Scale scale_;
    std::string out_;
};

}  // namespace

std::string svg_of(const BarChart& chart) {
    double height = 80;
    for (const BarPanel& p : chart.panels)
        height += static_cast<double>(p.bars.size()) * row_height + panel_gap;
    Drawing drawing(chart, height);
    double top = 50;
    for (const BarPanel& p : chart.panels) {
        drawing.panel(p, top);
        top += static_cast<double>(p.bars.size()) * row_height + panel_gap;
    }
    return std::move(drawing).finished(height);
}

}  // namespace scenes
