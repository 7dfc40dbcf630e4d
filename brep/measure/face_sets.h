// SPDX-License-Identifier: Apache-2.0
//
// Face sets: faces of a B-rep, a shell or an exact mesh, for measures.
// Vertices and faces are numbers.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_mesh.h>

namespace trisect::detail {

/// All faces of a B-rep.
class BrepFaces {
public:
    explicit BrepFaces(const Brep& brep) : brep_(&brep) {}

    [[nodiscard]] Lattice lattice() const { return brep_->lattice(); }
    [[nodiscard]] std::size_t vertex_count() const { return brep_->counts().vertices; }
    [[nodiscard]] const Point& point(std::uint32_t v) const { return brep_->point(VertexId(v)); }

    template <class Visit>
    void for_each_face(const Visit& visit) const {
        for (const FaceId f : brep_->faces()) visit(f.index);
    }
    template <class Visit>
    void for_each_corner(std::uint32_t f, const Visit& visit) const {
        for (const HalfedgeId h : brep_->halfedges(FaceId(f))) visit(brep_->origin(h).index);
    }
    /// Calls visit(o, p, q) for the fan triangles of all loops; those that are flat at the apex
    /// are left out.
    template <class Visit>
    void for_each_triangle(std::uint32_t f, const Visit& visit) const {
        const VertexId o = brep_->origin(brep_->halfedges(FaceId(f))[0]);
        for (const HalfedgeId h : brep_->halfedges(FaceId(f))) {
            const VertexId p = brep_->origin(h);
            const VertexId q = brep_->target(h);
            if (p != o && q != o) visit(o.index, p.index, q.index);
        }
    }

protected:
    const Brep* brep_;
};

/// The faces of one shell.
class ShellFaces : public BrepFaces {
public:
    ShellFaces(const Brep& brep, ShellId shell) : BrepFaces(brep), shell_(shell) {}

    template <class Visit>
    void for_each_face(const Visit& visit) const {
        for (const FaceId f : brep_->faces(shell_)) visit(f.index);
    }

private:
    ShellId shell_;
};

/// The triangles of an exact mesh.
class MeshFaces {
public:
    explicit MeshFaces(const ExactMesh& mesh) : mesh_(&mesh) {}

    [[nodiscard]] Lattice lattice() const { return mesh_->lattice; }
    [[nodiscard]] std::size_t vertex_count() const { return mesh_->points.size(); }
    [[nodiscard]] const Point& point(std::uint32_t v) const { return mesh_->points[v]; }

    template <class Visit>
    void for_each_face(const Visit& visit) const {
        for (std::uint32_t t = 0; t < mesh_->triangles.size(); ++t) visit(t);
    }
    template <class Visit>
    void for_each_corner(std::uint32_t f, const Visit& visit) const {
        for (const std::uint32_t v : mesh_->triangles[f]) visit(v);
    }
    template <class Visit>
    void for_each_triangle(std::uint32_t f, const Visit& visit) const {
        const auto& t = mesh_->triangles[f];
        visit(t[0], t[1], t[2]);
    }

private:
    const ExactMesh* mesh_;
};

template <class Boundary>
[[nodiscard]] bool is_lattice_face(const Boundary& boundary, std::uint32_t f) {
    bool all = true;
    boundary.for_each_corner(f,
                             [&](std::uint32_t v) { all = all && boundary.point(v).is_lattice(); });
    return all;
}

}  // namespace trisect::detail
