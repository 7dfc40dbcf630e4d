// SPDX-License-Identifier: Apache-2.0
//
// From a boundary to a tree, after Thibault and Naylor (1987), sec. 4.
//
// Take the plane of one of the polygons in the cell, send the polygons below it to one side, those
// above it to the other, split those that it cuts, and forget those that lie on it: the plane
// stands for them. A cell that no polygon is left in does not meet the boundary, so it is all
// inside or all outside.
//
// Which of the two? The well-known rule says: nothing below, inside; nothing above, outside. It
// holds because the plane was chosen from a polygon with area inside this very cell. The empty part
// below is one connected cell that does not meet the boundary and that touches that polygon from
// below, which is the solid's side; likewise above. Planes from elsewhere (splitting planes that
// balance the tree, planes of faces that do not reach into the cell) break the rule silently: their
// empty sides would need a neighbour. A coplanar face of the opposite orientation in the same cell
// does no harm: just below the plane the solid is inside at the chosen face and outside at the
// other one, so something separates the two places and the part below is not empty.
//
// The choice also makes every plane cut its cell, without a test: a polygon on the border of the
// cell would lie on an ancestor's plane and would have stayed there.
//
// Choosing badly cuts polygons over and over. No choice avoids it entirely: some inputs of n
// triangles need Ω(n²) pieces (Paterson and Yao 1990), and a random order reaches that bound in
// expectation. A few candidates, evenly spaced in the list, judged by the polygons they split and
// the imbalance they leave, keep real inputs at a few pieces per polygon. On convex solids nothing
// can be balanced; the tree is a list, and the work n²/2 classifications.

#include <trisect/bsp/bsp_build.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace trisect {

namespace {

using BspLabel = BspTree::Label;
using BspNode = BspTree::Node;
using BspNodeId = BspTree::NodeId;
using Polygons = std::vector<ConvexPolygon>;
using Indices = std::vector<std::uint32_t>;

class Builder {
public:
    Builder(Polygons polygons, const BspBuildOptions& options)
        : options_(options), polygons_(std::move(polygons)) {}

    BspTree run() {
        Indices all;
        for (std::size_t i = 0; i < polygons_.size(); ++i)
            if (!polygons_[i].is_empty()) all.push_back(static_cast<std::uint32_t>(i));
        if (all.empty()) return BspTree();
        pending_.push_back({std::move(all), 0, nullptr});
        while (!pending_.empty()) {
            const Cell cell = std::move(pending_.back());
            pending_.pop_back();
            refine(cell);
        }
        return BspTree(std::move(nodes_));
    }

private:
    /// A cell that holds polygons, and which child of which node it is.
    struct Cell {
        Indices polygons;
        std::uint32_t parent = 0;
        BspNodeId BspNode::*child = nullptr;  // null for the root
    };

    void refine(const Cell& cell) {
        const auto id = static_cast<std::uint32_t>(nodes_.size());
        const Plane plane = polygons_[choose(cell.polygons)].support();
        nodes_.push_back({plane, BspNodeId(BspLabel::In), BspNodeId(BspLabel::Out)});
        if (cell.child != nullptr) nodes_[cell.parent].*cell.child = BspNodeId(id);
        Indices below;
        Indices above;
        for (const std::uint32_t i : cell.polygons) send(i, plane, below, above);
        if (!above.empty()) pending_.push_back({std::move(above), id, &BspNode::above});
        if (!below.empty()) pending_.push_back({std::move(below), id, &BspNode::below});
    }

    void send(std::uint32_t i, const Plane& plane, Indices& below, Indices& above) {
        const auto parts = polygons_[i].classify(plane);
        if (parts.is_cut()) {
            ConvexPolygon upper;
            polygons_[i].split(plane, polygons_[i], upper);
            below.push_back(i);
            above.push_back(static_cast<std::uint32_t>(polygons_.size()));
            polygons_.push_back(std::move(upper));
        } else if (!parts.is_coplanar()) {
            (parts.below > 0 ? below : above).push_back(i);
        }
    }

    /// The candidate with the least penalty; the first one among equals.
    [[nodiscard]] std::uint32_t choose(const Indices& polygons) const {
        const std::size_t n = polygons.size();
        const std::size_t tried = std::clamp<std::size_t>(options_.candidates, 1, n);
        if (tried == 1) return polygons[0];
        std::uint32_t best = polygons[0];
        std::uint64_t least = ~std::uint64_t{0};
        for (std::size_t k = 0; k < tried; ++k) {
            const std::uint32_t candidate = polygons[k * n / tried];
            const std::uint64_t p = penalty(polygons, polygons_[candidate].support(), least);
            if (p >= least) continue;
            least = p;
            best = candidate;
        }
        return best;
    }

    /// Stops counting where the splits alone reach the limit.
    [[nodiscard]] std::uint64_t penalty(const Indices& polygons, const Plane& plane,
                                        std::uint64_t limit) const {
        std::uint64_t splits = 0;
        std::uint64_t below = 0;
        std::uint64_t above = 0;
        for (const std::uint32_t i : polygons) {
            const auto parts = polygons_[i].classify(plane);
            if (parts.below > 0) ++below;
            if (parts.above > 0) ++above;
            if (parts.is_cut() && ++splits * options_.split_weight >= limit) return limit;
        }
        return splits * options_.split_weight + (below > above ? below - above : above - below);
    }

    BspBuildOptions options_;
    Polygons polygons_;  // grows where polygons are cut; a cell names its own
    std::vector<BspNode> nodes_;
    std::vector<Cell> pending_;
};

}  // namespace

BspTree build_bsp(std::span<const ConvexPolygon> boundary, const BspBuildOptions& options) {
    return Builder(Polygons(boundary.begin(), boundary.end()), options).run();
}

BspTree build_bsp(const LatticeMesh& mesh, const BspBuildOptions& options) {
    return Builder(convex_polygons(mesh), options).run();
}

std::vector<ConvexPolygon> convex_polygons(const LatticeMesh& mesh) {
    std::vector<ConvexPolygon> polygons;
    polygons.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles)
        polygons.push_back(
            ConvexPolygon::from_triangle(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    return polygons;
}

}  // namespace trisect
