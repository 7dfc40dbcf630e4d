// SPDX-License-Identifier: Apache-2.0
//
// Of a facet's plane at a corner of its own nothing is computed: the value is 0. So is the
// determinant of two edges that end in one corner. What the moves make of such a sign is that of
// its first derivative (shifted_pairs.cpp, corner_derivatives.h), in doubles with a bound.
//
// Where meshes have most corners in common, as a mesh and its mirror image, nearly all pairs of
// facets that are near each other are of this kind.

#include <trisect/bsp/two_meshes/corner_pairs.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <trisect/bsp/cells/shift/corner_moves.h>
#include <trisect/bsp/cells/trace/interpolation.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/orientation.h>

namespace trisect::detail {

namespace {

// By corner of the one facet: the same of the other one, or -1.
using Matches = std::array<std::int8_t, 3>;

const LatticePoint& lattice_corner(const FilteredFacet& f, std::size_t i) {
    return f.ref.source->corner(f.ref.facet, static_cast<int>(i));
}

// A sum of products with a bound on its error.
struct Sum {
    double value = 0;
    double size = 0;  // of the terms

    void add(double a, double b, double size_of_a) {
        value += a * b;
        size += size_of_a * std::fabs(b);
    }
    // Terms carry at most five roundings, of a difference of products of differences and of the
    // product with an integer or a difference, and the sums of six of them five more: 11 u.
    [[nodiscard]] int sign() const { return certain_sign(value, 0x1p-48 * size); }
};

// The product of two vectors with the sums of its terms' magnitudes.
struct Product {
    Vector3 value{};
    Vector3 size{};

    Product(const Vector3& u, const Vector3& v) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            const double s = u[i] * v[j];
            const double t = u[j] * v[i];
            value[k] = s - t;
            size[k] = std::fabs(s) + std::fabs(t);
        }
    }
    void add_to(Sum& sum, const Vector3& v) const {
        for (std::size_t k = 0; k < 3; ++k) sum.add(value[k], v[k], size[k]);
    }
};

Vector3 in_doubles(const CornerMoves::Vector& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// Of a plane's normal and a move, which is what a corner in the plane gains in value.
int along_normal(const FilteredPlane& plane, const Vector3& move) {
    Sum sum;
    for (std::size_t k = 0; k < 3; ++k) sum.add(plane.normal[k], move[k], plane.slope);
    return sum.sign();
}

// The corners of a facet and the plane of another one, with the moves.
struct MovedSides {
    std::array<double, 3> value{};
    double bound = 0;
    std::array<int, 3> sign{};
    unsigned on = 0;  // without the moves
    int above = 0;

    // `derivative`: of common corners. False where doubles leave a sign open.
    template <class Derivative>
    [[nodiscard]] bool set(const FilteredPlane& plane, const FilteredFacet& facet,
                           const Matches& matches, const Derivative& derivative) {
        bound = plane.bound;
        for (std::size_t i = 0; i < 3; ++i) {
            if (matches[i] >= 0) {
                on |= 1U << i;
                sign[i] = derivative(i);
            } else {
                value[i] = plane.value(facet.corners[i]);
                sign[i] = certain_sign(value[i], bound);
            }
            if (sign[i] == 0) return false;
            above += sign[i] > 0 ? 1 : 0;
        }
        return true;
    }
    [[nodiscard]] bool is_off() const { return above == 0 || above == 3; }
    [[nodiscard]] bool is_on(std::size_t i) const { return (on >> i & 1U) != 0; }
    /// The corner that is alone on its side. \pre not is_off()
    [[nodiscard]] std::size_t lonely() const {
        const int alone = above == 1 ? 1 : -1;
        return sign[0] == alone ? 0 : (sign[1] == alone ? 1 : 2);
    }
};

// A facet's corners, the lonely one first, and turned over if need be so that the other facet's
// lonely corner is above it.
struct NumberedCorners {
    std::array<std::size_t, 3> corner;
    const FilteredFacet& facet;

    NumberedCorners(const FilteredFacet& f, std::size_t lonely, bool turned)
        : corner{lonely, (lonely + 1) % 3, (lonely + 2) % 3}, facet(f) {
        if (turned) std::swap(corner[1], corner[2]);
    }
    [[nodiscard]] const Vector3& operator[](std::size_t i) const {
        return facet.corners[corner[i]];
    }
    [[nodiscard]] std::int8_t edge_to(std::size_t i) const {
        const std::size_t a = corner[0];
        const std::size_t b = corner[i];
        return static_cast<std::int8_t>(b == (a + 1) % 3 ? a : b);
    }
};

class CornerPair {
public:
    CornerPair(FilteredFacets& facets, LeafIndex first, LeafIndex second,
               const CommonCorners& common, const InfinitesimalShift& shift)
        : facets_(facets),
          a_(facets[first]),
          b_(facets[second]),
          plane_a_(facets.plane(first)),
          plane_b_(facets.plane(second)),
          moves_(*shift.moves),
          of_a_matches_(common.of_first) {
        for (std::size_t i = 0; i < 3; ++i)
            if (const std::int8_t j = of_a_matches_[i]; j >= 0)
                of_b_matches_[static_cast<std::size_t>(j)] = static_cast<std::int8_t>(i);
    }

    [[nodiscard]] std::optional<ShiftedPair> relate() {
        ShiftedPair out;
        out.touches = true;
        if (!of_b_.set(plane_a_, b_, of_b_matches_,
                       [&](std::size_t i) { return along_normal(plane_a_, move_of(i)); }))
            return std::nullopt;
        if (of_b_.is_off()) return out;
        if (!of_a_.set(plane_b_, a_, of_a_matches_, [&](std::size_t i) {
                return -along_normal(plane_b_, move_of(static_cast<std::size_t>(of_a_matches_[i])));
            }))
            return std::nullopt;
        if (of_a_.is_off()) return out;
        return relate_edges(out);
    }

private:
    [[nodiscard]] Vector3 move_of(std::size_t corner) const {
        return in_doubles(moves_.of(lattice_corner(b_, corner)));
    }

    [[nodiscard]] std::optional<ShiftedPair> relate_edges(ShiftedPair& out) {
        const std::size_t lonely_a = of_a_.lonely();
        const std::size_t lonely_b = of_b_.lonely();
        const bool turned_a = of_b_.sign[lonely_b] < 0;
        const bool turned_b = of_a_.sign[lonely_a] < 0;
        const NumberedCorners p(a_, lonely_a, turned_a);
        const NumberedCorners q(b_, lonely_b, turned_b);
        bool touches = false;
        const int first = order(p, q, 1, 1, touches);
        if (first == 0) return std::nullopt;
        // As there: what parts them without the moves parts them with a gap.
        if (first < 0) return apart(out, touches);
        touches = false;
        const int second = order(p, q, 2, 2, touches);
        if (second == 0) return std::nullopt;
        if (second > 0) return apart(out, touches);
        const int starts = order(p, q, 2, 1, touches);
        const int ends = order(p, q, 1, 2, touches);
        if (starts == 0 || ends == 0) return std::nullopt;
        out.kind = ShiftedPair::Kind::Crossing;
        const auto set = [&](FacetCrossing::End& end, bool of_second, std::size_t corner) {
            return of_second ? set_end(q, of_b_, corner, true, end)
                             : set_end(p, of_a_, corner, false, end);
        };
        const std::size_t start = turned_a != turned_b ? 1 : 0;
        if (!set(out.ends[start], starts < 0, starts < 0 ? 1 : 2) ||
            !set(out.ends[1 - start], ends > 0, ends > 0 ? 2 : 1))
            return std::nullopt;
        return out;
    }

    [[nodiscard]] static std::optional<ShiftedPair> apart(ShiftedPair& out, bool touches) {
        out.touches = touches;
        return out;
    }

    // The sign of det(p0 - qj, pi - qj, q0 - qj); 0 where doubles leave it open.
    [[nodiscard]] int order(const NumberedCorners& p, const NumberedCorners& q, std::size_t i,
                            std::size_t j, bool& touches) const {
        const auto is_common = [&](std::size_t m, std::size_t n) {
            return of_a_matches_[p.corner[m]] == static_cast<std::int8_t>(q.corner[n]);
        };
        if (!is_common(0, 0) && !is_common(0, j) && !is_common(i, 0) && !is_common(i, j))
            return filtered_orientation(p[0], p[i], q[0], q[j]);
        touches = true;
        const Vector3 u0 = move_of(q.corner[0]);
        const Vector3 uj = move_of(q.corner[j]);
        Sum sum;
        Product(minus(p[0], q[j]), minus(p[i], q[j])).add_to(sum, minus(u0, uj));
        Product(minus(p[i], p[0]), minus(q[j], q[0])).add_to(sum, uj);
        return sum.sign();
    }

    // Where the edge from the lonely corner to corner i goes through the other plane.
    [[nodiscard]] bool set_end(const NumberedCorners& t, const MovedSides& sides, std::size_t i,
                               bool of_second, FacetCrossing::End& end) const {
        end.of_second = of_second;
        end.edge = t.edge_to(i);
        end.corner = -1;
        std::size_t from = t.corner[0];
        std::size_t to = t.corner[i];
        // An edge of both facets, of which the ends go to different sides, is left to the numbers
        // of relate_shifted().
        if (sides.is_on(from) && sides.is_on(to)) return false;
        for (const std::size_t c : {from, to}) {
            if (!sides.is_on(c)) continue;
            end.corner = static_cast<std::int8_t>(c);
            end.at = approximate(lattice_corner(t.facet, c));
            return true;
        }
        Approximation at;
        if (!interpolate({t.facet.corners[from], 0.0}, sides.value[from],
                         {t.facet.corners[to], 0.0}, sides.value[to], 2 * sides.bound, at))
            return false;
        end.at = facets_.in_lattice(at);
        return true;
    }

    const FilteredFacets& facets_;
    const FilteredFacet& a_;
    const FilteredFacet& b_;
    const FilteredPlane& plane_a_;
    const FilteredPlane& plane_b_;
    const CornerMoves& moves_;  // of the second facet's corners
    Matches of_a_matches_;
    Matches of_b_matches_{-1, -1, -1};
    MovedSides of_a_;
    MovedSides of_b_;
};

}  // namespace

std::optional<ShiftedPair> relate_at_corners(FilteredFacets& facets, LeafIndex first,
                                             LeafIndex second, const CommonCorners& common,
                                             const InfinitesimalShift& shift) {
    if (common.count == 0 || common.count == 3) return std::nullopt;
    return CornerPair(facets, first, second, common, shift).relate();
}

}  // namespace trisect::detail
