// SPDX-License-Identifier: Apache-2.0
//
// Drawings as SVG.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "color.h"

namespace trisect::app {

/// A point of a drawing in its own units, v upwards.
using DrawingPoint = std::array<double, 2>;

struct DrawingFrame {
    DrawingPoint lower{};
    DrawingPoint upper{};
    [[nodiscard]] double width() const { return upper[0] - lower[0]; }
    [[nodiscard]] double height() const { return upper[1] - lower[1]; }
    void add(const DrawingPoint& p);
    /// Larger on each side by a part of the longer side; never empty.
    [[nodiscard]] DrawingFrame with_margin(double part) const;
    /// Around nothing yet.
    [[nodiscard]] static DrawingFrame empty();
};

/// How a shape is drawn. Widths in pixels, whatever the units of the drawing.
struct SvgStyle {
    std::optional<Color> fill;
    double fill_opacity = 1;
    std::optional<Color> stroke;
    double stroke_width = 1;
    double stroke_opacity = 1;
};

/// A document that is built up. Coordinates appear in the file as they were given, with all their
/// digits (`Precise`), or in pixels with two decimals (`Compact`), which is half as long.
class Svg {
public:
    enum class Numbers { Precise, Compact };

    /// The longer side of the frame becomes `pixels` long; `footer` pixels are left free below.
    Svg(const DrawingFrame& frame, double pixels, double footer, std::string_view title,
        Numbers numbers);

    /// Closed polygons as one shape; where an even number of them overlap it is empty.
    void polygons(const std::vector<std::vector<DrawingPoint>>& loops, const SvgStyle& style);
    struct Rectangle {
        DrawingPoint lower;
        DrawingPoint upper;
    };
    /// Rectangles of one style, cut off at the frame.
    void rectangles(const std::vector<Rectangle>& boxes, const SvgStyle& style);
    /// A square with a word beside it in the footer; `left` in pixels. \return where it ends.
    double legend(double left, std::string_view word, const SvgStyle& style);

    /// The whole file.
    [[nodiscard]] std::string document() const;

private:
    [[nodiscard]] std::string point_text(const DrawingPoint& p) const;
    void shape(const std::string& path, const SvgStyle& style);

    DrawingFrame frame_;
    double scale_;
    double width_;
    double height_;
    double footer_;
    Numbers numbers_;
    std::string title_;
    std::string shapes_;
    std::string footer_shapes_;
};

}  // namespace trisect::app
