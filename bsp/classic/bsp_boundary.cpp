// SPDX-License-Identifier: Apache-2.0
//
// From a tree to its boundary, after Thibault and Naylor (1987), sec. 6.
//
// The boundary lies on the planes of the nodes, within their sections. A section is pushed down the
// subtree below the plane, which splits it into pieces that each touch one leaf from above; each
// piece is then pushed down the subtree above. A piece that ends between an In and an Out leaf is
// boundary, and the In side says where outside is. What lies between equal labels (planes that were
// needed to separate something elsewhere) drops out, so the result is regularised by construction.
//
// The naive way keeps the polygons that the tree was built from in its nodes and filters those. It
// fails after the first boolean: parts of a face vanish, the plane of one operand's face bounds the
// other operand's material, coincident faces cancel. The sections have no faces and therefore
// cannot be wrong about them.
//
// Going down, a piece lies in the border of each cell that it meets. A node's plane cannot hold it,
// because it would not cut its cell then; so the piece is cut, or is with its whole area on one
// side, and needs no rule for the coplanar case.

#include <trisect/bsp/classic/bsp_boundary.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <trisect/bsp/classic/bsp_sections.h>
#include <trisect/kernel/contract.h>

namespace trisect {

namespace {

using BspLabel = BspTree::Label;
using BspNodeId = BspTree::NodeId;

struct LabelledPiece {
    ConvexPolygon piece;
    BspLabel label;
};

/// Splits a polygon in the border of a subtree's cell by the leaves that it touches.
class LeafSplitter {
public:
    explicit LeafSplitter(const BspTree& tree) : tree_(tree) {}

    void split(ConvexPolygon polygon, BspNodeId subtree, std::vector<LabelledPiece>& pieces) {
        pending_.emplace_back(std::move(polygon), subtree);
        while (!pending_.empty()) {
            auto [piece, at] = std::move(pending_.back());
            pending_.pop_back();
            while (!at.is_leaf()) at = descend(piece, tree_.node(at));
            pieces.push_back({std::move(piece), at.label()});
        }
    }

private:
    BspNodeId descend(ConvexPolygon& piece, const BspTree::Node& node) {
        ConvexPolygon upper;
        const auto parts = piece.split(node.plane, piece, upper);
        TRISECT_EXPECTS(!parts.is_coplanar(), "a BSP plane lies in the border of its cell");
        if (parts.is_cut()) pending_.emplace_back(std::move(upper), node.above);
        return parts.below > 0 ? node.below : node.above;
    }

    const BspTree& tree_;
    std::vector<std::pair<ConvexPolygon, BspNodeId>> pending_;
};

ExactRational fraction(const HomogeneousPoint::Coordinate& numerator,
                       const HomogeneousPoint::Weight& denominator) {
    return ExactRational(numerator) / ExactRational(denominator);
}

/// Twice the signed area of a polygon's image along an axis, and six times the volume between the
/// polygon and the origin, which is -d/n_axis of it: the volume of a cone is its height times its
/// base, and tilting changes both by the same factor.
ExactRational six_cone_volumes(const ConvexPolygon& polygon) {
    const Plane& plane = polygon.support();
    if (plane.offset().is_zero()) return {};
    const int axis = plane.dominant_axis();
    const auto u = static_cast<std::size_t>((axis + 1) % 3);
    const auto v = static_cast<std::size_t>((axis + 2) % 3);
    std::vector<std::array<ExactRational, 2>> corners;
    for (const Point& p : polygon.vertices()) {
        const HomogeneousPoint h = p.homogeneous();
        corners.push_back({fraction(h.xyz[u], h.w), fraction(h.xyz[v], h.w)});
    }
    ExactRational twice_area;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto& a = corners[i];
        const auto& b = corners[i + 1 < corners.size() ? i + 1 : 0];
        twice_area += a[0] * b[1] - a[1] * b[0];
    }
    return -(twice_area * ExactRational(plane.offset()) / ExactRational(plane.normal(axis)));
}

}  // namespace

std::vector<ConvexPolygon> boundary_of(const BspTree& tree) {
    std::vector<ConvexPolygon> boundary;
    std::vector<ConvexPolygon> sections = cell_sections(tree);
    LeafSplitter splitter(tree);
    std::vector<LabelledPiece> below;
    std::vector<LabelledPiece> above;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const BspTree::Node& node = tree.nodes()[i];
        TRISECT_EXPECTS(!sections[i].is_empty(), "a BSP plane does not cut its cell");
        below.clear();
        splitter.split(std::move(sections[i]), node.below, below);
        for (LabelledPiece& lower : below) {
            above.clear();
            splitter.split(std::move(lower.piece), node.above, above);
            for (LabelledPiece& piece : above) {
                if (piece.label == lower.label) continue;
                boundary.push_back(piece.label == BspLabel::Out ? std::move(piece.piece)
                                                                : piece.piece.flipped());
            }
        }
    }
    return boundary;
}

ExactRational enclosed_volume(std::span<const ConvexPolygon> boundary) {
    // Summed like the leaves of a balanced tree: denominators grow, so long sums are few.
    std::vector<ExactRational> terms;
    terms.reserve(boundary.size());
    for (const ConvexPolygon& polygon : boundary) terms.push_back(six_cone_volumes(polygon));
    for (std::size_t step = 1; step < terms.size(); step *= 2)
        for (std::size_t i = 0; i + step < terms.size(); i += 2 * step) terms[i] += terms[i + step];
    return terms.empty() ? ExactRational() : terms[0] / ExactRational(6);
}

}  // namespace trisect
