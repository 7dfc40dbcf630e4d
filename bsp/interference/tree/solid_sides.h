// SPDX-License-Identifier: Apache-2.0
//
// SolidSides: the sides of a solid on which another one's boundary lies.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/tree/leaf_boxes.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::detail {

/// Which sides of a solid have points of a boundary.
struct Sides {
    bool in = false;
    bool out = false;
    [[nodiscard]] bool are_both() const { return in && out; }
};

/// The sides of the solid `of` on which points of the boundary `a` lie, at least one of each
/// connected component of `a` that has no point in common with the boundary of `of`. Points in
/// common are passed over. Doubles decide, exact locations what they leave open.
///
/// Cost: boxes of `a` that come near the other boundary, and one location for each box of the rest.
class SolidSides {
public:
    /// `to_other` takes `a` into the lattice of `of`. What is referred to must outlive this.
    SolidSides(const SolidBoundary& a, const Pose& pose_a, const SolidBoundary& of,
               const Pose& pose_of, const ApproximateMap& to_other);

    [[nodiscard]] Sides find();
    /// The same without a look at any box: for maps that doubles do not hold.
    [[nodiscard]] Sides find_exactly();

private:
    struct Near {  // boxes of the other boundary
        std::size_t begin = 0;
        std::size_t end = 0;
    };

    void visit(ObbId box, Near near);
    void visit_lane(ObbId lane, Near near);
    [[nodiscard]] Near refined(ObbId box, Near near);
    void add_pieces(const LeafBoxes& boxes, bool exactly);
    void add_box(ObbId box);
    void add_hull(const SolidBoundary::LeafAt& leaf);
    [[nodiscard]] Location location_of_box(ObbId box);
    void add(Location location);
    [[nodiscard]] std::optional<Location> quick_location(const std::array<double, 3>& point,
                                                         double error);
    [[nodiscard]] bool is_beyond_bounds(const std::array<double, 3>& x, double error) const;
    [[nodiscard]] bool is_near_other(const std::array<double, 3>& point, double error) const;
    [[nodiscard]] Location exact_location(const ExactPlace& place);

    const SolidBoundary& a_;
    const SolidBoundary& other_;
    const Pose& pose_a_;
    const Pose& pose_other_;
    ApproximateMap map_;
    ObbPose pose_;  // of `a` in the other's boxes
    bool is_rigid_ = false;
    double scale_ = 0;  // a little less than the scale of the map
    std::optional<RelativePose> exact_;
    std::vector<ObbId> near_;
    std::vector<unsigned> lanes_met_;
    std::vector<PolygonId> on_;
    Sides sides_;
};

}  // namespace trisect::detail
