// SPDX-License-Identifier: Apache-2.0
//
// Volume and moments are sums over the fan triangles (o, p, q) of the faces, each standing for the
// tetrahedron with the origin:
//
//     6 V = Σ det(o, p, q),        24 ∫ x dV = Σ det(o, p, q) (o + p + q).
//
// The fan's apex o may be any point of the face's plane; one serves all loops of a face, and
// holes subtract by their orientation.
//
// Lattice points give integers that fit fixed registers: |det| <= 6·2^159 < 2^162, times a sum of
// three coordinates < 2^217, which leaves 256 bits room for 2^38 triangles.
//
// Plane points are quotients with denominators of up to 330 bits, all different. Adding the terms
// one after the other costs O(n^2) for n points, and reducing each partial sum is slower still.
//
//  * Doubles (`FixedPointSums`): each term is divided to a fixed number of fractional bits, rounded
//    down. n terms enclose the sum in [s, s + n] units; where both ends round to the same double
//    that is the answer, otherwise the precision doubles and finally the exact sum decides. Before
//    that the volume is tried in pairs of doubles (pair_corners.h), which have some 100 bits.
//  * Exact sums (`FractionTree`): det(o, p, q) has the denominator w_o w_p w_q, so the whole sum
//    has a denominator that contains each w once (more often only where different points have equal
//    w). A node of a balanced tree keeps the set of the denominators below it; merging two nodes
//    multiplies by what the other has and it has not. Faces that are close in the list share
//    points, so little is counted twice, and one reduction at the end suffices.

#include <trisect/brep/measure.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <trisect/brep/measure/exact_values.h>
#include <trisect/brep/measure/face_sets.h>
#include <trisect/brep/measure/fraction_tree.h>
#include <trisect/brep/measure/pair_corners.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect {

namespace {

using namespace detail;

constexpr std::size_t axes = 3;

// Σ det and Σ det·(o + p + q), see the essay.
template <class Integer>
struct Sums {
    Integer volume6 = 0;
    std::array<Integer, axes> moment24{};
};

// Which of the sums are wanted.
enum class Want { Volume, VolumeAndMoments };

class LatticeSums {
public:
    explicit LatticeSums(Want want) : want_(want) {}

    void add(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
        if (!(a.is_whole() && b.is_whole() && c.is_whole())) [[unlikely]]
            return add_fractions({a, b, c});
        const Integers o = to_integers(a);
        const Integers p = to_integers(b);
        const Integers q = to_integers(c);
        const auto det = multiply<3>(WideInt<2>(minor(p, q, 1, 2)), WideInt<1>(o[0])) +
                         multiply<3>(WideInt<2>(minor(p, q, 2, 0)), WideInt<1>(o[1])) +
                         multiply<3>(WideInt<2>(minor(p, q, 0, 1)), WideInt<1>(o[2]));
        sums_.volume6 += WideInt<4>(det);
        if (want_ == Want::Volume) return;
        for (std::size_t i = 0; i < 3; ++i)
            sums_.moment24[i] += multiply<4>(det, WideInt<1>(o[i] + p[i] + q[i]));
    }
    ExactRational volume6() const {
        return ExactRational(sums_.volume6) +
               ExactRational(fine_.volume6).scaled(-3 * fraction_limit);
    }
    ExactRational moment24(std::size_t i) const {
        return ExactRational(sums_.moment24[i]) +
               ExactRational(fine_.moment24[i]).scaled(-4 * fraction_limit);
    }
    /// The same, times 2^bits and rounded down.
    mpz_class volume6(unsigned long bits) const {
        return fixed(sums_.volume6, fine_.volume6, 3 * fraction_limit, bits);
    }
    mpz_class moment24(std::size_t i, unsigned long bits) const {
        return fixed(sums_.moment24[i], fine_.moment24[i], 4 * fraction_limit, bits);
    }

private:
    // Coordinates in units of 2^-fraction_limit have 126 bits: minors 254, determinants 382, times
    // a sum of three 510, which leaves room for 2^64 triangles.
    using Fine = WideInt<9>;

    void add_fractions(const std::array<LatticePoint, 3>& corners) {
        const auto fine = [&](std::size_t i, std::size_t k) {
            return WideInt<2>(scaled_integer(coordinate(corners[i], k), fraction_limit));
        };
        WideInt<6> det;
        for (std::size_t i = 0; i < axes; ++i) {
            const std::size_t j = (i + 1) % axes;
            const std::size_t k = (i + 2) % axes;
            const auto minor =
                multiply<4>(fine(1, j), fine(2, k)) - multiply<4>(fine(1, k), fine(2, j));
            det += multiply<6>(minor, fine(0, i));
        }
        fine_.volume6 += Fine(det);
        if (want_ == Want::Volume) return;
        for (std::size_t i = 0; i < axes; ++i)
            for (std::size_t corner = 0; corner < 3; ++corner)
                fine_.moment24[i] += multiply<9>(det, fine(corner, i));
    }
    template <int N>
    static mpz_class fixed(const WideInt<N>& whole, const Fine& fine, int fine_bits,
                           unsigned long bits) {
        mpz_class rest = to_integer(fine) << bits;
        mpz_fdiv_q_2exp(rest.get_mpz_t(), rest.get_mpz_t(), static_cast<mp_bitcnt_t>(fine_bits));
        return (to_integer(whole) << bits) + rest;
    }

    using Integers = VectorOf<std::int64_t>;

    static Int128 minor(const Integers& p, const Integers& q, std::size_t i, std::size_t j) {
        return Int128{p[i]} * q[j] - Int128{p[j]} * q[i];
    }

    Want want_;
    Sums<WideInt<4>> sums_;
    Sums<Fine> fine_;  // of triangles with bits behind the point
};

mpz_class shifted_quotient(const mpz_class& n, const mpz_class& d, unsigned long bits) {
    mpz_class q = n << bits;
    mpz_fdiv_q(q.get_mpz_t(), q.get_mpz_t(), d.get_mpz_t());
    return q;
}

// Volume and moments of some faces.
template <class Boundary>
class SolidMeasure {
public:
    SolidMeasure(Boundary boundary, Want want)
        : boundary_(boundary),
          want_(want),
          lattice_(want),
          exact_faces_(faces_with_plane_points()) {}

    [[nodiscard]] Lattice lattice() const { return boundary_.lattice(); }

    ExactRational volume6() const {
        ExactRational r = lattice_.volume6();
        if (!exact_faces_.empty())
            r += exact_sum(3, [](const mpz_class& det, const mpz_class& w, const auto&...) {
                return fraction(det, w);
            });
        return r;
    }
    ExactRational moment24(std::size_t axis) const {
        ExactRational r = lattice_.moment24(axis);
        if (exact_faces_.empty()) return r;
        r += exact_sum(4, [axis](const mpz_class& det, const mpz_class& w, const Corner& o,
                                 const Corner& p, const Corner& q) {
            return fraction(det * coordinate_sum(axis, o, p, q), w * w);
        });
        return r;
    }
    bool is_exact() const { return exact_faces_.empty(); }

    /// What encloses 6 V in pairs of doubles.
    std::pair<ExactRational, ExactRational> quick_volume6() const {
        const PairCorners corners = pair_corners(boundary_, exact_faces_);
        PairSum sum;
        for (const std::uint32_t f : exact_faces_)
            boundary_.for_each_triangle(f, [&](std::uint32_t o, std::uint32_t p, std::uint32_t q) {
                corners.add_determinant(o, p, q, sum);
            });
        const ExactRational middle = lattice_.volume6() + sum.middle();
        const ExactRational error = ExactRational::from_double(sum.error());
        return {middle - error, middle + error};
    }

    // Enclosures of 6 V and of the 24-fold moments.
    std::pair<Enclosure, std::array<Enclosure, axes>> enclose(unsigned long bits) const {
        Sums<mpz_class> sums;
        sums.volume6 = lattice_.volume6(bits);
        for (std::size_t i = 0; i < axes; ++i) sums.moment24[i] = lattice_.moment24(i, bits);
        unsigned long terms = 1;  // what lattice_ rounds down
        for_each_exact_triangle([&](const mpz_class& det, const mpz_class& w, const Corner& o,
                                    const Corner& p, const Corner& q) {
            ++terms;
            sums.volume6 += shifted_quotient(det, w, bits);
            if (want_ == Want::Volume) return;
            const mpz_class ww = w * w;
            for (std::size_t i = 0; i < axes; ++i)
                sums.moment24[i] += shifted_quotient(det * coordinate_sum(i, o, p, q), ww, bits);
        });
        const auto enclosure = [&](const mpz_class& low) {
            return Enclosure{low, mpz_class(terms), bits};
        };
        return {enclosure(sums.volume6),
                {enclosure(sums.moment24[0]), enclosure(sums.moment24[1]),
                 enclosure(sums.moment24[2])}};
    }

private:
    const ExactCorners& corners() const {
        if (!corners_) corners_.emplace(boundary_, exact_faces_);
        return *corners_;
    }

    std::vector<std::uint32_t> faces_with_plane_points() {
        std::vector<std::uint32_t> exact;
        boundary_.for_each_face([&](std::uint32_t f) {
            if (!is_lattice_face(boundary_, f)) {
                exact.push_back(f);
                return;
            }
            boundary_.for_each_triangle(
                f, [this](std::uint32_t o, std::uint32_t p, std::uint32_t q) {
                    lattice_.add(boundary_.point(o).lattice(), boundary_.point(p).lattice(),
                                 boundary_.point(q).lattice());
                });
        });
        return exact;
    }

    // (o + p + q)_axis times w_o w_p w_q.
    static mpz_class coordinate_sum(std::size_t axis, const Corner& o, const Corner& p,
                                    const Corner& q) {
        return o.x[axis] * p.w * q.w + p.x[axis] * o.w * q.w + q.x[axis] * o.w * p.w;
    }

    template <class Visit>
    void for_each_exact_triangle(std::uint32_t f, const Visit& visit) const {
        boundary_.for_each_triangle(f, [&](std::uint32_t o, std::uint32_t p, std::uint32_t q) {
            const Corner& a = corners()[o];
            const Corner& b = corners()[p];
            const Corner& c = corners()[q];
            visit(determinant(a, b, c), mpz_class(a.w * b.w * c.w), a, b, c);
        });
    }
    template <class Visit>
    void for_each_exact_triangle(const Visit& visit) const {
        for (const std::uint32_t f : exact_faces_) for_each_exact_triangle(f, visit);
    }

    // `degree` is the number of coordinates multiplied in a term.
    template <class Term>
    ExactRational exact_sum(unsigned degree, const Term& term) const {
        FractionTree tree(corners());
        for (const std::uint32_t f : exact_faces_) {
            mpq_class sum = 0;
            for_each_exact_triangle(
                f, [&](const mpz_class& det, const mpz_class& w, const Corner& o, const Corner& p,
                       const Corner& q) { sum += term(det, w, o, p, q); });
            tree.add(sum, denominators(f, degree));
        }
        const auto [numerator, denominator] = tree.sum();
        return to_rational(numerator, denominator);
    }

    // A term multiplies the coordinates of three different corners, and one of them twice when
    // the degree is 4: a denominator appears at most that often.
    Denominators denominators(std::uint32_t f, unsigned degree) const {
        std::vector<std::uint32_t> numbers;
        boundary_.for_each_corner(
            f, [&](std::uint32_t v) { numbers.push_back(corners()[v].denominator); });
        std::sort(numbers.begin(), numbers.end());
        Denominators powers;
        for (std::size_t i = 0; i < numbers.size();) {
            std::size_t j = i;
            while (j < numbers.size() && numbers[j] == numbers[i]) ++j;
            if (numbers[i] != 0)
                powers.emplace_back(
                    numbers[i],
                    std::min<unsigned>(degree, static_cast<unsigned>(j - i + degree - 3)));
            i = j;
        }
        return powers;
    }

    Boundary boundary_;
    Want want_;
    LatticeSums lattice_;
    std::vector<std::uint32_t> exact_faces_;
    mutable std::optional<ExactCorners> corners_;  // made when they are first needed
};

ExactRational volume_from(const ExactRational& volume6, Lattice lattice) {
    return (volume6 / ExactRational(6)).scaled(3 * lattice.exponent);
}

ExactRational coordinate_from(const ExactRational& moment24, const ExactRational& volume6,
                              Lattice lattice) {
    return (moment24 / (volume6 * ExactRational(4))).scaled(lattice.exponent);
}

template <class Boundary>
ExactRational exact_volume_of(Boundary boundary) {
    return volume_from(SolidMeasure(boundary, Want::Volume).volume6(), boundary.lattice());
}

template <class Boundary>
double rounded_volume(Boundary boundary) {
    const SolidMeasure m(boundary, Want::Volume);
    if (!m.is_exact()) {
        const auto [least, most] = m.quick_volume6();
        const double quick = volume_from(least, m.lattice()).to_double();
        if (quick != 0 && quick == volume_from(most, m.lattice()).to_double()) return quick;
        for (const unsigned long bits : precisions) {
            const Enclosure e = m.enclose(bits).first;
            const double low = volume_from(e.lower_end(), m.lattice()).to_double();
            if (low != 0 && low == volume_from(e.upper_end(), m.lattice()).to_double()) return low;
        }
    }
    return volume_from(m.volume6(), m.lattice()).to_double();
}

// The double that the quotient of the enclosed numbers rounds to, if it is unique.
std::optional<double> rounded_coordinate(const Enclosure& moment24, const Enclosure& volume6,
                                         Lattice lattice) {
    // The extremes of a quotient whose divisor has one sign are quotients of the ends.
    std::optional<double> common;
    for (const auto& m : {moment24.lower_end(), moment24.upper_end()}) {
        for (const auto& v : {volume6.lower_end(), volume6.upper_end()}) {
            const double r = coordinate_from(m, v, lattice).to_double();
            if (common && *common != r) return std::nullopt;
            common = r;
        }
    }
    return common;
}

template <class Boundary>
std::optional<Point3d> rounded_centroid(const SolidMeasure<Boundary>& m) {
    if (m.is_exact()) return std::nullopt;
    for (const unsigned long bits : precisions) {
        const auto [volume6, moments] = m.enclose(bits);
        const int sign = volume6.lower_end().sign();
        if (sign == 0 || sign != volume6.upper_end().sign()) continue;
        Point3d out{};
        bool known = true;
        for (std::size_t i = 0; i < axes && known; ++i) {
            const auto c = rounded_coordinate(moments[i], volume6, m.lattice());
            known = c.has_value();
            if (known) out[i] = *c;
        }
        if (known) return out;
    }
    return std::nullopt;
}

std::optional<Point3d> rounded(const std::optional<std::array<ExactRational, 3>>& c) {
    if (!c) return std::nullopt;
    return Point3d{(*c)[0].to_double(), (*c)[1].to_double(), (*c)[2].to_double()};
}

template <class Boundary>
std::optional<std::array<ExactRational, 3>> exact_centroid_of(const SolidMeasure<Boundary>& m) {
    const ExactRational v = m.volume6();
    if (v.sign() == 0) return std::nullopt;
    const auto coordinate = [&](std::size_t i) {
        return coordinate_from(m.moment24(i), v, m.lattice());
    };
    return std::array{coordinate(0), coordinate(1), coordinate(2)};
}

template <class Boundary>
std::optional<Point3d> centroid_of(Boundary boundary) {
    const SolidMeasure m(boundary, Want::VolumeAndMoments);
    if (const auto c = rounded_centroid(m)) return c;
    return rounded(exact_centroid_of(m));
}

LatticeSums sums_of(const LatticeMesh& mesh, Want want) {
    LatticeSums sums(want);
    for (const auto& t : mesh.triangles)
        sums.add(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    return sums;
}

template <class Boundary>
int sign_of_measured(const SolidMeasure<Boundary>& m) {
    if (!m.is_exact()) {
        const auto [least, most] = m.quick_volume6();
        if (least.sign() != 0 && least.sign() == most.sign()) return least.sign();
        for (const unsigned long bits : precisions) {
            const Enclosure e = m.enclose(bits).first;
            const int sign = e.lower_end().sign();
            if (sign != 0 && sign == e.upper_end().sign()) return sign;
        }
    }
    return m.volume6().sign();
}

}  // namespace

ExactRational exact_volume(const Brep& brep) { return exact_volume_of(BrepFaces(brep)); }

ExactRational exact_volume(const Brep& brep, ShellId shell) {
    return exact_volume_of(ShellFaces(brep, shell));
}

ExactRational exact_volume(const ExactMesh& mesh) { return exact_volume_of(MeshFaces(mesh)); }

ExactRational exact_volume(const LatticeMesh& mesh) {
    return volume_from(sums_of(mesh, Want::Volume).volume6(), mesh.lattice);
}

double volume(const Brep& brep) { return rounded_volume(BrepFaces(brep)); }

double volume(const Brep& brep, ShellId shell) { return rounded_volume(ShellFaces(brep, shell)); }

double volume(const ExactMesh& mesh) { return rounded_volume(MeshFaces(mesh)); }

double volume(const LatticeMesh& mesh) { return exact_volume(mesh).to_double(); }

int sign_of_volume(const Brep& brep) {
    return sign_of_measured(SolidMeasure(BrepFaces(brep), Want::Volume));
}

int sign_of_volume(const Brep& brep, ShellId shell) {
    return sign_of_measured(SolidMeasure(ShellFaces(brep, shell), Want::Volume));
}

std::optional<std::array<ExactRational, 3>> exact_centroid(const Brep& brep) {
    return exact_centroid_of(SolidMeasure(BrepFaces(brep), Want::VolumeAndMoments));
}

std::optional<std::array<ExactRational, 3>> exact_centroid(const ExactMesh& mesh) {
    return exact_centroid_of(SolidMeasure(MeshFaces(mesh), Want::VolumeAndMoments));
}

std::optional<std::array<ExactRational, 3>> exact_centroid(const LatticeMesh& mesh) {
    const LatticeSums sums = sums_of(mesh, Want::VolumeAndMoments);
    const ExactRational v = sums.volume6();
    if (v.sign() == 0) return std::nullopt;
    const auto coordinate = [&](std::size_t i) {
        return coordinate_from(sums.moment24(i), v, mesh.lattice);
    };
    return std::array{coordinate(0), coordinate(1), coordinate(2)};
}

std::optional<Point3d> centroid(const Brep& brep) { return centroid_of(BrepFaces(brep)); }

std::optional<Point3d> centroid(const ExactMesh& mesh) { return centroid_of(MeshFaces(mesh)); }

std::optional<Point3d> centroid(const LatticeMesh& mesh) { return rounded(exact_centroid(mesh)); }

}  // namespace trisect
