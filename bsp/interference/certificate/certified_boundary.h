// SPDX-License-Identifier: Apache-2.0
//
// Boundary: a solid, for the checkers of certificates.
// No part of the library decides with it. Some searches for certificates use it to try out what
// the checker would decide.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/interference/certificate/certified_points.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail::certified {

enum class Where { Inside, Outside, Boundary, Unknown };

/// The vertices, loops and shells of a boundary under a pose, in the user's units; all questions
/// are answered by looking at all faces. O(faces) each.
class Boundary {
public:
    explicit Boundary(const Brep& brep, const Pose& pose = Pose());

    [[nodiscard]] const Brep& brep() const { return *brep_; }
    /// By vertex.
    [[nodiscard]] const std::vector<IntegerPoint>& points() const { return points_; }
    /// \pre there is such a vertex
    [[nodiscard]] ExactPoint at(VertexId v) const { return points_[v.index].rational(); }

    /// By the parity of a ray's crossings with faces; a ray that meets an edge is given up for
    /// another one.
    [[nodiscard]] Where locate(const ExactPoint& p) const;
    /// Whether a point is in a face or on its outline; false when there is no such face.
    [[nodiscard]] bool is_on_face(FaceId f, const ExactPoint& p) const;
    /// Whether a point is inside, and farther than `radius` from all triangles. They must fill the
    /// faces for that to mean anything.
    [[nodiscard]] bool is_deep_inside(const ExactPoint& p, const ExactRational& radius,
                                      const std::vector<CertifiedTriangle>& triangles) const;
    /// Whether triangles fill all faces: in each face their sides, cancelled, are its halfedges.
    /// Two bounded chains in a plane with one boundary are the same.
    [[nodiscard]] bool is_filled_by(const std::vector<CertifiedTriangle>& triangles) const;
    /// The segments of every face's loops, without direction: they identify the face, and all faces
    /// together a bounded solid.
    [[nodiscard]] std::vector<std::set<std::pair<IntegerPoint, IntegerPoint>>> outlines() const;

private:
    [[nodiscard]] IntegerPlane plane_of(FaceId f) const;
    [[nodiscard]] Where in_face(FaceId f, const IntegerPoint& p) const;
    [[nodiscard]] Where along_ray(const IntegerPoint& p, const IntegerVector& d) const;

    const Brep* brep_;
    std::vector<IntegerPoint> points_;
    std::vector<std::uint32_t> place_;  // of a vertex: the first one at the same point
    std::vector<IntegerPlane> planes_;  // by face, the normal outwards unless the pose is a mirror
};

}  // namespace trisect::detail::certified
