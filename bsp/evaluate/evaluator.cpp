// SPDX-License-Identifier: Apache-2.0
//
// One recursion over (cell, formula) evaluates a whole boolean expression:
//
//   1. operands without boundary in the cell are constant there: replace them by their value;
//   2. nothing left: a homogeneous cell. One operand left: share its subtree or its complement;
//   3. few polygons: a leaf arrangement (leaf_arrangement.cpp) decides which bound the result;
//   4. otherwise cut the cell. Where an operand already has a tree its plane is taken, so that its
//      subtrees can be shared. A large leaf beside small ones is refined by itself, for all
//      its users. Else the splitting plane that separates the operands soonest.
//
// The idea is EMBER's (Trettner, Nehring-Wirxel, Kobbelt 2022); keeping the cells, so that the next
// operation finds them, is Nehring-Wirxel, Trettner, Kobbelt 2021. Two things matter more than
// arithmetic. Splitting planes lie off the lattice, so nothing is listed twice because its box ends
// at a splitting plane. And every cell has a reference point with all winding numbers, so that
// classification never leaves the cell.
//
// Cells are independent, so the two sides of a splitting plane may be solved by two threads.
// Results are put together by their position in the tree and not by their time, and nothing that a
// thread keeps between cells decides anything; so the tree is the same for any number of threads.

#include <trisect/bsp/evaluate/evaluator.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include <tbb/task_arena.h>

#include <trisect/bsp/cells/axis_polygon.h>
#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/deferred_leaf.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/divide/choose_wall.h>
#include <trisect/bsp/divide/operand_lists.h>
#include <trisect/bsp/divide/partition.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/divide/refine_leaf.h>
#include <trisect/bsp/divide/shared_list.h>
#include <trisect/bsp/divide/slab.h>
#include <trisect/bsp/evaluate/arranger_pool.h>
#include <trisect/bsp/evaluate/covered_cells.h>
#include <trisect/bsp/evaluate/leaf_arrangement.h>
#include <trisect/bsp/evaluate/root_task.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/stack_arena.h>
#include <trisect/kernel/support/task_group.h>

namespace trisect::detail {

namespace {

// Cells with fewer polygons are not worth a task of their own.
constexpr std::uint64_t parallel_polygons = 4096;
// Leaves may be so many times as large where all polygons are axis-perpendicular.
constexpr std::uint64_t axis_leaf_factor = 8;
// Or where operands are small: where at least such a part of all their facets is in the cell.
constexpr std::uint64_t small_operands_factor = 8;
constexpr std::uint64_t small_operands_part = 8;

class Worker;

// What the threads of one evaluation share.
struct Shared {
    const EvaluateOptions& options;
    std::size_t slots;
    MemoryBudget memory;
    bool parallel = false;
    const Crossings* crossings = nullptr;  // their operands, if they are collected
    PerThread<Worker> workers = {};
    SharedFailure failure = {};  // of cells that were solved beside each other

    Worker& worker();
};

// Scratch memory and results of one thread. A thread that waits for another one may start a second
// task on the same worker; nothing of the first is in use then but what lies in the arena below.
class Worker {
public:
    explicit Worker(Shared& shared)
        : shared_(shared), options_(shared.options), values_(shared.slots, -1) {
        arranger_->make_pictures();
        if (shared.crossings != nullptr) arranger_->collect_crossings(shared.crossings->operands);
    }

    CellRef solve(CellTask& task);
    CellRef deep_solve(CellTask& task) {
        return with_enough_stack([&] { return solve(task); });
    }
    [[nodiscard]] const EvaluateStats& stats() const { return stats_; }
    [[nodiscard]] const std::vector<FacetName>& incomplete() const { return incomplete_; }
    [[nodiscard]] const Crossings& crossings() const { return arranger_->crossings(); }
    [[nodiscard]] const std::vector<std::uint32_t>& seen() const { return arranger_->seen(); }
    [[nodiscard]] const CoveredCells& covered() const { return covered_; }
    [[nodiscard]] StackArena& arena() { return arena_; }
    /// Last, and only when nothing was thrown.
    void give_back_arranger() noexcept { ArrangerPool::give_back(std::move(arranger_)); }

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
    CellRef resolve(CellTask& task);
    std::optional<CellRef> resolve_across_axes(CellTask& task);
    std::optional<CellRef> resolve_prisms(CellTask& task);
    std::optional<CellRef> resolve_small_operands(CellTask& task);
    template <class Arrange>
    std::optional<CellRef> resolve_by(CellTask& task, Arrange arrange);
    CellRef defer(const CellTask& task, PolygonList uncrossed, bool inside, std::size_t crossed);
    CellRef defer(const CellTask& task, std::unique_ptr<const AxisPicture> picture, bool inside);
    [[nodiscard]] std::unique_ptr<DeferredLeaf> problem_of(const CellTask& task);
    [[nodiscard]] std::optional<Wall> wall_to_peel(const CellTask& task) const;
    CellRef divide(CellTask& task);
    CellRef solve_children(const CellTask& task, const Wall& wall, Children& children);
    Children children_of(const CellTask& task, const Wall& wall);

    Shared& shared_;
    const EvaluateOptions& options_;
    EvaluateStats stats_;
    SlotValues values_;
    std::vector<std::uint8_t> used_;
    std::unique_ptr<LeafArranger> arranger_ = ArrangerPool::take();
    CoveredCells covered_;
    std::vector<FacetName> incomplete_;
    Workbench bench_;
    StackArena arena_;
    OperandLists lists_{arena_, bench_};
    std::vector<PolygonRef> polygons_;   // of leaves
    std::vector<std::uint32_t> facets_;  // of a leaf that is deferred
};

Worker& Shared::worker() {
    return workers.local([&] { return std::make_unique<Worker>(*this); });
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
    // What is left may overlap itself.
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
                arranger_->note_doubtful(o.slot, o.polygon(e.id).facet);
        } else {
            note_all(o.slot, *o.node);
        }
    }
}

// All facets that the leaves below a node list.
void Worker::note_all(std::int32_t slot, const CellNode& node) {
    if (node.is_leaf()) {
        for (const PolygonRef& r : node.polygons()) arranger_->note_doubtful(slot, r.facet);
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
    PolygonList list = shared_list(task, o, negated, bench_, arena_);
    shared_.memory.keep(list.bytes());
    return {CellNode::leaf(std::move(list), task.reference,
                           complemented_winding(o.winding, negated), o.node->is_mixed()),
            false};
}

// --- Step 3: few polygons.

CellRef Worker::resolve(CellTask& task) {
    return *resolve_by(task, [&](const LeafProblem& p) -> std::optional<LeafResult> {
        return arranger_->arrange(p, values_, stats_);
    });
}

// Whether the first and the last polygon of a list or a leaf pass a test: facets of one plane often
// stand together, so the first one alone says little about the others.
template <class Test>
bool ends_pass(const CellOperand& o, const Test& test) {
    if (o.is_list) {
        const auto list = o.list();
        return test(o.polygon(list.front().id)) && test(o.polygon(list.back().id));
    }
    if (!o.node->is_leaf() || o.node->polygons().empty()) return false;
    const PolygonList& polygons = o.node->polygons();
    return test(polygons[0]) && test(polygons[polygons.size() - 1]);
}

// Where everything is axis-perpendicular, leaves may be larger.
std::optional<CellRef> Worker::resolve_across_axes(CellTask& task) {
    const auto is_across_axis = [](const CellOperand& o) {
        return ends_pass(o, [](const PolygonRef& r) { return AxisPolygon().read(r); });
    };
    if (!std::ranges::all_of(task.operands, is_across_axis)) return std::nullopt;
    return resolve_by(
        task, [&](const LeafProblem& p) { return arranger_->arrange_across_axes(p, stats_); });
}

// Where operands are prisms along one axis: then a facet is perpendicular to that axis or a right
// triangle along it.
std::optional<CellRef> Worker::resolve_prisms(CellTask& task) {
    if (task.operands.size() < 2) return std::nullopt;
    const auto may_be_prism = [&](const CellOperand& o) {
        return o.embedded && ends_pass(o, [&](const PolygonRef& r) {
                   return PrismFacets::may_be_of_prism(r) && task.cell.contains(r.box());
               });
    };
    if (!std::ranges::all_of(task.operands, may_be_prism)) return std::nullopt;
    return resolve_by(task,
                      [&](const LeafProblem& p) { return arranger_->arrange_prisms(p, stats_); });
}

// A splitting plane pays where an operand is all on one side of it, and most where it contains the
// other side. Small operands contain little, and splitting planes cut most of their facets, so that
// these are listed and compared again and again.
std::optional<CellRef> Worker::resolve_small_operands(CellTask& task) {
    if (shared_.crossings == nullptr || task.operands.size() < 3) return std::nullopt;
    std::uint64_t all = 0;
    for (const CellOperand& o : task.operands) {
        if (!o.is_list && !o.node->is_leaf()) return std::nullopt;
        all += o.node->size();
    }
    if (small_operands_part * task.size() < all) return std::nullopt;
    return resolve_by(task,
                      [&](const LeafProblem& p) { return arranger_->arrange_plain(p, stats_); });
}

// Of a list or a leaf.
template <class Visit>
void for_each_polygon(const CellOperand& o, const Visit& visit) {
    if (o.is_list) {
        for (const PackedBox& e : o.list()) visit(o.polygon(e.id));
    } else {
        for (const PolygonRef& r : o.node->polygons()) visit(r);
    }
}

// Operands that are lists or leaves, with their polygons.
std::vector<LeafOperand> Worker::list_operands(const CellTask& task) {
    polygons_.clear();
    std::vector<std::size_t> ends;
    ends.reserve(task.operands.size());
    for (const CellOperand& o : task.operands) {
        for_each_polygon(o, [&](const PolygonRef& r) { polygons_.push_back(r); });
        ends.push_back(polygons_.size());
    }
    std::vector<LeafOperand> operands;
    operands.reserve(task.operands.size());
    for (std::size_t i = 0, first = 0; i < ends.size(); first = ends[i++]) {
        const CellOperand& o = task.operands[i];
        operands.push_back({o.slot, std::span(polygons_).subspan(first, ends[i] - first),
                            o.complemented, o.embedded, o.winding});
    }
    return operands;
}

template <class Arrange>
std::optional<CellRef> Worker::resolve_by(CellTask& task, Arrange arrange) {
    lists_.make_leaves(task);
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
    if (kept->picture != nullptr) return defer(task, std::move(kept->picture), inside);
    if (kept->deferred != 0) return defer(task, std::move(list), inside, kept->deferred);
    return CellRef{CellNode::leaf(std::move(list), task.reference, inside ? 1 : 0, true), false};
}

// A leaf whose `crossed` facets are cut when someone needs it.
CellRef Worker::defer(const CellTask& task, PolygonList uncrossed, bool inside,
                      std::size_t crossed) {
    auto leaf = problem_of(task);
    const std::uint64_t size = uncrossed.size() + crossed;
    leaf->uncrossed = std::move(uncrossed);
    return {CellNode::deferred(std::move(leaf), inside ? 1 : 0, size), false};
}

CellRef Worker::defer(const CellTask& task, std::unique_ptr<const AxisPicture> picture,
                      bool inside) {
    auto leaf = problem_of(task);
    shared_.memory.keep(picture->bytes());
    const std::uint64_t size = picture->facets.size();
    leaf->picture = std::move(picture);
    return {CellNode::deferred(std::move(leaf), inside ? 1 : 0, size), false};
}

// Operands are imported meshes, refined or not, or look like that here: of one source, no facet
// turned over.
std::unique_ptr<DeferredLeaf> Worker::problem_of(const CellTask& task) {
    auto leaf = std::make_unique<DeferredLeaf>();
    leaf->cell = task.cell;
    leaf->reference = task.reference;
    leaf->formula = task.formula;
    leaf->rule = options_.winding;
    leaf->operands.reserve(task.operands.size());
    for (const CellOperand& o : task.operands) {
        DeferredLeaf::Operand& listed = leaf->operands.emplace_back();
        listed.slot = o.slot;
        listed.flipped = o.complemented;
        listed.winding = o.winding;
        PolygonRef any;
        facets_.clear();
        for_each_polygon(o, [&](const PolygonRef& r) {
            any = r;
            facets_.push_back(r.facet);
        });
        if (facets_.empty()) continue;
        listed.polygons = PolygonList::whole_facets(*any.source, any.flipped, facets_, 0);
        shared_.memory.keep(facets_.size() * sizeof(std::uint32_t));
    }
    return leaf;
}

// --- Step 4: divide.

std::optional<Wall> wall_of_trees(const CellTask& task) {
    const CellOperand* largest = nullptr;
    for (const CellOperand& o : task.operands)
        if (!o.is_list && !o.node->is_leaf() && (largest == nullptr || o.size() > largest->size()))
            largest = &o;
    if (largest == nullptr) return std::nullopt;
    return Wall{largest->node->axis(), largest->node->wall()};
}

// A leaf of a solid that outnumbers everything else in the cell is refined for good.
void refine_large(CellTask& task) {
    const std::uint64_t total = task.size();
    for (CellOperand& o : task.operands) {
        if (o.is_list || !o.node->is_leaf()) continue;
        const std::uint64_t n = o.size();
        if (o.node->refinement() == nullptr && (n < refinable_leaf || n < 4 * (total - n)))
            continue;
        if (const CellNode* node = refined(*o.node, task.cell)) o.node = node;
    }
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

// A leaf looks at each of its polygons for some hundred instructions more than a list that is
// shared does. So what one operand has beside the other one is cut off where that is enough to pay
// for two cells more. Not in chains, where every later step meets those cells again.
std::optional<Wall> Worker::wall_to_peel(const CellTask& task) const {
    constexpr std::size_t least = 16;
    if (shared_.crossings == nullptr) return std::nullopt;
    if (task.operands.size() != 2 || task.size() < least || task.stalled != 0) return std::nullopt;
    if (!std::ranges::all_of(task.operands, &CellOperand::is_list)) return std::nullopt;
    return peeling_wall(task, least, options_.wall_offset);
}

CellRef Worker::divide(CellTask& task) {
    refine_large(task);
    std::optional<Wall> wall = wall_of_trees(task);
    lists_.make(task, wall, threads());
    if (!wall) {
        lists_.refine_frame(task);
        const bool too_deep = task.stalled >= (task.size() > 400 ? 12 : 3) || task.depth > 400;
        if (!too_deep) wall = choose_wall(task, options_.wall_offset);
    }
    if (!wall) return resolve(task);
    Children children = children_of(task, *wall);
    // Pairs are what a leaf costs. A splitting plane that leaves most of them on its sides was not
    // worth it, and after a few such splitting planes none will be: long thin facets cross all of
    // them. Where many facets meet in a corner, though, splitting planes around the corner cut off
    // small cells at little cost.
    const auto total = static_cast<double>(task.size());
    const auto first = static_cast<double>(children[0].size());
    const auto second = static_cast<double>(children[1].size());
    const double pairs = first * first + second * second;
    const bool worth_it = pairs < (total < 4000 ? 0.8 : 1.6) * total * total;
    // Splitting planes that make more pairs than there were never pay: a pair costs a few
    // nanoseconds.
    const bool makes_pairs = pairs > 1.05 * total * total;
    const int price = makes_pairs ? 12 : (std::min(first, second) > 0.5 * total ? 4 : 1);
    for (CellTask& c : children) c.stalled = worth_it ? 0 : task.stalled + price;
    return solve_children(task, *wall, children);
}

bool is_homogeneous(const CellRef& r) { return r.node->is_leaf() && r.node->size() == 0; }

int value_at_reference(const CellRef& r) {
    return complemented_winding(r.node->winding(), r.complemented);
}

// A subtree that comes back unchanged is shared as a whole.
std::optional<CellRef> unchanged(const CellTask& task, const std::array<CellRef, 2>& results) {
    for (const CellOperand& o : task.operands) {
        if (o.is_list || o.node->is_leaf()) continue;
        for (const bool complemented : {false, true}) {
            bool same = true;
            for (std::size_t i = 0; i < 2; ++i) {
                const CellRef& c = o.node->child(static_cast<int>(i));
                same = same && results[i].node == c.node &&
                       results[i].complemented == (c.complemented != complemented);
            }
            if (same) return CellRef{o.node->shared_from_this(), complemented};
        }
        break;
    }
    return std::nullopt;
}

// What a cell is, when the two sides of its splitting plane are known.
CellRef merged(const CellTask& task, const Wall& wall, std::array<CellRef, 2> results) {
    if (auto node = unchanged(task, results)) return *std::move(node);
    if (is_homogeneous(results[0]) && is_homogeneous(results[1]) &&
        value_at_reference(results[0]) == value_at_reference(results[1]))
        return {
            CellNode::leaf(PolygonList(), task.reference, value_at_reference(results[0]), false),
            false};
    return {CellNode::split(wall.axis, wall.position, std::move(results[0]), std::move(results[1])),
            false};
}

CellRef Worker::solve_children(const CellTask& task, const Wall& wall, Children& children) {
    std::uint64_t listed = 0;
    for (const CellTask& c : children)
        for (const CellOperand& o : c.operands)
            if (o.is_list) listed += o.count;
    const auto held = shared_.memory.hold(listed * sizeof(PackedBox));
    std::array<CellRef, 2> results;
    if (shared_.parallel && std::min(children[0].size(), children[1].size()) >= parallel_polygons) {
        SharedFailure& failure = shared_.failure;
        fork_join([&] { failure.guard([&] { results[1] = shared_.worker().solve(children[1]); }); },
                  [&] { failure.guard([&] { results[0] = deep_solve(children[0]); }); });
        failure.check();
    } else {
        for (std::size_t i = 0; i < 2; ++i) results[i] = deep_solve(children[i]);
    }
    return merged(task, wall, std::move(results));
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
    shared_.failure.check();
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
    if (total <= options_.leaf_polygons) {
        if (const auto wall = wall_to_peel(task)) {
            Children children = children_of(task, *wall);
            return solve_children(task, *wall, children);
        }
        return resolve(task);
    }
    if (total <= axis_leaf_factor * options_.leaf_polygons)
        if (auto leaf = resolve_across_axes(task)) return *std::move(leaf);
    if (total <= prism_leaf_factor * options_.leaf_polygons)
        if (auto leaf = resolve_prisms(task)) return *std::move(leaf);
    if (total <= small_operands_factor * options_.leaf_polygons)
        if (auto leaf = resolve_small_operands(task)) return *std::move(leaf);
    return divide(task);
}

CellRef solve_root(Shared& shared, const Residual::Ref& formula,
                   std::span<const std::shared_ptr<const SolidState>> states) {
    Worker& worker = shared.worker();
    const auto mark = worker.arena().mark();
    CellTask task = root_task(formula, states, worker.arena());
    CellRef root = worker.solve(task);
    worker.arena().release(mark);
    return root;
}

}  // namespace

Evaluation evaluate_formula(const Residual::Ref& formula,
                            std::span<const std::shared_ptr<const SolidState>> solids,
                            const EvaluateOptions& options) {
    std::optional<Crossings> crossings = crossings_of(*formula, solids);
    Shared shared{options, solids.size(), MemoryBudget(options.max_memory), false,
                  crossings ? &*crossings : nullptr};
    std::uint64_t polygons = 0;
    for (const auto& s : solids) polygons += s->root.node->size();
    // A work budget is counted by one thread, so that it is hit in the same place everywhere.
    shared.parallel =
        options.threads != 1 && options.max_work == 0 && polygons >= 2 * parallel_polygons;
    Evaluation result;
    if (shared.parallel) {
        tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic
                                                   : static_cast<int>(options.threads));
        try {
            arena.execute([&] { result.root = solve_root(shared, formula, solids); });
        } catch (const Abandoned&) {
            shared.failure.rethrow();
        }
    } else {
        result.root = solve_root(shared, formula, solids);
    }
    if (crossings) {
        CoveredCells covered;
        std::vector<std::uint32_t> seen;
        shared.workers.for_each([&](const Worker& worker) {
            crossings->append(worker.crossings());
            covered.append(worker.covered());
            seen.insert(seen.end(), worker.seen().begin(), worker.seen().end());
        });
        covered.compare(seen, options, result.stats, *crossings);
        crossings->arrange();
        result.crossings = std::make_shared<const Crossings>(*std::move(crossings));
    }
    shared.workers.for_each([&](const Worker& worker) {
        result.stats += worker.stats();
        const auto& incomplete = worker.incomplete();
        result.incomplete.insert(result.incomplete.end(), incomplete.begin(), incomplete.end());
    });
    shared.workers.for_each([](Worker& worker) { worker.give_back_arranger(); });
    result.stats.memory = shared.memory.peak();
    return result;
}

}  // namespace trisect::detail
