// SPDX-License-Identifier: Apache-2.0
//
// BoxScene: boxes as operands, with counted properties of their booleans.
//
// All planes of all boxes together divide space into cells, each wholly inside or outside every
// operand. Volume, area, the Euler number and memberships of the result are sums over these cells;
// no geometry kernel takes part.
#pragma once

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/winding_number.h>
#include <trisect/bsp/verify.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace trisect::app {

struct Box {
    Point3d low{};
    Point3d high{};
};

struct BoxScene {
    std::string name;
    BooleanOperation operation = BooleanOperation::Union;
    /// The boxes of one operand do not overlap.
    std::vector<std::vector<Box>> operands;
};

/// A point in the middle of a cell.
struct CountedPoint {
    ExactPoint at;
    bool inside = false;
};

struct CountedResult {
    ExactRational volume;
    ExactRational area;  ///< of the boundary of the regularised set, without its radicals
    /// To be added to the area: factor · √radicand. Empty for boxes.
    std::map<std::int64_t, ExactRational> area_roots;
    /// V - E + F - C of the closed set, cut up into cells of all dimensions. Where its boundary is
    /// a manifold, half of the boundary's.
    std::int64_t euler = 0;
    std::vector<CountedPoint> points;
};

[[nodiscard]] PolygonMesh mesh_of(const std::vector<Box>& boxes);

/// Cost: cells times boxes. `points` of them are picked by the seed.
[[nodiscard]] CountedResult count(const BoxScene& scene, std::size_t points, std::uint64_t seed);

}  // namespace trisect::app
