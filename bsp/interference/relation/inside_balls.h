// SPDX-License-Identifier: Apache-2.0
//
// InsideBalls: balls within a solid, for quick proofs of overlap.
// They show deep overlap, and containment deep inside the other solid, without a look at faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/kernel/support/float4.h>

namespace trisect::detail {

class Boundary;
struct InterferenceModelData;

/// Its interior is within the solid; in lattice units.
struct InsideBall {
    std::array<double, 3> center{};
    double radius = 0;
};

/// Up to 16 balls whose interiors are within the solid, large ones, in lattice units; smaller ones
/// all along the boundary; and points of the solid that reach farthest along the axes. Balls and
/// not boxes: they need not be turned.
class InsideBalls {
public:
    static constexpr std::size_t most = 16;

    InsideBalls() = default;
    /// A distance from the boundary for each of about a thousand points, the best ones located
    /// exactly. Some milliseconds. \pre the model is not empty and its index may be used
    explicit InsideBalls(const InterferenceModelData& model);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] const std::array<double, 3>& center(std::size_t i) const { return center_[i]; }
    /// Less than the distance of the centre from the boundary.
    [[nodiscard]] double radius(std::size_t i) const { return radius_[i]; }
    /// One that comes close to the boundary in each of some hundred regions, neighbours mostly one
    /// after the other; of radius 0 where none was found.
    [[nodiscard]] std::span<const InsideBall> along_boundary() const { return along_boundary_; }
    /// The region of a triangle, which is named by its place in the order of the boxes.
    [[nodiscard]] std::size_t region_of(std::uint32_t place) const { return place / region_; }
    /// Vertices with the least and largest x, y, z.
    [[nodiscard]] const std::array<std::array<double, 3>, 6>& extremes() const { return extremes_; }

private:
    friend std::optional<Relation> relation_by_balls(const Boundary& a, const InsideBalls& balls_a,
                                                     const Boundary& b, const InsideBalls& balls_b,
                                                     const ApproximateMap& to_a, double* reserve);
    void add(const std::array<double, 3>& center, double radius);
    void find_large_ones(const InterferenceModelData& model);
    void find_along_boundary(const InterferenceModelData& model);

    std::size_t size_ = 0;
    std::array<std::array<double, 3>, most> center_{};
    std::array<double, most> radius_{};
    // So many triangles, one after the other in the order of the boxes, which hang together.
    std::uint32_t region_ = 1;
    std::vector<InsideBall> along_boundary_;
    std::array<std::array<double, 3>, 6> extremes_{};
    // The same in floats, four side by side, for a first look. Radii of unused ones are -infinite.
    std::array<std::array<Float4, 3>, most / 4> quick_center_{};
    std::array<Float4, most / 4> quick_radius_{};
};

/// Overlapping, when a ball of each have common points and each solid has a point that is certainly
/// not in the other; Contains or Inside, when one solid is within a ball of the other; else
/// nothing. `to_a` is the map from B into A; maps that are not similarities give no answer. 0.2 us.
///
/// `reserve`: the answer stays right while no point of B is moved by as much, in lattice units of
/// A.
[[nodiscard]] std::optional<Relation> relation_by_balls(
    const Boundary& a, const InsideBalls& balls_a, const Boundary& b, const InsideBalls& balls_b,
    const ApproximateMap& to_a, double* reserve = nullptr);

/// The same by one ball of each solid: Overlapping or nothing.
[[nodiscard]] std::optional<Relation> relation_by_ball_pair(
    const Boundary& a, const InsideBall& in_a, const Boundary& b, const InsideBalls& balls_b,
    const InsideBall& in_b, const ApproximateMap& to_a, double* reserve);

/// The two of some balls of A and of B that reach into each other farthest, if any do, as far as
/// doubles decide: worth a test. Of balls of radius 0 none.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> deepest_pair(
    std::span<const InsideBall> of_a, std::span<const InsideBall> of_b, const ApproximateMap& to_a);

/// A large ball inside that comes close to the boundary at the middle of a triangle (Ma, Bae and
/// Choi, "3D medial axis point approximation using nearest neighbors and the normal field", 2012),
/// if one is found. Some microseconds. \pre the index may be used
[[nodiscard]] std::optional<InsideBall> touching_ball(const InterferenceModelData& model,
                                                      std::uint32_t triangle);

}  // namespace trisect::detail
