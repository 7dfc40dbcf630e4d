// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/pieces/convex_body.h>

#include <algorithm>
#include <array>

#include <trisect/kernel/predicates.h>

namespace trisect::detail {
namespace {

// Of a larger body each step costs as much as the union saves.
constexpr std::size_t most_corners = 96;
// About what each point of a hull takes.
constexpr std::size_t sides_for_point = 16;

/// The hull's corners in the order of their numbers.
std::vector<std::uint32_t> corners_of(const std::vector<HullFacets::Facet>& facets) {
    std::vector<std::uint32_t> out;
    for (const auto& f : facets) out.insert(out.end(), f.corners.begin(), f.corners.end());
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

}  // namespace

ConvexBody::ConvexBody(CoverBoundary& boundary, std::span<const std::uint8_t> covered,
                       std::uint32_t seed)
    : boundary_(&boundary), covered_(covered) {
    boundary.begin_body();
    const auto& first = boundary.triangle(seed);
    corners_.assign(first.begin(), first.end());
    add(seed);
    grow();
    if (is_flat()) grow_in_plane();
}

void ConvexBody::add(std::uint32_t triangle) {
    triangles_.push_back(triangle);
    boundary_->mark(triangle);
}

bool ConvexBody::may_grow_over(std::uint32_t triangle) const {
    return !boundary_->is_marked(triangle) && covered_[triangle] == 0 &&
           corners_.size() < most_corners && !boundary_->is_spent(triangles_.size());
}

// Triangles in the plane of a flat body wait until it is solid. What is refused once stays so: the
// body only grows.
void ConvexBody::grow() {
    for (bool is_larger = true; is_larger;) {
        is_larger = false;
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t t = boundary_->neighbour(triangles_[i], k);
                if (may_grow_over(t) && try_to_add(t)) is_larger = true;
            }
    }
}

bool ConvexBody::is_below_all(std::uint32_t triangle, std::span<const std::uint32_t> added) {
    return boundary_->are_below(corners_, boundary_->plane(triangle)) &&
           std::ranges::all_of(triangles_, [&](std::uint32_t t) {
               return boundary_->are_below(added, boundary_->plane(t));
           });
}

bool ConvexBody::try_to_add(std::uint32_t triangle) {
    const auto& t = boundary_->triangle(triangle);
    if (is_flat() && boundary_->are_on(t, boundary_->plane(triangles_[0]))) return false;
    boundary_->mark(triangle);
    std::vector<std::uint32_t> numbers = corners_;
    for (const std::uint32_t v : t)
        if (std::ranges::find(corners_, v) == corners_.end()) numbers.push_back(v);
    const std::span<const std::uint32_t> all(numbers);
    const std::span<const std::uint32_t> added = all.subspan(corners_.size());
    if (!is_below_all(triangle, added)) return false;
    if (numbers.size() == corners_.size()) {
        add(triangle);
        return true;
    }
    std::vector<LatticePoint> points;
    points.reserve(numbers.size());
    for (const std::uint32_t v : numbers) points.push_back(boundary_->point(v));
    boundary_->count_sides(sides_for_point * points.size());
    Facets facets = HullFacets(points).facets();
    for (HullFacets::Facet& f : facets)
        for (std::uint32_t& v : f.corners) v = numbers[v];
    std::vector<std::uint32_t> corners = corners_of(facets);
    if (!is_free(facets, corners, added)) return false;
    facets_ = std::move(facets);
    corners_ = std::move(corners);
    add(triangle);
    return true;
}

PointBox ConvexBody::box_of(std::span<const std::uint32_t> corners) const {
    PointBox out(boundary_->point(corners[0]));
    for (const std::uint32_t v : corners) out.add(boundary_->point(v));
    return out;
}

// Whether planes of the body or of triangles show that none reaches into it. Other planes could;
// then it is refused without need.
bool ConvexBody::is_free(const Facets& facets, std::span<const std::uint32_t> corners,
                         std::span<const std::uint32_t> added) {
    const PointBox box = box_of(corners);
    for (std::uint32_t t = 0; t < boundary_->size(); ++t) {
        if (!boundary_->is_near(t, box)) continue;
        if (boundary_->has_on_one_side(t, corners, added)) continue;
        if (std::ranges::none_of(facets, [&](const HullFacets::Facet& f) {
                return boundary_->are_above(boundary_->triangle(t), f.plane);
            }))
            return false;
    }
    return true;
}

std::vector<std::uint32_t> ConvexBody::covered_triangles() {
    if (is_flat() || boundary_->is_spent(triangles_.size())) return triangles_;
    std::vector<std::uint32_t> out = triangles_;
    const PointBox box = box_of(corners_);
    for (std::uint32_t t = 0; t < boundary_->size(); ++t)
        if (covered_[t] == 0 && boundary_->is_near(t, box) &&
            std::ranges::all_of(facets_, [&](const HullFacets::Facet& f) {
                return boundary_->are_below(boundary_->triangle(t), f.plane);
            }))
            out.push_back(t);
    return out;
}

bool ConvexBody::is_kept_apart_from(std::span<const std::uint32_t> points) {
    return std::ranges::any_of(
        facets_, [&](const HullFacets::Facet& f) { return boundary_->are_above(points, f.plane); });
}

// Of a face convex parts are left, where no body goes on from them: polygons that grow by the third
// corner of a triangle at one of their sides, as long as they turn to the left at its ends.
void ConvexBody::grow_in_plane() {
    for (bool is_larger = true; is_larger;) {
        is_larger = false;
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t t = boundary_->neighbour(triangles_[i], k);
                const std::uint32_t from = boundary_->triangle(triangles_[i])[k];
                if (may_grow_over(t) && try_to_add_in_plane(t, from)) is_larger = true;
            }
    }
}

bool ConvexBody::try_to_add_in_plane(std::uint32_t triangle, std::uint32_t from) {
    const auto& t = boundary_->triangle(triangle);
    if (!boundary_->are_on(t, boundary_->plane(triangles_[0]))) return false;
    const std::size_t n = corners_.size();
    const auto side =
        static_cast<std::size_t>(std::ranges::find(corners_, from) - corners_.begin());
    const auto third = std::ranges::find_if(
        t, [&](std::uint32_t v) { return std::ranges::find(corners_, v) == corners_.end(); });
    if (side == n || third == t.end()) return false;
    const auto corner = [&](std::size_t i) { return corners_[i % n]; };
    if (!turns_left(corner(side + n - 1), corner(side), *third) ||
        !turns_left(*third, corner(side + 1), corner(side + 2)))
        return false;
    corners_.insert(corners_.begin() + static_cast<std::ptrdiff_t>(side) + 1, *third);
    add(triangle);
    return true;
}

// Or straight on, seen from above the plane of the first triangle.
bool ConvexBody::turns_left(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const auto& [p, q, r] = boundary_->triangle(triangles_[0]);
    const Plane plane =
        Plane::through(boundary_->point(p), boundary_->point(q), boundary_->point(r));
    const int axis = plane.dominant_axis();
    const Plane side = Plane::along_axis(boundary_->point(a), boundary_->point(b), axis);
    const int turn = sign_of(side_of(boundary_->point(c), side));
    const Plane first = Plane::along_axis(boundary_->point(p), boundary_->point(q), axis);
    return turn * sign_of(side_of(boundary_->point(r), first)) >= 0;
}

}  // namespace trisect::detail
