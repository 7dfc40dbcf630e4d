// SPDX-License-Identifier: Apache-2.0
//
// ManifoldNode: the mesh and the solid of a Manifold, each made when it is needed.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <manifold/manifold.h>
#include <trisect/bsp/solid.h>

#include "tri_mesh.h"

namespace manifold {

/// The names of a solid's faces: groups of triangles of a mesh.
struct FaceTable {
    TriMesh mesh;
    std::vector<std::uint32_t> begin;  ///< by group; the end of the last one follows
    std::vector<std::uint32_t> triangles;
};

/// What the faces that name one operand come from.
struct FacePiece {
    std::shared_ptr<const FaceTable> table;
    std::uint32_t first_run = 0;  ///< where the runs of the table's mesh are in the node's
    mat3x4 place = la::identity;  ///< where the table's mesh was moved
    bool flipped = false;         ///< its faces look the other way
};

/// A solid and what its faces are called.
struct NamedSolid {
    trisect::Solid solid;
    std::map<std::uint32_t, FacePiece> pieces;  ///< by FaceSource::operand
    std::vector<Run> runs;
    std::size_t width = 0;
};

/// Immutable. Safe to read from many threads.
class ManifoldNode {
public:
    using Error = Manifold::Error;
    using Ptr = std::shared_ptr<const ManifoldNode>;

    static Ptr of_error(Error error);
    /// `original`: its number, or -1.
    static Ptr of_mesh(TriMesh mesh, int original = -1, double tolerance = 0);
    static Ptr of_solid(NamedSolid solid, double tolerance = 0);
    /// The same solid with exact faces that are named by a mesh of its own.
    static Ptr of_both(TriMesh mesh, trisect::Solid solid, std::vector<std::uint32_t> group,
                       int original, double tolerance);
    [[nodiscard]] Ptr with_tolerance(double tolerance) const;
    [[nodiscard]] Ptr with_context(std::shared_ptr<ExecutionContext::Impl> context) const;

    [[nodiscard]] Error status() const { return status_; }
    [[nodiscard]] int original() const { return original_; }
    /// As given; what theirs works with is no less than relative_epsilon of the extent.
    [[nodiscard]] double tolerance() const { return tolerance_; }
    [[nodiscard]] const std::shared_ptr<ExecutionContext::Impl>& context() const {
        return context_;
    }
    [[nodiscard]] bool is_empty() const;
    /// Whether the mesh came first, so that it has all there is.
    [[nodiscard]] bool is_mesh() const { return mesh_first_; }
    [[nodiscard]] const TriMesh& mesh() const;
    [[nodiscard]] const NamedSolid& solid() const;

private:
    Error status_ = Error::NoError;
    int original_ = -1;
    double tolerance_ = 0;
    bool mesh_first_ = true;
    std::shared_ptr<ExecutionContext::Impl> context_;
    // Shared by copies that differ in the members above.
    struct Lazy {
        std::once_flag mesh_made;
        std::once_flag solid_made;
        std::optional<TriMesh> mesh;
        std::optional<NamedSolid> solid;
    };
    std::shared_ptr<Lazy> lazy_;
};

/// Groups by number, as FaceTable has them.
[[nodiscard]] std::shared_ptr<const FaceTable> face_table(TriMesh mesh,
                                                          const std::vector<std::uint32_t>& group);
/// Triangles of one run and face that are connected without a seam of properties.
[[nodiscard]] std::vector<std::uint32_t> groups_of(const TriMesh& mesh);
/// Triangles of the boundary; what is left of one group is joined.
[[nodiscard]] TriMesh triangles_of(const NamedSolid& solid);
/// The solid with names of its own, that no other one has.
[[nodiscard]] ManifoldNode::Ptr renamed(const ManifoldNode& node);

}  // namespace manifold
