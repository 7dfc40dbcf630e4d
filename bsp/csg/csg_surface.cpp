// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/primitives/height_field.h>

#include <trisect/bsp/csg/csg_import.h>
#include <trisect/bsp/csg/csg_shapes.h>

#ifdef TRISECT_WITH_PNG
#include <trisect/bsp/csg/drawing/picture.h>
#endif

namespace trisect::detail {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28;
constexpr double base_depth = 1;
constexpr double highest_ground = 1;  // the bottom is at 0, or below where heights need it
// Of pictures: OpenSCAD inverts from 1, not from the brightest.
constexpr double brightest = 255;
constexpr double picture_height = 100;

using Rows = std::vector<std::vector<double>>;

std::vector<double> row_of(const CsgArguments& arguments, std::string_view line) {
    std::vector<double> out;
    const char* at = line.data();
    const char* const end = at + line.size();
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (true) {
        while (at != end && is_blank(*at)) ++at;
        if (at == end) return out;
        double value = 0;
        if (*at == '+') ++at;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || !std::isfinite(value) || (next != end && !is_blank(*next)))
            arguments.fail(ErrorCode::Input, "the height field has a text that is no number");
        out.push_back(value);
        at = next;
    }
}

/// Rows that are shorter than the longest one go on with 0.
Rows rows_of(const CsgArguments& arguments, std::string_view text) {
    Rows out;
    std::size_t width = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        line = line.substr(0, std::min(line.find('#'), line.size()));
        std::vector<double> row = row_of(arguments, line);
        width = std::max(width, row.size());
        if (!row.empty()) out.push_back(std::move(row));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (static_cast<double>(width) * static_cast<double>(out.size()) > shape_limit)
        arguments.fail(ErrorCode::Limit, "too many heights");
    for (auto& row : out) row.resize(width, 0);
    return out;
}

/// From the lowest row up.
Rows rows_of_picture(const CsgArguments& arguments, std::string_view bytes,
                     const std::string& name) {
#ifdef TRISECT_WITH_PNG
    Rows rows = png_brightness(bytes, name, static_cast<std::size_t>(shape_limit));
    std::reverse(rows.begin(), rows.end());
    const bool is_inverted = arguments.truth("invert", false);
    for (auto& row : rows)
        for (double& h : row) h = (is_inverted ? 1 - h : h) * picture_height / brightest;
    return rows;
#else
    (void)bytes;
    arguments.fail(ErrorCode::Unsupported,
                   "the picture " + name + " takes libpng, which this build lacks");
#endif
}

PolygonMesh mesh_of(const Rows& rows, bool center) {
    std::vector<double> heights;
    for (const auto& row : rows) heights.insert(heights.end(), row.begin(), row.end());
    const double least =
        std::min(highest_ground, *std::min_element(heights.begin(), heights.end()));
    HeightGrid grid{heights, static_cast<std::uint32_t>(rows[0].size())};
    if (center)
        grid.origin = {-(static_cast<double>(rows[0].size()) - 1.0) / 2,
                       -(static_cast<double>(rows.size()) - 1.0) / 2};
    return make_height_field(grid, least - base_depth);
}

}  // namespace

PolygonMesh csg_surface(const CsgArguments& arguments, const std::filesystem::path& file) {
    const FileBytes bytes = read_file(file, most_bytes);
    const Rows rows = csg_extension(file) == ".png"
                          ? rows_of_picture(arguments, bytes.view(), file.string())
                          : rows_of(arguments, bytes.view());
    if (rows.size() < 2 || rows[0].size() < 2) return {};
    return mesh_of(rows, arguments.truth("center", false));
}

}  // namespace trisect::detail
