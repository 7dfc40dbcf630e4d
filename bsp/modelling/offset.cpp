// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/offset.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/pieces/plane_triangles.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

using Corners = OffsetOptions::Corners;

Point2d moved(const Point2d& p, const Point2d& along, double by) {
    return {p[0] + by * along[0], p[1] + by * along[1]};
}

/// To the right of the way from p to q, which is outward; of length 1.
Point2d normal(const Point2d& p, const Point2d& q) {
    const double size = std::hypot(q[0] - p[0], q[1] - p[1]);
    return {(q[1] - p[1]) / size, (p[0] - q[0]) / size};
}

double cross(const Point2d& a, const Point2d& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const Point2d& a, const Point2d& b) { return a[0] * b[0] + a[1] * b[1]; }

class Strips {
public:
    Strips(double distance, const OffsetOptions& options, detail::PlaneTriangles& pieces)
        : distance_(distance), options_(options), pieces_(pieces) {}

    void add_loop(const std::vector<Point2d>& loop) {
        const std::size_t n = loop.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Point2d& p = loop[i];
            const Point2d& q = loop[(i + 1) % n];
            const Point2d along = normal(p, q);
            pieces_.add_fan({p, q, moved(q, along, distance_), moved(p, along, distance_)});
            add_corner(q, along, normal(q, loop[(i + 2) % n]));
        }
    }

private:
    /// Between the strips of two edges, where they are apart.
    void add_corner(const Point2d& at, const Point2d& before, const Point2d& after) {
        const double turn = std::atan2(cross(before, after), dot(before, after));
        if (!(turn * distance_ > 0)) return;
        Outline piece{at, moved(at, before, distance_)};
        const Corners corners = corners_for(before, after);
        if (corners == Corners::Round) add_arc(piece, at, before, turn);
        if (corners == Corners::Miter) add_miter(piece, at, before, after);
        if (corners == Corners::Chamfer) add_chamfer(piece, at, before, after, turn);
        piece.push_back(moved(at, after, distance_));
        pieces_.add_fan(piece);
    }

    // The tip of a miter is sqrt(2 / (1 + cos)) distances away.
    [[nodiscard]] Corners corners_for(const Point2d& before, const Point2d& after) const {
        const double limit = options_.miter_limit;
        const bool is_too_far =
            std::isfinite(limit) && (1 + dot(before, after)) * limit * limit < 2 - 0x1p-40;
        return options_.corners == Corners::Miter && is_too_far ? Corners::Chamfer
                                                                : options_.corners;
    }

    void add_arc(Outline& piece, const Point2d& at, const Point2d& before, double turn) const {
        const double step = std::copysign(2 * std::numbers::pi / options_.segments, turn);
        const double count = std::max(std::round(turn / step), 1.0);
        for (double i = 1; i < count; ++i) {
            const double c = std::cos(i * step);
            const double s = std::sin(i * step);
            const Point2d along{c * before[0] - s * before[1], s * before[0] + c * before[1]};
            piece.push_back(moved(at, along, distance_));
        }
    }

    void add_miter(Outline& piece, const Point2d& at, const Point2d& before,
                   const Point2d& after) const {
        // The bisector over 1 + cos: its length grows without bound towards a turn by 180 degrees.
        const double whole = 1 + dot(before, after);
        if (whole > 0x1p-40)
            piece.push_back(
                moved(at, {before[0] + after[0], before[1] + after[1]}, distance_ / whole));
    }

    void add_chamfer(Outline& piece, const Point2d& at, const Point2d& before, const Point2d& after,
                     double turn) const {
        const double along_edge = std::fabs(distance_) * std::tan(std::fabs(turn) / 4);
        const Point2d onward{-before[1], before[0]};
        const Point2d back{after[1], -after[0]};
        piece.push_back(moved(moved(at, before, distance_), onward, along_edge));
        piece.push_back(moved(moved(at, after, distance_), back, along_edge));
    }

    double distance_;
    const OffsetOptions& options_;
    detail::PlaneTriangles& pieces_;
};

}  // namespace

Solid offset_of_region(const Solid& prism, double distance, const OffsetOptions& options) {
    if (!std::isfinite(distance)) throw UsageError("an offset must be finite");
    if (options.segments < 3) throw UsageError("an arc needs at least three segments to a circle");
    if (!(options.miter_limit >= 1)) throw UsageError("a limit of miters must be at least 1");
    if (distance == 0 || prism.is_empty()) return prism;
    const std::vector<Outline> outlines = outlines_of_prism(prism);
    detail::PlaneTriangles pieces;
    Strips strips(distance, options, pieces);
    for (const Outline& loop : outlines)
        if (loop.size() >= 3) strips.add_loop(loop);
    if (distance < 0)
        return evaluate(flat_prism(outlines, OutlineRule::Positive, 0, 1) - pieces.prism(),
                        options.evaluate);
    // With the region itself its edges are gone, on which strips stand.
    for (const Outline& loop : outlines) pieces.add_loop(loop);
    return evaluate(pieces.prism(), options.evaluate);
}

}  // namespace trisect
