// SPDX-License-Identifier: Apache-2.0
//
// HullTree: convex hulls of parts of a solid, grouped and divided.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/hierarchies/convex/convex_polytope.h>
#include <trisect/bsp/interference/interference_model.h>

namespace trisect::hierarchies {

struct HullTreeOptions {
    /// Children of a node, at most: 2, 4, 8, 16, ... Deep trees of few children part boundaries
    /// after fewer tests in close proximity, shallow ones hold fewer hulls.
    std::uint32_t branching = 4;
    /// Triangles of a leaf, at most.
    std::uint32_t leaf_triangles = 4;
};

/// A tree whose nodes stand for sets of triangles of a model; the root's are all of them, those of
/// a node are divided among its children. A node's hull contains its triangles: exactly their hull
/// where the model's vertices are lattice points, otherwise as enclosing_hull says. The upper nodes
/// group convex parts (convex_parts), the lower ones divide a part.
///
/// Immutable. Safe to read from many threads.
class HullTree {
public:
    struct Node {
        ConvexPolytope hull;
        std::uint32_t first_child = 0;
        std::uint32_t child_count = 0;  ///< 0 for a leaf
        std::uint32_t first_triangle = 0;
        std::uint32_t triangle_count = 0;
        /// The node's triangles are (part of) one convex part.
        bool within_part = false;
        /// Which faces of the hull are boundary of the solid; the others bridge concavities. Found
        /// for lattice models, otherwise none is.
        std::vector<bool> real_face;
        /// Likewise for edges: in faces that are boundary, or sides of triangles.
        std::vector<bool> real_edge;

        [[nodiscard]] bool is_leaf() const { return child_count == 0; }
        /// Whether a feature of the hull is part of the boundary.
        [[nodiscard]] bool is_real(const PolytopeFeature& f) const;
    };

    /// \pre the model is not empty. \throw UsageError for a branching below 2 or a leaf of nothing,
    /// LimitError as enclosing_hull.
    explicit HullTree(const InterferenceModel& model, const HullTreeOptions& options = {});

    /// The root is the first one.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const std::uint32_t> triangles(const Node& n) const {
        return std::span(triangles_).subspan(n.first_triangle, n.triangle_count);
    }
    [[nodiscard]] std::size_t part_count() const { return part_count_; }
    [[nodiscard]] unsigned depth() const { return depth_; }
    [[nodiscard]] std::size_t bytes() const;
    /// The largest magnitude of a coordinate of any hull.
    [[nodiscard]] double largest() const { return nodes_.front().hull.largest(); }

private:
    class Builder;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> triangles_;
    std::size_t part_count_ = 0;
    unsigned depth_ = 0;
};

}  // namespace trisect::hierarchies
