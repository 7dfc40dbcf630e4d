// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_drawing.h>

#include <cmath>
#include <string>

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/formats/input_text.h>

#include <trisect/bsp/csg/csg_import.h>
#include <trisect/bsp/csg/csg_shapes.h>
#include <trisect/bsp/csg/drawing/read_dxf.h>

#ifdef TRISECT_WITH_EXPAT
#include <trisect/bsp/csg/drawing/read_svg.h>
#endif
#ifdef TRISECT_WITH_TEXT
#include <trisect/bsp/csg/drawing/text_drawing.h>
#endif

namespace trisect::detail {

constexpr std::uint64_t most_drawing_bytes = std::uint64_t{1} << 28;

#ifdef TRISECT_WITH_TEXT
Drawing csg_text(const CsgArguments& arguments) {
    TextOptions options;
    options.text = arguments.text("text", "");
    options.font = arguments.text("font", "");
    options.direction = arguments.text("direction", "");
    options.language = arguments.text("language", "");
    options.script = arguments.text("script", "");
    options.halign = arguments.text("halign", "left");
    options.valign = arguments.text("valign", "baseline");
    options.size = arguments.number("size", 10);
    options.spacing = arguments.number("spacing", 1);
    options.segments =
        std::max(csg_fragments(arguments, std::fabs(options.size)) / 8 + 1, std::uint32_t{2});
    return text_drawing(options);
}
#else
Drawing csg_text(const CsgArguments& arguments) {
    arguments.fail(ErrorCode::Unsupported,
                   "text takes FreeType, fontconfig and HarfBuzz, which this build lacks");
}
#endif

Drawing csg_drawing_file(const CsgArguments& arguments, const std::filesystem::path& file,
                         double scale) {
    const FileBytes bytes = read_file(file, most_drawing_bytes);
    const InputText source(bytes.view(), file.string(), ReadLimits(), false);
    const CircleSides sides = [&](double radius) { return csg_fragments(arguments, radius); };
    if (csg_extension(file) == ".dxf") {
        const std::vector<double> origin = arguments.numbers("origin", 2, 0);
        return read_dxf(source,
                        {arguments.text("layer", ""), {origin[0], origin[1]}, scale, sides});
    }
    if (csg_extension(file) != ".svg")
        arguments.fail(ErrorCode::Unsupported, "drawings are DXF or SVG files");
#ifdef TRISECT_WITH_EXPAT
    SvgOptions options;
    options.dots_per_inch = arguments.number("dpi", 72);
    options.is_centered = arguments.truth("center", false);
    return read_svg(source, options);
#else
    arguments.fail(ErrorCode::Unsupported, "SVG takes expat, which this build lacks");
#endif
}

}  // namespace trisect::detail
