// SPDX-License-Identifier: Apache-2.0
//
// No solid is cut into convex parts here. A point x is in the sum of A and B where A meets B turned
// about the origin and moved to x. Then their boundaries meet, and x is a sum of two points of the
// boundaries; or a whole part of one boundary lies in the other solid, and x is the sum of any
// point of that part and a point of the other solid. So the sum is the union of the sums of all
// pairs of triangles, and of B moved to one point of each part of A's boundary, and the other way
// round. Where B is convex, sums of a triangle and B take the place of the first two.
//
// Any sets in A that hold all of its boundary serve in place of the triangles: convex bodies
// between its corners (pieces/convex_cover.h), of which there are fewer. Where they are all of A,
// nothing needs to be moved to the parts of B's boundary. For a difference the bodies are outside
// of A.
#include <trisect/bsp/modelling/minkowski.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/transform.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/convex_pieces.h>
#include <trisect/bsp/modelling/pieces/plane_sums.h>
#include <trisect/bsp/modelling/pieces/sum_hull.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {
namespace {

using detail::ConvexPieces;

double twice_area(const Outline& outline) {
    double out = 0;
    const Point2d& o = outline[0];
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        out += (outline[i][0] - o[0]) * (outline[i + 1][1] - o[1]) -
               (outline[i][1] - o[1]) * (outline[i + 1][0] - o[0]);
    return out;
}

Solid moved(const Solid& solid, const Point3d& by) {
    return transformed(solid, AffineMap::translation(by));
}

/// The solid turned about the origin.
Solid turned_about(const Solid& solid) {
    return transformed(solid, AffineMap::scaling({-1, -1, -1}));
}

/// Sums of all pieces of the one and all pieces of the other.
std::vector<Solid> sums_of_pieces(const ConvexPieces& a, const ConvexPieces& b,
                                  const MinkowskiOptions& options) {
    if (a.pieces.size() > options.most_pieces / b.pieces.size())
        throw LimitError("a Minkowski sum of more than " + std::to_string(options.most_pieces) +
                         " convex pieces");
    std::vector<Solid> out;
    for (const auto& p : a.pieces)
        for (const auto& q : b.pieces) {
            detail::check_stop(p.size() * q.size());
            if (const auto hull = detail::sum_hull(p, q)) out.push_back(Solid::from_mesh(*hull));
        }
    return out;
}

void add_moved(std::vector<Solid>& out, const Solid& solid, const std::vector<Point3d>& to) {
    for (const Point3d& p : to) out.push_back(moved(solid, p));
}

Solid sum_of(const Solid& a, const ConvexPieces& in_a, const Solid& b, const ConvexPieces& in_b,
             const MinkowskiOptions& options) {
    std::vector<Solid> terms = sums_of_pieces(in_a, in_b, options);
    if (in_a.is_convex && in_b.is_convex) return terms.empty() ? Solid() : terms[0];
    if (!in_a.fills) add_moved(terms, a, in_b.representatives);
    if (!in_b.fills) add_moved(terms, b, in_a.representatives);
    return evaluate(Expression::any_of(terms), options.evaluate);
}

/// Outlines of the parts of a region, or the triangles of one with holes.
std::vector<Outline> parts_without_holes(const Solid& prism) {
    std::vector<Outline> out = outlines_of_prism(prism);
    std::erase_if(out, [](const Outline& o) { return o.size() < 3; });
    if (std::ranges::all_of(out, [](const Outline& o) { return twice_area(o) > 0; })) return out;
    out.clear();
    const PlaneRegion region = region_of_faces(prism, 1);
    for (const auto& [p, q, r] : region.triangles) {
        Outline triangle{region.points[p], region.points[q], region.points[r]};
        if (twice_area(triangle) > 0) out.push_back(std::move(triangle));
    }
    return out;
}

}  // namespace

Solid minkowski_sum(const Solid& a, const Solid& b, const MinkowskiOptions& options) {
    if (a.is_empty() || b.is_empty()) return {};
    return sum_of(a, detail::pieces_of_solid(a, options), b, detail::pieces_of_solid(b, options),
                  options);
}

Solid minkowski_sum_of_regions(const Solid& a, const Solid& b, const MinkowskiOptions& options) {
    if (a.is_empty() || b.is_empty()) return {};
    const std::vector<Outline> in_a = parts_without_holes(a);
    const std::vector<Outline> in_b = parts_without_holes(b);
    if (!in_b.empty() && in_a.size() > options.most_pieces / in_b.size())
        throw LimitError("a Minkowski sum of more than " + std::to_string(options.most_pieces) +
                         " pairs of parts");
    detail::SumSides sides;
    for (const Outline& p : in_a)
        for (const Outline& q : in_b) detail::add_convolution(sides, p, q);
    return evaluate(flat_prism(sides.corners, sides.sides, 0, 1), options.evaluate);
}

// `b` moved to x is within `a` where one point of each of its parts is, and its boundary meets that
// of `a` nowhere: where x is in no sum of the boundary of `a` and `b` turned about the origin.
Solid minkowski_difference(const Solid& a, const Solid& b, const MinkowskiOptions& options) {
    if (a.is_empty() || b.is_empty()) return a;
    const Solid turned = turned_about(b);
    const ConvexPieces in_a = detail::pieces_around(a);
    const ConvexPieces in_b = detail::pieces_of_solid(turned, options);
    std::vector<Solid> swept = sums_of_pieces(in_a, in_b, options);
    if (!in_b.is_convex) add_moved(swept, turned, in_a.representatives);
    std::vector<Solid> kept;
    add_moved(kept, a, in_b.representatives);
    return evaluate(Expression::all_of(kept) - Expression::any_of(swept), options.evaluate);
}

}  // namespace trisect
