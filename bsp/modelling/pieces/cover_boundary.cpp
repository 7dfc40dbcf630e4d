// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/pieces/cover_boundary.h>

#include <algorithm>

#include <trisect/kernel/predicates.h>

namespace trisect::detail {
namespace {

// What a body may cost is less than what a triangle costs in the union of all sums.
constexpr std::size_t sides_for_triangle = 2000;
constexpr std::size_t triangles_ahead = 8;
constexpr std::size_t boxes_for_side = 8;

struct DirectedEdge {
    std::uint32_t low, high;
    std::uint32_t triangle, place;
    [[nodiscard]] std::array<std::uint32_t, 2> ends() const { return {low, high}; }
};

// Pairs of edges come one after the other in the order of their ends.
std::vector<CoverBoundary::Triangle> neighbours_in(const LatticeMesh& mesh) {
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][k];
            const std::uint32_t b = mesh.triangles[t][(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), t, k});
        }
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        return a.ends() != b.ends() ? a.ends() < b.ends() : a.triangle < b.triangle;
    });
    std::vector<CoverBoundary::Triangle> out(mesh.triangles.size());
    for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
        out[edges[i].triangle][edges[i].place] = edges[i + 1].triangle;
        out[edges[i + 1].triangle][edges[i + 1].place] = edges[i].triangle;
    }
    return out;
}

}  // namespace

void PointBox::add(const LatticePoint& p) {
    const std::array<double, 3> at = p.doubles();
    for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], at[k]);
        hi[k] = std::max(hi[k], at[k]);
    }
}

bool PointBox::overlaps(const PointBox& o) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (lo[k] > o.hi[k] || o.lo[k] > hi[k]) return false;
    return true;
}

CoverBoundary::CoverBoundary(const LatticeMesh& mesh, CoverSide side)
    : mesh_(mesh),
      neighbours_(neighbours_in(mesh)),
      marks_(mesh.triangles.size(), 0),
      has_below_(marks_),
      has_above_(marks_) {
    planes_.reserve(mesh.triangles.size());
    boxes_.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Plane plane = Plane::through(mesh.points[a], mesh.points[b], mesh.points[c]);
        planes_.push_back(side == CoverSide::Inside ? plane : plane.flipped());
        PointBox box(mesh.points[a]);
        box.add(mesh.points[b]);
        box.add(mesh.points[c]);
        boxes_.push_back(box);
    }
}

Side CoverBoundary::side(std::uint32_t v, const Plane& plane) {
    ++sides_found_;
    return side_of(mesh_.points[v], plane);
}

bool CoverBoundary::are_below(std::span<const std::uint32_t> points, const Plane& plane) {
    return std::ranges::all_of(points,
                               [&](std::uint32_t v) { return side(v, plane) != Side::Above; });
}

bool CoverBoundary::are_above(std::span<const std::uint32_t> points, const Plane& plane) {
    return std::ranges::all_of(points,
                               [&](std::uint32_t v) { return side(v, plane) != Side::Below; });
}

bool CoverBoundary::are_on(std::span<const std::uint32_t> points, const Plane& plane) {
    return std::ranges::all_of(points, [&](std::uint32_t v) { return side(v, plane) == Side::On; });
}

void CoverBoundary::begin_body() {
    ++body_;
    sides_found_ = 0;
    boxes_compared_ = 0;
}

bool CoverBoundary::is_spent(std::size_t triangles) const {
    return sides_found_ + boxes_compared_ / boxes_for_side >
           sides_for_triangle * (triangles_ahead + triangles);
}

bool CoverBoundary::has_on_one_side(std::uint32_t t, std::span<const std::uint32_t> corners,
                                    std::span<const std::uint32_t> added) {
    if (has_below_[t] == body_ && are_below(added, planes_[t])) return true;
    if (has_above_[t] == body_ && are_above(added, planes_[t])) return true;
    has_below_[t] = has_above_[t] = 0;
    if (are_below(corners, planes_[t])) {
        has_below_[t] = body_;
        return true;
    }
    if (!are_above(corners, planes_[t])) return false;
    has_above_[t] = body_;
    return true;
}

}  // namespace trisect::detail
