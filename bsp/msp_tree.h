// SPDX-License-Identifier: Apache-2.0
//
// MspTree: a multidimensional space partitioning tree, Vanecek's BREP-INDEX.
// A cut has three sides, below, on and above, and the on side is a tree of one dimension less. So
// a point finds not only the inside and the outside but the very vertex, edge or face that
// carries it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/convex_polygon.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect {

/// How the next cut is chosen among the polygons of a cell, and among the lines in a plane. What a
/// point's location is never depends on it.
enum class MspHeuristic : std::uint8_t {
    AsGiven,      ///< the first face; what a plain loop over the boundary would do
    LeastSplits,  ///< of a sample, the one that cuts the fewest others
    Balanced,     ///< of a sample, the least of splits and imbalance, weighed
    LargestFirst  ///< of a sample, the one of the largest extent
};

struct MspOptions {
    MspHeuristic split_heuristic = MspHeuristic::Balanced;
    /// The size of the sample; at least 1.
    std::uint32_t candidates = 8;
    /// Balanced: a split counts as much as this many polygons of imbalance.
    std::uint32_t split_weight = 8;
};

/// A polygon of a boundary whose vertices, edges and faces have handles of the caller's. Edges
/// may end in the middle of neighbours' edges; the two need not match.
struct MspPolygon {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    ConvexPolygon shape;
    std::uint32_t face = 0;
    std::vector<std::uint32_t> edges;     ///< by edge of the shape; none where it is within a face
    std::vector<std::uint32_t> vertices;  ///< by vertex of the shape; none where it is within one
};

/// The sizes of a tree.
struct MspStats {
    /// Inner nodes of dimension 1, 2, 3: points that cut lines, lines, planes. Index 0 is unused.
    std::array<std::size_t, 4> nodes{};
    /// Leaves of each dimension, 0 to 3.
    std::array<std::size_t, 4> leaves{};
    /// Leaves of each kind, in the order of MspTree::Leaf.
    std::array<std::size_t, 5> leaves_of_kind{};
    std::size_t depth = 0;        ///< longest way to a leaf, on-trees included
    std::size_t space_depth = 0;  ///< the same through nodes of dimension 3 only
    std::size_t planes = 0;       ///< distinct planes that nodes name
    std::size_t faces = 0;        ///< faces that went in
    std::size_t polygons = 0;     ///< convex polygons that they were given as
    std::size_t fragments = 0;    ///< pieces of them that the cuts have left, one or more a polygon
    std::size_t bytes = 0;        ///< memory of nodes and planes
    double build_seconds = 0;

    /// 1 when no cut splits anything; the Paterson-Yao bounds are bounds of this number.
    [[nodiscard]] double fragments_per_polygon() const {
        return polygons == 0 ? 0.0 : static_cast<double>(fragments) / static_cast<double>(polygons);
    }
    [[nodiscard]] double bytes_per_face() const {
        return faces == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(faces);
    }
};

/// A boundary as an index of its entities by place.
///
/// A node of dimension 3 has a convex open region of space and a plane through it. Below and above
/// lead to the two parts, which are regions of space again; on leads to the part of the plane, a
/// convex open region of dimension 2. A node of dimension 2 cuts such a region by a line; its on
/// side is an open part of that line, of dimension 1. A node of dimension 1 cuts it by a point, and
/// its on side is that point: a leaf. The regions of all leaves are disjoint and fill space.
///
/// A leaf names what all points of its region have in common: outside, inside, or the vertex, edge
/// or face that they lie on (an edge without its ends, a face without its border). By dimension:
///   3   Out, In
///   2   the same, OnFace: the plane of a face goes on beyond the face
///   1   the same, OnEdge
///   0   the same, OnVertex
///
/// Lines and points are named by planes too, mostly by planes of other faces: a line in its plane
/// by one that crosses there, a point on its line likewise. Hence a descent is one loop with one
/// three-way sign of (point, plane) a level, whatever the dimension. It is exact.
///
/// What happens when things touch. Where several entities contain a point, the one of the lowest
/// dimension is named: a corner that touches a face's interior is OnVertex, an edge that lies in
/// another face OnEdge. Among equals the smallest handle is named; so a vertex or edge that a Brep
/// keeps in several copies is named by the smallest of them (Brep::copies leads to the others).
///
/// Only planes of faces cut space, and a face may fall into fragments: Θ(n²) of them at worst, n to
/// a few n in practice. The tree of a convex solid is a list. So the tree of a whole boundary is
/// for study, tests and small solids; large ones are divided by axis-perpendicular splitting planes
/// first, and a tree is made of the few polygons of a cell (from_polygons).
///
/// The tree can be walked: root(), node(ref), Node::plane, dimension, below, on, above; a leaf ref
/// has its kind and entity.
///
/// Regular value type; 16 bytes a node, 232 a plane. Safe to read from many threads. Nothing here
/// recurses, so trees may be as deep as they have nodes.
///
/// Source: G. Vanecek, Brep-Index: a multidimensional space partitioning tree, International
/// Journal of Computational Geometry and Applications 1(3), 1991.
class MspTree {
public:
    enum class Leaf : std::uint8_t { Out, In, OnFace, OnEdge, OnVertex };

    /// A leaf, or the number of an inner node. Two leaves that name the same are equal.
    class Ref {
    public:
        /// The leaf Out.
        constexpr Ref() = default;
        [[nodiscard]] static constexpr Ref leaf(Leaf kind, std::uint32_t entity = 0) {
            return Ref((1U + static_cast<std::uint32_t>(kind)) << kind_shift | entity);
        }
        [[nodiscard]] static constexpr Ref node(std::size_t index) {
            return Ref(static_cast<std::uint32_t>(index));
        }
        [[nodiscard]] constexpr bool is_leaf() const { return (value_ >> kind_shift) != 0; }
        /// \pre is_leaf()
        [[nodiscard]] constexpr Leaf kind() const {
            return static_cast<Leaf>((value_ >> kind_shift) - 1);
        }
        /// Handle of the face, edge or vertex; 0 for Out and In. \pre is_leaf()
        [[nodiscard]] constexpr std::uint32_t entity() const { return value_ & limit; }
        /// \pre !is_leaf()
        [[nodiscard]] constexpr std::uint32_t index() const { return value_; }
        /// \pre kind() == OnFace, OnEdge, OnVertex
        [[nodiscard]] constexpr FaceId face() const { return FaceId(entity()); }
        [[nodiscard]] constexpr EdgeId edge() const { return EdgeId(entity()); }
        [[nodiscard]] constexpr VertexId vertex() const { return VertexId(entity()); }
        friend constexpr bool operator==(Ref, Ref) = default;

        /// Handles and node numbers are below this.
        static constexpr std::uint32_t limit = (1U << 29U) - 1;

    private:
        static constexpr unsigned kind_shift = 29;
        constexpr explicit Ref(std::uint32_t v) : value_(v) {}
        std::uint32_t value_ = 1U << kind_shift;
    };

    /// An inner node.
    struct Node {
        std::uint32_t plane = 0;
        Ref below;
        Ref on;
        Ref above;
    };

    /// The empty set; so is a tree that was moved from.
    MspTree() = default;
    MspTree(const MspTree&) = default;
    MspTree& operator=(const MspTree&) = default;
    MspTree(MspTree&& o) noexcept : MspTree() { swap(o); }
    MspTree& operator=(MspTree&& o) noexcept {
        MspTree taken(std::move(o));
        swap(taken);
        return *this;
    }
    ~MspTree() = default;

    /// The index of a whole boundary; leaves name its faces, edges and vertices.
    /// O(candidates · n) predicates a level of the tree. Deterministic.
    /// \pre the boundary is embedded: faces share no area and cross nowhere. Otherwise the tree
    /// means nothing, or an Error (Internal) says what did not fit. \throw UnsupportedError, naming
    /// the edge, when two coplanar faces meet in an edge for which no bounded plane is known;
    /// assemble with maximal faces then. LimitError for more than 2^29 entities or nodes.
    [[nodiscard]] static MspTree from_brep(const Brep& brep, const MspOptions& options = {});

    /// The index of the part of a boundary within a convex cell, the common part of the half-spaces
    /// below `walls` (none for all of space). Polygons may reach out of the cell and are cut there;
    /// all that meet the open cell must be given. The answer for a point outside the cell has no
    /// meaning. A cell that no polygon meets is one leaf, `empty`.
    /// \pre as above.
    [[nodiscard]] static MspTree from_polygons(std::span<const MspPolygon> polygons,
                                               std::span<const Plane> walls, Leaf empty = Leaf::Out,
                                               const MspOptions& options = {},
                                               Lattice lattice = {});

    [[nodiscard]] Lattice lattice() const { return lattice_; }
    [[nodiscard]] Ref root() const { return root_; }
    [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
    /// \pre !ref.is_leaf()
    [[nodiscard]] const Node& node(Ref ref) const { return nodes_[ref.index()]; }
    /// The plane that cuts: it is the cut (dimension 3), or it meets the plane of the nearest
    /// ancestor of dimension 3 in the line (2), or the line of the one of dimension 2 in the point.
    [[nodiscard]] const Plane& plane(const Node& node) const { return planes_[node.plane]; }
    /// Of an inner node: 1, 2 or 3.
    [[nodiscard]] int dimension(Ref ref) const { return dimension_[ref.index()]; }

    /// The leaf whose region contains the point: one sign a level. Points are in lattice units.
    [[nodiscard]] Ref locate(const LatticePoint& p) const;
    [[nodiscard]] Ref locate(const Point& p) const;
    /// The same for a point in the user's units, taken as it is, not moved to the lattice.
    /// \throw UsageError when a coordinate is not finite.
    [[nodiscard]] Ref locate(const Point3d& p) const;

    /// O(n).
    [[nodiscard]] MspStats stats() const;

    /// Checks that nodes form a tree whose dimensions go down by one through `on` and stay
    /// otherwise, that leaves of each dimension are of the kinds listed above, and that every cut
    /// runs through its region. O(n · depth), for tests.
    /// \throw Error (Internal) naming the node.
    void validate() const;
    /// Also checks that every vertex, an interior point of every edge and one of every face of the
    /// boundary are located there, and that points around agree with a parity test that uses no
    /// tree. \throw Error (Internal) naming the entity.
    void validate(const Brep& brep, std::size_t parity_samples = 64) const;

private:
    friend class MspTreeBuilder;

    void swap(MspTree& o) noexcept {
        nodes_.swap(o.nodes_);
        dimension_.swap(o.dimension_);
        planes_.swap(o.planes_);
        std::swap(root_, o.root_);
        std::swap(lattice_, o.lattice_);
        std::swap(faces_, o.faces_);
        std::swap(polygons_, o.polygons_);
        std::swap(fragments_, o.fragments_);
        std::swap(build_seconds_, o.build_seconds_);
    }

    std::vector<Node> nodes_;
    std::vector<std::uint8_t> dimension_;  // by node
    std::vector<Plane> planes_;
    Ref root_;
    Lattice lattice_;
    std::size_t faces_ = 0;
    std::size_t polygons_ = 0;
    std::size_t fragments_ = 0;
    double build_seconds_ = 0;
};

}  // namespace trisect
