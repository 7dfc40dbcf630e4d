// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/certified_cells.h>

#include <cstddef>
#include <utility>

#include <trisect/bsp/interference/certificate/certified_polygon.h>

namespace trisect::detail::certified {

namespace {

std::vector<Polygon> polygons(const Boundary& boundary,
                              const std::vector<CertifiedTriangle>& triangles) {
    std::vector<Polygon> r;
    for (const CertifiedTriangle& t : triangles)
        r.push_back({boundary.at(t.vertex[0]), boundary.at(t.vertex[1]), boundary.at(t.vertex[2])});
    return r;
}

// The pieces of triangles in an open cell, and the planes that bound it: points of it have the sign
// given with each.
struct Cell {
    std::size_t node = 0;
    std::vector<Polygon> of_a;
    std::vector<Polygon> of_b;
    std::vector<std::pair<std::size_t, int>> bounds;
};

std::string wrong_leaf(const InterferenceCertificate& c, const Cell& cell, const Boundary& a,
                       const Boundary& b) {
    const CertifiedCell& leaf = c.cells[cell.node];
    for (const auto& [node, side] : cell.bounds)
        if (value_at(c.cells[node].plane, leaf.point).sign() != side)
            return "the point of a cell is not in it";
    const bool is_of_a = leaf.kind == CertifiedCell::Kind::WithoutA;
    if (!(is_of_a ? cell.of_a : cell.of_b).empty()) return "a boundary reaches into a cell";
    const Relation within = is_of_a ? Relation::Contains : Relation::Inside;
    const Where where = (is_of_a ? a : b).locate(leaf.point);
    const Where enough = c.relation == within ? Where::Inside : Where::Outside;
    return where == enough ? "" : "a cell is on the wrong side";
}

}  // namespace

std::string wrong_cells(const InterferenceCertificate& c, const Boundary& a, const Boundary& b) {
    std::vector<bool> seen(c.cells.size(), false);
    std::vector<Cell> open{{0, polygons(a, c.triangles_a), polygons(b, c.triangles_b), {}}};
    while (!open.empty()) {
        Cell cell = std::move(open.back());
        open.pop_back();
        if (cell.node >= c.cells.size() || seen[cell.node]) return "the cells are no tree";
        seen[cell.node] = true;
        const CertifiedCell& n = c.cells[cell.node];
        if (n.kind != CertifiedCell::Kind::Split) {
            if (std::string wrong = wrong_leaf(c, cell, a, b); !wrong.empty()) return wrong;
            continue;
        }
        if (is_zero(n.plane.normal)) return "a plane of a cell has no normal";
        for (const int side : {1, -1}) {
            Cell half;
            half.node = side < 0 ? cell.node + 1 : n.other;
            half.of_a = beside(cell.of_a, n.plane, side);
            half.of_b = beside(cell.of_b, n.plane, side);
            half.bounds = cell.bounds;
            half.bounds.emplace_back(cell.node, side);
            open.push_back(std::move(half));
        }
    }
    return {};
}

}  // namespace trisect::detail::certified
