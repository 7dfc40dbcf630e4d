// SPDX-License-Identifier: Apache-2.0
//
// StepBodies: a mesh as faces, edges, shells and voids.
#pragma once

#include <trisect/brep/planar_loops.h>
#include <trisect/brep/polygon_mesh.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trisect::detail {

struct StepEdgeUse {
    std::uint32_t edge = 0;
    bool is_forward = true;
};

struct StepFace {
    std::vector<IndexLoop> loops;                 ///< the outline first
    std::vector<std::vector<StepEdgeUse>> edges;  ///< by loop and corner: the one that leaves it
    Point3d normal{};                             ///< of length 1
};

struct StepShell {
    std::vector<std::uint32_t> faces;
    bool is_closed = true;
};

/// A closed shell with those of its voids, or one that is open.
struct StepBody {
    std::uint32_t shell = 0;
    std::vector<std::uint32_t> voids;
};

/// Invariant: every edge is used at most once in each direction.
struct StepBodies {
    std::vector<Point3d> points;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<StepFace> faces;  ///< face f of the mesh is face f here
    std::vector<StepShell> shells;
    std::vector<StepBody> bodies;
};

/// Bridges (brep/joined_loops.h) are taken out of faces. Points of one place become one where the
/// mesh is closed only then. Shells are the faces that edges connect; one that is inside out is a
/// void of the smallest shell around it. Corners may be off the plane of their face by at most
/// `uncertainty`. Cost: O(n log n), and the winding number of each void about each shell that may
/// be around it. \throw UnsupportedError for faces that are not planar, have no area, or have an
/// edge without length; `name` stands for the file
[[nodiscard]] StepBodies step_bodies(const PolygonMesh& mesh, double uncertainty,
                                     const std::string& name);

}  // namespace trisect::detail
