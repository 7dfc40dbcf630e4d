// SPDX-License-Identifier: Apache-2.0
//
// Three ways to distribute a list, from fast to slow. A list that lies on one side of the splitting
// plane is handed on as it is. When the splitting plane is between two rounded positions of the
// frame, comparing the rounded boxes is exact: one pass without branches. Otherwise (a splitting
// plane that another evaluation chose in another frame) the polygons' own boxes are looked up.
//
// Memory that is touched for the first time costs a fault and its clearing, more than the pass
// itself. So both sides of a large list share one piece that has room for few entries that cross
// the splitting plane, which arenas can keep for the next evaluation; where there are more a larger
// one is taken. The lists of two large operands are distributed, and the boxes of large meshes
// made, by several threads.

#include <trisect/bsp/divide/partition.h>

#include <algorithm>
#include <optional>

#include <trisect/bsp/cells/facet_in_cell.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/support/parallel_parts.h>

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

// Where the next entries go: those below the splitting plane upwards from the front of the memory,
// those above it downwards from its end. Both get the entries that cross the splitting plane.
struct Ends {
    PackedBox* below;
    PackedBox* above;
};

// The splitting plane is below rounded position `first_above`. Every entry is written to both ends,
// and those are advanced by the outcome of the comparisons. Entries that cross the splitting plane
// and are longer than `long_facet` are left to `add_long`; without a limit the loop has no branch.
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

// The same for a splitting plane anywhere. Where it lies within a rounded position that does not
// decide all: then polygons that begin or end in that position are looked up.
template <class AddLong>
Ends distribute_exactly(const CellOperand& operand, std::span<const PackedBox> list,
                        const Frame& frame, std::size_t axis, std::int64_t last_below,
                        int long_facet, Ends ends, const AddLong& add_long) {
    const bool covered = frame.covers(axis, last_below);
    const int at_splitter = frame.at(axis, last_below);
    for (const PackedBox& e : list) {
        bool below = e.low(axis) < at_splitter;
        bool above = e.high(axis) > at_splitter;
        if (!covered || e.low(axis) == at_splitter || e.high(axis) == at_splitter) {
            const Box b = operand.polygon(e.id).box();
            below = b.lo[axis] <= last_below;
            above = b.hi[axis] > last_below;
        }
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

// What loops over all points or facets need is passed by value: as far as the compiler can prove,
// boxes that are written may be anything that is read through a pointer.
template <bool Whole>
void pack_points(Frame frame, std::span<const LatticePoint> points, PackedBox* out) {
    for (const LatticePoint& p : points) *out++ = packed_point<Whole>(frame, p);
}

void pack_facets(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t number,
                 const PackedBox* points, PackedBox* out) {
    for (const auto& t : triangles) {
        // No copy of both: to read what was just written in two parts waits for it.
        *out = box_of_three(points[t[0]], points[t[1]], points[t[2]]);
        out++->id = number++;
    }
}

// All facets of a mesh: every corner is rounded once.
void pack_all(const Source& source, const Frame& frame, StackArena& arena, std::uint32_t threads,
              PackedBox* entries) {
    constexpr std::size_t least_part = 16384;
    const std::span points(source.mesh().points);
    const std::span triangles(source.mesh().triangles);
    const auto mark = arena.mark();
    auto* const packed = arena.take<PackedBox>(points.size());
    ParallelParts(points.size(), threads, least_part)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            const auto some = points.subspan(begin, end - begin);
            if (source.is_whole()) {
                pack_points<true>(frame, some, packed + begin);
            } else {
                pack_points<false>(frame, some, packed + begin);
            }
        });
    ParallelParts(triangles.size(), threads, least_part)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            pack_facets(triangles.subspan(begin, end - begin), static_cast<std::uint32_t>(begin),
                        packed, entries + begin);
        });
    arena.release(mark);
}

}  // namespace

void open_leaf(CellOperand& operand, const CellTask& task, StackArena& arena,
               std::uint32_t threads) {
    auto* entries = arena.take<PackedBox>(operand.node->polygons().size());
    const PolygonList& polygons = operand.node->polygons();
    if (polygons.has_all_facets() && !polygons.whole_source()->is_half_space()) {
        pack_all(*polygons.whole_source(), task.frame, arena, threads, entries);
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

namespace {

// A splitting plane, and what all lists of a task have in common there.
class Division {
public:
    Division(const CellTask& task, const SplittingPlane& splitter, const std::array<Cell, 2>& cells)
        : task_(task),
          cells_(cells),
          axis_(static_cast<std::size_t>(splitter.axis)),
          last_(splitter.last_below()),
          first_above_(task.frame.first_above(axis_, last_)),
          small_(task.size() < short_list),
          long_facet_(small_ ? long_facet_of(task, axis_) : unlimited) {}

    [[nodiscard]] bool is_below(const CellOperand& o) const {
        if (o.drawn_in) return false;
        // The box is exact outside the frame as well.
        return first_above_ ? o.box.high(axis_) < *first_above_
                            : last_ >= unpacked(task_.frame, axis_, o.box.high(axis_) + 1) - 1;
    }
    [[nodiscard]] bool is_above(const CellOperand& o) const {
        if (o.drawn_in) return false;
        return first_above_ ? o.box.low(axis_) >= *first_above_
                            : last_ < unpacked(task_.frame, axis_, o.box.low(axis_));
    }

    // False when the room does not suffice; then nothing happened. Large lists at the same time are
    // all right.
    bool distribute_list(const CellOperand& o, std::span<PackedBox> room,
                         const std::array<CellOperand*, 2>& out) {
        Ends ends{room.data(), room.data() + room.size()};
        auto rest = o.list();
        while (!rest.empty()) {
            // Each entry takes at most two places, and two more are written to in vain.
            const auto free = static_cast<std::size_t>(ends.above - ends.below);
            const std::size_t n = std::min(rest.size(), (std::max<std::size_t>(free, 2) - 2) / 2);
            if (n == 0) return false;
            ends = distribute_some(o, rest.first(n), ends);
            rest = rest.subspan(n);
        }
        const std::span<PackedBox> below(room.data(), ends.below);
        const std::span<PackedBox> above(ends.above, room.data() + room.size());
        out[0]->entries = below.data();
        out[0]->count = static_cast<std::uint32_t>(below.size());
        out[1]->entries = above.data();
        out[1]->count = static_cast<std::uint32_t>(above.size());
        for (std::size_t i = 0; i < 2; ++i) set_box(*out[i], task_, cells_[i]);
        return true;
    }

private:
    Ends distribute_some(const CellOperand& o, std::span<const PackedBox> list, Ends ends) {
        const auto misses = [&](const PackedBox& e, std::size_t i) {
            if (!reach_[i]) reach_[i] = reach_in(task_, cells_[i]);
            return certainly_misses(o.polygon(e.id), *reach_[i]);
        };
        // A facet that crosses the splitting plane and is long for its cell may still miss one of
        // the children.
        const auto add_long = [&](const PackedBox& e, Ends to) {
            if (!misses(e, 0)) *to.below++ = e;
            if (!misses(e, 1)) *--to.above = e;
            return to;
        };
        if (!first_above_)
            return distribute_exactly(o, list, task_.frame, axis_, last_, long_facet_, ends,
                                      add_long);
        if (small_)
            return distribute<true>(list, axis_, *first_above_, long_facet_, ends, add_long);
        return distribute<false>(list, axis_, *first_above_, unlimited, ends, add_long);
    }

    const CellTask& task_;
    const std::array<Cell, 2>& cells_;
    std::size_t axis_;
    std::int64_t last_;
    std::optional<int> first_above_;  // where rounded positions distinguish the sides
    bool small_;                      // all lists together
    int long_facet_;
    std::array<std::optional<Box>, 2> reach_;  // made for small lists
};

struct ListToDivide {
    const CellOperand* list = nullptr;
    std::array<CellOperand*, 2> out{};
};

// Room for both sides: for large lists enough unless many entries cross the splitting plane, or in
// any case. What stays free between them is never touched, but a few large blocks are all that
// arenas keep.
std::span<PackedBox> take_room(const CellOperand& o, bool in_any_case, StackArena& arena) {
    constexpr std::size_t large = std::size_t{1} << 18;
    const std::size_t n = o.count;
    const std::size_t room = in_any_case || n < large ? 2 * n + 2 : n + n / 8;
    return {arena.take<PackedBox>(room), room};
}

void divide(Division& division, const ListToDivide& l, StackArena& arena) {
    const auto mark = arena.mark();
    if (division.distribute_list(*l.list, take_room(*l.list, false, arena), l.out)) return;
    arena.release(mark);
    TRISECT_EXPECTS(division.distribute_list(*l.list, take_room(*l.list, true, arena), l.out),
                    "room for every entry twice");
}

void divide_both(Division& division, const ListToDivide& a, const ListToDivide& b,
                 StackArena& arena) {
    const auto room_a = take_room(*a.list, false, arena);
    const auto room_b = take_room(*b.list, false, arena);
    bool done_a = false;
    bool done_b = false;
    both_at_once([&] { done_a = division.distribute_list(*a.list, room_a, a.out); },
                 [&] { done_b = division.distribute_list(*b.list, room_b, b.out); });
    if (!done_a) divide(division, a, arena);
    if (!done_b) divide(division, b, arena);
}

// A half-space's plane has no box, so each cell is compared with the plane itself. `list`: a copy
// of the list that is divided.
void leave_out_plane(CellOperand& list, const Cell& cell) {
    if (!certainly_misses(list.polygon(list.entries[0].id), cell.lattice_box())) return;
    list.count = 0;
    list.box = PackedBox{};
    list.unbounded = false;
}

}  // namespace

void partition(const CellTask& task, const SplittingPlane& splitter,
               const std::array<Cell, 2>& cells, StackArena& arena, std::uint32_t threads,
               const std::array<std::span<CellOperand>, 2>& out) {
    constexpr std::size_t large = 100'000;
    Division division(task, splitter, cells);
    std::optional<ListToDivide> waiting;  // a large one, for another at the same time
    for (std::size_t i = 0; i < task.operands.size(); ++i) {
        const CellOperand& o = task.operands[i];
        if (!o.is_list || o.count == 0) continue;
        if (o.unbounded) {
            for (std::size_t side = 0; side < 2; ++side) leave_out_plane(out[side][i], cells[side]);
            continue;
        }
        const ListToDivide list{&o, {&out[0][i], &out[1][i]}};
        const bool below = division.is_below(o);
        if (below || division.is_above(o)) {
            CellOperand& none = *list.out[below ? 1 : 0];
            none.count = 0;
            none.box = PackedBox{};
        } else if (threads == 1 || o.count < large) {
            divide(division, list, arena);
        } else if (!waiting) {
            waiting = list;
        } else {
            divide_both(division, *waiting, list, arena);
            waiting.reset();
        }
    }
    if (waiting) divide(division, *waiting, arena);
}

}  // namespace trisect::detail
