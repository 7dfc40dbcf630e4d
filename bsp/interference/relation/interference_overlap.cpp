// SPDX-License-Identifier: Apache-2.0
//
// Solids live on lattices, placed solids do not. With the relative pose (M x + t) / S both are on
// A's lattice divided by S: A's corners times S and M b + t are integers. What S and all these
// have in common is taken out; if the rest has 53 bits, the boolean is exact. Powers of two in S go
// into the unit of the lattice, an odd factor is left in the result as its scale.
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

// The images of lattice points times the pose's denominator.
std::vector<IntVector> images(const InterferenceModelData& model, const RelativePose& pose) {
    std::vector<IntVector> out;
    for (const Point& p : model.brep.points()) {
        const IntVector x = detail::exact_point(p).x;
        IntVector y;
        for (std::size_t i = 0; i < 3; ++i) y[i] = dot(pose.row(i), x) + pose.translation()[i];
        out.push_back(y);
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
        const std::vector<IntVector> moved = images(b_, to_a_);
        BoundedInt common = to_a_.denominator();
        for (const IntVector& p : moved)
            for (const BoundedInt& x : p)
                if (common.bit_length() > 1) common = gcd(common, x);
        const BoundedInt s = divided_exactly(to_a_.denominator(), common);
        // s = odd · 2^twos; the lattice takes multiples of 2^8, rounded up where there is room.
        const int twos = s.trailing_zeros();
        for (const int exponent : {(twos + 7) / 8 * 8, twos / 8 * 8}) {
            const int shift = std::max(0, exponent - twos);
            const auto points_a = fitting(images(a_, RelativePose()), s.shifted_left(shift), {});
            const auto points_b = fitting(moved, BoundedInt(1).shifted_left(shift), common);
            if (!points_a || !points_b) continue;
            result_.scale =
                ExactRational(s.shifted_left(shift).shifted_right(exponent).to_wide<16>());
            intersect(Lattice{a_.brep.lattice().exponent - exponent}, *points_a, *points_b,
                      Embedding::Assume);
            return true;
        }
        return false;
    }
    static std::optional<std::vector<LatticePoint>> fitting(const std::vector<IntVector>& points,
                                                            const BoundedInt& factor,
                                                            const BoundedInt& divisor) {
        std::vector<LatticePoint> out;
        for (const IntVector& p : points) {
            std::array<std::int64_t, 3> c{};
            for (std::size_t i = 0; i < 3; ++i) {
                const BoundedInt x =
                    (divisor.is_zero() ? p[i] : divided_exactly(p[i], divisor)) * factor;
                if (x.bit_length() > coordinate_bits) return std::nullopt;
                c[i] = static_cast<std::int64_t>(x.to_wide<1>().limb(0));
            }
            out.push_back({c[0], c[1], c[2]});
        }
        return out;
    }

    void round() {
        const auto places = [](const InterferenceModelData& model, const RelativePose& pose) {
            std::vector<ExactPlace> out;
            for (const Point& p : model.brep.points())
                out.push_back(moved(detail::exact_place(p), pose));
            return out;
        };
        const std::vector<ExactPlace> a = places(a_, RelativePose());
        const std::vector<ExactPlace> b = places(b_, to_a_);
        double largest = 1;
        for (const auto* points : {&a, &b})
            for (const ExactPlace& p : *points)
                for (const ExactRational& x : p.c)
                    largest = std::max(largest, std::abs(x.to_double()));
        const int bits = std::ilogb(largest) + 1;
        const int finer =
            static_cast<int>(std::floor((coordinate_bits - growth_bits - bits) / 8.0)) * 8;
        const int exponent = a_.brep.lattice().exponent - finer;
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
        intersect(Lattice{exponent}, points_a, points_b, Embedding::Resolve);
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
