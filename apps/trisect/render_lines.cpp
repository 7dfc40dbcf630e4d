// SPDX-License-Identifier: Apache-2.0
//
// Lines are found between neighbouring samples, not by projecting edges: what is hidden is not
// drawn without any further test, and an edge between coplanar triangles does not exist.
//
// Two neighbouring samples that hit different planes p and q have an edge between them, or one
// surface ends there and the other one lies behind. If it is an edge, the planes meet between the
// two rays (or near by: a third, tiny face may lie in between), so their order along the rays
// changes. Otherwise the distance between the planes there tells how far behind the other one is.
//
// A fine mesh of a smooth body is all edges. So with EdgeStyle::Auto an edge is as dark as its
// angle is large, and shallow edges fade where they are crowded: their share of the samples around
// tells.
#include "render_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "parallel_rows.h"

namespace trisect::app {
namespace {

using Eigen::Vector3d;

double smooth_step(double from, double to, double x) {
    const double s = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

std::uint8_t to_byte(double part) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
}

/// What is between two samples.
struct Step {
    double outline = 0;  ///< one surface before another one, or before nothing
    double crease = 0;   ///< an edge: its angle in degrees
};

constexpr double steps_per_degree = 255.0 / 180;

/// The most marked of the steps around each sample.
struct Marks {
    std::vector<std::uint8_t> outline;
    std::vector<std::uint8_t> crease;  ///< angle; 0 where there is no edge
};

class LineFinder {
public:
    LineFinder(const Camera& camera, const SampleGrid& grid) : camera_(camera), grid_(grid) {}

    [[nodiscard]] Marks find() const {
        Marks marks{std::vector<std::uint8_t>(grid_.size.count()),
                    std::vector<std::uint8_t>(grid_.size.count())};
        for_rows(grid_.size.height, [&](std::uint32_t y) { find_in_row(y, marks); });
        return marks;
    }

private:
    /// Each sample looks at all four neighbours and writes only to itself.
    void find_in_row(std::uint32_t y, Marks& marks) const {
        for (std::uint32_t x = 0; x < grid_.size.width; ++x) {
            Step worst;
            const auto look = [&](std::uint32_t i, std::uint32_t j) {
                const Step step = step_between(x, y, i, j);
                worst.outline = std::max(worst.outline, step.outline);
                worst.crease = std::max(worst.crease, step.crease);
            };
            if (x > 0) look(x - 1, y);
            if (y > 0) look(x, y - 1);
            if (x + 1 < grid_.size.width) look(x + 1, y);
            if (y + 1 < grid_.size.height) look(x, y + 1);
            marks.outline[grid_.index(x, y)] = to_byte(worst.outline);
            marks.crease[grid_.index(x, y)] =
                static_cast<std::uint8_t>(std::ceil(worst.crease * steps_per_degree));
        }
    }

    [[nodiscard]] Step step_between(std::uint32_t x, std::uint32_t y, std::uint32_t i,
                                    std::uint32_t j) const {
        const std::size_t a = grid_.index(x, y);
        const std::size_t b = grid_.index(i, j);
        const std::uint32_t p = grid_.look[a];
        const std::uint32_t q = grid_.look[b];
        if (p == q) return {};
        if (p == SurfaceHit::nothing || q == SurfaceHit::nothing) return {1, 0};
        const Look& first = grid_.looks[p];
        const Look& second = grid_.looks[q];
        if (first.plane == second.plane) return {};
        const double jump =
            jump_between({x, y}, {i, j}, first.normal.cast<double>(), second.normal.cast<double>());
        if (jump > 0) return {jump, 0};
        const double cosine = std::clamp(double{first.normal.dot(second.normal)}, -1.0, 1.0);
        return {0, std::acos(cosine) * 180 / std::numbers::pi};
    }

    /// 0 when the two planes meet between the samples or near by, else how much of an outline it
    /// is.
    [[nodiscard]] double jump_between(std::array<std::uint32_t, 2> a,
                                      std::array<std::uint32_t, 2> b, const Vector3d& n,
                                      const Vector3d& m) const {
        const ViewRay ray_a = grid_.ray(camera_, a[0], a[1]);
        const ViewRay ray_b = grid_.ray(camera_, b[0], b[1]);
        const double depth_a = grid_.depth[grid_.index(a[0], a[1])];
        const double depth_b = grid_.depth[grid_.index(b[0], b[1])];
        // Order of the planes along ray a, and along ray b.
        const double at_a = plane_distance(ray_b, depth_b, m, ray_a) - depth_a;
        const double at_b = depth_b - plane_distance(ray_a, depth_a, n, ray_b);
        if (!std::isfinite(at_a) || !std::isfinite(at_b)) return 1;
        // They meet at a + s (b - a); between the samples for s in [0, 1].
        if (at_a != at_b) {
            const double s = at_a / (at_a - at_b);
            if (s > -2 && s < 3) return 0;
        }
        const double spacing = camera_.pixel_width(std::min(depth_a, depth_b)) / grid_.per_pixel;
        const double gap = std::min(std::abs(at_a), std::abs(at_b));
        return smooth_step(3 * spacing, 12 * spacing, gap);
    }

    const Camera& camera_;
    const SampleGrid& grid_;
};

/// Sums over rectangles in constant time.
class SummedArea {
public:
    SummedArea(PixelSize size, const std::vector<std::uint8_t>& values)
        : size_(size), sums_(std::size_t{size.width + 1} * (size.height + 1)) {
        for (std::uint32_t y = 0; y < size.height; ++y) {
            std::uint32_t row = 0;
            for (std::uint32_t x = 0; x < size.width; ++x) {
                row += values[std::size_t{y} * size.width + x] != 0 ? 1 : 0;
                at(x + 1, y + 1) = at(x + 1, y) + row;
            }
        }
    }
    /// Part of the non-zero values in the square around (x, y).
    [[nodiscard]] double share(std::uint32_t x, std::uint32_t y, std::uint32_t radius) {
        const std::uint32_t x0 = x - std::min(x, radius);
        const std::uint32_t y0 = y - std::min(y, radius);
        const std::uint32_t x1 = std::min(x + radius + 1, size_.width);
        const std::uint32_t y1 = std::min(y + radius + 1, size_.height);
        const std::uint32_t sum = at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
        return double{static_cast<double>(sum)} / (double(x1 - x0) * double(y1 - y0));
    }

private:
    std::uint32_t& at(std::uint32_t x, std::uint32_t y) {
        return sums_[std::size_t{y} * (size_.width + 1) + x];
    }
    PixelSize size_;
    std::vector<std::uint32_t> sums_;
};

/// How dark an edge of this angle is where this share of the samples lies on edges.
double darkness(double angle, double share) {
    const double sharp = smooth_step(18, 40, angle);
    const double crowd_limit = 0.16 + 0.30 * sharp;
    const double base =
        0.08 + 0.22 * smooth_step(0, 5, angle) + 0.30 * smooth_step(2, 15, angle) + 0.25 * sharp;
    return base * (1 - smooth_step(crowd_limit, 2.2 * crowd_limit, share));
}

std::vector<std::uint8_t> combine(const SampleGrid& grid, const Marks& marks, EdgeStyle style) {
    std::vector<std::uint8_t> lines(grid.size.count());
    SummedArea crowd(grid.size, marks.crease);
    const std::uint32_t radius = 6 * grid.per_pixel;
    for_rows(grid.size.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < grid.size.width; ++x) {
            const std::size_t i = grid.index(x, y);
            double dark = 0.92 * marks.outline[i] / 255;
            if (marks.crease[i] != 0) {
                const double edge =
                    style == EdgeStyle::All
                        ? 0.85
                        : darkness(marks.crease[i] / steps_per_degree, crowd.share(x, y, radius));
                dark = std::max(dark, edge);
            }
            lines[i] = to_byte(dark);
        }
    });
    return lines;
}

/// Each sample takes the darkest one within the radius.
std::vector<std::uint8_t> widened(const SampleGrid& grid, const std::vector<std::uint8_t>& lines,
                                  double radius) {
    std::vector<std::array<int, 2>> offsets;
    const int reach = static_cast<int>(radius);
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            if (i * i + j * j <= radius * radius) offsets.push_back({i, j});
        }
    }
    if (offsets.size() <= 1) return lines;
    std::vector<std::uint8_t> out(lines.size());
    const auto width = static_cast<int>(grid.size.width);
    const auto height = static_cast<int>(grid.size.height);
    for_rows(grid.size.height, [&](std::uint32_t row) {
        for (int x = 0; x < width; ++x) {
            std::uint8_t darkest = 0;
            for (const auto& [i, j] : offsets) {
                const int u = x + i;
                const int v = static_cast<int>(row) + j;
                if (u < 0 || v < 0 || u >= width || v >= height) continue;
                darkest = std::max(darkest, lines[grid.index(static_cast<std::uint32_t>(u),
                                                             static_cast<std::uint32_t>(v))]);
            }
            out[grid.index(static_cast<std::uint32_t>(x), row)] = darkest;
        }
    });
    return out;
}

}  // namespace

std::vector<std::uint8_t> draw_lines(const Camera& camera, const SampleGrid& grid, EdgeStyle style,
                                     double width) {
    if (style == EdgeStyle::None) return std::vector<std::uint8_t>(grid.size.count());
    const Marks marks = LineFinder(camera, grid).find();
    // The samples on both sides of a step are two samples wide.
    const double radius = std::round((width * grid.per_pixel - 2) / 2);
    return widened(grid, combine(grid, marks, style), radius);
}

}  // namespace trisect::app
