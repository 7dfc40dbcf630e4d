// SPDX-License-Identifier: Apache-2.0
//
// The box of a turned box is up to three times as long as the body, and the broad phase pays for
// every pair of boxes that meet for no reason. The box of all turned vertices is the best one, but
// costs O(n) for each body and frame. In between: vertices are put into the 4 x 4 x 4 cells of a
// grid over the body, and the tight boxes of the vertices in each cell are turned one by one. What
// a turned box is too large by is then a quarter, and a body of few vertices has parts that are
// points.
//
// Rounding. A row of the map gives m . c + t for a centre c and |m| . h for half sides h. Entries
// have relative errors of 2^-50 (Pose::approximate); each product and sum rounds once, at most ten
// of them for a value, partial sums are at most Q = sum |m_k| (|c_k| + h_k) + |t|. So both ends are
// within Q (2^-50 + 10 2^-53)(1 + 2^-49) < 2^-48 Q of their exact values, Q as computed included.
// Beyond that an underflow may lose a smallest double a few times; `tiny` covers that.
#include <trisect/bsp/interference/scene/body_bounds.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/infinity.h>

namespace trisect::detail {
namespace {

constexpr std::size_t grid_side = 4;
constexpr double tiny = 0x1p-1000;

double next_up(double v) { return std::nextafter(v, infinity); }
double next_down(double v) { return std::nextafter(v, -infinity); }

BodyBox nothing() { return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}; }

void add_point(BodyBox& box, const std::array<double, 3>& p) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], p[k]);
        box.hi[k] = std::max(box.hi[k], p[k]);
    }
}

/// The cell does not need to be exact: any assignment of vertices to boxes will do.
std::size_t cell_of(const std::array<double, 3>& p, const InterferenceModelData& model) {
    std::size_t cell = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double side = model.hi[k] - model.lo[k];
        const double at = side > 0 ? (p[k] - model.lo[k]) / side * grid_side : 0;
        const double clamped = std::clamp(at, 0.0, static_cast<double>(grid_side - 1));
        cell = cell * grid_side + static_cast<std::size_t>(clamped);
    }
    return cell;
}

}  // namespace

BodyBounds::Part BodyBounds::part_of(const BodyBox& box, Lattice lattice, double slack) {
    Part part;
    for (std::size_t k = 0; k < 3; ++k) {
        const double lo = lattice.to_double(box.lo[k]);
        const double hi = lattice.to_double(box.hi[k]);
        part.centre[k] = 0.5 * lo + 0.5 * hi;
        part.half[k] = tiny;
        if (box.lo[k] == box.hi[k] && slack == 0) continue;
        const double reach = std::max(hi - part.centre[k], part.centre[k] - lo);
        const double size = std::max(std::abs(lo), std::abs(hi));
        part.half[k] += next_up(reach) + 2 * lattice.to_double(slack) + size * 0x1p-51;
    }
    return part;
}

BodyBounds::BodyBounds(const InterferenceModelData& model) {
    std::vector<BodyBox> cells(grid_side * grid_side * grid_side, nothing());
    for (const std::array<double, 3>& p : model.positions) add_point(cells[cell_of(p, model)], p);
    for (const BodyBox& cell : cells) {
        if (cell.lo[0] <= cell.hi[0])
            parts_.push_back(part_of(cell, model.lattice, model.position_error));
    }
}

BodyBounds::BodyBounds(const SolidBoundary& solid) {
    for (const DoubleBox& box : solid.outline(grid_side * grid_side * grid_side))
        parts_.push_back(part_of({box.lo, box.hi}, solid.lattice, solid.position_error));
}

BodyBox BodyBounds::under(const std::array<double, 12>& m) const {
    BodyBox out = nothing();
    for (std::size_t i = 0; i < 3; ++i) {
        const double* row = m.data() + 4 * i;
        double most = 0;
        double all = 0;  // finite only if everything was
        for (const Part& p : parts_) {
            const double value =
                row[0] * p.centre[0] + row[1] * p.centre[1] + row[2] * p.centre[2] + row[3];
            const double half = std::abs(row[0]) * p.half[0] + std::abs(row[1]) * p.half[1] +
                                std::abs(row[2]) * p.half[2];
            const double size = std::abs(row[0] * p.centre[0]) + std::abs(row[1] * p.centre[1]) +
                                std::abs(row[2] * p.centre[2]) + half;
            out.lo[i] = std::min(out.lo[i], value - half);
            out.hi[i] = std::max(out.hi[i], value + half);
            most = std::max(most, size);
            all += size + std::abs(value);
        }
        const double error = (most + std::abs(row[3])) * 0x1p-48 + tiny;
        out.lo[i] = next_down(out.lo[i] - error);
        out.hi[i] = next_up(out.hi[i] + error);
        if (!std::isfinite(all + out.lo[i] + out.hi[i])) {
            out.lo[i] = -infinity;
            out.hi[i] = infinity;
        }
    }
    return out;
}

}  // namespace trisect::detail
