// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/height_field.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <trisect/kernel/error.h>

namespace trisect {
namespace {

constexpr std::size_t most_heights = std::size_t{1} << 24;

class HeightField {
public:
    HeightField(const HeightGrid& grid, double base)
        : grid_(grid),
          base_(base),
          width_(grid.columns),
          height_(static_cast<std::uint32_t>(grid.heights.size() / grid.columns)) {}

    PolygonMesh mesh() {
        reserve();
        for (std::uint32_t y = 0; y < height_; ++y)
            for (std::uint32_t x = 0; x < width_; ++x) add_point(x, y, height(x, y));
        add_cells();
        add_below();
        return std::move(mesh_);
    }

private:
    void reserve() {
        const std::size_t cells = std::size_t{width_ - 1} * (height_ - 1);
        const std::size_t border = 2 * (std::size_t{width_} + height_) - 4;
        const std::size_t triangles = 4 * cells + 2 * border;
        mesh_.points.reserve(grid_.heights.size() + cells + border);
        mesh_.corners.reserve(3 * triangles + border);
        mesh_.face_begin.reserve(triangles + 2);
    }
    [[nodiscard]] double height(std::uint32_t x, std::uint32_t y) const {
        return grid_.heights[at(x, y)];
    }
    [[nodiscard]] std::uint32_t at(std::uint32_t x, std::uint32_t y) const {
        return y * width_ + x;
    }
    void add_point(double x, double y, double z) {
        mesh_.points.push_back(
            {grid_.origin[0] + grid_.spacing[0] * x, grid_.origin[1] + grid_.spacing[1] * y, z});
    }

    void add_cells() {
        for (std::uint32_t y = 0; y + 1 < height_; ++y)
            for (std::uint32_t x = 0; x + 1 < width_; ++x) {
                const double sum =
                    height(x, y) + height(x + 1, y) + height(x, y + 1) + height(x + 1, y + 1);
                const auto middle = static_cast<std::uint32_t>(mesh_.points.size());
                add_point(x + 0.5, y + 0.5, sum / 4);
                mesh_.add_triangle(at(x, y), at(x + 1, y), middle);
                mesh_.add_triangle(at(x + 1, y), at(x + 1, y + 1), middle);
                mesh_.add_triangle(at(x + 1, y + 1), at(x, y + 1), middle);
                mesh_.add_triangle(at(x, y + 1), at(x, y), middle);
            }
    }

    /// Walls down to a bottom that has a point below each point of the border.
    void add_below() {
        std::vector<std::uint32_t> border;
        for (std::uint32_t x = 0; x + 1 < width_; ++x) border.push_back(at(x, 0));
        for (std::uint32_t y = 0; y + 1 < height_; ++y) border.push_back(at(width_ - 1, y));
        for (std::uint32_t x = width_ - 1; x > 0; --x) border.push_back(at(x, height_ - 1));
        for (std::uint32_t y = height_ - 1; y > 0; --y) border.push_back(at(0, y));
        const auto first = static_cast<std::uint32_t>(mesh_.points.size());
        const auto n = static_cast<std::uint32_t>(border.size());
        for (const std::uint32_t p : border) {
            const Point3d above = mesh_.points[p];
            mesh_.points.push_back({above[0], above[1], base_});
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

    const HeightGrid& grid_;
    double base_;
    std::uint32_t width_;
    std::uint32_t height_;
    PolygonMesh mesh_;
};

/// Whether middles are strictly between their neighbours once rounded.
bool has_steps(double origin, double spacing, std::size_t count) {
    double before = origin;
    for (std::size_t i = 1; i < 2 * count - 1; ++i) {
        const double at = origin + spacing * (static_cast<double>(i) / 2);
        if (!(at > before) || !std::isfinite(at)) return false;
        before = at;
    }
    return true;
}

void require_grid(const HeightGrid& grid, double base) {
    const std::size_t count = grid.heights.size();
    if (grid.columns < 2 || count % grid.columns != 0 || count / grid.columns < 2)
        throw UsageError("a height field has two rows and columns or more, and whole rows");
    if (count > most_heights) throw LimitError("a height field of more than 2^24 heights");
    if (!std::isfinite(base)) throw UsageError("the base of a height field must be finite");
    for (std::size_t i = 0; i < count; ++i) {
        if (std::isfinite(grid.heights[i]) && grid.heights[i] > base) continue;
        throw UsageError("the height in row " + std::to_string(i / grid.columns) + ", column " +
                         std::to_string(i % grid.columns) + " is not above the base");
    }
    const std::array<std::size_t, 2> counts{grid.columns, count / grid.columns};
    for (std::size_t k = 0; k < 2; ++k)
        if (!std::isfinite(grid.origin[k]) || !(grid.spacing[k] > 0) ||
            !has_steps(grid.origin[k], grid.spacing[k], counts[k]))
            throw UsageError(
                "the spacing of a height field must be positive, and not be lost in "
                "its coordinates");
}

}  // namespace

PolygonMesh make_height_field(const HeightGrid& grid, double base) {
    require_grid(grid, base);
    return HeightField(grid, base).mesh();
}

}  // namespace trisect
