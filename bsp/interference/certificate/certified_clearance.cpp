// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/certified_clearance.h>

#include <algorithm>
#include <functional>

namespace trisect::detail::certified {

namespace {

SeparatingPlane opposite(const SeparatingPlane& plane) {
    return {{-plane.normal[0], -plane.normal[1], -plane.normal[2]}, -plane.offset};
}

}  // namespace

std::string ClearanceRange::divide(const ClearanceNode& node, ClearanceRange& first,
                                   ClearanceRange& second) const {
    using Kind = ClearanceNode::Kind;
    first = second = *this;
    if (node.kind == Kind::SplitTime) {
        if (!(from < node.time && node.time < to)) return "a time is not in its range";
        first.to = second.from = node.time;
    } else if (node.kind == Kind::SplitA) {
        if (is_zero(node.cut.normal)) return "a plane that divides has no normal";
        auto [below, above] = part->divided(IntegerPlane(node.cut));
        first.part = std::make_shared<const Part>(std::move(below));
        second.part = std::make_shared<const Part>(std::move(above));
    } else {
        if (b1 - b0 < 2) return "the tree splits a single triangle";
        first.b1 = second.b0 = (b0 + b1) / 2;
    }
    return {};
}

bool Clearance::is_regular() const {
    const ExactRational last = event_ ? event_->upper() : ExactRational(1);
    return is_positive(to_a_.w, 0, last) && is_positive(to_b_.w, 0, last);
}

bool Clearance::is_not_negative(const Polynomial& p, const ClearanceRange& r) const {
    return goes_to_the_event(r) ? event_->is_not_negative_before(p, r.from)
                                : certified::is_not_negative(p, r.from, r.to);
}

// Bernstein coefficients first; polynomials of corners for which these say nothing.
template <class Points, class ToPoint>
bool Clearance::stay_above(const Points& points, ToPoint point, bool are_of_b,
                           const ClearanceRange& r, const SeparatingPlane& plane) {
    const Piece& map = are_of_b ? to_a_ : to_b_;
    const ExactRational& to = goes_to_the_event(r) ? event_->upper() : r.to;
    const auto key = std::make_tuple(are_of_b, r.from, to);
    auto controls = controls_.find(key);
    if (controls == controls_.end())
        controls = controls_.emplace(key, ControlMaps(map, r.from, to)).first;
    const std::vector<IntegerPlane> planes = controls->second.planes(plane);
    const auto stays = [&](const IntegerPoint& x) {
        if (std::ranges::all_of(planes, [&x](const IntegerPlane& q) { return q.side_of(x) >= 0; }))
            return true;
        return is_not_negative(
            dot(constant(plane.normal), map.point(x.rational())) + Polynomial(plane.offset) * map.w,
            r);
    };
    return std::ranges::all_of(points, stays, point);
}

bool Clearance::are_apart(const ClearanceRange& r, const std::vector<std::uint32_t>& of_b,
                          const SupportingPlane& plane) {
    if (r.part->points().empty()) return true;
    if (plane.kind == SupportingPlane::Kind::Edges) return are_apart_by_edges(r, of_b, plane);
    if (is_zero(plane.plane.normal)) return false;
    const IntegerPlane resting(plane.plane);
    const auto corner = [this](std::uint32_t v) -> const IntegerPoint& { return b_.points()[v]; };
    if (plane.kind == SupportingPlane::Kind::OfA)
        return std::ranges::all_of(
                   r.part->points(),
                   [&](const IntegerPoint& x) { return resting.side_of(x) <= 0; }) &&
               stay_above(of_b, corner, true, r, plane.plane);
    return std::ranges::all_of(of_b,
                               [&](std::uint32_t v) { return resting.side_of(corner(v)) >= 0; }) &&
           stay_above(r.part->points(), std::identity(), false, r, opposite(plane.plane));
}

bool Clearance::are_apart_by_edges(const ClearanceRange& r, const std::vector<std::uint32_t>& of_b,
                                   const SupportingPlane& plane) const {
    const PolynomialVector n = cross(constant(plane.along_a), to_a_.direction(plane.along_b));
    if (n[0].is_zero() && n[1].is_zero() && n[2].is_zero()) return false;
    const PolynomialVector through = to_a_.w * constant(plane.through);
    return std::ranges::all_of(r.part->points(),
                               [&](const IntegerPoint& x) {
                                   return is_not_negative(
                                       dot(n, constant(minus(plane.through, x.rational()))), r);
                               }) &&
           std::ranges::all_of(of_b, [&](std::uint32_t v) {
               return is_not_negative(dot(n, to_a_.point(b_.at(VertexId(v))) - through), r);
           });
}

}  // namespace trisect::detail::certified
