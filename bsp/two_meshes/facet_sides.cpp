// SPDX-License-Identifier: Apache-2.0
//
// Cubes without facets of the other mesh that lie side by side are on the same side of it, and so
// is whatever facets lie in them: that gives nine of ten facets their side. What hangs together by
// facets that nothing crosses is on one side as well, so the others get theirs from their
// neighbours, or from a corner in such a cube. Sides themselves come from the crossings: an edge
// that pierces one facet, and no other, has its ends on the two sides of it. What reaches out of
// the grid is far outside. Of parts that nothing pierces a line is followed to there.

#include <trisect/bsp/two_meshes/facet_sides.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include <trisect/bsp/cells/shift/shifted_pairs.h>
#include <trisect/bsp/two_meshes/listed_numbers.h>
#include <trisect/bsp/two_meshes/point_side.h>

namespace trisect::detail {

namespace {

// A line looks at all facets of the other mesh: some milliseconds' worth of them, and a few lines
// beside meshes of any size. With more parts the attempt ends.
constexpr std::size_t facets_on_lines = std::size_t{1} << 22;
constexpr std::size_t few_lines = 8;

}  // namespace

FacetSides::FacetSides(const CubeGrid& grid, const LatticeMesh& mesh, const OccupiedCubes& cubes,
                       const CubeSet& other, std::span<const std::uint32_t> near,
                       std::span<const EqualFacets::Fate> fates, std::uint32_t threads)
    : grid_(grid),
      mesh_(mesh),
      cubes_(cubes),
      other_(other),
      near_(near),
      fates_(fates),
      threads_(threads),
      is_crossed_(near.size()),
      nodes_(mesh.points.size()) {
    list_runs();
}

void FacetSides::list_runs() {
    const std::uint64_t all = ~std::uint64_t{0} >> (CubeGrid::side - 1 - grid_.last(0));
    const std::size_t stride = grid_.row_stride();
    first_run_.assign(grid_.row_count() + 1, 0);
    for (std::size_t row = 0; row < grid_.row_count(); ++row) {
        first_run_[row] = static_cast<std::uint32_t>(runs_.size());
        if (row % stride > grid_.last(1)) continue;
        for (std::uint64_t rest = all & ~other_.row(row); rest != 0;) {
            // The lowest ones in a sequence: what adding the lowest bit carries away.
            const std::uint64_t above = rest + (rest & (~rest + 1));
            runs_.push_back({rest & ~above, row});
            rest &= above;
        }
    }
    first_run_.back() = static_cast<std::uint32_t>(runs_.size());
    parents_.resize(runs_.size());
    std::iota(parents_.begin(), parents_.end(), 0U);
    for (std::size_t row = 0; row < grid_.row_count(); ++row) {
        if (row != 0) join_runs(row, row - 1);  // the one before the first slab has no runs
        if (row >= stride) join_runs(row, row - stride);
    }
}

void FacetSides::join_runs(std::size_t row, std::size_t other_row) {
    for (std::uint32_t i = first_run_[row]; i < first_run_[row + 1]; ++i)
        for (std::uint32_t j = first_run_[other_row]; j < first_run_[other_row + 1]; ++j)
            if ((runs_[i].bits & runs_[j].bits) != 0) join(i, j);
}

std::uint32_t FacetSides::node_of(std::uint32_t point) {
    std::uint32_t& node = nodes_[point];
    if (node != 0) return node - 1;
    const CubeGrid::Cube cube = cubes_.cube_of(point);
    if (other_.has(grid_, cube)) {
        parents_.push_back(static_cast<std::uint32_t>(parents_.size()));
        node = static_cast<std::uint32_t>(parents_.size());
        return node - 1;
    }
    std::uint32_t run = first_run_[grid_.row(cube)];
    while ((runs_[run].bits >> CubeGrid::x(cube) & 1U) == 0) ++run;
    node = run + 1;
    return run;
}

std::uint32_t FacetSides::root(std::uint32_t node) {
    while (parents_[node] != node) node = parents_[node] = parents_[parents_[node]];
    return node;
}

// Every node then has its root for its parent. Parents come before their children.
void FacetSides::flatten() {
    for (std::uint32_t& parent : parents_) parent = parents_[parent];
}

// Of a point that has a node, once all are joined.
FacetSides::Side FacetSides::side_of_joined(std::uint32_t point) const {
    return sides_[parents_[nodes_[point] - 1]];
}

void FacetSides::join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    // Runs stay ahead of points.
    if (a < b) {
        parents_[b] = a;
    } else {
        parents_[a] = b;
    }
}

// False where it was known to be the other one.
bool FacetSides::set_side(std::uint32_t node, Side side) {
    Side& known = sides_[root(node)];
    if (known != Side::Unknown) return known == side;
    known = side;
    return true;
}

void FacetSides::mark_crossed(const Crossings& crossings, std::size_t operand) {
    const std::uint32_t first = crossings.operands[operand].first;
    auto shown = std::ranges::lower_bound(crossings.shown, first);
    for (std::size_t i = 0; i < near_.size() && shown != crossings.shown.end(); ++i) {
        if (first + near_[i] != *shown) continue;
        is_crossed_[i] = 1;
        ++shown;
    }
}

void FacetSides::join_uncrossed() {
    for (std::size_t i = 0; i < near_.size(); ++i) {
        if (is_crossed_[i] != 0 || has_equal(i)) continue;
        const auto& t = mesh_.triangles[near_[i]];
        const std::uint32_t a = node_of(point_of(i));
        for (const std::uint32_t v : t)
            if (v != point_of(i) && !is_common(v)) join(a, node_of(v));
    }
}

// What reaches from a common corner or edge to where the other mesh is not.
bool FacetSides::take_known_sides() {
    if (conforming_ == nullptr) return true;
    for (std::size_t i = 0; i < near_.size(); ++i) {
        const FacetRelation relation = conforming_->relations[i];
        if (relation != FacetRelation::Above && relation != FacetRelation::Below) continue;
        for (const std::uint32_t v : mesh_.triangles[near_[i]]) {
            if (is_common(v)) continue;
            const std::uint32_t node = node_of(v);
            sides_.resize(parents_.size(), Side::Unknown);
            if (!set_side(node, relation == FacetRelation::Above ? Side::Above : Side::Below))
                return false;
        }
    }
    return true;
}

// Of a facet with an equal one only some crossings are.
bool FacetSides::are_pierces_known(std::uint32_t facet) const {
    if (fates_.empty()) return true;
    const auto at = std::ranges::lower_bound(near_, facet);
    return !has_equal(static_cast<std::size_t>(at - near_.begin()));
}

// Such a run ends nowhere, and the other mesh does.
bool FacetSides::look_at_outer_runs(Side side) {
    const std::uint64_t ends = std::uint64_t{1} | std::uint64_t{1} << grid_.last(0);
    for (std::uint32_t i = 0; i < runs_.size(); ++i) {
        const std::size_t y = runs_[i].row % grid_.row_stride();
        const std::size_t z = runs_[i].row / grid_.row_stride();
        const bool is_outer = y == 0 || y == grid_.last(1) || z == 0 || z == grid_.last(2) ||
                              (runs_[i].bits & ends) != 0;
        if (is_outer && !set_side(i, side)) return false;
    }
    return true;
}

// Ends of a crossing come in the direction of the product of the normals. So an edge of the first
// facet goes up through the second one's support where it is the start, an edge of the second one
// down through the first one's (filtered_pair_relation.cpp). All that pierces a facet's edges
// crosses it.
bool FacetSides::look_at_pierced_edges(const Crossings& crossings, std::size_t operand) {
    const std::uint32_t first = crossings.operands[operand].first;
    const auto& pairs = crossings.pairs;
    struct Pierced {
        unsigned often = 0;
        bool up = false;
    };
    const auto is_own = [&](const FacetCrossing::End& end) {
        return end.of_second == (operand == 1);
    };
    const auto look_at = [&](std::uint32_t facet, const std::array<Pierced, 3>& edges) {
        const auto& t = mesh_.triangles[facet - first];
        if (!are_pierces_known(facet - first)) return true;
        for (std::size_t e = 0; e < 3; ++e) {
            if (edges[e].often != 1) continue;
            const std::uint32_t below = node_of(t[edges[e].up ? e : (e + 1) % 3]);
            const std::uint32_t above = node_of(t[edges[e].up ? (e + 1) % 3 : e]);
            sides_.resize(parents_.size(), Side::Unknown);
            if (!set_side(below, Side::Below) || !set_side(above, Side::Above)) return false;
        }
        return true;
    };
    std::array<Pierced, 3> edges;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto pair = [&](std::size_t k) -> const FacetCrossing& {
            return operand == 0 ? pairs[k] : pairs[crossings.by_second[k]];
        };
        const FacetCrossing& c = pair(i);
        const std::uint32_t facet = c.facets[operand];
        for (std::size_t k = 0; k < 2; ++k) {
            if (!is_own(c.ends[k])) continue;
            Pierced& edge = edges[static_cast<std::size_t>(c.ends[k].edge)];
            ++edge.often;
            edge.up = (k == 0) == (operand == 0);
        }
        if (i + 1 < pairs.size() && pair(i + 1).facets[operand] == facet) continue;
        if (!look_at(facet, edges)) return false;
        edges = {};
    }
    return true;
}

// From the first and the last one of the facets that pierce an edge follow the sides of its ends.
bool FacetSides::look_at_often_pierced_edges(const Crossings& crossings, std::size_t operand,
                                             const LatticeMesh& other) {
    struct Pierce {
        std::size_t edge = 0;
        bool up = false;
        std::uint32_t cutter = 0;
    };
    const std::uint32_t first = crossings.operands[operand].first;
    const std::uint32_t first_cutter = crossings.operands[1 - operand].first;
    const auto corners_of = [&](std::uint32_t cutter) -> FacetCorners {
        const auto& t = other.triangles[cutter - first_cutter];
        return {&other.points[t[0]], &other.points[t[1]], &other.points[t[2]]};
    };
    std::vector<Pierce> pierces;
    const auto look_at = [&](std::uint32_t facet) {
        const auto& t = mesh_.triangles[facet - first];
        for (std::size_t e = 0; e < 3; ++e) {
            const std::uint32_t from = t[e];
            const std::uint32_t to = t[(e + 1) % 3];
            if (std::ranges::none_of(pierces, [e](const Pierce& p) { return p.edge == e; }))
                continue;
            const std::uint32_t a = node_of(from);
            const std::uint32_t b = node_of(to);
            sides_.resize(parents_.size(), Side::Unknown);
            // Edges around a vertex all say the same.
            const bool wants_low = sides_[root(a)] == Side::Unknown;
            const bool wants_high = sides_[root(b)] == Side::Unknown;
            if (!wants_low && !wants_high) continue;
            const Pierce* low = nullptr;
            const Pierce* high = nullptr;
            const auto is_before = [&](const Pierce& p, const Pierce& q) {
                return order_along_shifted(mesh_.points[from], mesh_.points[to], operand == 1,
                                           corners_of(p.cutter), corners_of(q.cutter),
                                           crossings.shift) < 0;
            };
            for (const Pierce& p : pierces) {
                if (p.edge != e) continue;
                if (low == nullptr || (wants_low && is_before(p, *low))) low = &p;
                if (high == nullptr || (wants_high && is_before(*high, p))) high = &p;
            }
            if (wants_low && !set_side(a, low->up ? Side::Below : Side::Above)) return false;
            if (wants_high && !set_side(b, high->up ? Side::Above : Side::Below)) return false;
        }
        return true;
    };
    const auto& pairs = crossings.pairs;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto pair = [&](std::size_t k) -> const FacetCrossing& {
            return operand == 0 ? pairs[k] : pairs[crossings.by_second[k]];
        };
        const FacetCrossing& c = pair(i);
        for (std::size_t k = 0; k < 2; ++k)
            if (c.ends[k].of_second == (operand == 1))
                pierces.push_back({static_cast<std::size_t>(c.ends[k].edge),
                                   (k == 0) == (operand == 0), c.facets[1 - operand]});
        if (i + 1 < pairs.size() && pair(i + 1).facets[operand] == c.facets[operand]) continue;
        if (!are_pierces_known(c.facets[operand] - first)) {
            pierces.clear();
            continue;
        }
        if (!look_at(c.facets[operand])) return false;
        pierces.clear();
    }
    return true;
}

std::optional<std::vector<std::uint32_t>> FacetSides::uncrossed(const Crossings& crossings,
                                                                std::size_t operand,
                                                                bool outer_below, bool below,
                                                                const LatticeMesh& other) {
    mark_crossed(crossings, operand);
    join_uncrossed();
    sides_.assign(parents_.size(), Side::Unknown);
    if (!look_at_outer_runs(outer_below ? Side::Below : Side::Above) || !take_known_sides() ||
        !look_at_pierced_edges(crossings, operand))
        return std::nullopt;
    auto facets = list_uncrossed(below);
    if (facets) return facets;
    if (!look_at_often_pierced_edges(crossings, operand, other)) return std::nullopt;
    facets = list_uncrossed(below);
    if (facets) return facets;
    const PointSide side_of(other, operand == 1, crossings.shift, outer_below);
    const std::size_t most = std::max(few_lines, facets_on_lines / other.triangles.size());
    return look_along_lines(side_of, most) ? list_uncrossed(below) : std::nullopt;
}

// Of what nothing else gives the side, from one point of each part that hangs together.
bool FacetSides::look_along_lines(const PointSide& side_of, std::size_t most) {
    std::size_t lines = 0;
    const auto look_at = [&](std::uint32_t point) {
        const std::uint32_t node = node_of(point);
        sides_.resize(parents_.size(), Side::Unknown);
        if (sides_[root(node)] != Side::Unknown) return true;
        if (++lines > most) return false;
        const std::optional<bool> below = side_of.is_below(mesh_.points[point]);
        return below && set_side(node, *below ? Side::Below : Side::Above);
    };
    std::size_t next = 0;  // of the near ones
    for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) {
        const bool is_near = next < near_.size() && near_[next] == f;
        const bool has_side = !is_near || (is_crossed_[next] == 0 && !has_equal(next));
        const std::uint32_t point = is_near && has_side ? point_of(next) : mesh_.triangles[f][0];
        next += is_near ? 1 : 0;
        if (has_side && !look_at(point)) return false;
    }
    return true;
}

std::optional<std::vector<std::uint32_t>> FacetSides::list_uncrossed(bool below) {
    CubeSet wanted(std::vector<std::uint64_t>(grid_.row_count()));
    CubeSet unknown(std::vector<std::uint64_t>(grid_.row_count()));
    const Side side = below ? Side::Below : Side::Above;
    for (std::uint32_t i = 0; i < runs_.size(); ++i) {
        const std::size_t row = runs_[i].row;
        const Side known = sides_[root(i)];
        if (known == side) wanted.row(row) |= runs_[i].bits;
        if (known == Side::Unknown) unknown.row(row) |= runs_[i].bits & cubes_.cubes().row(row);
    }
    const bool any_unknown = unknown.is_any();
    flatten();
    std::atomic<bool> is_known{true};
    auto facets = listed_in_parts(
        mesh_.triangles.size(), threads_,
        [&](std::size_t begin, std::size_t end, std::uint32_t* out) {
            bool known = true;
            const auto add_far = [&, grid = grid_](std::uint32_t first, std::uint32_t last) {
                std::uint32_t* to = out;
                for (std::uint32_t f = first; f < last; ++f) {
                    *to = f;
                    to += wanted.has(grid, cubes_.cube_of_facet(f)) ? 1 : 0;
                }
                out = to;
                for (std::uint32_t f = first; any_unknown && f < last; ++f)
                    known = known && !unknown.has(grid, cubes_.cube_of_facet(f));
            };
            auto next = static_cast<std::uint32_t>(begin);
            for (auto i = static_cast<std::size_t>(std::ranges::lower_bound(near_, next) -
                                                   near_.begin());
                 i < near_.size() && near_[i] < end; ++i) {
                add_far(next, near_[i]);
                next = near_[i] + 1;
                if (has_equal(i)) {
                    if (fates_[i] == EqualFacets::Fate::Kept) *out++ = near_[i];
                    continue;
                }
                if (is_crossed_[i] != 0) continue;
                const Side of_facet = side_of_joined(point_of(i));
                if (of_facet == side) *out++ = near_[i];
                known = known && of_facet != Side::Unknown;
            }
            add_far(next, static_cast<std::uint32_t>(end));
            if (!known) is_known = false;
            return out;
        });
    if (!is_known) return std::nullopt;
    return facets;
}

std::vector<Crossings::Corner> FacetSides::first_corners(bool below) {
    std::vector<Crossings::Corner> out;
    const Side open = below ? Side::Below : Side::Above;
    for (std::size_t i = 0; i < near_.size(); ++i) {
        if (is_crossed_[i] == 0) continue;
        const std::uint32_t node = node_of(mesh_.triangles[near_[i]][0]);
        sides_.resize(parents_.size(), Side::Unknown);
        const Side side = sides_[root(node)];
        out.push_back(side == Side::Unknown ? Crossings::Corner::Unknown
                      : side == open        ? Crossings::Corner::Open
                                            : Crossings::Corner::Contained);
    }
    return out;
}

}  // namespace trisect::detail
