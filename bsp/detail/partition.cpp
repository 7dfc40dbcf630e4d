// SPDX-License-Identifier: Apache-2.0
//
// Three ways to distribute a list, from fast to slow. A list that lies on one side of the wall is
// handed on as it is. When the wall is between two rounded positions of the frame, comparing the
// rounded boxes is exact: one pass without branches. Otherwise (a wall that another evaluation
// chose in another frame) the polygons' own boxes are looked up.

#include <trisect/bsp/detail/partition.h>

#include <algorithm>
#include <optional>

#include <trisect/bsp/detail/facet_in_cell.h>

namespace trisect::detail {

namespace {

// In longer lists a few facets too many cost less than looking.
constexpr std::size_t short_list = 4000;
// Longer than any rounded box.
constexpr int unlimited = 4 * packed_limit;

template <class Visit>
void for_each_box(const CellNode& leaf, Visit&& visit) {
    const PolygonList& polygons = leaf.polygons();
    const Source* source = polygons.whole_source();
    if (source == nullptr) {
        for (std::size_t i = 0; i < polygons.size(); ++i)
            visit(static_cast<std::uint32_t>(i), polygons[i].box());
    } else if (polygons.has_all_facets()) {
        for (std::uint32_t f = 0; f < source->facet_count(); ++f) visit(f, source->facet_box(f));
    } else {
        for (const std::uint32_t f : polygons.facets()) visit(f, source->facet_box(f));
    }
}

bool reaches_out(const Frame& frame, const Box& box) {
    for (std::size_t k = 0; k < 3; ++k)
        if (!frame.covers(k, box.lo[k]) || !frame.covers(k, box.hi[k])) return true;
    return false;
}

void set_box(CellOperand& operand, const CellTask& task, const Cell& cell) {
    operand.box = box_of(operand.entries, operand.count).intersected(packed_cell(task.frame, cell));
}

// Where the next entries go: those below the wall upwards from the front of the memory, those above
// it downwards from its end. Both get the entries that cross the wall.
struct Ends {
    PackedBox* below;
    PackedBox* above;
};

// The wall is below rounded position `first_above`. Every entry is written to both ends, and those
// are advanced by the outcome of the comparisons. Entries that cross the wall and are longer than
// `long_facet` are left to `add_long`; without a limit the loop has no branch.
template <bool Limited, class AddLong>
Ends distribute(std::span<const PackedBox> list, std::size_t axis, int first_above, int long_facet,
                Ends ends, const AddLong& add_long) {
    const auto q = static_cast<std::int16_t>(first_above);
    const auto minus_q = static_cast<std::int16_t>(-first_above);
    for (const PackedBox& e : list) {
        const std::size_t below = e.lo[axis] < q ? 1 : 0;
        const std::size_t above = e.minus_hi[axis] <= minus_q ? 1 : 0;
        if (Limited && (below & above) != 0 && e.high(axis) - e.low(axis) > long_facet)
            [[unlikely]] {
            ends = add_long(e, ends);
            continue;
        }
        copy(e, ends.below);
        copy(e, ends.above - 1);
        ends.below += below;
        ends.above -= above;
    }
    return ends;
}

// The same for a wall anywhere.
template <class AddLong>
Ends distribute_exactly(const CellOperand& operand, std::size_t axis, std::int64_t last_below,
                        int long_facet, Ends ends, const AddLong& add_long) {
    for (const PackedBox& e : operand.list()) {
        const Box b = operand.polygon(e.id).box();
        const bool below = b.lo[axis] <= last_below;
        const bool above = b.hi[axis] > last_below;
        if (below && above && e.high(axis) - e.low(axis) > long_facet) {
            ends = add_long(e, ends);
            continue;
        }
        if (below) *ends.below++ = e;
        if (above) *--ends.above = e;
    }
    return ends;
}

std::int64_t unpacked(const Frame& frame, std::size_t axis, int q) {
    return frame.origin[axis] + (static_cast<std::int64_t>(q) << frame.shift);
}

// The reach of all lists in a child, exact up to rounding outwards.
Box reach_in(const CellTask& task, const Cell& cell) {
    PackedBox all;
    for (const CellOperand& o : task.operands)
        if (o.is_list && !o.unbounded && !o.box.is_empty()) all.add(o.box);
    const Box b = cell.lattice_box();
    if (all.is_empty()) return b;
    Box reach;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool open_low = all.low(k) <= -packed_limit;
        const bool open_high = all.high(k) >= packed_limit;
        reach.lo[k] = open_low ? b.lo[k] : unpacked(task.frame, k, all.low(k));
        reach.hi[k] = open_high ? b.hi[k] : unpacked(task.frame, k, all.high(k) + 1) - 1;
    }
    return reach.intersected(b);
}

// Facets that are longer than this along an axis are looked at themselves.
int long_facet_of(const CellTask& task, std::size_t axis) {
    PackedBox all;
    for (const CellOperand& o : task.operands)
        if (o.is_list && !o.unbounded && !o.box.is_empty()) all.add(o.box);
    return all.is_empty() ? unlimited : (all.high(axis) - all.low(axis)) / 4;
}

}  // namespace

PackedBox packed_cell(const Frame& frame, const Cell& cell) {
    return PackedBox::of(frame, cell.lattice_box());
}

Box exact_box(const CellOperand& operand, const Cell& cell) {
    Box all;
    const PolygonList& polygons = operand.node->polygons();
    if (operand.is_list) {
        for (const PackedBox& e : operand.list()) all.add(operand.polygon(e.id).box());
    } else if (polygons.has_all_facets()) {
        all = polygons.whole_source()->box();
    } else {
        for_each_box(*operand.node, [&](std::uint32_t, const Box& b) { all.add(b); });
    }
    return all.intersected(cell.lattice_box());
}

namespace {

// All facets of a mesh: every corner is rounded once.
void pack_all(const Source& source, const Frame& frame, StackArena& arena, PackedBox* entries) {
    const auto& mesh = source.mesh();
    const auto mark = arena.mark();
    auto* points = arena.take<PackedBox>(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        points[i] = packed_point(frame, mesh.points[i]);
    for (std::uint32_t f = 0; f < source.facet_count(); ++f) {
        const auto& t = mesh.triangles[f];
        entries[f] = box_of_three(points[t[0]], points[t[1]], points[t[2]]);
        entries[f].id = f;
    }
    arena.release(mark);
}

}  // namespace

void open_leaf(CellOperand& operand, const CellTask& task, StackArena& arena) {
    auto* entries = arena.take<PackedBox>(operand.node->polygons().size());
    const PolygonList& polygons = operand.node->polygons();
    if (polygons.has_all_facets() && !polygons.whole_source()->is_half_space()) {
        pack_all(*polygons.whole_source(), task.frame, arena, entries);
        operand.entries = entries;
        operand.count = polygons.whole_source()->facet_count();
        operand.is_list = true;
        operand.unbounded = false;
        operand.drawn_in = reaches_out(task.frame, polygons.whole_source()->box());
        set_box(operand, task, task.cell);
        return;
    }
    std::uint32_t n = 0;
    Box all;
    for_each_box(*operand.node, [&](std::uint32_t id, const Box& b) {
        entries[n++] = PackedBox::of(task.frame, b, id);
        all.add(b);
    });
    operand.entries = entries;
    operand.count = n;
    operand.is_list = true;
    operand.unbounded = n == 1 && operand.polygon(entries[0].id).source->is_half_space();
    operand.drawn_in = n != 0 && reaches_out(task.frame, all);
    set_box(operand, task, task.cell);
}

void reframe(CellOperand& operand, const CellTask& task, StackArena& arena) {
    auto* entries = arena.take<PackedBox>(operand.count);
    Box all;
    for (std::uint32_t i = 0; i < operand.count; ++i) {
        const std::uint32_t id = operand.entries[i].id;
        const Box b = operand.polygon(id).box();
        entries[i] = PackedBox::of(task.frame, b, id);
        all.add(b);
    }
    operand.entries = entries;
    operand.drawn_in = operand.count != 0 && reaches_out(task.frame, all);
    set_box(operand, task, task.cell);
}

void partition(const CellOperand& operand, const CellTask& task, const Wall& wall,
               const std::array<Cell, 2>& cells, StackArena& arena,
               std::array<CellOperand, 2>& out) {
    const auto k = static_cast<std::size_t>(wall.axis);
    out[0] = out[1] = operand;
    if (operand.count == 0) return;
    const std::int64_t last = wall.last_below();
    const auto q = task.frame.first_above(k, last);
    if (!operand.drawn_in) {
        // The box is exact outside the frame as well.
        const bool all_below = q ? operand.box.high(k) < *q
                                 : last >= unpacked(task.frame, k, operand.box.high(k) + 1) - 1;
        const bool all_above =
            q ? operand.box.low(k) >= *q : last < unpacked(task.frame, k, operand.box.low(k));
        if (all_below || all_above) {
            CellOperand& none = out[all_below ? 1 : 0];
            none.count = 0;
            none.box = PackedBox{};
            return;
        }
    }
    const std::size_t n = operand.count;
    // Room for both lists at their largest. What stays free between them is never touched.
    const std::size_t room = 2 * n + 2;
    auto* memory = arena.take<PackedBox>(room);
    Ends ends{memory, memory + room};
    const bool small = task.size() < short_list;
    const int long_facet = small ? long_facet_of(task, k) : unlimited;
    std::array<std::optional<Box>, 2> reach;
    const auto misses = [&](const PackedBox& e, std::size_t i) {
        if (!reach[i]) reach[i] = reach_in(task, cells[i]);
        return certainly_misses(operand.polygon(e.id), *reach[i]);
    };
    // A facet that crosses the wall and is long for its cell may still miss one of the children.
    const auto add_long = [&](const PackedBox& e, Ends to) {
        if (!misses(e, 0)) *to.below++ = e;
        if (!misses(e, 1)) *--to.above = e;
        return to;
    };
    if (!q) {
        ends = distribute_exactly(operand, k, last, long_facet, ends, add_long);
    } else if (small) {
        ends = distribute<true>(operand.list(), k, *q, long_facet, ends, add_long);
    } else {
        ends = distribute<false>(operand.list(), k, *q, unlimited, ends, add_long);
    }
    out[0].entries = memory;
    out[0].count = static_cast<std::uint32_t>(ends.below - memory);
    out[1].entries = ends.above;
    out[1].count = static_cast<std::uint32_t>(memory + room - ends.above);
    for (std::size_t i = 0; i < 2; ++i) set_box(out[i], task, cells[i]);
}

}  // namespace trisect::detail
