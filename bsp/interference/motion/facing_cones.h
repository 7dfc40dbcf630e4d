// SPDX-License-Identifier: Apache-2.0
//
// FacingCones, RecedingFaces: parts of two boundaries that move away from each other.
// No first contact begins there.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/event_model.h>
#include <trisect/bsp/interference/motion/swept_walk.h>

namespace trisect::detail {

/// For a box of a model's tree a cone that contains the outward normals of all faces around the
/// triangles below it: their own, and those at the vertices and edges that events look at with
/// them. Computed on demand, of boxes with few triangles; the cones of large ones hold every
/// direction.
class FacingCones {
public:
    /// All unit vectors whose product with the axis is at least the cosine.
    struct Cone {
        std::array<double, 3> axis{};
        double cosine = -1;
        double sine = 1;
        /// Whether n · v > slack certainly holds for all unit vectors n in it. False may mean
        /// anything.
        [[nodiscard]] bool is_all_along(const std::array<double, 3>& v, double slack) const;
    };

    /// The model must outlive it.
    explicit FacingCones(const ModelEvents& model);
    [[nodiscard]] const Cone& of(ObbId box);

private:
    using Normal = std::array<double, 3>;
    [[nodiscard]] Cone make(ObbId box);
    void append_normals(std::uint32_t triangle);
    void append_normal(FaceId face);

    const ModelEvents* model_;
    std::vector<std::uint32_t> place_;  // of a box's cone, 0 for none yet
    std::vector<Cone> cones_;
    std::vector<Normal> normals_;  // scratch
};

/// Hierarchical back-face culling over an interval of a motion.
class RecedingFaces {
public:
    /// `model_b` is the model of the cones of B.
    RecedingFaces(FacingCones& a, FacingCones& b, const ModelEvents& model_b)
        : cones_a_(a), cones_b_(b), b_(model_b) {}

    void set(const BallMotion& over, const SweptMap& swept);
    /// Whether, all through the interval, everything of B in its box moves to the outside of all
    /// faces of A in its box, or the other way round. Then, if the solids have been apart so far,
    /// no contact begins there.
    [[nodiscard]] bool operator()(ObbId a, ObbId b);
    [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

private:
    struct Extent;
    struct Step;
    [[nodiscard]] static Step step_between(const BallMotion::Maps& m0, const BallMotion::Maps& m1,
                                           const SweptMap& swept, const Extent& extent);
    [[nodiscard]] static double errors_of(const BallMotion::Maps& m, const SweptMap& swept,
                                          const Extent& extent);
    [[nodiscard]] double deviation_of(const Step& step, const Extent& extent) const;
    void set_velocity(const BallMotion& over, const SweptMap& swept);
    void set_inverse(const BallMotion& over, const SweptMap& swept, double least_weight);

    FacingCones& cones_a_;
    FacingCones& cones_b_;
    const ModelEvents& b_;
    // The velocity of a point p of B, times a positive number: turn_ p + way_, within `error_`.
    std::array<std::array<double, 3>, 3> turn_{};
    std::array<double, 3> way_{};
    double turn_norm_ = 0;
    double error_ = 0;
    // The same seen from B: times inverse_, within this part of its length.
    std::array<std::array<double, 3>, 3> inverse_{};
    double inverse_norm_ = 0;
    double inverse_error_ = 0;
    std::uint64_t left_out_ = 0;
};

}  // namespace trisect::detail
