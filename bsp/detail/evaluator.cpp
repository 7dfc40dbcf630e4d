// SPDX-License-Identifier: Apache-2.0
//
// One recursion over (cell, formula) evaluates a whole boolean expression:
//
//   1. operands without boundary in the cell are constant there: replace them by their value;
//   2. nothing left: a homogeneous cell. One operand left: share its subtree or its complement;
//   3. few polygons: a leaf arrangement (leaf_arrangement.cpp) decides which bound the result;
//   4. otherwise cut the cell. Where an operand already has a tree its wall is taken, so that its
//      subtrees can be shared. A large leaf beside small ones is refined by itself, for everybody
//      who uses it. Else the wall that soonest parts the operands.
//
// The idea is EMBER's (Trettner, Nehring-Wirxel, Kobbelt 2022); keeping the cells, so that the next
// operation finds them, is Nehring-Wirxel, Trettner, Kobbelt 2021. Two things matter more than
// arithmetic. Walls lie off the lattice, so nothing is listed twice because its box ends at a wall.
// And every cell knows a reference point with all winding numbers, so that classification never
// leaves the cell.
//
// Cells are independent, so the two sides of a wall may be solved by two threads. Results are put
// together by their position in the tree and not by their time, and nothing that a thread keeps
// between cells decides anything; so the tree is the same for any number of threads.

#include <trisect/bsp/detail/evaluator.h>

#include <algorithm>
#include <array>
#include <exception>
#include <optional>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <trisect/bsp/detail/axis_polygon.h>
#include <trisect/bsp/detail/budget.h>
#include <trisect/bsp/detail/cell_task.h>
#include <trisect/bsp/detail/choose_wall.h>
#include <trisect/bsp/detail/covered_cells.h>
#include <trisect/bsp/detail/crossings.h>
#include <trisect/bsp/detail/deep_recursion.h>
#include <trisect/bsp/detail/deferred_leaf.h>
#include <trisect/bsp/detail/leaf_arrangement.h>
#include <trisect/bsp/detail/leaf_problem.h>
#include <trisect/bsp/detail/partition.h>
#include <trisect/bsp/detail/polygon_in_cell.h>
#include <trisect/bsp/detail/prism_facets.h>
#include <trisect/bsp/detail/reference_points.h>
#include <trisect/bsp/detail/refine_leaf.h>
#include <trisect/bsp/detail/slab.h>
#include <trisect/bsp/detail/stack_arena.h>
#include <trisect/bsp/detail/work_budget.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/detail/handover.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

// Cells with fewer polygons are not worth a task of their own.
constexpr std::uint64_t parallel_size = 4096;
// Leaves may be so many times as large where all polygons are across an axis.
constexpr std::uint64_t axis_leaf_factor = 8;
// And where all operands are prisms along one axis.
constexpr std::uint64_t prism_leaf_factor = 40;
// Where rounded positions get this coarse for what has to be parted, a finer frame is made.
constexpr int coarse_extent = 128;

class Worker;

// What the threads of one evaluation share.
struct Shared {
    const EvaluateOptions& options;
    std::size_t slots;
    MemoryBudget memory;
    bool parallel = false;
    const Crossings* crossings = nullptr;  // their operands, if they are collected
    tbb::enumerable_thread_specific<std::unique_ptr<Worker>> workers;

    Worker& worker();
};

// Scratch memory and results of one thread. A thread that waits for another one may start a second
// task on the same worker; nothing of the first is in use then but what lies in the arena below.
class Worker {
public:
    explicit Worker(Shared& shared)
        : shared_(shared), options_(shared.options), values_(shared.slots, -1) {
        if (shared.crossings != nullptr) arranger_.collect_crossings(shared.crossings->operands);
    }

    CellRef solve(CellTask& task);
    CellRef deep_solve(CellTask& task) {
        return with_enough_stack([&] { return solve(task); });
    }
    [[nodiscard]] const EvaluateStats& stats() const { return stats_; }
    [[nodiscard]] const std::vector<FacetName>& incomplete() const { return incomplete_; }
    [[nodiscard]] const Crossings& crossings() const { return arranger_.crossings(); }
    [[nodiscard]] const std::vector<std::uint32_t>& seen() const { return arranger_.seen(); }
    [[nodiscard]] const CoveredCells& covered() const { return covered_; }
    [[nodiscard]] StackArena& arena() { return arena_; }

private:
    using Children = CellChildren;

    // For ParallelParts: as many as the arena has, or the calling one.
    [[nodiscard]] std::uint32_t threads() const { return shared_.parallel ? 0 : 1; }

    void prune(CellTask& task);
    void drop(CellTask& task);
    template <class IsLeft>
    void note_dropped(const CellTask& task, const IsLeft& is_left);
    void note_all(std::int32_t slot, const CellNode& node);
    [[nodiscard]] std::vector<LeafOperand> list_operands(const CellTask& task);
    CellRef constant(const CellTask& task, bool inside);
    CellRef share(CellTask& task, bool negated);
    CellRef share_list(const CellTask& task, const CellOperand& o, bool negated);
    CellRef resolve(CellTask& task);
    std::optional<CellRef> resolve_across_axes(CellTask& task);
    std::optional<CellRef> resolve_prisms(CellTask& task);
    template <class Arrange>
    std::optional<CellRef> resolve_by(CellTask& task, Arrange arrange);
    CellRef defer(const CellTask& task, PolygonList uncrossed, bool inside, std::size_t crossed);
    CellRef divide(CellTask& task);
    CellRef solve_children(const CellTask& task, const Wall& wall, Children& children);

    std::optional<Wall> wall_of_trees(const CellTask& task) const;
    void refine_large(CellTask& task) const;
    void make_lists(CellTask& task, const std::optional<Wall>& wall);
    void make_leaf(CellOperand& operand, const Cell& cell);
    void make_frame(CellTask& task) const;
    void refine_frame(CellTask& task);
    Children children_of(const CellTask& task, const Wall& wall);

    void flatten(const CellRef& tree, const Cell& cell, std::vector<PolygonRef>& out);

    Shared& shared_;
    const EvaluateOptions& options_;
    EvaluateStats stats_;
    SlotValues values_;
    std::vector<std::uint8_t> used_;
    LeafArranger arranger_;
    CoveredCells covered_;
    std::vector<FacetName> incomplete_;
    Workbench bench_;
    StackArena arena_;
    std::vector<PolygonRef> polygons_;                   // of leaves
    std::vector<std::uint32_t> facets_;                  // of a leaf that is deferred
    std::vector<std::shared_ptr<const CellNode>> made_;  // leaves that name flattened lists
};

Worker& Shared::worker() {
    auto& w = workers.local();
    if (!w) w = std::make_unique<Worker>(*this);
    return *w;
}

CellRef child_of(const CellNode& node, bool complemented, std::size_t i) {
    CellRef c = node.child(static_cast<int>(i));
    c.complemented = c.complemented != complemented;
    return c;
}

// --- Steps 1 and 2: prune, share.

void Worker::prune(CellTask& task) {
    bool any = false;
    for (const CellOperand& o : task.operands) {
        if (o.size() != 0) continue;
        values_[static_cast<std::size_t>(o.slot)] = is_inside(o.winding, options_.winding) ? 1 : 0;
        any = true;
    }
    if (any) drop(task);
    // What is left may cover itself.
    if (task.operands.size() > 2 && find_covered(task, values_, incomplete_)) drop(task);
}

// Takes operands with a value out of the formula, and those that it then does not name.
void Worker::drop(CellTask& task) {
    task.formula = simplified(task.formula, values_);
    for (const CellOperand& o : task.operands) values_[static_cast<std::size_t>(o.slot)] = -1;
    used_.assign(values_.size(), 0);
    for_each_slot(*task.formula, [&](std::int32_t s) { used_[static_cast<std::size_t>(s)] = 1; });
    const auto is_left = [&](const CellOperand& o) {
        return used_[static_cast<std::size_t>(o.slot)] != 0;
    };
    if (shared_.crossings != nullptr) note_dropped(task, is_left);
    const auto end = std::remove_if(task.operands.begin(), task.operands.end(),
                                    [&](const CellOperand& o) { return !is_left(o); });
    task.operands = {task.operands.data(), static_cast<std::size_t>(end - task.operands.begin())};
}

// What is dropped with its polygons is not compared in this cell.
template <class IsLeft>
void Worker::note_dropped(const CellTask& task, const IsLeft& is_left) {
    std::size_t listed = 0;
    std::size_t dropped = 0;
    bool lists = true;
    for (const CellOperand& o : task.operands) {
        if (o.size() == 0) continue;
        ++listed;
        if (!is_left(o)) ++dropped;
        lists = lists && o.is_list;
    }
    if (dropped == 0 || listed < 2) return;
    if (lists && task.formula->kind == Residual::Kind::Constant) {
        covered_.add(task);
        return;
    }
    for (const CellOperand& o : task.operands) {
        if (o.is_list) {
            for (const PackedBox& e : o.list())
                arranger_.note_doubtful(o.slot, o.polygon(e.id).facet);
        } else {
            note_all(o.slot, *o.node);
        }
    }
}

// All facets that the leaves below a node list.
void Worker::note_all(std::int32_t slot, const CellNode& node) {
    if (node.is_leaf()) {
        for (const PolygonRef& r : node.polygons()) arranger_.note_doubtful(slot, r.facet);
        return;
    }
    for (int i = 0; i < 2; ++i) with_enough_stack([&] { note_all(slot, *node.child(i).node); });
}

CellRef Worker::constant(const CellTask& task, bool inside) {
    ++stats_.constant_cells;
    return {CellNode::leaf(PolygonList(), task.reference, inside ? 1 : 0, false), false};
}

// One operand is left and the formula is that operand or its complement.
CellRef Worker::share(CellTask& task, bool negated) {
    const CellOperand& o = task.operands[0];
    ++stats_.shared_cells;
    if (!o.is_list) return {o.node->shared_from_this(), o.complemented != negated};
    return share_list(task, o, negated);
}

// Listed are the polygons whose boxes meet the cell. Of a list without one that certainly lies in
// the cell those that do not meet it are taken out: a leaf that lists polygons must not be
// homogeneous only because nobody looked.
CellRef Worker::share_list(const CellTask& task, const CellOperand& o, bool negated) {
    const PolygonList& names = o.node->polygons();
    const bool flip = o.complemented != negated;
    const int winding = complemented_winding(o.winding, negated);
    const PackedBox within = [&] {
        PackedBox b = packed_cell(task.frame, task.cell);
        // Rounding outwards at walls of other frames: one position farther in is certain.
        for (std::size_t k = 0; k < 3; ++k) {
            if (!task.frame.first_above(k, task.cell.lo[k] >> wall_bits) &&
                b.low(k) > -packed_limit)
                ++b.lo[k];
            if (!task.frame.first_above(k, task.cell.hi[k] >> wall_bits) &&
                b.high(k) < packed_limit)
                ++b.minus_hi[k];
        }
        return b;
    }();
    const auto mark = arena_.mark();
    auto* ids = arena_.take<std::uint32_t>(o.count);
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
        count = static_cast<std::size_t>(
            std::remove_if(
                ids, ids + o.count,
                [&](std::uint32_t id) { return !meets_cell(bench_, o.polygon(id), task.cell); }) -
            ids);
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
    arena_.release(mark);
    shared_.memory.keep(list.bytes());
    return {CellNode::leaf(std::move(list), task.reference, winding, o.node->is_mixed()), false};
}

// --- Step 3: few polygons.

CellRef Worker::resolve(CellTask& task) {
    return *resolve_by(task, [&](const LeafProblem& p) -> std::optional<LeafResult> {
        return arranger_.arrange(p, values_, stats_);
    });
}

// Where everything is across an axis, leaves may be larger.
std::optional<CellRef> Worker::resolve_across_axes(CellTask& task) {
    const auto is_across_axis = [](const CellOperand& o) {
        if (!o.is_list && (!o.node->is_leaf() || o.node->polygons().empty())) return false;
        AxisPolygon first;
        return first.read(o.is_list ? o.polygon(o.list()[0].id) : o.node->polygons()[0]);
    };
    if (!std::ranges::all_of(task.operands, is_across_axis)) return std::nullopt;
    return resolve_by(
        task, [&](const LeafProblem& p) { return arranger_.arrange_across_axes(p, stats_); });
}

// Where operands are prisms along one axis: then a facet is across that axis or a right triangle
// along it.
std::optional<CellRef> Worker::resolve_prisms(CellTask& task) {
    if (task.operands.size() < 2) return std::nullopt;
    const auto may_be_prism = [&](const CellOperand& o) {
        if (!o.embedded || (!o.is_list && (!o.node->is_leaf() || o.node->polygons().empty())))
            return false;
        const PolygonRef first = o.is_list ? o.polygon(o.list()[0].id) : o.node->polygons()[0];
        return PrismFacets::may_be_of_prism(first) && task.cell.contains(first.box());
    };
    if (!std::ranges::all_of(task.operands, may_be_prism)) return std::nullopt;
    return resolve_by(task,
                      [&](const LeafProblem& p) { return arranger_.arrange_prisms(p, stats_); });
}

// Operands that are lists, with their polygons.
std::vector<LeafOperand> Worker::list_operands(const CellTask& task) {
    polygons_.clear();
    for (const CellOperand& o : task.operands)
        for (const PackedBox& e : o.list()) polygons_.push_back(o.polygon(e.id));
    std::vector<LeafOperand> operands;
    operands.reserve(task.operands.size());
    std::size_t first = 0;
    for (const CellOperand& o : task.operands) {
        operands.push_back({o.slot, std::span(polygons_).subspan(first, o.count), o.complemented,
                            o.embedded, o.winding});
        first += o.count;
    }
    return operands;
}

template <class Arrange>
std::optional<CellRef> Worker::resolve_by(CellTask& task, Arrange arrange) {
    make_lists(task, std::nullopt);
    const std::vector<LeafOperand> operands = list_operands(task);
    for (const CellOperand& o : task.operands)
        values_[static_cast<std::size_t>(o.slot)] = is_inside(o.winding, options_.winding) ? 1 : 0;
    const bool inside = value_of(*task.formula, values_);
    const LeafProblem problem{task.cell, task.reference, operands, task.formula.get(), &options_};
    std::optional<LeafResult> kept = arrange(problem);
    for (const CellOperand& o : task.operands) values_[static_cast<std::size_t>(o.slot)] = -1;
    if (!kept) return std::nullopt;
    const std::uint64_t bytes = bytes_of_result(kept->polygons);
    // Keeps fragments, whatever is thrown from here on.
    PolygonList list(std::move(kept->polygons));
    incomplete_.insert(incomplete_.end(), kept->incomplete.begin(), kept->incomplete.end());
    shared_.memory.keep(bytes);
    if (kept->deferred != 0) return defer(task, std::move(list), inside, kept->deferred);
    return CellRef{CellNode::leaf(std::move(list), task.reference, inside ? 1 : 0, true), false};
}

// A leaf whose `crossed` facets are cut when someone needs it.
CellRef Worker::defer(const CellTask& task, PolygonList uncrossed, bool inside,
                      std::size_t crossed) {
    auto leaf = std::make_unique<DeferredLeaf>();
    leaf->cell = task.cell;
    leaf->reference = task.reference;
    leaf->formula = task.formula;
    leaf->rule = options_.winding;
    const std::uint64_t size = uncrossed.size() + crossed;
    leaf->uncrossed = std::move(uncrossed);
    for (const CellOperand& o : task.operands) {
        DeferredLeaf::Operand& listed = leaf->operands.emplace_back();
        listed.slot = o.slot;
        listed.flipped = o.complemented;
        listed.winding = o.winding;
        if (o.count == 0) continue;
        // Of an imported mesh, refined or not: one source, no facet turned over.
        const PolygonRef first = o.polygon(o.list()[0].id);
        facets_.clear();
        for (const PackedBox& e : o.list()) facets_.push_back(o.polygon(e.id).facet);
        listed.polygons = PolygonList::whole_facets(*first.source, first.flipped, facets_, 0);
        shared_.memory.keep(facets_.size() * sizeof(std::uint32_t));
    }
    return {CellNode::deferred(std::move(leaf), inside ? 1 : 0, size), false};
}

// Lists the polygons below a node. A polygon that also reaches into other leaves may be missing
// there, so it is clipped to the leaf that lists it.
void Worker::flatten(const CellRef& tree, const Cell& cell, std::vector<PolygonRef>& out) {
    const CellNode& node = *tree.node;
    if (!node.is_leaf()) {
        for (std::size_t i = 0; i < 2; ++i)
            with_enough_stack([&] {
                flatten(child_of(node, tree.complemented, i),
                        i == 0 ? cell.below(node.axis(), node.wall())
                               : cell.above(node.axis(), node.wall()),
                        out);
            });
        return;
    }
    for (const PolygonRef& r : node.polygons()) {
        make_room(out);
        auto part = clip_to_cell(bench_, r, cell);
        if (!part) continue;
        part->flipped = part->flipped != tree.complemented;
        out.push_back(*part);
    }
}

// Makes a leaf of an operand's subtree.
void Worker::make_leaf(CellOperand& operand, const Cell& cell) {
    if (operand.is_list || operand.node->is_leaf()) return;
    std::vector<PolygonRef> parts;
    bench_.clear();
    try {
        flatten({operand.node->shared_from_this(), operand.complemented}, cell, parts);
    } catch (...) {
        end_fragments(parts);
        throw;
    }
    made_.push_back(CellNode::leaf(PolygonList(std::move(parts)), {}, 0, true));
    operand.node = made_.back().get();
    operand.complemented = false;
}

// A frame for all lists and leaves of a task.
void Worker::make_frame(CellTask& task) const {
    Box all;
    for (const CellOperand& o : task.operands) {
        if (!o.is_list && !o.node->is_leaf()) continue;
        const bool unbounded = o.size() == 1 && o.node->polygons().size() == 1 &&
                               o.node->polygons()[0].source->is_half_space();
        const Box b = exact_box(o, task.cell);
        if (!unbounded && !b.is_empty()) all.add(b);
    }
    task.has_frame = true;
    if (!all.is_empty()) task.frame = Frame::covering(all);
}

bool has_wall(const CellOperand& o, const std::optional<Wall>& wall) {
    return wall && !o.is_list && !o.node->is_leaf() && o.node->axis() == wall->axis &&
           o.node->wall() == wall->position;
}

// Makes lists of all operands, except trees that have the wall. When nothing but lists is left, the
// frame is made anew: the one so far may belong to one operand and be narrow.
void Worker::make_lists(CellTask& task, const std::optional<Wall>& wall) {
    bool opened = false;
    for (CellOperand& o : task.operands) {
        if (o.is_list || has_wall(o, wall)) continue;
        make_leaf(o, task.cell);
        opened = true;
    }
    if (!opened) return;
    const bool anew = task.has_frame && !wall;
    if (anew || !task.has_frame) make_frame(task);
    for (CellOperand& o : task.operands) {
        if (has_wall(o, wall)) continue;
        if (!o.is_list) {
            open_leaf(o, task, arena_, threads());
        } else if (anew) {
            reframe(o, task, arena_);
        }
    }
}

// --- Step 4: divide.

std::optional<Wall> Worker::wall_of_trees(const CellTask& task) const {
    const CellOperand* largest = nullptr;
    for (const CellOperand& o : task.operands)
        if (!o.is_list && !o.node->is_leaf() && (largest == nullptr || o.size() > largest->size()))
            largest = &o;
    if (largest == nullptr) return std::nullopt;
    return Wall{largest->node->axis(), largest->node->wall()};
}

// A leaf of a solid that outnumbers everything else in the cell is refined for good.
void Worker::refine_large(CellTask& task) const {
    const std::uint64_t total = task.size();
    for (CellOperand& o : task.operands) {
        if (o.is_list || !o.node->is_leaf()) continue;
        const std::uint64_t n = o.size();
        if (o.node->refinement() == nullptr && (n < refinable_leaf || n < 4 * (total - n)))
            continue;
        if (const CellNode* node = refined(*o.node, task.cell)) o.node = node;
    }
}

// What still has to be parted is small in the frame: make a finer one.
void Worker::refine_frame(CellTask& task) {
    if (task.frame.shift == 0 || contested_extent(task) >= coarse_extent) return;
    Box all;
    for (const CellOperand& o : task.operands) {
        if (o.unbounded || o.count == 0) continue;
        const Box b = exact_box(o, task.cell);
        if (!b.is_empty()) all.add(b);
    }
    if (all.is_empty()) return;
    const Frame finer = Frame::covering(all);
    if (finer.shift >= task.frame.shift) return;
    task.frame = finer;
    for (CellOperand& o : task.operands) reframe(o, task, arena_);
}

// Both children of a cell. Their lists are in the arena.
Worker::Children Worker::children_of(const CellTask& task, const Wall& wall) {
    Children out;
    for (std::size_t i = 0; i < 2; ++i) {
        CellTask& c = out[i];
        c.cell = i == 0 ? task.cell.below(wall.axis, wall.position)
                        : task.cell.above(wall.axis, wall.position);
        c.frame = task.frame;
        c.has_frame = task.has_frame;
        c.formula = task.formula;
        c.depth = task.depth + 1;
        c.operands = {arena_.take<CellOperand>(task.operands.size()), task.operands.size()};
    }
    const std::array<Cell, 2> cells{out[0].cell, out[1].cell};
    for (std::size_t n = 0; n < task.operands.size(); ++n) {
        const CellOperand& o = task.operands[n];
        for (std::size_t i = 0; i < 2; ++i) {
            CellOperand& c = *::new (&out[i].operands[n]) CellOperand(o);
            if (o.is_list) continue;
            const CellRef& child = o.node->child(static_cast<int>(i));
            c.node = unfolded(child.node.get());
            c.complemented = child.complemented != o.complemented;
        }
    }
    partition(task, wall, cells, arena_, threads(), {out[0].operands, out[1].operands});
    for (int i = 0; i < 2; ++i)
        TRISECT_EXPECTS(place_reference(task, wall, i, out), "no reference point found in a cell");
    return out;
}

CellRef Worker::divide(CellTask& task) {
    refine_large(task);
    std::optional<Wall> wall = wall_of_trees(task);
    make_lists(task, wall);
    if (!wall) {
        refine_frame(task);
        const bool too_deep = task.stalled >= (task.size() > 400 ? 12 : 3) || task.depth > 400;
        if (!too_deep) wall = choose_wall(task, options_.wall_offset);
    }
    if (!wall) return resolve(task);
    Children children = children_of(task, *wall);
    // Pairs are what a leaf costs. A wall that leaves most of them on its sides was not worth it,
    // and after a few such walls none will be: long thin facets cross all of them. Where many
    // facets meet in a corner, though, walls around the corner cut off small cells at little cost.
    const auto total = static_cast<double>(task.size());
    const auto first = static_cast<double>(children[0].size());
    const auto second = static_cast<double>(children[1].size());
    const double pairs = first * first + second * second;
    const bool worth_it = pairs < (total < 4000 ? 0.8 : 1.6) * total * total;
    // Walls that make more pairs than there were never pay: a pair costs a few nanoseconds.
    const bool makes_pairs = pairs > 1.05 * total * total;
    const int price = makes_pairs ? 12 : (std::min(first, second) > 0.5 * total ? 4 : 1);
    for (CellTask& c : children) c.stalled = worth_it ? 0 : task.stalled + price;
    return solve_children(task, *wall, children);
}

bool is_homogeneous(const CellRef& r) { return r.node->is_leaf() && r.node->size() == 0; }

int value_at_reference(const CellRef& r) {
    return complemented_winding(r.node->winding(), r.complemented);
}

CellRef Worker::solve_children(const CellTask& task, const Wall& wall, Children& children) {
    std::uint64_t listed = 0;
    for (const CellTask& c : children)
        for (const CellOperand& o : c.operands)
            if (o.is_list) listed += o.count;
    const auto held = shared_.memory.hold(listed * sizeof(PackedBox));
    std::array<CellRef, 2> results;
    if (shared_.parallel && std::min(children[0].size(), children[1].size()) >= parallel_size) {
        tbb::task_group group;
        Handover start;
        Handover result;
        start.give();
        group.run([&] {
            start.take();
            results[1] = shared_.worker().solve(children[1]);
            result.give();
        });
        std::exception_ptr failure;
        try {
            results[0] = deep_solve(children[0]);
        } catch (...) {
            failure = std::current_exception();
            group.cancel();
        }
        group.wait();
        result.take();
        if (failure) std::rethrow_exception(failure);
    } else {
        for (std::size_t i = 0; i < 2; ++i) results[i] = deep_solve(children[i]);
    }
    // A subtree that comes back unchanged is shared as a whole.
    for (const CellOperand& o : task.operands) {
        if (o.is_list || o.node->is_leaf()) continue;
        for (const bool complemented : {false, true}) {
            bool same = true;
            for (std::size_t i = 0; i < 2; ++i) {
                const CellRef& c = o.node->child(static_cast<int>(i));
                same = same && results[i].node == c.node &&
                       results[i].complemented == (c.complemented != complemented);
            }
            if (same) return {o.node->shared_from_this(), complemented};
        }
        break;
    }
    if (is_homogeneous(results[0]) && is_homogeneous(results[1]) &&
        value_at_reference(results[0]) == value_at_reference(results[1]))
        return {
            CellNode::leaf(PolygonList(), task.reference, value_at_reference(results[0]), false),
            false};
    return {CellNode::split(wall.axis, wall.position, std::move(results[0]), std::move(results[1])),
            false};
}

// With one unknown the formula is that unknown, its complement, or constant.
struct OfOne {
    bool at_outside;
    bool at_inside;
};

OfOne of_one(const Residual& formula, std::int32_t slot, SlotValues& values) {
    auto& v = values[static_cast<std::size_t>(slot)];
    v = 0;
    const bool at_outside = value_of(formula, values);
    v = 1;
    const bool at_inside = value_of(formula, values);
    v = -1;
    return {at_outside, at_inside};
}

CellRef Worker::solve(CellTask& task) {
    const auto mark = arena_.mark();
    struct Release {
        StackArena& arena;
        StackArena::Mark mark;
        ~Release() { arena.release(mark); }
    } release{arena_, mark};
    ++stats_.cells;
    check_budget(options_, stats_);
    stats_.depth = std::max(stats_.depth, task.depth);
    prune(task);
    if (task.formula->kind == Residual::Kind::Constant) return constant(task, task.formula->value);
    if (task.operands.size() == 1) {
        const OfOne f = of_one(*task.formula, task.operands[0].slot, values_);
        if (f.at_outside == f.at_inside) return constant(task, f.at_inside);
        if (task.operands[0].embedded) return share(task, f.at_outside);
    }
    const std::uint64_t total = task.size();
    for (const CellOperand& o : task.operands)
        if (o.is_list || o.node->is_leaf()) stats_.listed_polygons += o.size();
    if (total <= options_.leaf_polygons) return resolve(task);
    if (total <= axis_leaf_factor * options_.leaf_polygons)
        if (auto leaf = resolve_across_axes(task)) return *std::move(leaf);
    if (total <= prism_leaf_factor * options_.leaf_polygons)
        if (auto leaf = resolve_prisms(task)) return *std::move(leaf);
    return divide(task);
}

// A point outside the boxes of all leaves, three units beyond their common corner; or, when there
// is a tree, any point that it knows.
FinePoint outer_reference(std::span<const std::shared_ptr<const SolidState>> states) {
    Box all;
    for (const auto& s : states) {
        const CellNode* n = s->root.node.get();
        if (!n->is_leaf()) {
            while (!n->is_leaf()) n = n->child(0).node.get();
            return n->reference();
        }
        const PolygonList& polygons = n->polygons();
        const Source* whole = polygons.has_all_facets() ? polygons.whole_source() : nullptr;
        if (whole != nullptr && !whole->is_half_space()) {
            if (!whole->box().is_empty()) all.add(whole->box());
            continue;
        }
        for (const PolygonRef& r : polygons)
            if (r.fragment != nullptr || !r.source->is_half_space()) all.add(r.box());
    }
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k)
        p.c[k] = all.is_empty() ? 0 : (all.lo[k] - 3) * wall_scale + 2 * static_cast<int>(k) + 12;
    return p;
}

bool passes_by(const Box& box, const FinePoint& a, const FinePoint& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::max(a.c[k], b.c[k]) < box.lo[k] * wall_scale ||
            std::min(a.c[k], b.c[k]) > box.hi[k] * wall_scale)
            return true;
    return false;
}

// Winding number of a root at a point: at once where the way there is free.
std::optional<int> winding_of_root(const SolidState& state, const FinePoint& p) {
    const CellNode& n = *state.root.node;
    const Source* whole =
        n.is_leaf() && n.polygons().has_all_facets() ? n.polygons().whole_source() : nullptr;
    if (whole != nullptr && passes_by(whole->box(), n.reference(), p))
        return complemented_winding(n.winding(), state.root.complemented);
    return winding_in_tree(n, state.root.complemented, Cell{}, p);
}

bool place_root(std::span<const std::shared_ptr<const SolidState>> states, CellTask& task) {
    for (std::size_t i = 0; i < states.size(); ++i) {
        const auto w = winding_of_root(*states[i], task.reference);
        if (!w) return false;
        CellOperand o;
        o.slot = static_cast<std::int32_t>(i);
        o.winding = *w;
        o.embedded = states[i]->embedded;
        o.complemented = states[i]->root.complemented;
        o.node = unfolded(states[i]->root.node.get());
        ::new (&task.operands[i]) CellOperand(o);
    }
    return true;
}

CellRef solve_root(Shared& shared, const Residual::Ref& formula,
                   std::span<const std::shared_ptr<const SolidState>> states) {
    Worker& worker = shared.worker();
    const auto mark = worker.arena().mark();
    CellTask task;
    task.formula = formula;
    task.reference = outer_reference(states);
    task.operands = {worker.arena().take<CellOperand>(states.size()), states.size()};
    bool placed = place_root(states, task);
    for (int attempt = 0; attempt < 100 && !placed; ++attempt) {
        for (std::size_t k = 0; k < 3; ++k)
            task.reference.c[k] -= static_cast<std::int64_t>(
                2 * (mix64(static_cast<std::uint64_t>(attempt) * 3 + k) % 2000));
        placed = place_root(states, task);
    }
    TRISECT_EXPECTS(placed, "no reference point for the operands");
    CellRef root = worker.solve(task);
    worker.arena().release(mark);
    return root;
}

}  // namespace

Evaluation evaluate_formula(const Residual::Ref& formula,
                            std::span<const std::shared_ptr<const SolidState>> solids,
                            const EvaluateOptions& options) {
    std::optional<Crossings> crossings = crossings_of(*formula, solids);
    Shared shared{options,
                  solids.size(),
                  MemoryBudget(options.max_memory),
                  false,
                  crossings ? &*crossings : nullptr,
                  {}};
    std::uint64_t polygons = 0;
    for (const auto& s : solids) polygons += s->root.node->size();
    // A work budget is counted by one thread, so that it is hit in the same place everywhere.
    shared.parallel =
        options.threads != 1 && options.max_work == 0 && polygons >= 2 * parallel_size;
    Evaluation result;
    if (shared.parallel) {
        tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic
                                                   : static_cast<int>(options.threads));
        arena.execute([&] { result.root = solve_root(shared, formula, solids); });
    } else {
        result.root = solve_root(shared, formula, solids);
    }
    if (crossings) {
        for (const auto& worker : shared.workers) crossings->append(worker->crossings());
        CoveredCells covered;
        std::vector<std::uint32_t> seen;
        for (const auto& worker : shared.workers) {
            covered.append(worker->covered());
            seen.insert(seen.end(), worker->seen().begin(), worker->seen().end());
        }
        covered.compare(seen, options, result.stats, *crossings);
        crossings->arrange();
        result.crossings = std::make_shared<const Crossings>(*std::move(crossings));
    }
    for (const auto& worker : shared.workers) {
        const EvaluateStats& s = worker->stats();
        result.stats += s;
        const auto& incomplete = worker->incomplete();
        result.incomplete.insert(result.incomplete.end(), incomplete.begin(), incomplete.end());
    }
    result.stats.memory = shared.memory.peak();
    return result;
}

}  // namespace trisect::detail
