// SPDX-License-Identifier: Apache-2.0
//
// Area is a sum of square roots, one a face, and has no exact representation in general.
//
// A face of lattice points has the vector area A = Σ p × q / 2 over its edges, an integer vector
// over 2; holes subtract by their orientation. Where only one component differs from 0 the area is
// that component; these areas are summed as integers. A face with plane points, normal n and the
// area S of its projection along axis k has the area |S|/|n_k| · |n|.
//
// Where lattice points have bits behind the point the same is done in units of 2^-fraction_limit.
//
// Plain doubles lose the last digits in a sum of a million roots. The first attempt takes the roots
// of lattice faces, and the triangles of an exact mesh with plane points, in pairs of doubles
// (pair_corners.h): about 100 bits with an error bound, at the cost of a few operations. Faces of a
// B-rep with plane points, and everything else when the first attempt does not decide the rounding,
// use integer square roots of more and more bits, which enclose the sum.

#include <trisect/brep/measure.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/brep/measure/exact_values.h>
#include <trisect/brep/measure/face_sets.h>
#include <trisect/brep/measure/pair_corners.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect {

namespace {

using namespace detail;

enum class Corners { Whole, Lattice, Others };

Corners corners_of(const Brep& brep, FaceId f) {
    Corners out = Corners::Whole;
    for (const HalfedgeId h : brep.halfedges(f)) {
        const Point& p = brep.point(brep.origin(h));
        if (!p.is_lattice()) return Corners::Others;
        if (!p.lattice().is_whole()) out = Corners::Lattice;
    }
    return out;
}

// Twice the vector area of a loop of whole lattice points. A projected area is below (2^54)^2, so
// the final components have 109 bits; partial sums wrap around without harm.
class VectorArea {
public:
    void add_edge(const LatticePoint& from, const LatticePoint& to) {
        const auto p = to_integers(from);
        const auto q = to_integers(to);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            twice_[i] += static_cast<Uint128>(Int128{p[j]} * q[k] - Int128{p[k]} * q[j]);
        }
    }
    Int128 twice(std::size_t i) const { return static_cast<Int128>(twice_[i]); }

private:
    std::array<Uint128, 3> twice_{};
};

// The same of lattice points with bits behind the point, in units of 2^-fine_area_bits. Differences
// from an origin are below 2^127. A plane has at most 2^0.5 times the area of a side in a cube, so
// doubled areas are below 2^255.5, their components below 2^255, and their squares below 2^511.
constexpr int fine_area_bits = 2 * fraction_limit;

class FineVectorArea {
public:
    explicit FineVectorArea(const LatticePoint& origin) : origin_(origin) {}

    void add_edge(const LatticePoint& from, const LatticePoint& to) {
        const auto p = from_origin(from);
        const auto q = from_origin(to);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            twice_[i] += multiply<4>(p[j], q[k]) - multiply<4>(p[k], q[j]);
        }
    }
    [[nodiscard]] const WideInt<4>& twice(std::size_t i) const { return twice_[i]; }

private:
    [[nodiscard]] std::array<WideInt<2>, 3> from_origin(const LatticePoint& p) const {
        const auto difference = [](Coordinate a, Coordinate b) {
            return WideInt<2>(scaled_integer(a, fraction_limit) -
                              scaled_integer(b, fraction_limit));
        };
        return {difference(p.x, origin_.x), difference(p.y, origin_.y), difference(p.z, origin_.z)};
    }

    LatticePoint origin_;
    std::array<WideInt<4>, 3> twice_{};
};

// The area of one face with plane points: factor · sqrt(radicand), both non-negative.
struct FaceArea {
    mpq_class factor;
    mpz_class radicand;
};

// Twice the signed area of the projection along an axis.
mpq_class doubled_projection(const Brep& brep, FaceId f, int axis) {
    const auto u = static_cast<std::size_t>((axis + 1) % 3);
    const auto v = static_cast<std::size_t>((axis + 2) % 3);
    mpq_class sum = 0;
    for (const HalfedgeId h : brep.halfedges(f)) {
        const Corner a = corner_at(brep.point(brep.origin(h)));
        const Corner b = corner_at(brep.point(brep.target(h)));
        sum += fraction(a.x[u] * b.x[v] - a.x[v] * b.x[u], a.w * b.w);
    }
    return sum;
}

FaceArea face_area(const Brep& brep, FaceId f) {
    const Plane& plane = brep.plane(f);
    const int k = plane.dominant_axis();
    mpz_class square = 0;
    for (int i = 0; i < 3; ++i) {
        const mpz_class n = to_integer(plane.normal(i));
        square += n * n;
    }
    const mpz_class divisor = 2 * abs(to_integer(plane.normal(k)));
    return {abs(doubled_projection(brep, f, k)) / divisor, std::move(square)};
}

// Of a triangle: half the length of (q - p) × (r - p), whose components are determinants of the
// homogeneous coordinates over w_p w_q w_r.
FaceArea triangle_area(const Corner& p, const Corner& q, const Corner& r) {
    mpz_class square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t u = (i + 1) % 3;
        const std::size_t v = (i + 2) % 3;
        const mpz_class twice = p.w * (q.x[u] * r.x[v] - q.x[v] * r.x[u]) +
                                q.w * (r.x[u] * p.x[v] - r.x[v] * p.x[u]) +
                                r.w * (p.x[u] * q.x[v] - p.x[v] * q.x[u]);
        square += twice * twice;
    }
    return {fraction(1, 2 * abs(p.w * q.w * r.w)), std::move(square)};
}

class AreaSum {
public:
    explicit AreaSum(Lattice lattice) : lattice_(lattice) {}

    void add(const Brep& brep, FaceId f) {
        const Corners corners = corners_of(brep, f);
        if (corners == Corners::Others) {
            faces_.push_back(face_area(brep, f));
            return;
        }
        if (corners == Corners::Lattice) {
            add_fine(brep, f);
            return;
        }
        VectorArea a;
        for (const HalfedgeId h : brep.halfedges(f))
            a.add_edge(brep.point(brep.origin(h)).lattice(), brep.point(brep.target(h)).lattice());
        add(a);
    }
    void add(const LatticePoint& p, const LatticePoint& q, const LatticePoint& r) {
        const auto add_triangle = [&](auto a) {
            a.add_edge(p, q);
            a.add_edge(q, r);
            a.add_edge(r, p);
            add(a);
        };
        if (p.is_whole() && q.is_whole() && r.is_whole()) {
            add_triangle(VectorArea());
        } else {
            add_triangle(FineVectorArea(p));
        }
    }

    /// All triangles of a mesh, which has to stay.
    void add(const ExactMesh& mesh) {
        mesh_ = &mesh;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [p, q, r] = mesh.triangles[t];
            if (is_lattice_face(MeshFaces(mesh), t)) {
                add(mesh.points[p].lattice(), mesh.points[q].lattice(), mesh.points[r].lattice());
            } else {
                triangles_.push_back(t);
            }
        }
    }

    Area result() {
        Area out;
        if (is_rational()) {
            out.exact = exact();
            out.value = out.exact->to_double();
            return out;
        }
        if (faces_.empty()) {
            const Interval areas = plus(quick_roots(), quick_triangles());
            const double low = in_units(areas.low);
            if (low == in_units(areas.high)) return {low, {}};
        }
        make_faces();
        if (const auto value = rounded(quick_roots(), precisions[0])) return {*value, {}};
        for (const unsigned long bits : precisions) {
            const Interval roots = enclose_roots(bits);
            out.value = in_units(roots.low + enclose_faces(bits).low);
            if (const auto value = rounded(roots, bits)) return {*value, {}};
        }
        return out;
    }

private:
    // Lattice units.
    struct Interval {
        ExactRational low;
        ExactRational high;
    };

    void add(const VectorArea& a) {
        WideInt<4> square;
        int components = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (a.twice(i) == 0) continue;
            ++components;
            square += multiply<4>(WideInt<2>(a.twice(i)), WideInt<2>(a.twice(i)));
        }
        if (components > 1) {
            squares_.push_back(square);
            return;
        }
        for (std::size_t i = 0; i < 3; ++i) twice_flat_ += WideInt<4>(a.twice(i)).abs();
    }

    void add_fine(const Brep& brep, FaceId f) {
        std::optional<FineVectorArea> a;
        for (const HalfedgeId h : brep.halfedges(f)) {
            const LatticePoint& from = brep.point(brep.origin(h)).lattice();
            if (!a) a.emplace(from);
            a->add_edge(from, brep.point(brep.target(h)).lattice());
        }
        add(*a);
    }
    void add(const FineVectorArea& a) {
        WideInt<8> square;
        int components = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (a.twice(i).is_zero()) continue;
            ++components;
            square += multiply<8>(a.twice(i), a.twice(i));
        }
        if (components > 1) {
            fine_squares_.push_back(square);
            return;
        }
        for (std::size_t i = 0; i < 3; ++i) fine_flat_ += WideInt<5>(a.twice(i)).abs();
    }

    // Whether every root is a rational; one that is not is usually the first.
    bool is_rational() {
        const auto is_square = [](const mpz_class& z) {
            return mpz_perfect_square_p(z.get_mpz_t()) != 0;
        };
        const auto is_root = [&](const auto& s) { return is_square(to_integer(s)); };
        if (!std::ranges::all_of(squares_, is_root) ||
            !std::ranges::all_of(fine_squares_, is_root) ||
            !std::ranges::all_of(faces_, [&](const auto& a) { return is_square(a.radicand); }))
            return false;
        for (const std::uint32_t t : triangles_)
            if (!is_square(area_of(t).radicand)) return false;
        make_faces();
        return true;
    }

    [[nodiscard]] FaceArea area_of(std::uint32_t triangle) const {
        const auto& [p, q, r] = mesh_->triangles[triangle];
        return triangle_area(corner_at(mesh_->points[p]), corner_at(mesh_->points[q]),
                             corner_at(mesh_->points[r]));
    }

    // Triangles with plane points in integers: only where pairs of doubles do not suffice.
    void make_faces() {
        for (const std::uint32_t t : triangles_) faces_.push_back(area_of(t));
        triangles_.clear();
    }

    ExactRational exact() const {
        mpz_class twice = to_integer(twice_flat_);
        for (const auto& s : squares_) twice += sqrt(to_integer(s));
        mpz_class fine = to_integer(fine_flat_);
        for (const auto& s : fine_squares_) fine += sqrt(to_integer(s));
        std::vector<mpq_class> terms{mpq_class(twice) / 2,
                                     fraction(fine, mpz_class(1) << (fine_area_bits + 1))};
        for (const FaceArea& a : faces_) terms.push_back(a.factor * mpz_class(sqrt(a.radicand)));
        while (terms.size() > 1) {
            const std::size_t half = (terms.size() + 1) / 2;
            for (std::size_t i = 0; i + half < terms.size(); ++i) terms[i] += terms[i + half];
            terms.resize(half);
        }
        return to_rational(terms[0].get_num(), terms[0].get_den()).scaled(2 * lattice_.exponent);
    }

    // The lattice faces by pairs of doubles.
    Interval quick_roots() const {
        DoublePair sum;
        for (const auto& s : squares_) sum = trisect::add(sum, root(to_pair(s)));
        constexpr double unit = 0x1p-146;
        static_assert(fine_area_bits == 146);
        for (const auto& s : fine_squares_) {
            const DoublePair r = root(to_pair(s));
            sum = trisect::add(sum, {r.high * unit, r.low * unit});
        }
        const ExactRational middle =
            ExactRational::from_double(sum.high) + ExactRational::from_double(sum.low);
        const double relative =
            0x1p-98 * (static_cast<double>(squares_.size() + fine_squares_.size()) + 1);
        const ExactRational error = ExactRational::from_double(sum.high * relative);
        return with_flat_faces({middle - error, middle + error});
    }

    // Triangles with plane points, likewise.
    Interval quick_triangles() const {
        if (triangles_.empty()) return {};
        const PairCorners corners = pair_corners(MeshFaces(*mesh_), triangles_);
        PairSum twice;
        for (const std::uint32_t t : triangles_) {
            const auto& [p, q, r] = mesh_->triangles[t];
            corners.add_area(p, q, r, twice);
        }
        const ExactRational error = ExactRational::from_double(twice.error());
        return {(twice.middle() - error).scaled(-1), (twice.middle() + error).scaled(-1)};
    }

    static Interval plus(const Interval& a, const Interval& b) {
        return {a.low + b.low, a.high + b.high};
    }

    // The lattice faces by integer roots: floor(sqrt(floor(x))) = floor(sqrt(x)).
    Interval enclose_roots(unsigned long bits) const {
        const std::size_t count = squares_.size() + fine_squares_.size();
        Enclosure e{0, mpz_class(static_cast<unsigned long>(count)), bits};
        for (const auto& s : squares_) e.low += sqrt(mpz_class(to_integer(s) << (2 * bits)));
        for (const auto& s : fine_squares_)
            e.low += sqrt(mpz_class((to_integer(s) << (2 * bits)) >> (2 * fine_area_bits)));
        return with_flat_faces({e.lower_end(), e.upper_end()});
    }

    // Doubled areas in, areas of all lattice faces out.
    Interval with_flat_faces(const Interval& twice) const {
        const ExactRational flat =
            ExactRational(twice_flat_) + ExactRational(fine_flat_).scaled(-fine_area_bits);
        return {(twice.low + flat).scaled(-1), (twice.high + flat).scaled(-1)};
    }

    Interval enclose_faces(unsigned long bits) const {
        Enclosure e{0, mpz_class(static_cast<unsigned long>(faces_.size())), bits};
        for (const FaceArea& a : faces_) {
            mpz_class square = a.factor.get_num() * a.factor.get_num() * a.radicand;
            square <<= 2 * bits;
            square /= a.factor.get_den() * a.factor.get_den();
            e.low += sqrt(square);
        }
        return {e.lower_end(), e.upper_end()};
    }

    // The double that both ends round to.
    std::optional<double> rounded(const Interval& lattice_faces, unsigned long bits) const {
        const Interval others = enclose_faces(bits);
        const double low = in_units(lattice_faces.low + others.low);
        const double high = in_units(lattice_faces.high + others.high);
        if (low != high) return std::nullopt;
        return low;
    }
    double in_units(const ExactRational& area) const {
        return area.scaled(2 * lattice_.exponent).to_double();
    }

    Lattice lattice_;
    WideInt<4> twice_flat_;            // doubled areas of faces along coordinate planes
    std::vector<WideInt<4>> squares_;  // squares of the doubled areas of other lattice faces
    WideInt<5> fine_flat_;             // the same with bits behind the point
    std::vector<WideInt<8>> fine_squares_;
    std::vector<FaceArea> faces_;  // faces with plane points
    const ExactMesh* mesh_ = nullptr;
    std::vector<std::uint32_t> triangles_;  // of the mesh, with plane points: not among faces_ yet
};

}  // namespace

Area area(const Brep& brep) {
    AreaSum sum(brep.lattice());
    for (const FaceId f : brep.faces()) sum.add(brep, f);
    return sum.result();
}

Area area(const Brep& brep, FaceId face) {
    AreaSum sum(brep.lattice());
    sum.add(brep, face);
    return sum.result();
}

Area area(const ExactMesh& mesh) {
    AreaSum sum(mesh.lattice);
    sum.add(mesh);
    return sum.result();
}

Area area(const LatticeMesh& mesh) {
    AreaSum sum(mesh.lattice);
    for (const auto& t : mesh.triangles)
        sum.add(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    return sum.result();
}

}  // namespace trisect
