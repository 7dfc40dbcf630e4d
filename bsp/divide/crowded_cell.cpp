// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/divide/crowded_cell.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace trisect::detail {

namespace {

// The part of their common box that boxes of operands take in a crowded cell, on average.
constexpr double crowded_share = 0.4;

struct OperandExtent {
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};

    [[nodiscard]] double length(std::size_t k) const { return hi[k] - lo[k]; }
};

// Of what an operand has in the cell, in lattice units.
OperandExtent extent_of(const CellOperand& o, const CellTask& task) {
    OperandExtent e;
    if (o.is_list) {
        for (std::size_t k = 0; k < 3; ++k) {
            e.lo[k] = static_cast<double>(task.frame.last_below(k, o.box.low(k)));
            e.hi[k] = static_cast<double>(task.frame.last_below(k, o.box.high(k) + 1));
        }
        return e;
    }
    Box box;
    const PolygonList& polygons = o.node->polygons();
    const Source* const whole = polygons.has_all_facets() ? polygons.whole_source() : nullptr;
    if (whole != nullptr) {
        box = whole->box();
    } else {
        for (const PolygonRef& r : polygons) box.add(r.box());
    }
    box = box.intersected(task.cell.lattice_box());
    for (std::size_t k = 0; k < 3; ++k) {
        e.lo[k] = static_cast<double>(box.lo[k] - 1);
        e.hi[k] = static_cast<double>(box.hi[k]);
    }
    return e;
}

}  // namespace

bool is_crowded(const CellTask& task) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    OperandExtent all;
    all.lo.fill(infinity);
    all.hi.fill(-infinity);
    std::vector<OperandExtent> extents;
    extents.reserve(task.operands.size());
    for (const CellOperand& o : task.operands) {
        if (o.unbounded || (!o.is_list && !o.node->is_leaf())) return false;
        const OperandExtent& e = extents.emplace_back(extent_of(o, task));
        for (std::size_t k = 0; k < 3; ++k) {
            all.lo[k] = std::min(all.lo[k], e.lo[k]);
            all.hi[k] = std::max(all.hi[k], e.hi[k]);
        }
    }
    double sum = 0;
    for (const OperandExtent& e : extents) {
        double part = 1;
        for (std::size_t k = 0; k < 3; ++k) part *= e.length(k) / all.length(k);
        sum += part;
    }
    return sum >= crowded_share * static_cast<double>(extents.size());
}

}  // namespace trisect::detail
