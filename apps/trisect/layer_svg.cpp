// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "layer_stack.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr double longer_side = 800;  // pixels; lines are one wide

/// From blue for the lowest to red for the highest.
Color color_of(std::size_t number, std::size_t count) {
    const double part =
        count < 2 ? 0 : static_cast<double>(number) / static_cast<double>(count - 1);
    const auto mixed = [&](double low, double high) {
        return static_cast<std::uint32_t>(low + part * (high - low));
    };
    return {mixed(0x1f, 0xc8) << 16U | mixed(0x5f, 0x3c) << 8U | mixed(0xb4, 0x28)};
}

void add_polygon(std::string& out, const Outline& loop, bool is_hole) {
    out += fmt::format("      <polygon slic3r:type=\"{}\" points=\"", is_hole ? "hole" : "contour");
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if (i > 0) out += ' ';
        out += number_text(loop[i][0]) + ',' + number_text(loop[i][1]);
    }
    out += "\"/>\n";
}

}  // namespace

DrawingFrame LayerStack::frame() const {
    DrawingFrame out = DrawingFrame::empty();
    for (const Layer& layer : layers)
        for (const auto& region : layer.regions)
            for (const DrawingPoint& p : region.front()) out.add(p);
    return out;
}

// The picture is turned over as a whole, so that coordinates stay what they are.
std::string svg_of_layers(const LayerStack& stack) {
    const DrawingFrame frame = stack.frame().with_margin(0.04);
    const double scale = longer_side / std::max(frame.width(), frame.height());
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\" width=\"{}\" height=\"{}\" "
        "viewBox=\"{} {} {} {}\">\n"
        "  <title>Slices</title>\n"
        "  <g transform=\"scale(1,-1)\" stroke-width=\"{}\" stroke-linejoin=\"round\">\n",
        number_text(frame.width() * scale), number_text(frame.height() * scale),
        number_text(frame.lower[0]), number_text(-frame.upper[1] + 0.0), number_text(frame.width()),
        number_text(frame.height()), number_text(1 / scale));
    for (std::size_t i = 0; i < stack.layers.size(); ++i) {
        const Layer& layer = stack.layers[i];
        out += fmt::format("    <g id=\"layer{}\" slic3r:z=\"{}\" fill=\"none\" stroke=\"{}\">\n",
                           i, number_text(layer.height), color_of(i, stack.layers.size()).hex());
        for (const auto& region : layer.regions)
            for (std::size_t k = 0; k < region.size(); ++k) add_polygon(out, region[k], k > 0);
        out += "    </g>\n";
    }
    return out + "  </g>\n</svg>\n";
}

}  // namespace trisect::app
