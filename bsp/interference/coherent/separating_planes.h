// SPDX-License-Identifier: Apache-2.0
//
// SeparatingPlanes: four separating planes between boxes of two bodies.
// They are tested again under other poses at very little cost.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/kernel/support/float4.h>

namespace trisect::detail {

[[nodiscard]] inline float least_of(Float4 v) {
    const auto less = [](float a, float b) { return a < b ? a : b; };
    return less(less(v[0], v[1]), less(v[2], v[3]));
}

/// The lanes whose bits are set.
[[nodiscard]] inline Mask4 lanes_of(unsigned bits) {
    const auto b = static_cast<std::int32_t>(bits);
    return (Mask4{b, b, b, b} & Mask4{1, 2, 4, 8}) != Mask4{0, 0, 0, 0};
}

/// Data of a pose for the planes, side by side in all lanes.
///
/// A point c of B is at n·(M c + T) along a direction n of A: a linear function of the pose. A box
/// about c adds at most its half diagonal times the change of M. So of a box that was parted from A
/// by n once its centre is enough, and how much B has turned since then.
class PlanePose {
public:
    PlanePose() = default;
    /// `turn`: a bound, the same for all poses of one sequence of planes, on the sum of the changes
    /// of M up to here, in units of A for a unit of B. \pre at most `most_turn` times the scale
    PlanePose(const ObbPose& pose, double turn) {
        for (std::size_t i = 0; i < 3; ++i) {
            t_[i] = all_lanes(pose.way(i));
            for (std::size_t j = 0; j < 3; ++j) m_[j][i] = all_lanes(pose.turned(i, j));
        }
        scale_ = all_lanes(pose.scale());
        margin_ = all_lanes(pose.margin());
        turn_ = all_lanes(static_cast<float>(turn * (1 + 0x1p-23)));
    }
    static constexpr double most_turn = 2;

    /// Where the points are along the directions, up to half the margin.
    [[nodiscard]] Float4 place(const ObbPose::Directions& along,
                               const std::array<Float4, 3>& point) const {
        const auto turned = [&](std::size_t j) {
            return (along[0] * m_[j][0] + along[1] * m_[j][1]) + along[2] * m_[j][2];
        };
        const Float4 of_b = (turned(0) * point[0] + turned(1) * point[1]) + turned(2) * point[2];
        return scale_ * of_b + ((along[0] * t_[0] + along[1] * t_[1]) + along[2] * t_[2]);
    }
    [[nodiscard]] Float4 margin() const { return margin_; }
    [[nodiscard]] Float4 turn() const { return turn_; }

private:
    std::array<std::array<Float4, 3>, 3> m_{};  // [j][i], divided by scale
    std::array<Float4, 3> t_{};
    Float4 scale_{};
    Float4 margin_{};
    Float4 turn_{};
};

struct alignas(64) SeparatingPlanes {
    ObbPose::Directions along{};    ///< from A to B
    std::array<Float4, 3> point{};  ///< the centre of B's box
    Float4 radius{};                ///< half its diagonal
    /// The gap is at least the point's place, and this, less radius times turn.
    Float4 base = all_lanes(-std::numeric_limits<float>::infinity());

    /// Takes the gaps along these directions under a pose, each at most the distance of the boxes.
    void set(const PlanePose& pose, Float4 gaps, const ObbNode& b) {
        set(pose, gaps, b.center, b.half);
    }
    void set(const PlanePose& pose, Float4 gaps, const OrientedBox& b) {
        std::array<Float4, 3> center;
        std::array<Float4, 3> half;
        for (std::size_t k = 0; k < 3; ++k) {
            center[k] = all_lanes(b.center[k]);
            half[k] = all_lanes(b.half[k]);
        }
        set(pose, gaps, center, half);
    }
    /// Other lanes are not used from now on.
    void ask_only(Mask4 lanes) {
        base = lanes ? base : all_lanes(std::numeric_limits<float>::infinity());
    }
    void forget() { base = all_lanes(-std::numeric_limits<float>::infinity()); }
    /// A lower bound of the distances of the boxes along their directions now, in units of A;
    /// positive only where they are apart.
    [[nodiscard]] Float4 gaps(const PlanePose& now) const {
        return (now.place(along, point) + (base - (radius * now.turn() + now.margin()))) *
               all_lanes(1 - 0x1p-18F);
    }
    /// The least of them.
    [[nodiscard]] float gap(const PlanePose& now) const { return least_of(gaps(now)); }

private:
    void set(const PlanePose& pose, Float4 gaps, const std::array<Float4, 3>& center,
             const std::array<Float4, 3>& half) {
        point = center;
        radius = square_root((half[0] * half[0] + half[1] * half[1]) + half[2] * half[2]) *
                 all_lanes(1 + 0x1p-18F);
        base = (gaps - pose.place(along, point)) + (radius * pose.turn() - pose.margin());
    }
};

}  // namespace trisect::detail
