// SPDX-License-Identifier: Apache-2.0
//
// Solids live on lattices, placed solids do not. With the relative pose (M x + t) / S, and k bits
// behind the point at most, both are on A's lattice divided by D = 2^k S: A's corners times D and
// 2^k (M b + t) are integers. What D and all these have in common is taken out. Powers of two in
// what is left of D go into the unit of the lattice, an odd factor is left in the result as its
// scale. If corners have 53 bits then, the boolean is exact; and if each of them is a double within
// the range of coordinates, it is exact with bits behind the point.
//
// Else corners are rounded to a lattice a little coarser than 53 bits, which is said, and the
// operands are resolved, because rounding may make them meet themselves.

#include <trisect/bsp/interference/interference_overlap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect {

using detail::BoundedInt;
using detail::ExactPlace;
using detail::InterferenceModelData;
using detail::IntVector;
using detail::RelativePose;

namespace {

LatticeMesh mesh_of(const InterferenceModelData& model, Lattice lattice,
                    std::vector<LatticePoint> points) {
    LatticeMesh mesh{lattice, std::move(points), {}, {}};
    for (const auto& t : model.triangles) {
        mesh.triangles.push_back({t.vertex[0].index, t.vertex[1].index, t.vertex[2].index});
        mesh.face_of_triangle.push_back(t.face.index);
    }
    return mesh;
}

// Units of lattices are powers of 2^8.
int floor_to_unit(int exponent) { return (exponent - (exponent % 8 + 8) % 8); }
int ceil_to_unit(int exponent) { return -floor_to_unit(-exponent); }

// Bits behind the point. \pre all corners are lattice points
int fraction_bits_of(const InterferenceModelData& model) {
    int bits = 0;
    for (const Point& p : model.brep.points())
        bits = std::max(bits, detail::fraction_bits(p.lattice()));
    return bits;
}

// The images of lattice points times the pose's denominator and 2^bits.
std::vector<IntVector> images(const InterferenceModelData& model, const RelativePose& pose,
                              int bits) {
    std::vector<IntVector> out;
    for (const Point& p : model.brep.points()) {
        detail::IntPoint x = detail::exact_point(p);
        const int shift = bits - (x.w.bit_length() - 1);  // the weight is a power of two
        if (shift > 0)
            for (BoundedInt& c : x.x) c = c.shifted_left(shift);
        IntVector y;
        for (std::size_t i = 0; i < 3; ++i)
            y[i] = dot(pose.row(i), x.x) + pose.translation()[i].shifted_left(bits);
        out.push_back(y);
    }
    return out;
}

// v 2^exponent, where it is a coordinate.
std::optional<Coordinate> coordinate_of(const BoundedInt& v, int exponent) {
    if (v.is_zero()) return Coordinate();
    const int zeros = v.trailing_zeros();
    const int bits = v.bit_length();
    if (bits - zeros > coordinate_bits || bits + exponent > coordinate_bits ||
        zeros + exponent < -fraction_limit)
        return std::nullopt;
    const auto digits = static_cast<double>(v.shifted_right(zeros).to_int128());
    return Coordinate(std::ldexp(digits, zeros + exponent));
}

std::optional<std::vector<LatticePoint>> coordinates_of(const std::vector<IntVector>& points,
                                                        int exponent) {
    std::vector<LatticePoint> out;
    out.reserve(points.size());
    for (const IntVector& p : points) {
        const auto x = coordinate_of(p[0], exponent);
        const auto y = coordinate_of(p[1], exponent);
        const auto z = coordinate_of(p[2], exponent);
        if (!x || !y || !z) return std::nullopt;
        out.push_back({*x, *y, *z});
    }
    return out;
}

using DoublePoint = std::array<double, 3>;

// Over the denominator and 2^bits, up to a relative error of 2^-50.
std::vector<DoublePoint> quotients(const std::vector<IntVector>& points,
                                   const BoundedInt& denominator, int bits) {
    const BoundedInt::Scaled d = denominator.scaled();
    std::vector<DoublePoint> out;
    out.reserve(points.size());
    for (const IntVector& p : points) {
        DoublePoint& q = out.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const BoundedInt::Scaled n = p[i].scaled();
            q[i] = std::ldexp(n.mantissa / d.mantissa, n.exponent - d.exponent - bits);
        }
    }
    return out;
}

class Overlapping {
public:
    Overlapping(const InterferenceModel& a, const Pose& pose_a, const InterferenceModel& b,
                const Pose& pose_b)
        : a_(detail::data_of(a)),
          b_(detail::data_of(b)),
          to_a_(detail::relative_pose(pose_a, a.lattice(), pose_b, b.lattice())) {}

    Overlap run(const Pose& pose_a) {
        if (!try_exact()) round();
        result_.volume = exact_volume(result_.scaled_solid.to_brep());
        for (int i = 0; i < 3; ++i) result_.volume /= result_.scale;
        // Into the world: times |det M| / S^3.
        std::array<IntVector, 3> m;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) m[i][j] = pose_a.matrix(i, j);
        ExactRational factor(determinant(m[0], m[1], m[2]).to_wide<22>());
        if (factor.sign() < 0) factor = -factor;
        const ExactRational s(pose_a.denominator());
        result_.volume *= factor / (s * s * s);
        return std::move(result_);
    }

private:
    bool try_exact() {
        if (!a_.all_lattice || !b_.all_lattice) return false;
        const int bits = std::max(fraction_bits_of(a_), fraction_bits_of(b_));
        const BoundedInt whole = to_a_.denominator().shifted_left(bits);
        std::vector<IntVector> points_a = images(a_, RelativePose(), bits);
        for (IntVector& p : points_a)
            for (BoundedInt& x : p) x = x * to_a_.denominator();
        std::vector<IntVector> points_b = images(b_, to_a_, bits);
        BoundedInt common = whole;
        for (auto* points : {&points_b, &points_a})
            for (const IntVector& p : *points)
                for (const BoundedInt& x : p)
                    if (common.bit_length() > 1) common = gcd(common, x);
        for (auto* points : {&points_a, &points_b})
            for (IntVector& p : *points)
                for (BoundedInt& x : p) x = divided_exactly(x, common);
        return place_exactly(points_a, points_b, divided_exactly(whole, common));
    }

    // Corners times s. The lattice is divided by the powers of two in s, rounded up where there is
    // room for whole coordinates.
    bool place_exactly(const std::vector<IntVector>& points_a,
                       const std::vector<IntVector>& points_b, const BoundedInt& s) {
        const int twos = s.trailing_zeros();
        const int unit = a_.brep.lattice().exponent;
        for (const int exponent : {floor_to_unit(unit - twos), ceil_to_unit(unit - twos)}) {
            const int finer = unit - exponent;
            if (finer < 0) continue;
            const int shift = std::max(0, finer - twos);
            const auto a = coordinates_of(points_a, shift);
            const auto b = coordinates_of(points_b, shift);
            if (!a || !b) continue;
            result_.scale = ExactRational(s.shifted_left(shift).shifted_right(finer).to_wide<16>());
            intersect(Lattice{exponent}, *a, *b, Embedding::Assume);
            return true;
        }
        // Bits behind the point: as many before it as import leaves.
        int bits = 0;
        for (const auto* points : {&points_a, &points_b})
            for (const IntVector& p : *points)
                for (const BoundedInt& x : p) bits = std::max(bits, x.bit_length());
        const int exponent = ceil_to_unit(unit - twos + bits - (coordinate_bits - growth_bits));
        const auto a = coordinates_of(points_a, unit - twos - exponent);
        const auto b = coordinates_of(points_b, unit - twos - exponent);
        if (!a || !b) return false;
        result_.scale = ExactRational(s.shifted_right(twos).to_wide<16>());
        intersect(Lattice{exponent}, *a, *b, Embedding::Assume);
        return true;
    }

    void round() {
        if (!a_.all_lattice || !b_.all_lattice || !round_in_doubles()) round_in_rationals();
    }

    // As good as in rationals but for a last bit: numerators and denominator are exact, so a
    // coordinate of 45 bits has an error below 2^-6. False where it is not clear whether a corner
    // moves at all.
    bool round_in_doubles() {
        constexpr double error = 0x1p-6;
        const int bits = std::max(fraction_bits_of(a_), fraction_bits_of(b_));
        const std::vector<DoublePoint> a =
            quotients(images(a_, RelativePose(), bits), BoundedInt(1), bits);
        const std::vector<DoublePoint> b =
            quotients(images(b_, to_a_, bits), to_a_.denominator(), bits);
        double largest = 0;
        for (const auto* points : {&a, &b})
            for (const DoublePoint& p : *points)
                for (const double x : p) largest = std::max(largest, std::abs(x));
        if (largest == 0) return false;
        const int exponent = rounded_exponent(largest);
        const int finer = a_.brep.lattice().exponent - exponent;
        double move = 0;
        const auto rounded = [&](const std::vector<DoublePoint>& points) {
            std::vector<LatticePoint> out;
            out.reserve(points.size());
            for (const DoublePoint& p : points) {
                std::array<std::int64_t, 3> c{};
                for (std::size_t i = 0; i < 3; ++i) {
                    const double x = std::ldexp(p[i], finer);
                    c[i] = std::llround(x);
                    move = std::max(move, std::abs(x - static_cast<double>(c[i])));
                }
                out.push_back({c[0], c[1], c[2]});
            }
            return out;
        };
        const auto points_a = rounded(a);
        const auto points_b = rounded(b);
        if (move <= error) return false;
        result_.max_move = std::ldexp(move + error, exponent);
        result_.is_exact = false;
        intersect(Lattice{exponent}, points_a, points_b, Embedding::Resolve);
        return true;
    }

    // Of a lattice that is fine enough for coordinates up to `largest`, in units of A's.
    [[nodiscard]] int rounded_exponent(double largest) const {
        const int bits = std::ilogb(largest) + 1;
        return ceil_to_unit(a_.brep.lattice().exponent - (coordinate_bits - growth_bits - bits));
    }

    void round_in_rationals() {
        const auto places = [](const InterferenceModelData& model, const RelativePose& pose) {
            std::vector<ExactPlace> out;
            for (const Point& p : model.brep.points())
                out.push_back(moved(detail::exact_place(p), pose));
            return out;
        };
        const std::vector<ExactPlace> a = places(a_, RelativePose());
        const std::vector<ExactPlace> b = places(b_, to_a_);
        double largest = 0;
        for (const auto* points : {&a, &b})
            for (const ExactPlace& p : *points)
                for (const ExactRational& x : p.c)
                    largest = std::max(largest, std::abs(x.to_double()));
        const int exponent = rounded_exponent(largest);
        const int finer = a_.brep.lattice().exponent - exponent;
        const auto rounded = [&](const std::vector<ExactPlace>& points) {
            std::vector<LatticePoint> out;
            for (const ExactPlace& p : points) {
                std::array<std::int64_t, 3> c{};
                for (std::size_t i = 0; i < 3; ++i) {
                    const ExactRational x = p.c[i].scaled(finer);
                    c[i] = std::llround(x.to_double());
                    ExactRational move = (x - ExactRational(c[i])).scaled(exponent);
                    if (move.sign() < 0) move = -move;
                    result_.max_move = std::max(result_.max_move, move.to_double());
                }
                out.push_back({c[0], c[1], c[2]});
            }
            return out;
        };
        const auto points_a = rounded(a);
        const auto points_b = rounded(b);
        result_.is_exact = result_.max_move == 0;
        intersect_rounded(Lattice{exponent}, points_a, points_b);
    }

    // Triangles whose corners came to lie on one line are left out by import.
    void intersect_rounded(Lattice lattice, const std::vector<LatticePoint>& points_a,
                           const std::vector<LatticePoint>& points_b) {
        const auto solid = [&](const InterferenceModelData& model,
                               const std::vector<LatticePoint>& points, bool is_mirror) {
            PolygonMesh mesh;
            for (const LatticePoint& p : points)
                mesh.points.push_back({lattice.to_double(p.x.to_double()),
                                       lattice.to_double(p.y.to_double()),
                                       lattice.to_double(p.z.to_double())});
            for (const auto& t : model.triangles)
                mesh.add_triangle(t.vertex[0].index, t.vertex[is_mirror ? 2 : 1].index,
                                  t.vertex[is_mirror ? 1 : 2].index);
            SolidOptions options;
            options.import.lattice = lattice;
            options.embedding = Embedding::Resolve;
            options.inside_out = InsideOut::Accept;
            return Solid::from_mesh(mesh, options);
        };
        result_.scaled_solid =
            evaluate(solid(a_, points_a, false) & solid(b_, points_b, to_a_.is_mirror()));
    }

    void intersect(Lattice lattice, std::vector<LatticePoint> points_a,
                   std::vector<LatticePoint> points_b, Embedding embedding) {
        LatticeMesh mesh_a = mesh_of(a_, lattice, std::move(points_a));
        LatticeMesh mesh_b = mesh_of(b_, lattice, std::move(points_b));
        if (to_a_.is_mirror())
            for (auto& t : mesh_b.triangles) std::swap(t[1], t[2]);
        result_.scaled_solid =
            evaluate(Expression(Solid::from_lattice_mesh(std::move(mesh_a), embedding)) &
                     Expression(Solid::from_lattice_mesh(std::move(mesh_b), embedding)));
    }

    const InterferenceModelData& a_;
    const InterferenceModelData& b_;
    RelativePose to_a_;
    Overlap result_;
};

}  // namespace

Overlap overlap(const InterferenceModel& a, const Pose& pose_a, const InterferenceModel& b,
                const Pose& pose_b) {
    if (a.is_empty() || b.is_empty()) return {};
    return Overlapping(a, pose_a, b, pose_b).run(pose_a);
}

}  // namespace trisect
