// SPDX-License-Identifier: Apache-2.0
//
// IndexHandles: faces, edges and vertices of the B-rep for an index.
// They are found from its polygons and leaves.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

/// A polygon belongs to one face: both are connected, and a face is a union of polygons. So faces
/// are a table by polygon. Edges and vertices are listed by the leaves that they reach into, as the
/// polygons are; a leaf holds few of them.
///
/// Immutable.
class IndexHandles {
public:
    /// Assembles the B-rep of maximal faces. \throw what Solid::to_brep throws.
    explicit IndexHandles(const IndexBase& base);

    [[nodiscard]] const Brep& brep() const { return brep_; }
    [[nodiscard]] double seconds() const { return seconds_; }
    [[nodiscard]] std::size_t bytes() const;

    [[nodiscard]] FaceId face_of(const PolygonId& id) const {
        return faces_[numbers_of(*id.leaf).polygon + id.number];
    }
    [[nodiscard]] std::span<const PolygonId> polygons_of(FaceId face) const {
        return std::span(polygons_).subspan(
            polygons_begin_[face.index],
            polygons_begin_[face.index + 1] - polygons_begin_[face.index]);
    }
    /// Sets the handle that belongs to the place's location. `on` lists the polygons that contain
    /// the point.
    void name(const IndexCore& core, Place& place, std::span<const PolygonId> on,
              const IndexPoint& point) const;

    /// Of a mixed cell.
    [[nodiscard]] std::span<const EdgeId> edges_in(const IndexedLeaf& index,
                                                   const IndexedLeaf::Cell& cell) const {
        const std::uint32_t i = numbers_of(index).leaf + cell.leaf;
        return std::span(edges_).subspan(edges_begin_[i], edges_begin_[i + 1] - edges_begin_[i]);
    }
    [[nodiscard]] std::span<const VertexId> vertices_in(const IndexedLeaf& index,
                                                        const IndexedLeaf::Cell& cell) const {
        const std::uint32_t i = numbers_of(index).leaf + cell.leaf;
        return std::span(vertices_).subspan(vertices_begin_[i],
                                            vertices_begin_[i + 1] - vertices_begin_[i]);
    }

private:
    // The first polygon and the first mixed cell of a leaf, counted through all leaves.
    struct Numbers {
        std::uint32_t polygon = 0;
        std::uint32_t leaf = 0;
    };
    [[nodiscard]] const Numbers& numbers_of(const IndexedLeaf& leaf) const {
        return numbers_.at(&leaf);
    }
    void number_leaves(const IndexBase& base);
    void find_faces();
    void list_edges(const IndexBase& base);
    void list_vertices(const IndexBase& base);
    [[nodiscard]] EdgeId edge_at(const IndexBase& base, const IndexPoint& point) const;
    [[nodiscard]] VertexId vertex_at(const IndexBase& base, const IndexPoint& point) const;
    [[nodiscard]] bool is_on(EdgeId edge, const IndexPoint& point) const;

    Brep brep_;
    std::unordered_map<const IndexedLeaf*, Numbers> numbers_;
    std::vector<PolygonId> all_polygons_;
    std::vector<FaceId> faces_;  // by polygon; none for one that misses its cell
    std::vector<PolygonId> polygons_;
    std::vector<std::uint32_t> polygons_begin_;  // by face
    std::vector<EdgeId> edges_;
    std::vector<std::uint32_t> edges_begin_;  // by mixed leaf
    std::vector<VertexId> vertices_;
    std::vector<std::uint32_t> vertices_begin_;
    double seconds_ = 0;
};

/// -1, 0, 1: coordinate k of one point before, equal to, behind that of the other.
[[nodiscard]] int compare_coordinate(const IndexPoint& a, const IndexPoint& b, std::size_t k);
[[nodiscard]] bool is_same(const IndexPoint& a, const IndexPoint& b);

}  // namespace trisect::detail
