// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/brep/io/file_bytes.h>

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

class Field {
public:
    Field(const Rows& rows, bool center)
        : rows_(rows),
          width_(static_cast<std::uint32_t>(rows[0].size())),
          height_(static_cast<std::uint32_t>(rows.size())),
          x0_(center ? -(width_ - 1.0) / 2 : 0),
          y0_(center ? -(height_ - 1.0) / 2 : 0) {}

    PolygonMesh mesh() {
        double least = highest_ground;
        for (const auto& row : rows_)
            least = std::min(least, *std::min_element(row.begin(), row.end()));
        for (std::uint32_t y = 0; y < height_; ++y)
            for (std::uint32_t x = 0; x < width_; ++x) add_point(x, y, rows_[y][x]);
        add_cells();
        add_below(least - base_depth);
        return std::move(mesh_);
    }

private:
    void add_point(double x, double y, double z) { mesh_.points.push_back({x0_ + x, y0_ + y, z}); }
    [[nodiscard]] std::uint32_t at(std::uint32_t x, std::uint32_t y) const {
        return y * width_ + x;
    }

    void add_cells() {
        for (std::uint32_t y = 0; y + 1 < height_; ++y)
            for (std::uint32_t x = 0; x + 1 < width_; ++x) {
                const double mean =
                    (rows_[y][x] + rows_[y][x + 1] + rows_[y + 1][x] + rows_[y + 1][x + 1]) / 4;
                const auto middle = static_cast<std::uint32_t>(mesh_.points.size());
                add_point(x + 0.5, y + 0.5, mean);
                mesh_.add_triangle(at(x, y), at(x + 1, y), middle);
                mesh_.add_triangle(at(x + 1, y), at(x + 1, y + 1), middle);
                mesh_.add_triangle(at(x + 1, y + 1), at(x, y + 1), middle);
                mesh_.add_triangle(at(x, y + 1), at(x, y), middle);
            }
    }

    /// Walls down to a bottom that has a point below each point of the border.
    void add_below(double bottom) {
        std::vector<std::uint32_t> border;
        for (std::uint32_t x = 0; x + 1 < width_; ++x) border.push_back(at(x, 0));
        for (std::uint32_t y = 0; y + 1 < height_; ++y) border.push_back(at(width_ - 1, y));
        for (std::uint32_t x = width_ - 1; x > 0; --x) border.push_back(at(x, height_ - 1));
        for (std::uint32_t y = height_ - 1; y > 0; --y) border.push_back(at(0, y));
        const auto first = static_cast<std::uint32_t>(mesh_.points.size());
        const auto n = static_cast<std::uint32_t>(border.size());
        for (const std::uint32_t p : border) {
            const Point3d above = mesh_.points[p];
            mesh_.points.push_back({above[0], above[1], bottom});
        }
        std::vector<std::uint32_t> loop;
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t j = (i + 1) % n;
            mesh_.add_triangle(first + i, first + j, border[j]);
            mesh_.add_triangle(first + i, border[j], border[i]);
            loop.push_back(first + n - 1 - i);
        }
        mesh_.add_face(loop);
    }

    const Rows& rows_;
    std::uint32_t width_;
    std::uint32_t height_;
    double x0_;
    double y0_;
    PolygonMesh mesh_;
};

}  // namespace

PolygonMesh csg_surface(const CsgArguments& arguments, const std::filesystem::path& file) {
    const FileBytes bytes = read_file(file, most_bytes);
    const Rows rows = csg_extension(file) == ".png"
                          ? rows_of_picture(arguments, bytes.view(), file.string())
                          : rows_of(arguments, bytes.view());
    if (rows.size() < 2 || rows[0].size() < 2) return {};
    return Field(rows, arguments.truth("center", false)).mesh();
}

}  // namespace trisect::detail
