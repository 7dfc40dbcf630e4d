// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/level_set/level_grid.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

// So that rounding a vertex moves it by less than the tetrahedra of level_set_mesh.cpp stand.
constexpr double most_cells_from_origin = 0x1p20;
// 1.1 are eleven cells of 0.1.
constexpr double nearly_one = 1 - 0x1p-40;

std::array<std::int32_t, 3> cell_counts(const Bounds& box, double edge_length,
                                        std::uint64_t most_cells) {
    std::array<std::int32_t, 3> out{};
    double all = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = box.hi[k] - box.lo[k];
        if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k]) || !(length > 0))
            throw UsageError("the box of a level set must be finite and lo < hi on each axis");
        if (!std::isfinite(length)) throw LimitError("the box of a level set is too large");
        const double count = std::max(std::ceil(length / edge_length * nearly_one), 1.0);
        all *= count;
        const double farthest = std::max(std::fabs(box.lo[k]), std::fabs(box.hi[k]));
        if (!(all <= static_cast<double>(most_cells)))
            throw LimitError("a level set of more than " + std::to_string(most_cells) + " cells");
        if (!(farthest <= length / count * most_cells_from_origin))
            throw LimitError("the box of a level set is more than 2^20 cells from the origin");
        out[k] = static_cast<std::int32_t>(count);
    }
    return out;
}

std::vector<double> planes_of(double lo, double hi, std::int32_t cells) {
    std::vector<double> out(static_cast<std::size_t>(2 * cells) + 3);
    const auto at = [&](std::int32_t i) -> double& { return out[static_cast<std::size_t>(i) + 1]; };
    for (std::int32_t i = 0; i < cells; ++i) at(2 * i) = lo + (hi - lo) * i / cells;
    at(2 * cells) = hi;
    for (std::int32_t i = 0; i < cells; ++i)
        at(2 * i + 1) = at(2 * i) + (at(2 * i + 2) - at(2 * i)) / 2;
    out.front() = lo;
    out.back() = hi;
    return out;
}

}  // namespace

LevelGrid::LevelGrid(const Bounds& box, double edge_length, std::uint64_t most_cells) {
    if (!(edge_length > 0) || !std::isfinite(edge_length))
        throw UsageError("the edge length of a level set must be positive");
    cells_ = cell_counts(box, edge_length, most_cells);
    corner_count_ = centre_count_ = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        planes_[k] = planes_of(box.lo[k], box.hi[k], cells_[k]);
        cell_size_[k] = (box.hi[k] - box.lo[k]) / cells_[k];
        corner_steps_[k] = corner_count_;
        centre_steps_[k] = centre_count_;
        corner_count_ *= static_cast<std::size_t>(cells_[k]) + 1;
        centre_count_ *= static_cast<std::size_t>(cells_[k]) + 2;
    }
}

std::size_t LevelGrid::number(const NodePoint& p) const {
    const bool is_centre = p[0] % 2 != 0;
    std::size_t out = is_centre ? corner_count_ : 0;
    for (std::size_t k = 0; k < 3; ++k)
        out += is_centre ? static_cast<std::size_t>((p[k] + 1) / 2) * centre_steps_[k]
                         : static_cast<std::size_t>(p[k] / 2) * corner_steps_[k];
    return out;
}

NodePoint LevelGrid::point(std::size_t number) const {
    const bool is_centre = number >= corner_count_;
    if (is_centre) number -= corner_count_;
    const auto& steps = is_centre ? centre_steps_ : corner_steps_;
    NodePoint out{};
    for (std::size_t k = 3; k-- > 0;) {
        out[k] = static_cast<std::int32_t>(number / steps[k]) * 2 - (is_centre ? 1 : 0);
        number %= steps[k];
    }
    return out;
}

Point3d LevelGrid::place(const NodePoint& p) const {
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = planes_[k][static_cast<std::size_t>(p[k] + 1)];
    return out;
}

bool LevelGrid::is_node(const NodePoint& p) const {
    int beyond = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (p[k] < -1 || p[k] > 2 * cells_[k] + 1) return false;
        if (p[k] == -1 || p[k] == 2 * cells_[k] + 1) ++beyond;
    }
    return beyond <= 1;
}

bool LevelGrid::is_inner(const NodePoint& p) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (p[k] <= 0 || p[k] >= 2 * cells_[k]) return false;
    return true;
}

NodePoint LevelGrid::along(const NodePoint& p, int direction) {
    NodePoint out = p;
    if (direction >= short_directions) {
        out[static_cast<std::size_t>(direction - short_directions)] += 2;
        return out;
    }
    for (std::size_t k = 0; k < 3; ++k)
        out[k] += ((static_cast<unsigned>(direction) >> k) & 1U) != 0 ? 1 : -1;
    return out;
}

bool LevelGrid::is_edge(const NodePoint& p, int direction) const {
    const bool is_centre = p[0] % 2 != 0;
    const NodePoint q = along(p, direction);
    if (direction >= short_directions) {
        // Between centres on one side of the box there are corners.
        const auto axis = static_cast<std::size_t>(direction - short_directions);
        for (std::size_t k = 0; k < 3; ++k)
            if (is_centre && k != axis && (p[k] < 0 || p[k] > 2 * cells_[k])) return false;
        return is_node(q);
    }
    if (!is_centre) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (q[k] < 0 || q[k] > 2 * cells_[k]) return false;
    return true;
}

}  // namespace trisect::detail
