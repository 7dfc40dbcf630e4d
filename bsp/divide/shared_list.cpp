// SPDX-License-Identifier: Apache-2.0
//
// Polygons were sent to the cell by their boxes, rounded outwards, so that a list may hold some
// that only pass by. To look at each would make sharing as dear as cutting. One polygon that
// certainly lies in the cell is enough for the leaf's promise (a leaf without polygons is
// homogeneous, others are rarely so); boxes decide that for nearly all. Those that lie within come
// first: later readers of the leaf need not test whether to clip them.

#include <trisect/bsp/divide/shared_list.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/packed_box.h>
#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/divide/partition.h>

namespace trisect::detail {

namespace {

// Positions of a task's frame that certainly lie in its cell.
PackedBox certain_positions(const CellTask& task) {
    PackedBox b = packed_cell(task.frame, task.cell);
    // Rounding outwards at splitting planes of other frames: one position farther in is certain.
    for (std::size_t k = 0; k < 3; ++k) {
        if (!task.frame.first_above(k, lattice_below(task.cell.lo[k])) && b.low(k) > -packed_limit)
            ++b.lo[k];
        if (!task.frame.first_above(k, lattice_below(task.cell.hi[k])) && b.high(k) < packed_limit)
            ++b.minus_hi[k];
    }
    return b;
}

}  // namespace

PolygonList shared_list(const CellTask& task, const CellOperand& o, bool complemented,
                        Workbench& bench, StackArena& arena) {
    const PolygonList& names = o.node->polygons();
    const bool flip = o.complemented != complemented;
    const PackedBox within = certain_positions(task);
    const auto mark = arena.mark();
    auto* ids = arena.take<std::uint32_t>(o.count);
    std::uint32_t* front = ids;
    std::uint32_t* back = ids + o.count;
    for (const PackedBox& e : o.list()) {
        if (within.contains(e)) {
            *front++ = e.id;
        } else {
            *--back = e.id;
        }
    }
    const auto contained = static_cast<std::size_t>(front - ids);
    std::reverse(back, ids + o.count);
    std::size_t count = o.count;
    if (contained == 0) {
        const auto misses = [&](std::uint32_t id) {
            return !meets_cell(bench, o.polygon(id), task.cell);
        };
        count = static_cast<std::size_t>(std::remove_if(ids, ids + o.count, misses) - ids);
    }
    PolygonList list;
    if (names.whole_source() != nullptr) {
        list = PolygonList::whole_facets(*names.whole_source(), names.flipped() != flip,
                                         {ids, count}, contained);
    } else {
        std::vector<PolygonRef> refs(count);
        for (std::size_t i = 0; i < count; ++i) {
            refs[i] = o.polygon(ids[i]);
            refs[i].flipped = refs[i].flipped != flip;
        }
        list = PolygonList(std::move(refs));
    }
    arena.release(mark);
    return list;
}

}  // namespace trisect::detail
