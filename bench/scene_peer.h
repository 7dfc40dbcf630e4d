// SPDX-License-Identifier: Apache-2.0
//
// The peer of scenes: FCL's dynamic tree of boxes over bounding volume hierarchies.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace scene_peer {

/// A 3x4 matrix, row by row.
using Rows = std::array<double, 12>;
/// Numbers of bodies, the smaller one first.
using Pair = std::pair<std::uint32_t, std::uint32_t>;

enum class Volume : std::uint8_t { Obb, ObbRss };

/// DynamicAABBTreeCollisionManager with collide() as the narrow phase, one contact a pair.
class FclScene {
public:
    FclScene(const std::vector<trisect::PolygonMesh>& models,
             const std::vector<std::size_t>& model_of_body, Volume volume);
    FclScene(const FclScene&) = delete;
    FclScene& operator=(const FclScene&) = delete;
    ~FclScene();

    /// Moves all bodies and returns those pairs whose surfaces meet, in order.
    std::vector<Pair> frame(const std::vector<Rows>& poses);
    /// Pairs of boxes of the last frame.
    [[nodiscard]] std::size_t boxes_met() const;
    /// Seconds of the last frame in collide() of pairs.
    [[nodiscard]] double narrow_seconds() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace scene_peer
