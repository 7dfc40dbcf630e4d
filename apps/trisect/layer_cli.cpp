// SPDX-License-Identifier: Apache-2.0
//
// $$POLYLINE/id,dir,n,...: dir is 0 for a hole and 1 for an outline, and the first point comes
// again at the end.
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>

#include "layer_stack.h"
#include "values.h"

namespace trisect::app {
namespace {

double top_of(const Layer& layer) { return layer.step ? (*layer.step)[1] : layer.height; }
double bottom_of(const Layer& layer) { return layer.step ? (*layer.step)[0] : layer.height; }

void add_polyline(std::string& out, const Outline& loop, bool is_hole) {
    out += fmt::format("$$POLYLINE/1,{},{}", is_hole ? 0 : 1, loop.size() + 1);
    for (std::size_t i = 0; i <= loop.size(); ++i)
        for (const double c : loop[i % loop.size()]) out += ',' + number_text(c);
    out += '\n';
}

void add_header(std::string& out, const LayerStack& stack, std::size_t count) {
    out += fmt::format(
        "$$HEADERSTART\n$$ASCII\n$$UNITS/1\n$$VERSION/200\n$$LABEL/1,solid\n$$LAYERS/{}\n", count);
    const DrawingFrame frame = stack.frame();
    if (frame.width() >= 0)
        out +=
            fmt::format("$$DIMENSION/{},{},{},{},{},{}\n", number_text(frame.lower[0]),
                        number_text(frame.lower[1]), number_text(bottom_of(stack.layers.front())),
                        number_text(frame.upper[0]), number_text(frame.upper[1]),
                        number_text(top_of(stack.layers.back())));
    out += "$$HEADEREND\n$$GEOMETRYSTART\n";
}

}  // namespace

std::string cli_of_layers(const LayerStack& stack) {
    const auto& layers = stack.layers;
    for (std::size_t i = 1; i < layers.size(); ++i)
        if (!(top_of(layers[i - 1]) < top_of(layers[i])))
            throw UnsupportedError("CLI files have layers in rising order only");
    const bool has_base = !layers.empty() && bottom_of(layers[0]) < top_of(layers[0]);
    std::string out;
    add_header(out, stack, layers.size() + (has_base ? 1 : 0));
    if (has_base) out += "$$LAYER/" + number_text(bottom_of(layers[0])) + '\n';
    for (const Layer& layer : layers) {
        out += "$$LAYER/" + number_text(top_of(layer)) + '\n';
        for (const auto& region : layer.regions)
            for (std::size_t k = 0; k < region.size(); ++k) add_polyline(out, region[k], k > 0);
    }
    return out + "$$GEOMETRYEND\n";
}

}  // namespace trisect::app
