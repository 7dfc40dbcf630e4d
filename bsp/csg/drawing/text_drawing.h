// SPDX-License-Identifier: Apache-2.0
//
// Outlines of text.
#pragma once

#include <cstdint>
#include <string>

#include <trisect/bsp/csg/drawing/drawing.h>

namespace trisect::detail {

struct TextOptions {
    std::string text;  ///< UTF-8
    std::string font;  ///< a pattern of fontconfig, as "Liberation Sans:style=Bold"
    std::string direction = "ltr";
    std::string language = "en";
    std::string script;
    std::string halign = "left";
    std::string valign = "baseline";
    double size = 10;
    double spacing = 1;
    std::uint32_t segments = 4;  ///< of each curve
};

/// Shapes of glyphs (glyph_shapes.h). Corners are those of the font's design, scaled and rounded
/// once. Sizes are OpenSCAD's: the em is 1.3889 times the size, 1.3880 for TrueType; advances and
/// alignments are 1/1.024 of what they are in the font, and alignments by height are of boxes on a
/// grid of 0.00064 times the size. \throw UnsupportedError in a build without FreeType, fontconfig
/// and HarfBuzz, and where no font is found; LimitError for texts of more than 10,000 bytes, and
/// beyond drawing_limit corners
[[nodiscard]] Drawing text_drawing(const TextOptions& options);

}  // namespace trisect::detail
