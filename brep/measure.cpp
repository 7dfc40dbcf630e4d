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
//    that is the answer, otherwise the precision doubles and finally the exact sum decides.
//  * Exact sums (`FractionTree`): det(o, p, q) has the denominator w_o w_p w_q, so the whole sum
//    has a denominator that contains each w once (more often only where different points have equal
//    w). A node of a balanced tree keeps the set of the denominators below it; merging two nodes
//    multiplies by what the other has and it has not. Faces that are close in the list share
//    points, so little is counted twice, and one reduction at the end suffices.
//
// The area of a face with normal n, whose projection along axis k has area S, is S/|n_k| · |n|: a
// rational times the root of an integer. The roots are taken to fixed point like the terms above.

#include <trisect/brep/measure.h>

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include <trisect/kernel/contract.h>

namespace trisect {

namespace {

constexpr std::array<unsigned long, 4> precisions{128, 512, 2048, 8192};
constexpr std::size_t axes = 3;

template <int N>
mpz_class to_integer(const WideInt<N>& v) {
    std::array<std::uint64_t, static_cast<std::size_t>(N)> limbs{};
    const WideInt<N> magnitude = v.abs();
    for (int i = 0; i < N; ++i) limbs[static_cast<std::size_t>(i)] = magnitude.limb(i);
    mpz_class z;
    mpz_import(z.get_mpz_t(), limbs.size(), -1, sizeof(std::uint64_t), 0, 0, limbs.data());
    return v.is_negative() ? mpz_class(-z) : z;
}

ExactRational to_rational(const mpz_class& numerator, const mpz_class& denominator) {
    static_assert(sizeof(mp_limb_t) == sizeof(std::uint64_t));
    const auto limbs = [](const mpz_class& z) {
        std::vector<std::uint64_t> out(mpz_size(z.get_mpz_t()));
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = mpz_getlimbn(z.get_mpz_t(), static_cast<mp_size_t>(i));
        return out;
    };
    return ExactRational::from_limbs(sgn(numerator) < 0, limbs(numerator), limbs(denominator));
}

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

    void add(const LatticePoint& o, const LatticePoint& p, const LatticePoint& q) {
        const auto det = multiply<3>(WideInt<2>(minor(p, q, 1, 2)), WideInt<1>(o.x)) +
                         multiply<3>(WideInt<2>(minor(p, q, 2, 0)), WideInt<1>(o.y)) +
                         multiply<3>(WideInt<2>(minor(p, q, 0, 1)), WideInt<1>(o.z));
        sums_.volume6 += WideInt<4>(det);
        if (want_ == Want::Volume) return;
        for (int i = 0; i < 3; ++i)
            sums_.moment24[static_cast<std::size_t>(i)] +=
                multiply<4>(det, WideInt<1>(o[i] + p[i] + q[i]));
    }
    const Sums<WideInt<4>>& sums() const { return sums_; }

private:
    static Int128 minor(const LatticePoint& p, const LatticePoint& q, int i, int j) {
        return Int128{p[i]} * q[j] - Int128{p[j]} * q[i];
    }

    Want want_;
    Sums<WideInt<4>> sums_;
};

// A point in lowest terms.
struct Corner {
    std::array<mpz_class, axes> x;
    mpz_class w;
    std::uint32_t denominator = 0;  // number of w among the different denominators
};

Corner corner_at(const Point& point) {
    const HomogeneousPoint h = point.homogeneous();
    Corner c{{to_integer(h.xyz[0]), to_integer(h.xyz[1]), to_integer(h.xyz[2])}, to_integer(h.w)};
    mpz_class common = c.w;
    for (const auto& x : c.x) common = gcd(common, x);
    for (auto& x : c.x) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), common.get_mpz_t());
    mpz_divexact(c.w.get_mpz_t(), c.w.get_mpz_t(), common.get_mpz_t());
    return c;
}

mpz_class determinant(const Corner& o, const Corner& p, const Corner& q) {
    return o.x[0] * (p.x[1] * q.x[2] - p.x[2] * q.x[1]) +
           o.x[1] * (p.x[2] * q.x[0] - p.x[0] * q.x[2]) +
           o.x[2] * (p.x[0] * q.x[1] - p.x[1] * q.x[0]);
}

bool is_lattice_face(const Brep& brep, FaceId f) {
    for (const HalfedgeId h : brep.halfedges(f))
        if (!brep.point(brep.origin(h)).is_lattice()) return false;
    return true;
}

// Calls visit(o, p, q) for the fan triangles of all loops, leaving out the flat ones at the apex.
template <class Visit>
void for_each_fan_triangle(const Brep& brep, FaceId f, const Visit& visit) {
    const VertexId o = brep.origin(brep.halfedges(f)[0]);
    for (const HalfedgeId h : brep.halfedges(f)) {
        const VertexId p = brep.origin(h);
        const VertexId q = brep.target(h);
        if (p != o && q != o) visit(o, p, q);
    }
}

// The corners of the faces that have a plane point.
class ExactCorners {
public:
    ExactCorners(const Brep& brep, std::span<const FaceId> faces) {
        number_.assign(brep.counts().vertices, EntityId<Corner>::none);
        std::map<mpz_class, std::uint32_t> numbers;
        numbers.emplace(1, 0U);
        for (const FaceId f : faces) {
            for (const HalfedgeId h : brep.halfedges(f)) {
                const VertexId v = brep.origin(h);
                if (number_[v.index] != EntityId<Corner>::none) continue;
                number_[v.index] = static_cast<std::uint32_t>(corners_.size());
                corners_.push_back(corner_at(brep.point(v)));
                Corner& c = corners_.back();
                const auto next = static_cast<std::uint32_t>(numbers.size());
                c.denominator = numbers.try_emplace(c.w, next).first->second;
            }
        }
        denominators_.resize(numbers.size());
        for (const auto& [w, number] : numbers) denominators_[number] = w;
    }
    const Corner& operator[](VertexId v) const { return corners_[number_[v.index]]; }
    const mpz_class& denominator(std::uint32_t number) const { return denominators_[number]; }

private:
    std::vector<std::uint32_t> number_;
    std::vector<Corner> corners_;
    std::vector<mpz_class> denominators_;
};

// A set of denominators with exponents, by ascending number. Number 0 is the denominator 1.
using Denominators = std::vector<std::pair<std::uint32_t, unsigned>>;

class FractionTree {
public:
    explicit FractionTree(const ExactCorners& corners) : corners_(corners) {}

    // \pre the denominator of the fraction divides the product of the powers
    void add(const mpq_class& fraction, Denominators powers) {
        mpz_class product = 1;
        for (const auto& [number, exponent] : powers) product *= power(number, exponent);
        mpz_class numerator = product;
        mpz_divexact(numerator.get_mpz_t(), numerator.get_mpz_t(), fraction.get_den_mpz_t());
        numerator *= fraction.get_num();
        leaves_.push_back({std::move(numerator), std::move(product), std::move(powers)});
    }
    // Not in lowest terms.
    std::pair<mpz_class, mpz_class> sum() {
        if (leaves_.empty()) return {0, 1};
        while (leaves_.size() > 1) {
            std::vector<Node> merged;
            merged.reserve((leaves_.size() + 1) / 2);
            for (std::size_t i = 0; i + 1 < leaves_.size(); i += 2)
                merged.push_back(merge(leaves_[i], leaves_[i + 1]));
            if (leaves_.size() % 2 != 0) merged.push_back(std::move(leaves_.back()));
            leaves_ = std::move(merged);
        }
        return {std::move(leaves_[0].numerator), std::move(leaves_[0].denominator)};
    }

private:
    struct Node {
        mpz_class numerator;
        mpz_class denominator;  // the product of the powers
        Denominators powers;
    };

    mpz_class power(std::uint32_t number, unsigned exponent) const {
        mpz_class p;
        mpz_pow_ui(p.get_mpz_t(), corners_.denominator(number).get_mpz_t(), exponent);
        return p;
    }

    Node merge(const Node& a, const Node& b) const {
        mpz_class shared = 1;
        Node out;
        auto i = a.powers.begin();
        auto j = b.powers.begin();
        while (i != a.powers.end() && j != b.powers.end()) {
            if (i->first < j->first) {
                out.powers.push_back(*i++);
            } else if (j->first < i->first) {
                out.powers.push_back(*j++);
            } else {
                shared *= power(i->first, std::min(i->second, j->second));
                out.powers.emplace_back(i->first, std::max(i->second, j->second));
                ++i;
                ++j;
            }
        }
        out.powers.insert(out.powers.end(), i, a.powers.end());
        out.powers.insert(out.powers.end(), j, b.powers.end());
        mpz_class only_b;
        mpz_class only_a;
        mpz_divexact(only_b.get_mpz_t(), b.denominator.get_mpz_t(), shared.get_mpz_t());
        mpz_divexact(only_a.get_mpz_t(), a.denominator.get_mpz_t(), shared.get_mpz_t());
        out.numerator = a.numerator * only_b + b.numerator * only_a;
        out.denominator = a.denominator * only_b;
        return out;
    }

    const ExactCorners& corners_;
    std::vector<Node> leaves_;
};

mpq_class fraction(const mpz_class& numerator, const mpz_class& denominator) {
    mpq_class q(numerator, denominator);
    q.canonicalize();
    return q;
}

mpz_class shifted_quotient(const mpz_class& n, const mpz_class& d, unsigned long bits) {
    mpz_class q = n << bits;
    mpz_fdiv_q(q.get_mpz_t(), q.get_mpz_t(), d.get_mpz_t());
    return q;
}

// A number known to lie in [low, low + width] units of 2^-bits.
struct Enclosure {
    mpz_class low;
    mpz_class width;
    unsigned long bits = 0;

    ExactRational lower_end() const { return to_rational(low, mpz_class(1) << bits); }
    ExactRational upper_end() const { return to_rational(low + width, mpz_class(1) << bits); }
};

// Volume and moments of some faces of a Brep.
class SolidMeasure {
public:
    SolidMeasure(const Brep& brep, std::span<const FaceId> faces, Want want)
        : brep_(brep),
          want_(want),
          lattice_(want),
          exact_faces_(faces_with_plane_points(faces)),
          corners_(brep, exact_faces_) {}

    ExactRational volume6() const {
        ExactRational r(lattice_.sums().volume6);
        if (!exact_faces_.empty())
            r += exact_sum(3, [](const mpz_class& det, const mpz_class& w, const auto&...) {
                return fraction(det, w);
            });
        return r;
    }
    ExactRational moment24(std::size_t axis) const {
        ExactRational r(lattice_.sums().moment24[axis]);
        if (exact_faces_.empty()) return r;
        r += exact_sum(4, [axis](const mpz_class& det, const mpz_class& w, const Corner& o,
                                 const Corner& p, const Corner& q) {
            return fraction(det * coordinate_sum(axis, o, p, q), w * w);
        });
        return r;
    }
    bool is_exact() const { return exact_faces_.empty(); }

    // Enclosures of 6 V and of the 24-fold moments.
    std::pair<Enclosure, std::array<Enclosure, axes>> enclose(unsigned long bits) const {
        Sums<mpz_class> sums;
        sums.volume6 = to_integer(lattice_.sums().volume6) << bits;
        for (std::size_t i = 0; i < axes; ++i)
            sums.moment24[i] = to_integer(lattice_.sums().moment24[i]) << bits;
        unsigned long terms = 0;
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
    std::vector<FaceId> faces_with_plane_points(std::span<const FaceId> faces) {
        std::vector<FaceId> exact;
        for (const FaceId f : faces) {
            if (!is_lattice_face(brep_, f)) {
                exact.push_back(f);
                continue;
            }
            for_each_fan_triangle(brep_, f, [this](VertexId o, VertexId p, VertexId q) {
                lattice_.add(brep_.point(o).lattice(), brep_.point(p).lattice(),
                             brep_.point(q).lattice());
            });
        }
        return exact;
    }

    // (o + p + q)_axis times w_o w_p w_q.
    static mpz_class coordinate_sum(std::size_t axis, const Corner& o, const Corner& p,
                                    const Corner& q) {
        return o.x[axis] * p.w * q.w + p.x[axis] * o.w * q.w + q.x[axis] * o.w * p.w;
    }

    template <class Visit>
    void for_each_exact_triangle(FaceId f, const Visit& visit) const {
        for_each_fan_triangle(brep_, f, [&](VertexId o, VertexId p, VertexId q) {
            const Corner& a = corners_[o];
            const Corner& b = corners_[p];
            const Corner& c = corners_[q];
            visit(determinant(a, b, c), mpz_class(a.w * b.w * c.w), a, b, c);
        });
    }
    template <class Visit>
    void for_each_exact_triangle(const Visit& visit) const {
        for (const FaceId f : exact_faces_) for_each_exact_triangle(f, visit);
    }

    // `degree` is the number of coordinates multiplied in a term.
    template <class Term>
    ExactRational exact_sum(unsigned degree, const Term& term) const {
        FractionTree tree(corners_);
        for (const FaceId f : exact_faces_) {
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
    Denominators denominators(FaceId f, unsigned degree) const {
        std::vector<std::uint32_t> numbers;
        for (const HalfedgeId h : brep_.halfedges(f))
            numbers.push_back(corners_[brep_.origin(h)].denominator);
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

    const Brep& brep_;
    Want want_;
    LatticeSums lattice_;
    std::vector<FaceId> exact_faces_;
    ExactCorners corners_;
};

std::vector<FaceId> all_faces(const Brep& brep) {
    std::vector<FaceId> faces;
    faces.reserve(brep.counts().faces);
    for (const FaceId f : brep.faces()) faces.push_back(f);
    return faces;
}

ExactRational volume_from(const ExactRational& volume6, Lattice lattice) {
    return (volume6 / ExactRational(6)).scaled(3 * lattice.exponent);
}

ExactRational coordinate_from(const ExactRational& moment24, const ExactRational& volume6,
                              Lattice lattice) {
    return (moment24 / (volume6 * ExactRational(4))).scaled(lattice.exponent);
}

double rounded_volume(const SolidMeasure& m, Lattice lattice) {
    if (!m.is_exact()) {
        for (const unsigned long bits : precisions) {
            const Enclosure e = m.enclose(bits).first;
            const double low = volume_from(e.lower_end(), lattice).to_double();
            if (low != 0 && low == volume_from(e.upper_end(), lattice).to_double()) return low;
        }
    }
    return volume_from(m.volume6(), lattice).to_double();
}

// The double that the quotient of the enclosed numbers rounds to, if they tell.
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

std::optional<Point3d> rounded_centroid(const SolidMeasure& m, Lattice lattice) {
    if (m.is_exact()) return std::nullopt;
    for (const unsigned long bits : precisions) {
        const auto [volume6, moments] = m.enclose(bits);
        const int sign = volume6.lower_end().sign();
        if (sign == 0 || sign != volume6.upper_end().sign()) continue;
        Point3d out{};
        bool known = true;
        for (std::size_t i = 0; i < axes && known; ++i) {
            const auto c = rounded_coordinate(moments[i], volume6, lattice);
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

// The area of one face: factor · sqrt(radicand), both non-negative.
struct FaceArea {
    mpq_class factor;
    mpz_class radicand;
};

FaceArea triangle_area(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    const Plane plane = Plane::through(a, b, c);
    mpz_class square = 0;
    for (int i = 0; i < 3; ++i) {
        const mpz_class n = to_integer(WideInt<2>(plane.normal(i)));
        square += n * n;
    }
    return {mpq_class(1, 2), std::move(square)};
}

// Twice the signed area of the projection along an axis.
mpq_class doubled_projection(const Brep& brep, FaceId f, int axis) {
    const auto u = static_cast<std::size_t>((axis + 1) % 3);
    const auto v = static_cast<std::size_t>((axis + 2) % 3);
    mpq_class sum = 0;
    const bool on_lattice = is_lattice_face(brep, f);
    WideInt<3> lattice_sum;
    for (const HalfedgeId h : brep.halfedges(f)) {
        const Point& p = brep.point(brep.origin(h));
        const Point& q = brep.point(brep.target(h));
        if (on_lattice) {
            const auto i = static_cast<int>(u);
            const auto j = static_cast<int>(v);
            lattice_sum += WideInt<3>(Int128{p.lattice()[i]} * q.lattice()[j] -
                                      Int128{p.lattice()[j]} * q.lattice()[i]);
            continue;
        }
        const Corner a = corner_at(p);
        const Corner b = corner_at(q);
        sum += fraction(a.x[u] * b.x[v] - a.x[v] * b.x[u], a.w * b.w);
    }
    if (on_lattice) sum = to_integer(lattice_sum);
    return sum;
}

FaceArea face_area(const Brep& brep, FaceId f) {
    const Plane& plane = brep.plane(f);
    const int k = plane.dominant_axis();
    mpz_class square = 0;
    for (int i = 0; i < 3; ++i) {
        const mpz_class n = to_integer(WideInt<2>(plane.normal(i)));
        square += n * n;
    }
    const mpz_class divisor = 2 * abs(to_integer(WideInt<2>(plane.normal(k))));
    return {abs(doubled_projection(brep, f, k)) / divisor, std::move(square)};
}

class AreaSum {
public:
    explicit AreaSum(Lattice lattice) : lattice_(lattice) {}

    void add(FaceArea a) {
        is_rational_ = is_rational_ && mpz_perfect_square_p(a.radicand.get_mpz_t()) != 0;
        faces_.push_back(std::move(a));
    }

    Area result() const {
        Area out;
        if (is_rational_) {
            out.exact = exact();
            out.value = out.exact->to_double();
            return out;
        }
        for (const unsigned long bits : precisions) {
            const Enclosure e = enclose(bits);
            out.value = e.lower_end().scaled(2 * lattice_.exponent).to_double();
            // 128 significant bits more than the error has.
            const bool precise =
                mpz_sizeinbase(e.low.get_mpz_t(), 2) > 128 + mpz_sizeinbase(e.width.get_mpz_t(), 2);
            if (precise && out.value == e.upper_end().scaled(2 * lattice_.exponent).to_double())
                break;
        }
        return out;
    }

private:
    Enclosure enclose(unsigned long bits) const {
        Enclosure e{0, mpz_class(static_cast<unsigned long>(faces_.size())), bits};
        mpz_class square;
        for (const FaceArea& a : faces_) {
            // floor(sqrt(floor(x))) = floor(sqrt(x)): one unit of error in all.
            const mpz_class& d = a.factor.get_den();
            square = a.factor.get_num() * a.factor.get_num() * a.radicand;
            square <<= 2 * bits;
            square /= d * d;
            e.low += sqrt(square);
        }
        return e;
    }

    ExactRational exact() const {
        std::vector<mpq_class> terms;
        terms.reserve(faces_.size());
        for (const FaceArea& a : faces_) terms.push_back(a.factor * mpz_class(sqrt(a.radicand)));
        while (terms.size() > 1) {
            const std::size_t half = (terms.size() + 1) / 2;
            for (std::size_t i = 0; i + half < terms.size(); ++i) terms[i] += terms[i + half];
            terms.resize(half);
        }
        if (terms.empty()) return {};
        return to_rational(terms[0].get_num(), terms[0].get_den()).scaled(2 * lattice_.exponent);
    }

    Lattice lattice_;
    bool is_rational_ = true;
    std::vector<FaceArea> faces_;
};

LatticeSums sums_of(const LatticeMesh& mesh, Want want) {
    LatticeSums sums(want);
    for (const auto& t : mesh.triangles)
        sums.add(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    return sums;
}

class BoundsCollector {
public:
    void add(const std::array<double, 3>& p) {
        if (!box_) box_ = Bounds{p, p};
        for (std::size_t i = 0; i < axes; ++i) {
            box_->lower[i] = std::min(box_->lower[i], p[i]);
            box_->upper[i] = std::max(box_->upper[i], p[i]);
        }
    }
    std::optional<Bounds> in_units_of(Lattice lattice) const {
        if (!box_) return std::nullopt;
        Bounds b = *box_;
        for (std::size_t i = 0; i < axes; ++i) {
            b.lower[i] = lattice.to_double(b.lower[i]);
            b.upper[i] = lattice.to_double(b.upper[i]);
        }
        return b;
    }

private:
    std::optional<Bounds> box_;  // lattice units
};

}  // namespace

ExactRational exact_volume(const Brep& brep) {
    return volume_from(SolidMeasure(brep, all_faces(brep), Want::Volume).volume6(), brep.lattice());
}

ExactRational exact_volume(const Brep& brep, ShellId shell) {
    return volume_from(SolidMeasure(brep, brep.faces(shell), Want::Volume).volume6(),
                       brep.lattice());
}

ExactRational exact_volume(const LatticeMesh& mesh) {
    return volume_from(ExactRational(sums_of(mesh, Want::Volume).sums().volume6), mesh.lattice);
}

double volume(const Brep& brep) {
    return rounded_volume(SolidMeasure(brep, all_faces(brep), Want::Volume), brep.lattice());
}

double volume(const Brep& brep, ShellId shell) {
    return rounded_volume(SolidMeasure(brep, brep.faces(shell), Want::Volume), brep.lattice());
}

double volume(const LatticeMesh& mesh) { return exact_volume(mesh).to_double(); }

int sign_of_volume(const Brep& brep, ShellId shell) {
    const SolidMeasure m(brep, brep.faces(shell), Want::Volume);
    if (!m.is_exact()) {
        for (const unsigned long bits : precisions) {
            const Enclosure e = m.enclose(bits).first;
            const int sign = e.lower_end().sign();
            if (sign != 0 && sign == e.upper_end().sign()) return sign;
        }
    }
    return m.volume6().sign();
}

Area area(const Brep& brep) {
    AreaSum sum(brep.lattice());
    for (const FaceId f : brep.faces()) sum.add(face_area(brep, f));
    return sum.result();
}

Area area(const Brep& brep, FaceId face) {
    AreaSum sum(brep.lattice());
    sum.add(face_area(brep, face));
    return sum.result();
}

Area area(const LatticeMesh& mesh) {
    AreaSum sum(mesh.lattice);
    for (const auto& t : mesh.triangles)
        sum.add(triangle_area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    return sum.result();
}

std::optional<std::array<ExactRational, 3>> exact_centroid(const Brep& brep) {
    const SolidMeasure m(brep, all_faces(brep), Want::VolumeAndMoments);
    const ExactRational v = m.volume6();
    if (v.sign() == 0) return std::nullopt;
    return std::array{coordinate_from(m.moment24(0), v, brep.lattice()),
                      coordinate_from(m.moment24(1), v, brep.lattice()),
                      coordinate_from(m.moment24(2), v, brep.lattice())};
}

std::optional<std::array<ExactRational, 3>> exact_centroid(const LatticeMesh& mesh) {
    const LatticeSums sums = sums_of(mesh, Want::VolumeAndMoments);
    const ExactRational v(sums.sums().volume6);
    if (v.sign() == 0) return std::nullopt;
    const auto coordinate = [&](std::size_t i) {
        return coordinate_from(ExactRational(sums.sums().moment24[i]), v, mesh.lattice);
    };
    return std::array{coordinate(0), coordinate(1), coordinate(2)};
}

std::optional<Point3d> centroid(const Brep& brep) {
    const SolidMeasure m(brep, all_faces(brep), Want::VolumeAndMoments);
    if (const auto c = rounded_centroid(m, brep.lattice())) return c;
    return rounded(exact_centroid(brep));
}

std::optional<Point3d> centroid(const LatticeMesh& mesh) { return rounded(exact_centroid(mesh)); }

std::optional<Bounds> bounds(const Brep& brep) {
    BoundsCollector box;
    for (const Point& p : brep.points()) box.add(p.nearest());
    return box.in_units_of(brep.lattice());
}

std::optional<Bounds> bounds(const LatticeMesh& mesh) {
    BoundsCollector box;
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t) box.add(approximate(mesh.points[v]).c);
    return box.in_units_of(mesh.lattice);
}

}  // namespace trisect
