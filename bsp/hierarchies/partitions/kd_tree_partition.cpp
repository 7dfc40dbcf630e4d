// SPDX-License-Identifier: Apache-2.0
//
// Where a k-d tree cuts is a choice, and the surface-area heuristic makes it by a guess of the
// cost: a box that comes to the cell meets a part of it with a chance that grows with the part's
// surface, and then pays for the triangles listed there. Sixteen places along each axis are tried.
// Cutting off empty space is a gain by the same formula.
//
// Source: J. MacDonald and K. Booth, Heuristics for ray tracing using space subdivision (1990); I.
// Wald and V. Havran, On building fast kd-trees for ray tracing (2006).

#include <algorithm>

#include <trisect/bsp/hierarchies/partitions/partitions.h>
#include <trisect/bsp/hierarchies/partitions/space_tree_partition.h>

namespace trisect::hierarchies {

namespace {

constexpr std::size_t bins = 16;
/// Of going down a level, in comparisons with a listed triangle.
constexpr double step_cost = 1.5;

double half_surface(const Box& b) {
    const double x = b.hi[0] - b.lo[0];
    const double y = b.hi[1] - b.lo[1];
    const double z = b.hi[2] - b.lo[2];
    return x * y + y * z + z * x;
}

struct Cut {
    std::size_t axis = 0;
    double at = 0;
    double cost = 0;
};

void cut_at(const Box& cell, std::size_t axis, double at, Box& low, Box& high) {
    low = high = cell;
    low.hi[axis] = at;
    high.lo[axis] = at;
}

std::size_t bin_of(double x, const Box& cell, std::size_t axis) {
    const double at = (x - cell.lo[axis]) / (cell.hi[axis] - cell.lo[axis]) * bins;
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(bins - 1)));
}

std::vector<Box> best_cut(const Box& cell, std::span<const std::uint32_t> list,
                          const TriangleBoxes& boxes) {
    const double surface = half_surface(cell);
    Cut best{0, 0, static_cast<double>(list.size())};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double size = cell.hi[axis] - cell.lo[axis];
        if (!(size > 0)) continue;
        std::array<std::size_t, bins> begins{};
        std::array<std::size_t, bins> ends{};
        for (const std::uint32_t i : list) {
            ++begins[bin_of(boxes[i].lo[axis], cell, axis)];
            ++ends[bin_of(boxes[i].hi[axis], cell, axis)];
        }
        std::size_t below = 0;
        std::size_t above = list.size();
        for (std::size_t b = 1; b < bins; ++b) {
            below += begins[b - 1];
            above -= ends[b - 1];
            const double at = cell.lo[axis] + size * static_cast<double>(b) / bins;
            if (!(cell.lo[axis] < at && at < cell.hi[axis])) continue;
            Box low;
            Box high;
            cut_at(cell, axis, at, low, high);
            const double cost = step_cost + (half_surface(low) * static_cast<double>(below) +
                                             half_surface(high) * static_cast<double>(above)) /
                                                surface;
            if (cost < best.cost) best = {axis, at, cost};
        }
    }
    if (!(best.cost < static_cast<double>(list.size()))) return {};
    std::vector<Box> parts(2);
    cut_at(cell, best.axis, best.at, parts[0], parts[1]);
    return parts;
}

SpaceTree kd_tree(const detail::InterferenceModelData&, const TriangleBoxes& boxes) {
    const auto divide = [&boxes](const Box& cell, std::span<const std::uint32_t> list) {
        return best_cut(cell, list, boxes);
    };
    const auto may_meet = [](std::uint32_t, const Box&) { return true; };
    return {boxes, boxes.bounds(), divide, may_meet};
}

}  // namespace

std::unique_ptr<PairStructure> make_kd_tree_partition(const InterferenceModel& a,
                                                      const InterferenceModel& b) {
    return std::make_unique<SpaceTreePartition>("kd-tree", kd_tree, a, b);
}

}  // namespace trisect::hierarchies
