// SPDX-License-Identifier: Apache-2.0
#include "slab_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect::app {

namespace {

std::uint64_t hash_of(const Point3d& p) {
    std::uint64_t h = 0;
    for (const double x : p) {
        h ^= std::bit_cast<std::uint64_t>(x) + 0x9e3779b97f4a7c15ULL + (h << 6) + (h >> 2);
        h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
        h ^= h >> 27;
    }
    return h;
}

constexpr std::uint32_t not_walked = std::numeric_limits<std::uint32_t>::max();

/// An end of edges.
struct CycleCorner {
    std::uint32_t point;
    std::uint32_t next;   ///< the edges from here on were not walked
    std::uint32_t place;  ///< on the walk
};

}  // namespace

void SlabMesh::reserve(std::uint64_t triangles) {
    triangles_.reserve(triangles + triangles / 64 + 64);
    points_.reserve(triangles / 2 + triangles / 16 + 64);
    while (table_.size() < triangles + 64) grow_table();
}

void SlabMesh::grow_table() {
    std::vector<std::uint32_t> larger(std::max<std::size_t>(1024, table_.size() * 2));
    for (const std::uint32_t n : table_) {
        if (n == 0) continue;
        std::size_t at = hash_of(points_[n - 1]) & (larger.size() - 1);
        while (larger[at] != 0) at = (at + 1) & (larger.size() - 1);
        larger[at] = n;
    }
    table_ = std::move(larger);
}

std::uint32_t SlabMesh::number_of(const Point3d& p) {
    if (table_.size() < 2 * points_.size() + 2) grow_table();
    std::size_t at = hash_of(p) & (table_.size() - 1);
    while (table_[at] != 0) {
        if (points_[table_[at] - 1] == p) return table_[at] - 1;
        at = (at + 1) & (table_.size() - 1);
    }
    if (points_.size() >= std::numeric_limits<std::uint32_t>::max() - 8)
        throw LimitError("a slab has too many corners");
    points_.push_back(p);
    table_[at] = static_cast<std::uint32_t>(points_.size());
    return table_[at] - 1;
}

void SlabMesh::add(const Corners& corners) {
    triangles_.push_back({number_of(corners[0]), number_of(corners[1]), number_of(corners[2])});
}

int SlabMesh::side_of(std::uint32_t corner) const {
    const double x = points_[corner][range_.axis];
    if (x < range_.low) return -1;
    return x > range_.high ? 1 : 0;
}

// Edges beyond the slab that are not passed equally often both ways, with the direction in which
// they lack a triangle.
std::vector<DirectedEdge> SlabMesh::lost_edges() const {
    std::vector<DirectedEdge> edges;
    for (const auto& t : triangles_)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = t[i];
            const std::uint32_t to = t[(i + 1) % 3];
            const int side = side_of(from);
            if (from != to && side != 0 && side == side_of(to)) edges.push_back({from, to});
        }
    return missing_edges(std::move(edges));
}

void SlabMesh::close() {
    table_ = {};
    fill(lost_edges());
    add_fine_triangles();
}

// A walk along the edges; where it comes back to one of its corners, a cycle is cut off.
void SlabMesh::fill(std::vector<DirectedEdge> edges) {
    std::ranges::sort(edges);
    std::vector<CycleCorner> corners;
    for (std::uint32_t i = 0; i < edges.size(); ++i)
        if (i == 0 || edges[i - 1][0] != edges[i][0])
            corners.push_back({edges[i][0], i, not_walked});
    const auto corner_of = [&](std::uint32_t point) {
        return std::ranges::lower_bound(corners, point, {}, &CycleCorner::point);
    };
    std::vector<std::uint32_t> walk;
    for (const CycleCorner& start : corners) {
        std::uint32_t point = start.point;
        while (true) {
            const auto at = corner_of(point);
            if (at == corners.end() || at->point != point) break;  // an open mesh; import says so
            if (at->place != not_walked) {
                const auto first = walk.begin() + static_cast<std::ptrdiff_t>(at->place);
                for (auto c = first; c != walk.end(); ++c) corner_of(*c)->place = not_walked;
                fill_cycle({first, walk.end()});
                walk.erase(first, walk.end());
            }
            if (at->next == edges.size() || edges[at->next][0] != point) break;
            at->place = static_cast<std::uint32_t>(walk.size());
            walk.push_back(point);
            point = edges[at->next++][1];
        }
        for (const std::uint32_t c : walk) corner_of(c)->place = not_walked;
        walk.clear();
    }
}

// Whether three points are on one line, or nearly: import would leave such a triangle out, and what
// is left would only be closed along lines.
bool SlabMesh::are_in_line(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    Point3d u{};
    Point3d v{};
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = points_[b][k] - points_[a][k];
        v[k] = points_[c][k] - points_[a][k];
    }
    const double area =
        std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    return !(area > 1e-9 * std::hypot(u[0], u[1], u[2]) * std::hypot(v[0], v[1], v[2]));
}

// From its highest corner down both sides, so that triangles stay short across.
void SlabMesh::fill_cycle(std::vector<std::uint32_t> cycle) {
    const std::size_t k = (range_.axis + 1) % 3;
    const auto highest =
        std::ranges::max_element(cycle, {}, [&](std::uint32_t c) { return points_[c][k]; });
    std::rotate(cycle.begin(), highest, cycle.end());
    std::size_t low = 0;
    std::size_t high = cycle.size() - 1;
    while (high - low >= 2) {
        const auto fits = [&](bool forward) {
            return !are_in_line(cycle[low], forward ? cycle[low + 1] : cycle[high - 1],
                                cycle[high]);
        };
        bool forward = points_[cycle[low + 1]][k] >= points_[cycle[high - 1]][k];
        if (!fits(forward)) {
            forward = !forward;
            if (!fits(forward)) break;
        }
        triangles_.push_back({cycle[low], forward ? cycle[low + 1] : cycle[high - 1], cycle[high]});
        forward ? ++low : --high;
    }
    if (high - low >= 2)
        fill_from_afar({cycle.begin() + static_cast<std::ptrdiff_t>(low),
                        cycle.begin() + static_cast<std::ptrdiff_t>(high) + 1});
}

// From a point that is hardly in line with any edge.
void SlabMesh::fill_from_afar(const std::vector<std::uint32_t>& cycle) {
    Point3d p{};
    p[range_.axis] =
        side_of(cycle[0]) < 0 ? range_.low - range_.bound / 4 : range_.high + range_.bound / 4;
    p[(range_.axis + 1) % 3] = 12345677 * range_.quantum;
    p[(range_.axis + 2) % 3] = 27182819 * range_.quantum;
    const auto apex = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    for (std::size_t i = 0; i < cycle.size(); ++i)
        triangles_.push_back({apex, cycle[i], cycle[(i + 1) % cycle.size()]});
}

void SlabMesh::add_fine_triangles() {
    const double q = range_.quantum;
    const auto first = static_cast<std::uint32_t>(points_.size());
    Point3d p{q, q, q};
    p[range_.axis] = 2 * range_.bound + q;
    if (std::isfinite(range_.low)) p[range_.axis] = range_.low - 64 * q;
    if (std::isfinite(range_.high)) p[range_.axis] = range_.high + 64 * q;
    for (std::size_t i = 0; i < 3; ++i) {
        points_.push_back(p);
        if (i != 0) points_.back()[(range_.axis + i) % 3] += 2 * q;
    }
    triangles_.push_back({first, first + 1, first + 2});
    triangles_.push_back({first, first + 2, first + 1});
}

}  // namespace trisect::app
