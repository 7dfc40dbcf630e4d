// SPDX-License-Identifier: Apache-2.0
//
// LayerStack: layers of outlines, as files of them hold them.
#pragma once

#include <trisect/brep/primitives/point_2d.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "svg.h"

namespace trisect::app {

/// What a plane cuts.
struct Layer {
    double height = 0;  ///< along the axis of the stack
    /// Between which heights it stands for the solid, where that was said.
    std::optional<std::array<double, 2>> step;
    /// Connected pieces: the outline counter-clockwise, then holes clockwise.
    std::vector<std::vector<Outline>> regions;
    double area = 0;
    double perimeter = 0;
    bool is_exact = true;  ///< no corner was rounded
};

struct LayerStack {
    std::vector<Layer> layers;
    /// Which axis the planes are across: coordinates are (y, z), (x, z) or (x, y). Nothing for a
    /// drawing that has no place in space.
    std::optional<int> axis;

    [[nodiscard]] DrawingFrame frame() const;
};

/// Numbers have the shortest digits that read back as the same doubles.
enum class LayerFormat { Svg, Dxf, Cli, JsonText };

/// A group for each layer, with a polygon for each loop, as Slic3r writes them: `slic3r:z` has the
/// height, `slic3r:type` is contour or hole.
[[nodiscard]] std::string svg_of_layers(const LayerStack& stack);
/// As of version AC1015: closed LWPOLYLINEs at their elevations, on a layer for each layer.
[[nodiscard]] std::string dxf_of_layers(const LayerStack& stack);
/// Common Layer Interface 2.0, as text. Layers have the heights of their upper sides, as it has
/// them, and a first one without outlines the lower side of all.
/// \throw UnsupportedError unless heights rise
[[nodiscard]] std::string cli_of_layers(const LayerStack& stack);
[[nodiscard]] std::string json_of_layers(const LayerStack& stack);

}  // namespace trisect::app
