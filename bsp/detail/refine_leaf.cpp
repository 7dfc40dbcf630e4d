// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/refine_leaf.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <trisect/bsp/detail/axis_trace.h>

namespace trisect::detail {

namespace {

constexpr std::int64_t wall_offset = 83;

struct Half {
    std::vector<std::uint32_t> contained;
    std::vector<std::uint32_t> crossing;
};

Box box_within(const CellNode& leaf, const Cell& cell) {
    const PolygonList& polygons = leaf.polygons();
    Box all;
    if (polygons.has_all_facets()) {
        all = polygons.whole_source()->box();
    } else {
        for (const std::uint32_t f : polygons.facets())
            all.add(polygons.whole_source()->facet_box(f));
    }
    return all.intersected(cell.lattice_box());
}

// The leaf's reference moved through the wall, with the winding number there.
std::optional<std::pair<FinePoint, int>> reference_beyond(const CellNode& leaf, const Cell& cell,
                                                          int axis, std::int64_t wall,
                                                          std::int64_t direction) {
    const auto k = static_cast<std::size_t>(axis);
    for (const std::int64_t step : {3, 37, 59, 101, 1001, 10001}) {
        FinePoint p = leaf.reference();
        p.c[k] = wall + direction * step;
        if (!cell.contains(p)) continue;
        AxisTrace trace(leaf.reference(), p, axis);
        Box segment;
        for (std::size_t i = 0; i < 3; ++i) {
            segment.lo[i] = (std::min(p.c[i], leaf.reference().c[i]) >> wall_bits) - 1;
            segment.hi[i] = (std::max(p.c[i], leaf.reference().c[i]) >> wall_bits) + 2;
        }
        for (const PolygonRef& r : leaf.polygons())
            if (r.box().overlaps(segment)) trace.add(r);
        if (const auto change = trace.change(false)) return std::pair(p, leaf.winding() + *change);
    }
    return std::nullopt;
}

std::shared_ptr<const CellNode> halved(const CellNode& leaf, const Cell& cell) {
    const PolygonList& polygons = leaf.polygons();
    const Source& source = *polygons.whole_source();
    const Box box = box_within(leaf, cell);
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const auto j = static_cast<std::size_t>(axis);
        if (box.hi[i] - box.lo[i] > box.hi[j] - box.lo[j]) axis = k;
    }
    const auto k = static_cast<std::size_t>(axis);
    if (box.is_empty() || box.hi[k] == box.lo[k]) return nullptr;
    const std::int64_t last_below = box.lo[k] + (box.hi[k] - box.lo[k] - 1) / 2;
    const std::int64_t wall = last_below * wall_scale + wall_offset;
    const std::array<Cell, 2> cells{cell.below(axis, wall), cell.above(axis, wall)};
    std::array<Half, 2> halves;
    for (const PolygonRef& r : polygons) {
        const Box& b = r.box();
        const bool below = b.lo[k] <= last_below;
        const bool above = b.hi[k] > last_below;
        if (below)
            (!above && cell.contains(b) ? halves[0].contained : halves[0].crossing)
                .push_back(r.facet);
        if (above)
            (!below && cell.contains(b) ? halves[1].contained : halves[1].crossing)
                .push_back(r.facet);
    }
    std::array<CellRef, 2> children;
    for (std::size_t i = 0; i < 2; ++i) {
        Half& h = halves[i];
        const std::size_t contained = h.contained.size();
        h.contained.insert(h.contained.end(), h.crossing.begin(), h.crossing.end());
        // Both halves nearly as large as the whole: a wall that parts nothing.
        if (h.contained.size() > polygons.size() - polygons.size() / 16 && i == 1 &&
            children[0].node->size() > polygons.size() - polygons.size() / 16)
            return nullptr;
        std::pair<FinePoint, int> reference{leaf.reference(), leaf.winding()};
        if (!cells[i].contains(leaf.reference())) {
            const auto moved = reference_beyond(leaf, cells[i], axis, wall, i == 0 ? -1 : 1);
            if (!moved) return nullptr;
            reference = *moved;
        }
        children[i].node = CellNode::leaf(
            PolygonList::whole_facets(source, polygons.flipped(), h.contained, contained),
            reference.first, reference.second, leaf.is_mixed());
    }
    return CellNode::split(axis, wall, children[0], children[1]);
}

}  // namespace

const CellNode* refined(const CellNode& leaf, const Cell& cell) {
    if (const CellNode* done = leaf.refinement()) return done;
    const PolygonList& polygons = leaf.polygons();
    if (polygons.whole_source() == nullptr || polygons.whole_source()->is_half_space())
        return nullptr;
    return leaf.refine([&] { return halved(leaf, cell); });
}

namespace {

// Both halves of a large leaf are independent.
void refine_below(const CellNode& node, const Cell& cell, bool parallel) {
    const CellNode* at = &node;
    if (at->is_leaf()) {
        if (at->size() < refinable_leaf) return;
        at = refined(*at, cell);
        if (at == nullptr) return;
    }
    const auto below = [&](int i) {
        const Cell c =
            i == 0 ? cell.below(at->axis(), at->wall()) : cell.above(at->axis(), at->wall());
        refine_below(*at->child(i).node, c, parallel);
    };
    if (parallel && at->size() > 64 * refinable_leaf) {
        tbb::parallel_invoke([&] { below(0); }, [&] { below(1); });
    } else {
        below(0);
        below(1);
    }
}

}  // namespace

void refine_all(const CellRef& root, std::uint32_t threads) {
    if (threads == 1) {
        refine_below(*root.node, Cell{}, false);
        return;
    }
    tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
    arena.execute([&] { refine_below(*root.node, Cell{}, true); });
}

}  // namespace trisect::detail
