// SPDX-License-Identifier: Apache-2.0
//
// IndexCore: the shared state of the copies of a BrepIndex.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/indexed_leaf.h>
#include <trisect/bsp/query/index/polygon_id.h>

namespace trisect::detail {

class BranchBlock;
class CoarseMap;

/// A view of a solid's cell tree, whose leaves get their index when a query first enters them.
/// Costs what is new in the tree: bounds are facts of nodes.
class IndexBase {
public:
    explicit IndexBase(const Solid& solid);

    /// Free of self-intersection; keeps sources and fragments.
    [[nodiscard]] const Solid& solid() const { return solid_; }
    [[nodiscard]] Lattice lattice() const { return solid_.lattice(); }
    [[nodiscard]] const CellRef& root() const { return root_; }
    /// Where the tree is one leaf that lists something: its index. Else null.
    [[nodiscard]] const IndexedLeaf* only_leaf() const {
        if (root_block_ != nullptr) return nullptr;
        const IndexedLeaf* const known = only_leaf_.load(std::memory_order_acquire);
        return known != nullptr ? known : find_only_leaf();
    }
    /// Contains the boundary; strictly outside of it everything has the membership `beyond`.
    [[nodiscard]] const std::array<double, 3>& lo() const { return lo_; }
    [[nodiscard]] const std::array<double, 3>& hi() const { return hi_; }
    [[nodiscard]] bool is_bounded() const { return bounded_; }
    [[nodiscard]] bool is_inside_beyond() const;
    /// Where the tree has inner nodes: the first block of a descent. Else null.
    [[nodiscard]] const BranchBlock* root_block() const { return root_block_; }
    /// \pre is_bounded(), and the tree has inner nodes
    [[nodiscard]] const CoarseMap& coarse_map() const {
        const CoarseMap* const known = coarse_map_.load(std::memory_order_acquire);
        return known != nullptr ? *known : find_coarse_map();
    }
    [[nodiscard]] double build_seconds() const { return build_seconds_; }

private:
    [[nodiscard]] const IndexedLeaf* find_only_leaf() const;
    [[nodiscard]] const CoarseMap& find_coarse_map() const;

    Solid solid_;
    std::shared_ptr<const SolidState> state_;  // with the tree
    CellRef root_;
    std::array<double, 3> lo_{};
    std::array<double, 3> hi_{};
    bool bounded_ = true;
    const BranchBlock* root_block_ = nullptr;
    mutable std::atomic<const IndexedLeaf*> only_leaf_{nullptr};
    mutable std::atomic<const CoarseMap*> coarse_map_{nullptr};
    mutable std::atomic<std::int8_t> beyond_{-1};  // -1: not known yet
    double build_seconds_ = 0;
};

/// With the handles of a B-rep, if there is one.
class IndexHandles;

class IndexCore {
public:
    std::shared_ptr<const IndexBase> base;
    std::shared_ptr<const IndexHandles> handles;  // may be null
};

/// A leaf of the cell tree on the way of a query.
struct LeafPlace {
    const IndexedLeaf* leaf = nullptr;  ///< null for an empty one
    bool turned = false;                ///< read it as that of a complement
    bool inside = false;                ///< of an empty one
    bool on_wall = false;               ///< the point is on a splitting plane that bounds its cell
};

/// Calls visit(place) for the leaves whose closed cells hold the point: one, or several when it
/// lies on splitting planes.
template <class Visit>
void for_leaves_at(const IndexBase& base, const IndexPoint& p, Visit&& visit);

/// Inside, Outside or, when the point is on the boundary, OnFace with `on` naming polygons that
/// contain it: at least one for each that does (in no order).
[[nodiscard]] Location locate_polygons(const IndexBase& index, const IndexPoint& point,
                                       std::vector<PolygonId>& on);

/// Of a point in the solid's box, in lattice units: whether it is inside, if it is so far from the
/// boundary that the coarse map decides.
/// \pre the index is bounded, and its tree has inner nodes.
[[nodiscard]] std::optional<bool> far_side(const IndexBase& index,
                                           const std::array<double, 3>& point);

/// The same as locate_polygons without a look at the solid's bounds.
[[nodiscard]] Location locate_in_leaves(const IndexBase& index, const IndexPoint& point,
                                        std::vector<PolygonId>& on);

/// Of one of many points: its number, where it is, and when it is on the boundary the point itself
/// and the polygons that contain it.
using FoundPoint = std::function<void(std::uint32_t number, Location location,
                                      const IndexPoint* point, std::vector<PolygonId>& on)>;

/// Many points in the user's units, in an order of its own; the same as one by one but for the time
/// that is spent waiting for memory. Fewer than 2^32; on so many threads, 0 for as many as there
/// are, each of which may call `found`.
void locate_batch(const IndexBase& index, std::span<const std::array<double, 3>> points,
                  unsigned threads, const FoundPoint& found);

/// The same, but only where each point is: results[i] of points[i].
void classify_batch(const IndexBase& index, std::span<const std::array<double, 3>> points,
                    unsigned threads, std::span<Location> results);

/// Location and names of a point from the polygons that contain it, in any order, not none.
/// Handles are not set.
[[nodiscard]] Place place_on(std::vector<PolygonId>& on, const IndexPoint& point);

/// Its location alone, which doubles mostly decide.
[[nodiscard]] Location location_on(const std::vector<PolygonId>& on);

/// The same as place_on, for what is not a point: the rank is that of the normals, and no corner is
/// looked for.
[[nodiscard]] Place place_on(std::vector<PolygonId>& on);

/// What queries take a node for: made once, so that all of them go the same way from then on.
struct NodeBounds final : NodeFact {
    Box box;                            ///< of positions; contains the polygons below
    const CellNode* queried = nullptr;  ///< the node, or a leaf's refinement if there was one
};

/// Made with those of all nodes below, where they are not there yet.
[[nodiscard]] const NodeBounds& node_bounds(const CellNode& node);

[[nodiscard]] inline const Box& bounds_of(const CellNode& node) { return node_bounds(node).box; }

/// The node that a query goes on with: always the same one.
[[nodiscard]] inline const CellNode& refined(const CellNode& node) {
    return node.is_leaf() ? *node_bounds(node).queried : node;
}

template <class Visit>
void for_leaves_at(const IndexBase& base, const IndexPoint& p, Visit&& visit) {
    struct Branch {
        const CellNode* node;
        bool turned;
        bool on_wall;
        Cell cell;
    };
    std::vector<Branch> pending;  // allocates only for points on splitting planes
    Branch at{base.root().node.get(), base.root().complemented, false, Cell{}};
    for (;;) {
        const CellNode& n = refined(*at.node);
        if (!n.is_leaf()) {
            const auto axis = static_cast<std::size_t>(n.axis());
            const std::int64_t splitter = n.splitter();
            const int s = p.compare_fine(axis, splitter);
            const auto enter = [&](Branch& b, int side) {
                const CellRef& child = n.child(side);
                (side == 0 ? b.cell.hi : b.cell.lo)[axis] = splitter;
                b.node = child.node.get();
                b.turned = b.turned != child.complemented;
            };
            if (s == 0) {
                at.on_wall = true;
                pending.push_back(at);
                enter(pending.back(), 1);
            }
            enter(at, s > 0 ? 1 : 0);
            continue;
        }
        LeafPlace place;
        place.turned = at.turned;
        place.on_wall = at.on_wall;
        if (n.size() == 0) {
            place.inside = (n.winding() > 0) != at.turned;
        } else {
            place.leaf = &indexed_leaf(n, at.cell);
        }
        visit(place);
        if (pending.empty()) return;
        at = pending.back();
        pending.pop_back();
    }
}

}  // namespace trisect::detail
