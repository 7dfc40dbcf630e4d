// SPDX-License-Identifier: Apache-2.0
//
// Peers of interference queries behind one interface, each compiled with what it needs.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace interference_peers {

/// A 3x4 matrix, row by row: where the second body is put. The first one stays.
using Placement = std::array<double, 12>;

constexpr Placement home_placement{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// Two bodies prepared, and the placements, in the peer's own form; a query names a placement.
class Peer {
public:
    virtual ~Peer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Of the first body.
    [[nodiscard]] virtual double build_seconds() const = 0;
    [[nodiscard]] virtual bool collide(std::size_t placement) = 0;
    /// The number of contacting pairs; nothing when the peer has no such query.
    [[nodiscard]] virtual std::optional<std::size_t> contacts(std::size_t) { return {}; }
    [[nodiscard]] virtual std::optional<double> distance(std::size_t) { return {}; }
    /// Whether a query copies and refits a whole model: then only a few are asked.
    [[nodiscard]] virtual bool is_slow() const { return false; }
};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// FCL with each of its volumes. The first body is at `home`.
void add_fcl(Peers& peers, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
             std::span<const Placement> placements, const Placement& home = home_placement);
/// FCL with the volume that it uses by default, for collisions and distances.
void add_fcl_obbrss(Peers& peers, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
                    std::span<const Placement> placements);
/// FCL with the volumes that we have too: AABB, KDOP16, KDOP18, KDOP24, OBB.
void add_fcl_volumes(Peers& peers, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
                     std::span<const Placement> placements);
/// CGAL Rigid_triangle_mesh_collision_detection: surfaces, and with inclusion.
void add_cgal(Peers& peers, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
              std::span<const Placement> placements, const Placement& home = home_placement);
/// FCL's own bodies: two boxes about the origin with these sides, by its solvers for shapes.
void add_fcl_boxes(Peers& peers, const std::array<double, 3>& a, const std::array<double, 3>& b,
                   std::span<const Placement> placements, const Placement& home);

}  // namespace interference_peers
