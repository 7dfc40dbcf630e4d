// SPDX-License-Identifier: Apache-2.0
//
// The polar form f of a polynomial piece is the function of as many arguments as the degree says
// that is affine in each, symmetric, and has f(t, ..., t) equal to the piece. Control point j of
// the Bézier form over [a, b] is f with j arguments b and the others a; de Boor's recursion
// evaluates it with a different argument in each step. Two neighbouring pieces compute their common
// control points from different control points of the surface, but in rationals they are equal, and
// rounding them once makes equal doubles.

#include <trisect/brep/curved/bspline_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect {

namespace {

using ExactHomogeneous = std::array<ExactRational, 4>;  // w x, w y, w z, w

class Knots {
public:
    Knots(const std::vector<double>& knots, std::size_t degree, const char* direction)
        : degree_(degree) {
        if (degree == 0 || degree > BezierPatch::max_degree)
            throw UsageError(std::string("the degree of a B-spline surface in ") + direction +
                             " must be 1 to " + std::to_string(BezierPatch::max_degree));
        if (knots.size() < 2 * degree + 2)
            throw UsageError(std::string("too few knots in ") + direction + ": degree " +
                             std::to_string(degree) + " needs " + std::to_string(2 * degree + 2));
        for (std::size_t i = 0; i < knots.size(); ++i)
            if (!std::isfinite(knots[i]) || (i > 0 && knots[i] < knots[i - 1]))
                throw UsageError("knot " + std::to_string(i) + " in " + direction +
                                 " is not finite or less than the one before it");
        for (const double t : knots) knots_.push_back(ExactRational::from_double(t));
        for (std::size_t k = degree; k < count(); ++k)
            if (knots[k] < knots[k + 1]) spans_.push_back(k);
        if (spans_.empty()) throw UsageError(std::string("no knot span in ") + direction);
    }
    [[nodiscard]] std::size_t count() const { return knots_.size() - degree_ - 1; }
    /// Numbers k of the knots that begin the spans.
    [[nodiscard]] const std::vector<std::size_t>& spans() const { return spans_; }
    /// The Bézier control points over span k of the curve with these control points.
    [[nodiscard]] std::vector<ExactHomogeneous> bezier(
        std::size_t k, const std::vector<ExactHomogeneous>& points) const {
        std::vector<ExactHomogeneous> r;
        for (std::size_t j = 0; j <= degree_; ++j) r.push_back(polar(k, j, points));
        return r;
    }

private:
    // With j arguments at the end of span k.
    [[nodiscard]] ExactHomogeneous polar(std::size_t k, std::size_t j,
                                         const std::vector<ExactHomogeneous>& points) const {
        const auto first = points.begin() + static_cast<std::ptrdiff_t>(k - degree_);
        std::vector<ExactHomogeneous> d(first, first + static_cast<std::ptrdiff_t>(degree_) + 1);
        for (std::size_t r = 1; r <= degree_; ++r) {
            const ExactRational& at = r <= j ? knots_[k + 1] : knots_[k];
            for (std::size_t i = degree_; i >= r; --i) {
                const std::size_t knot = k - degree_ + i;
                const ExactRational& low = knots_[knot];
                const ExactRational& high = knots_[knot + degree_ + 1 - r];
                const ExactRational t = (at - low) / (high - low);
                for (std::size_t c = 0; c < 4; ++c)
                    d[i][c] = d[i - 1][c] + (d[i][c] - d[i - 1][c]) * t;
            }
        }
        return d[degree_];
    }

    std::size_t degree_;
    std::vector<ExactRational> knots_;
    std::vector<std::size_t> spans_;
};

BezierPatch rounded(std::size_t degree_u, std::size_t degree_v,
                    const std::vector<std::vector<ExactHomogeneous>>& rows) {
    std::vector<Point3d> points;
    std::vector<double> weights;
    for (const auto& row : rows)
        for (const ExactHomogeneous& p : row) {
            points.push_back(
                {(p[0] / p[3]).to_double(), (p[1] / p[3]).to_double(), (p[2] / p[3]).to_double()});
            weights.push_back(p[3].to_double());
        }
    return {degree_u, degree_v, std::move(points), std::move(weights)};
}

}  // namespace

BSplinePatches to_bezier(const BSplineSurface& s) {
    const Knots u(s.knots_u, s.degree_u, "u");
    const Knots v(s.knots_v, s.degree_v, "v");
    const std::size_t count = u.count() * v.count();
    if (s.points.size() != count || (!s.weights.empty() && s.weights.size() != count))
        throw UsageError("a B-spline surface with knots for " + std::to_string(u.count()) + " x " +
                         std::to_string(v.count()) + " control points, but " +
                         std::to_string(s.points.size()) + " points and " +
                         std::to_string(s.weights.size()) + " weights");
    std::vector<std::vector<ExactHomogeneous>> rows(u.count());
    double largest = 0;
    for (std::size_t i = 0; i < u.count(); ++i)
        for (std::size_t j = 0; j < v.count(); ++j) {
            const std::size_t at = i * v.count() + j;
            const double w = s.weights.empty() ? 1 : s.weights[at];
            if (!(w > 0 && std::isfinite(w)))
                throw UsageError("the weight of control point " + std::to_string(at) +
                                 " is not a positive number");
            ExactHomogeneous p;
            p[3] = ExactRational::from_double(w);
            for (std::size_t c = 0; c < 3; ++c) {
                p[c] = ExactRational::from_double(s.points[at][c]) * p[3];
                largest = std::max(largest, std::abs(s.points[at][c]));
            }
            rows[i].push_back(std::move(p));
        }

    BSplinePatches r;
    r.rows = u.spans().size();
    r.columns = v.spans().size();
    // Points are off by 2^-53 of their coordinates, and weights by 2^-53 of themselves, which moves
    // weighted means by at most twice that of the extent.
    r.largest_move = 8 * detail::unit_roundoff * largest;
    for (const std::size_t k : u.spans()) {
        // Over this span of u: one curve of u for each column.
        std::vector<std::vector<ExactHomogeneous>> across(s.degree_u + 1);
        for (std::size_t j = 0; j < v.count(); ++j) {
            std::vector<ExactHomogeneous> column;
            for (std::size_t i = 0; i < u.count(); ++i) column.push_back(rows[i][j]);
            const auto curve = u.bezier(k, column);
            for (std::size_t i = 0; i <= s.degree_u; ++i) across[i].push_back(curve[i]);
        }
        for (const std::size_t l : v.spans()) {
            std::vector<std::vector<ExactHomogeneous>> net;
            for (const auto& row : across) net.push_back(v.bezier(l, row));
            r.patches.push_back(rounded(s.degree_u, s.degree_v, net));
        }
    }
    return r;
}

}  // namespace trisect
