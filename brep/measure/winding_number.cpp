// SPDX-License-Identifier: Apache-2.0
//
// A ray towards +x is counted against all triangles. Where it would meet an edge or a corner, the
// point is moved by (0, e, e^2) for an infinitely small e > 0: the point is not on the surface, so
// its winding number stays the same, and the moved ray meets no edge that is not parallel to it.
// A sign that is zero is then the sign of its derivative by y, or else by z; this is the rule for
// half-open edges of scan conversion, and needs neither retries nor other directions
// [Edelsbrunner and Mücke, Simulation of simplicity, 1990].
#include <trisect/brep/winding_number.h>

#include <trisect/brep/measure/exact_values.h>
#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/plane.h>

namespace trisect {

namespace {

using detail::to_gmp;
using detail::to_integer;

/// p = x / w in lattice units, and the integers around each coordinate.
struct HomogeneousQuery {
    std::array<mpz_class, 3> x;
    mpz_class w;
    std::array<Coordinate, 3> below, above;
};

/// Beyond all coordinates all integers are alike.
Coordinate clamped(const mpz_class& v) {
    const mpz_class limit = to_gmp(coordinate_limit);
    if (v > limit) return coordinate_limit;
    if (v < -limit) return -coordinate_limit;
    return detail::to_int64(v);
}

HomogeneousQuery query_of(const ExactPoint& point, Lattice lattice) {
    HomogeneousQuery q;
    std::array<mpq_class, 3> value;
    q.w = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        value[k] = detail::to_fraction(point[k].scaled(-lattice.exponent));
        mpz_lcm(q.w.get_mpz_t(), q.w.get_mpz_t(), value[k].get_den_mpz_t());
    }
    for (std::size_t k = 0; k < 3; ++k) {
        q.x[k] = value[k].get_num() * (q.w / value[k].get_den());
        mpz_class quotient;
        mpz_fdiv_q(quotient.get_mpz_t(), q.x[k].get_mpz_t(), q.w.get_mpz_t());
        q.below[k] = clamped(quotient);
        mpz_cdiv_q(quotient.get_mpz_t(), q.x[k].get_mpz_t(), q.w.get_mpz_t());
        q.above[k] = clamped(quotient);
    }
    return q;
}

class RayCount {
public:
    RayCount(const LatticeMesh& mesh, const ExactPoint& point)
        : mesh_(mesh), q_(query_of(point, mesh.lattice)) {}

    std::optional<int> count() {
        int total = 0;
        for (const auto& t : mesh_.triangles) {
            const LatticePoint& a = mesh_.points[t[0]];
            const LatticePoint& b = mesh_.points[t[1]];
            const LatticePoint& c = mesh_.points[t[2]];
            if (is_passed_by(a, b, c)) continue;
            const int side = side_of_plane(Plane::through(a, b, c));
            if (side == 0 && is_on(a, b, c)) return std::nullopt;
            total += crossing(a, b, c, side);
        }
        return total;
    }

private:
    /// The ray begins behind all corners, or all corners are beside it.
    bool is_passed_by(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) const {
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            if (a[axis] < q_.below[k] && b[axis] < q_.below[k] && c[axis] < q_.below[k])
                return true;
            if (axis != 0 && a[axis] > q_.above[k] && b[axis] > q_.above[k] &&
                c[axis] > q_.above[k])
                return true;
        }
        return false;
    }

    int side_of_plane(const Plane& p) const {
        mpz_class value = to_integer(p.offset()) * q_.w;
        for (int i = 0; i < 3; ++i)
            value += to_integer(p.normal(i)) * q_.x[static_cast<std::size_t>(i)];
        return sgn(value);
    }

    /// Of a, b and the point in the projection to two axes; positive for a left turn.
    int turn(const LatticePoint& a, const LatticePoint& b, int u, int v) const {
        const auto pu = static_cast<std::size_t>(u);
        const auto pv = static_cast<std::size_t>(v);
        if (!(a.is_whole() && b.is_whole())) return turn_of_fractions(a, b, u, v);
        const mpz_class au = to_gmp(a[u].to_integer());
        const mpz_class av = to_gmp(a[v].to_integer());
        const mpz_class left = to_gmp(detail::difference(b[u], a[u])) * (q_.x[pv] - q_.w * av);
        const mpz_class right = to_gmp(detail::difference(b[v], a[v])) * (q_.x[pu] - q_.w * au);
        return sgn(mpz_class(left - right));
    }

    int turn_of_fractions(const LatticePoint& a, const LatticePoint& b, int u, int v) const {
        const auto fine = [](Coordinate c) {
            return to_integer(WideInt<2>(detail::scaled_integer(c, fraction_limit)));
        };
        const auto from = [&](int k) {
            const mpz_class x = q_.x[static_cast<std::size_t>(k)] << fraction_limit;
            return mpz_class(x - q_.w * fine(a[k]));
        };
        const auto way = [&](int k) { return mpz_class(fine(b[k]) - fine(a[k])); };
        return sgn(mpz_class(way(u) * from(v) - way(v) * from(u)));
    }

    /// \pre the point is in the triangle's plane.
    bool is_on(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) const {
        const int axis = Plane::through(a, b, c).dominant_axis();
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const int ab = turn(a, b, u, v);
        const int bc = turn(b, c, u, v);
        const int ca = turn(c, a, u, v);
        return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    }

    /// Never 0 unless a and b agree in y and z: see the essay.
    int moved_turn(const LatticePoint& a, const LatticePoint& b) const {
        const int exact = turn(a, b, 1, 2);
        if (exact != 0) return exact;
        if (a.z != b.z) return b.z > a.z ? -1 : 1;
        return a.y == b.y ? 0 : (b.y > a.y ? 1 : -1);
    }

    int crossing(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                 int side) const {
        const int ab = moved_turn(a, b);
        if (ab == 0 || moved_turn(b, c) != ab || moved_turn(c, a) != ab) return 0;
        // Seen along -x the triangle turns left when its normal points to +x.
        return side == -ab ? ab : 0;
    }

    const LatticeMesh& mesh_;
    HomogeneousQuery q_;
};

}  // namespace

std::optional<int> winding_number(const LatticeMesh& mesh, const ExactPoint& point) {
    return RayCount(mesh, point).count();
}

}  // namespace trisect
