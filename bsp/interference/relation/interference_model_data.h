// SPDX-License-Identifier: Apache-2.0
//
// InterferenceModelData: the arrays behind an InterferenceModel.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/relation/boundary.h>
#include <trisect/bsp/interference/relation/inside_balls.h>
#include <trisect/bsp/interference/relation/lazy_model.h>

namespace trisect::detail {

/// A triangle of a face, counter-clockwise seen from outside. 28 bytes.
struct ModelTriangle {
    std::array<VertexId, 3> vertex;
    /// Side i runs from vertex i to vertex i + 1. Invalid for a diagonal within the face. Of an
    /// edge that was taken apart it is the copy that bounds this face.
    std::array<EdgeId, 3> edge;
    FaceId face;
};

/// The triangles of one face of a B-rep, which fill it exactly. No corner of the face lies within
/// a side.
void append_triangles(const Brep& brep, FaceId face, std::vector<ModelTriangle>& triangles);

/// Immutable once built, except for what is made on first use.
struct InterferenceModelData final : Boundary {
    /// Of the model and its B-rep, which outlive this.
    InterferenceModelData(const LazyModel& m, const Brep& b);

    const LazyModel& model;
    const Brep& brep;

    /// In order of their faces.
    std::vector<ModelTriangle> triangles;
    /// Triangles of face f: first_triangle[f] .. first_triangle[f + 1].
    std::vector<std::uint32_t> first_triangle{0};

    /// Whether all vertices are lattice points: then `position_error` is 0 and bounds are exact.
    bool all_lattice = true;

    /// The smallest id of all vertices at the same place as the vertex, for each vertex.
    std::vector<VertexId> place;
    /// A vertex of each shell.
    std::vector<VertexId> shell_vertex;

    double triangulate_seconds = 0;
    double boxes_seconds = 0;

    [[nodiscard]] bool is_empty() const { return triangles.empty(); }
    [[nodiscard]] const std::array<double, 3>& position(VertexId v) const {
        return positions[v.index];
    }
    [[nodiscard]] std::span<const ModelTriangle> triangles_of(FaceId f) const {
        return std::span(triangles).subspan(first_triangle[f.index],
                                            first_triangle[f.index + 1] - first_triangle[f.index]);
    }
    [[nodiscard]] ShellId shell_of(const ModelTriangle& t) const { return brep.shell(t.face); }
    [[nodiscard]] TriangleCorners corners_of(std::uint32_t triangle) const override {
        const ModelTriangle& t = triangles[triangle];
        return {position(t.vertex[0]), position(t.vertex[1]), position(t.vertex[2])};
    }
    /// Balls inside, made after some questions, since making them takes as long as many of these;
    /// null before. Safe to call from several threads.
    [[nodiscard]] const InsideBalls* balls_in_time() const override;
    /// The same, made at once.
    [[nodiscard]] const InsideBalls& balls() const;
    /// Whether the boundary touches itself anywhere but in the copies of vertices and edges that
    /// the B-rep has: a corner in a face, say. Found out at the first call (pairs of near
    /// triangles). Safe to call from several threads. In self_contact.cpp.
    [[nodiscard]] bool touches_itself() const;
    /// Whether a triangle meets others in common corners and sides only. Where two clear triangles
    /// of two solids cross, the solids overlap. Where one is not clear they need not: an edge of
    /// the same boundary may lie in it just there, with the solid on both sides. Found out when
    /// used and kept; some microseconds. Safe to call from several threads. In self_contact.cpp.
    [[nodiscard]] bool is_clear(std::uint32_t triangle) const override;
    [[nodiscard]] std::size_t bytes() const;

private:
    mutable std::once_flag self_contact_once_;
    mutable bool touches_itself_ = false;
    mutable std::vector<std::atomic<std::uint8_t>> clear_;
    mutable std::once_flag balls_once_;
    mutable std::atomic<std::uint32_t> questions_{0};
    mutable InsideBalls balls_;
};

struct InterferenceModelAccess {
    [[nodiscard]] static const InterferenceModelData& data(const InterferenceModel& model) {
        return model.shared().data();
    }
};

/// Made when it is first needed. \throw what InterferenceModel::brep() throws
[[nodiscard]] inline const InterferenceModelData& data_of(const InterferenceModel& model) {
    return InterferenceModelAccess::data(model);
}

}  // namespace trisect::detail
