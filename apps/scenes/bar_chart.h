// SPDX-License-Identifier: Apache-2.0
//
// BarChart: bars on a logarithmic scale, as an SVG file.
#pragma once

#include <string>
#include <vector>

namespace scenes {

struct Bar {
    std::string name;
    double value = 0;
    double mark = 0;  ///< beside the bar, such as a prediction; 0 for none
};

struct BarPanel {
    std::string title;
    std::vector<Bar> bars;
};

/// Panels below each other, all on one scale.
struct BarChart {
    std::string title;
    std::string unit;
    std::string bars_mean;
    std::string marks_mean;  ///< empty where there are none
    std::vector<BarPanel> panels;
};

/// \pre some value is positive.
[[nodiscard]] std::string svg_of(const BarChart& chart);

}  // namespace scenes
