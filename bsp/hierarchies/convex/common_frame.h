// SPDX-License-Identifier: Apache-2.0
//
// CommonFrame: two posed lattices in one coordinate system.
// Distances in it are Euclidean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/number/ball.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/pose.h>

namespace trisect::hierarchies {

/// Maps of the lattices of A and of B into one space, where both stand as their poses put them up
/// to one translation and one scale. Points come in doubles with certified errors, and as integers
/// of any size for exact answers. Poses may be any affine maps.
///
/// Cheap to make; the integers are made when first needed. Move-only, for one thread.
class CommonFrame {
public:
    /// Both at the origin.
    CommonFrame();
    /// Distances are those of the world, in the user's units. `reach_a`, `reach_b`: no coordinate
    /// of a point that will be used is larger in magnitude (ConvexPolytope::largest).
    CommonFrame(const Pose& pose_a, Lattice lattice_a, double reach_a, const Pose& pose_b,
                Lattice lattice_b, double reach_b);
    /// Distances are those in the lattice of A, in its units.
    [[nodiscard]] static CommonFrame in_lattice_of_a(const Pose& pose_a, Lattice lattice_a,
                                                     double reach_a, const Pose& pose_b,
                                                     Lattice lattice_b, double reach_b);
    CommonFrame(CommonFrame&&) noexcept;
    CommonFrame& operator=(CommonFrame&&) noexcept;
    CommonFrame(const CommonFrame&) = delete;
    CommonFrame& operator=(const CommonFrame&) = delete;
    ~CommonFrame();

    /// Which of the two bodies.
    enum class Body : std::uint8_t { A, B };

    /// Up to a factor `unit()`; all coordinates are at most about 1.
    [[nodiscard]] detail::BallVector approximate(Body body, const LatticePoint& p) const {
        const Map& m = body == Body::A ? a_ : b_;
        const std::array<double, 3> x = p.doubles();
        detail::BallVector r;
        for (std::size_t i = 0; i < 3; ++i)
            r[i] = {((m.m[i][0] * x[0] + m.m[i][1] * x[1]) + m.m[i][2] * x[2]) + m.t[i], m.error};
        return r;
    }
    /// Distances are those between approximate points times this power of two.
    [[nodiscard]] double unit() const { return unit_; }
    /// Whether the map of the body turns orientation over.
    [[nodiscard]] bool is_mirror(Body body) const {
        return body == Body::A ? a_.mirror : b_.mirror;
    }

    /// Integers, for algorithms: bsp/hierarchies/convex/exact_frame.h. Of whole coordinates, or of
    /// all; both are in the same space up to their scale.
    struct Exact;
    [[nodiscard]] const Exact& exact(bool whole) const;

private:
    struct Map {
        std::array<std::array<double, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        std::array<double, 3> t{};
        double error = 0;
        bool mirror = false;
    };
    void normalise(double reach_a, double reach_b, double translation_error);

    Map a_;
    Map b_;
    double unit_ = 1;
    Pose pose_a_;
    Pose pose_b_;
    Lattice lattice_a_;
    Lattice lattice_b_;
    bool in_world_ = true;
    [[nodiscard]] std::unique_ptr<Exact> made_exact() const;

    mutable std::array<std::unique_ptr<Exact>, 2> exact_;  // of whole coordinates, of all
};

}  // namespace trisect::hierarchies
