// SPDX-License-Identifier: Apache-2.0
//
// A grid of cubes, each with the sheet whose triangles have boxes there. Where a cube has several
// sheets, their triangles may meet; most triangles lie in cubes of one sheet only.

#include <trisect/brep/validate/sheet_grid.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <trisect/brep/validate/sheets.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t empty = static_cast<std::uint32_t>(-1);
constexpr std::uint32_t several = static_cast<std::uint32_t>(-2);

// Boxes that come to more cubes than this in the mean would cost more than they save.
constexpr std::size_t most_cubes_a_triangle = 16;
constexpr int least_bits = 3, most_bits = 8;

class SheetGrid {
public:
    SheetGrid(std::span<const LatticePoint> points,
              std::span<const std::array<std::uint32_t, 3>> triangles, double error)
        : boxes_(triangles.size()) {
        LatticeBox all;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            for (const std::uint32_t c : triangles[t]) boxes_[t].add(points[c]);
            if (error > 0) boxes_[t].grow(error);
            all.add(boxes_[t]);
        }
        // About as many cubes as triangles: a surface comes to few of them.
        const int bits = std::clamp((static_cast<int>(std::bit_width(triangles.size())) + 4) / 3,
                                    least_bits, most_bits);
        int shift = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            origin_[k] = coordinate(all.low, k).to_double();
            const double extent = coordinate(all.high, k).to_double() - origin_[k];
            if (extent > 0) shift = std::max(shift, std::ilogb(extent) + 1 - bits);
        }
        scale_ = std::ldexp(1, -shift);
        std::size_t count = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            stride_[k] = count;
            count *= at(all.high, k) + 1;
        }
        cubes_.assign(count, empty);
    }

    [[nodiscard]] std::size_t cubes_of_all_boxes() const {
        std::size_t sum = 0;
        for (const LatticeBox& box : boxes_) {
            std::size_t cubes = 1;
            for (std::size_t k = 0; k < 3; ++k) cubes *= at(box.high, k) - at(box.low, k) + 1;
            sum += cubes;
        }
        return sum;
    }

    void add(std::size_t triangle, std::uint32_t sheet) {
        any_cube_of(triangle, [&](std::uint32_t& cube) {
            const bool is_alone = sheet != no_sheet && (cube == empty || cube == sheet);
            cube = is_alone ? sheet : several;
            return false;
        });
    }
    [[nodiscard]] bool is_near_others(std::size_t triangle) {
        return any_cube_of(triangle, [](const std::uint32_t& cube) { return cube == several; });
    }

private:
    // Monotone in the coordinate, which is all that counts.
    [[nodiscard]] std::size_t at(const LatticePoint& p, std::size_t k) const {
        return static_cast<std::size_t>((coordinate(p, k).to_double() - origin_[k]) * scale_);
    }

    template <class Visit>
    bool any_cube_of(std::size_t triangle, const Visit& visit) {
        const LatticeBox& box = boxes_[triangle];
        const std::size_t begin = at(box.low, 0);
        const std::size_t end = at(box.high, 0) + 1;
        for (std::size_t z = at(box.low, 2); z <= at(box.high, 2); ++z)
            for (std::size_t y = at(box.low, 1); y <= at(box.high, 1); ++y) {
                std::uint32_t* const row = cubes_.data() + z * stride_[2] + y * stride_[1];
                for (std::size_t x = begin; x < end; ++x)
                    if (visit(row[x])) return true;
            }
        return false;
    }

    std::vector<LatticeBox> boxes_;
    Vector3 origin_{};
    double scale_ = 1;
    std::array<std::size_t, 3> stride_{};
    std::vector<std::uint32_t> cubes_;
};

}  // namespace

std::vector<std::uint32_t> triangles_near_others(
    std::span<const LatticePoint> points, std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const std::uint32_t> sheets, double error) {
    SheetGrid grid(points, triangles, error);
    check_stop(triangles.size());
    std::vector<std::uint32_t> near;
    if (grid.cubes_of_all_boxes() > most_cubes_a_triangle * triangles.size()) {
        near.resize(triangles.size());
        std::iota(near.begin(), near.end(), 0U);
        return near;
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) grid.add(t, sheets[t]);
    check_stop(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (grid.is_near_others(t)) near.push_back(static_cast<std::uint32_t>(t));
    return near;
}

}  // namespace trisect::detail
