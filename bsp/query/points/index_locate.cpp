// SPDX-License-Identifier: Apache-2.0
//
// Point location, one point after the other: a descent to a cell, and there PointInLeaf.

#include <algorithm>

#include <trisect/bsp/query/index/branch_block.h>
#include <trisect/bsp/query/index/coarse_map.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/index/index_counters.h>
#include <trisect/bsp/query/index/index_signs.h>
#include <trisect/bsp/query/points/index_in_leaf.h>

namespace trisect::detail {

namespace {

// Whether a point is known well enough for the planes of a cell.
bool is_precise(const IndexedLeaf::Cell& cell, const IndexPoint& p) {
    if (p.is_doubles()) return true;
    if (cell.grid == nullptr) return false;
    const auto& s = cell.grid->scale;
    return p.error() * std::max({s[0], s[1], s[2]}) < 0x1p-22;
}

bool is_beyond(const IndexBase& index, const IndexPoint& p) {
    if (!index.is_bounded()) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (p[k] - p.error() > index.hi()[k] || p[k] + p.error() < index.lo()[k]) return true;
    return false;
}

// Of a point in the closed cell: whether it is inside, if none of the polygons that enter the cell
// contains it. The others do not count, and some of them contains it.
bool is_inside(const IndexedLeaf& leaf, const IndexPoint& p) {
    ++index_counters().exact;
    const IndexPolygons& polygons = leaf.polygons();
    const Reference reference(leaf.reference());
    int winding = leaf.winding();
    for (IndexedLeaf::Id id = 0; id < polygons.size(); ++id) {
        const Passing s = passing(polygons, id, p, reference);
        if (s == Passing::On) continue;
        winding += polygons.is_flipped(id) ? -static_cast<int>(s) : static_cast<int>(s);
    }
    return winding > 0;
}

// A point, leaf by leaf.
class PointInLeaves {
public:
    PointInLeaves(const IndexPoint& p, std::vector<PolygonId>& on) : p_(p), on_(on) {}

    void visit(const LeafPlace& place) {
        if (place.leaf == nullptr) {
            ++index_counters().empty;
            inside_ = place.inside;
            return;
        }
        const IndexedLeaf& leaf = place.leaf->divided();
        if (const auto inside = leaf.beyond(p_.approximate(), p_.error())) {
            ++index_counters().empty;
            inside_ = *inside != place.turned;
            return;
        }
        leaf.prefetch_cells();
        IndexGrid::Position at;
        IndexedLeaf::Cell cell;
        if (const IndexGrid* const grid = leaf.grid()) {
            at = grid->position(p_);
            cell = leaf.cell_at(at);
        } else {
            cell = leaf.whole();
        }
        if (!cell.is_mixed()) {
            ++index_counters().empty;
            inside_ = cell.is_inside() != place.turned;
            return;
        }
        const auto before = static_cast<std::ptrdiff_t>(on_.size());
        PointInLeaf in_leaf;
        in_leaf.begin(leaf, place.turned, cell, at, is_precise(cell, p_));
        const PointInLeaf::Answer quick = in_leaf.decide();
        bool found = quick == PointInLeaf::Answer::Open ? in_leaf.finish(p_, on_)
                                                        : quick == PointInLeaf::Answer::Inside;
        if (std::ssize(on_) != before && place.on_wall) {
            // On the cell's border: what does not enter the cell is its neighbours' affair.
            on_.erase(std::remove_if(on_.begin() + before, on_.end(),
                                     [](const PolygonId& id) { return !id.enters(); }),
                      on_.end());
            if (std::ssize(on_) == before) found = is_inside(leaf, p_);
        }
        if (std::ssize(on_) == before) inside_ = found != place.turned;
    }
    /// When no polygon contains it.
    [[nodiscard]] bool inside() const { return inside_; }

private:
    const IndexPoint& p_;
    std::vector<PolygonId>& on_;
    bool inside_ = false;
};

// The leaf of a point that is on no splitting plane, if it has an index already.
bool find_quickly(const IndexBase& index, const IndexPoint& p, LeafPlace& place) {
    place.turned = index.root().complemented;
    const BranchBlock* block = index.root_block();
    if (block == nullptr) {
        place.leaf = index.only_leaf();
        return place.leaf != nullptr;
    }
    const WallPoint at(p);
    for (;;) {
        const int way = block->way_of(at);
        if (way < 0) return false;
        const BranchBlock::Next next = block->next(way);
        if (!next.is_known()) return false;
        if (next.is_empty()) {
            place.inside = next.turned() != place.turned;
            return true;
        }
        place.turned = place.turned != next.turned();
        if (next.is_leaf()) {
            place.leaf = &next.leaf();
            place.leaf->prefetch();
            return true;
        }
        block = &next.block();
        block->prefetch();
    }
}

}  // namespace

Location locate_in_leaves(const IndexBase& index, const IndexPoint& point,
                          std::vector<PolygonId>& on) {
    on.clear();
    PointInLeaves found(point, on);
    LeafPlace quick;
    if (find_quickly(index, point, quick)) {
        found.visit(quick);
    } else {
        for_leaves_at(index, point, [&](const LeafPlace& place) { found.visit(place); });
    }
    if (!on.empty()) return Location::OnFace;
    return found.inside() ? Location::Inside : Location::Outside;
}

std::optional<bool> far_side(const IndexBase& index, const std::array<double, 3>& point) {
    const bool turned = index.root().complemented;
    const CoarseMap::Side side = index.coarse_map().at(point, [&] {
        std::vector<PolygonId> on;
        return (locate_in_leaves(index, IndexPoint(point), on) == Location::Inside) != turned;
    });
    if (side == CoarseMap::Side::Open) return std::nullopt;
    return (side == CoarseMap::Side::Inside) != turned;
}

Location locate_polygons(const IndexBase& index, const IndexPoint& point,
                         std::vector<PolygonId>& on) {
    // A single leaf has bounds of its own.
    if (index.only_leaf() != nullptr) return locate_in_leaves(index, point, on);
    bool inside = false;
    if (is_beyond(index, point)) {
        inside = index.is_inside_beyond();
    } else {
        std::optional<bool> far;
        if (index.is_bounded() && index.root_block() != nullptr && point.is_doubles())
            far = far_side(index, point.approximate());
        if (!far) return locate_in_leaves(index, point, on);
        inside = *far;
    }
    on.clear();
    ++index_counters().empty;
    return inside ? Location::Inside : Location::Outside;
}

}  // namespace trisect::detail
