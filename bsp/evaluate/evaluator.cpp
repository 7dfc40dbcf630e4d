// SPDX-License-Identifier: Apache-2.0
//
// One recursion over (cell, formula) evaluates a whole boolean expression:
//
//   1. operands without boundary in the cell are constant there: replace them by their value;
//   2. take the first rule of the table (rules.h) that serves: nothing left is a homogeneous cell,
//      of one operand left the subtree is shared, few polygons are arranged;
//   3. where many operands fill the cell, halves of the formula are evaluated one after the other,
//      and then what they leave;
//   4. the last rule cuts the cell. Where an operand already has a tree its plane is taken, so that
//      its subtrees can be shared. A large leaf beside small ones is refined by itself, for all its
//      users. Else the splitting plane that separates the operands soonest.
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
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/deferred_leaf.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/divide/choose_splitting_plane.h>
#include <trisect/bsp/divide/embedded_part.h>
#include <trisect/bsp/divide/operand_lists.h>
#include <trisect/bsp/divide/partition.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/divide/refine_leaf.h>
#include <trisect/bsp/divide/shared_list.h>
#include <trisect/bsp/divide/slab.h>
#include <trisect/bsp/evaluate/arranger_pool.h>
#include <trisect/bsp/evaluate/changed_box.h>
#include <trisect/bsp/evaluate/contained_cells.h>
#include <trisect/bsp/evaluate/formula_halves.h>
#include <trisect/bsp/evaluate/root_task.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/stack_arena.h>
#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/thread_pool.h>

namespace trisect::detail {

namespace {

// Cells with fewer polygons are not worth a task of their own: a leaf takes some 40 microseconds, a
// thread that sleeps twice as long to come. A step of a chain has twenty leaves.
constexpr std::uint64_t parallel_polygons = 128;
// A leaf that outnumbers all others in its cell so many times is refined for good.
constexpr std::uint64_t outnumbering = 4;

// A measure of what is to be done: polygons beside those of the largest operand, which is shared as
// it is where nothing meets it, and leaves that may be refined.
class WorkMeasure {
public:
    void add(std::uint64_t size, bool is_refinable) {
        total_ += size;
        largest_ = std::max(largest_, size);
        if (is_refinable) refinable_ += size;
    }
    [[nodiscard]] std::uint64_t work() const {
        constexpr std::uint64_t of_one = 16;  // nodes of the largest operand around a polygon
        const std::uint64_t others = total_ - largest_;
        return others == 0 ? 0 : std::max(refinable_, std::min(total_, of_one * others));
    }

private:
    std::uint64_t total_ = 0;
    std::uint64_t largest_ = 0;
    std::uint64_t refinable_ = 0;
};

bool is_refinable(const CellNode& node) { return node.is_leaf() && node.refinement() == nullptr; }

std::uint64_t work_in(std::span<const CellOperand> operands) {
    WorkMeasure measure;
    for (const CellOperand& o : operands)
        measure.add(o.size(), !o.is_list && is_refinable(*o.node));
    return measure.work();
}

std::uint64_t work_in(const SolidStates& solids) {
    WorkMeasure measure;
    for (const auto& s : solids) measure.add(s->root().node->size(), is_refinable(*s->root().node));
    return measure.work();
}

class Worker;

// What the threads of one evaluation share.
struct Shared {
    const EvaluateSettings& options;
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
class Worker final : public CellSteps {
public:
    explicit Worker(Shared& shared)
        : shared_(shared), options_(shared.options), values_(shared.slots, -1) {
        if (shared.crossings == nullptr) return;
        findings_.crossings.emplace();
        findings_.crossings->operands = shared.crossings->operands;
    }

    CellRef solve(CellTask& task);
    CellRef deep_solve(CellTask& task) {
        return with_enough_stack([&] { return solve(task); });
    }
    [[nodiscard]] const LeafFindings& findings() const { return findings_; }
    [[nodiscard]] Crossings take_crossings() { return *std::move(findings_.crossings); }
    [[nodiscard]] const ContainedCells& covered() const { return covered_; }
    [[nodiscard]] StackArena& arena() { return arena_; }
    /// Last, and only when nothing was thrown.
    void give_back_arrangers() noexcept { ArrangerPool::give_back(std::move(arrangers_)); }

private:
    using Children = CellChildren;
    // A cell as its arrangements see it.
    struct Listed {
        std::vector<LeafOperand> operands;
        LeafProblem problem;
        bool inside = false;  // the reference point, of the result
    };

    [[nodiscard]] bool collects(const CellTask& task) const {
        return shared_.crossings != nullptr && !task.is_part;
    }
    // For ParallelParts: as many as the arena has, or the calling one.
    [[nodiscard]] std::uint32_t threads() const { return shared_.parallel ? 0 : 1; }

    [[nodiscard]] std::optional<CellRef> choose_formula(CellTask& task);
    void prune(CellTask& task);
    void drop(CellTask& task);
    template <class IsLeft>
    void note_dropped(const CellTask& task, const IsLeft& is_left);
    void note_listed(const CellTask& task);
    void note_all(std::int32_t slot, const CellNode& node);

    [[nodiscard]] std::optional<CellRef> first_of(std::span<const Rule> rules, const CellView& view,
                                                  CellTask& task);
    [[nodiscard]] std::optional<CellRef> make_constant(CellTask& task) override;
    [[nodiscard]] std::optional<CellRef> share(CellTask& task) override;
    [[nodiscard]] std::optional<CellRef> halve(CellTask& task) override;
    [[nodiscard]] std::optional<CellRef> divide(CellTask& task) override;

    [[nodiscard]] bool is_inside_at_reference(const CellTask& task);
    [[nodiscard]] CellTask part_of(const CellTask& task, const Residual::Ref& part);
    [[nodiscard]] int value_with(const Residual& formula, const CellOperand& o);
    void list(CellTask& task, Listed& out);
    [[nodiscard]] std::vector<LeafOperand> list_operands(const CellTask& task);
    [[nodiscard]] std::optional<CellRef> arrange(const LeafRule& rule, const CellTask& task,
                                                 const Listed& listed);
    CellRef keep(LeafPolygons made, const CellTask& task, bool inside);
    CellRef keep(LeafUncrossed made, const CellTask& task, bool inside);
    CellRef keep(LeafPicture made, const CellTask& task, bool inside);
    CellRef keep(LeafOutlines made, const CellTask& task, bool inside);
    [[nodiscard]] PolygonList kept_list(std::vector<PolygonRef> polygons);
    [[nodiscard]] std::unique_ptr<DeferredLeaf> problem_of(const CellTask& task);

    CellRef solve_children(const CellTask& task, const SplittingPlane& splitter,
                           Children& children);
    Children children_of(const CellTask& task, const SplittingPlane& splitter);

    Shared& shared_;
    const EvaluateSettings& options_;
    SlotValues values_;  // all unknown between uses
    std::vector<std::uint8_t> used_;
    std::unique_ptr<LeafArrangers> arrangers_ = ArrangerPool::take();
    LeafFindings findings_;
    ContainedCells covered_;
    Workbench bench_;
    StackArena arena_;
    OperandLists lists_{arena_, bench_};
    std::vector<PolygonRef> polygons_;   // of leaves
    std::vector<std::uint32_t> facets_;  // of a leaf that is deferred
};

Worker& Shared::worker() {
    return workers.local([&] { return std::make_unique<Worker>(*this); });
}

// --- Step 0: what a cell has from before.

// Cells are those of the tree of before, down to its leaves, and to cells beside the box.
std::optional<CellRef> Worker::choose_formula(CellTask& task) {
    const ChangedBox& change = *options_.change;
    const auto window = std::ranges::find(task.operands, change.window, &CellOperand::slot);
    if (window == task.operands.end()) return std::nullopt;  // chosen already
    const auto before = std::ranges::find(task.operands, change.before, &CellOperand::slot);
    Box around;  // the cell, which may have no lattice point
    for (std::size_t k = 0; k < 3; ++k) {
        around.lo[k] = lattice_below(task.cell.lo[k]);
        around.hi[k] = lattice_below(task.cell.hi[k]) + 1;
    }
    const bool is_beside = around.intersected(change.box).is_empty();
    if (!is_beside && !before->is_list && !before->node->is_leaf()) {
        const SplittingPlane splitter{before->node->axis(), before->node->splitter()};
        lists_.make(task, splitter, threads());
        Children children = children_of(task, splitter);
        return solve_children(task, splitter, children);
    }
    values_[static_cast<std::size_t>(change.window)] = is_beside ? 0 : 1;
    drop(task);
    return std::nullopt;
}

// --- Step 1: prune.

void Worker::prune(CellTask& task) {
    bool any = false;
    for (const CellOperand& o : task.operands) {
        if (o.size() != 0) continue;
        values_[static_cast<std::size_t>(o.slot)] = is_inside(o.winding, options_.winding) ? 1 : 0;
        any = true;
    }
    if (any) drop(task);
    // What is left may overlap itself.
    if (task.operands.size() > 2 && find_contained(task, values_, findings_.incomplete)) drop(task);
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
    if (collects(task)) note_dropped(task, is_left);
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
    note_listed(task);
}

// All facets of all operands of a cell.
void Worker::note_listed(const CellTask& task) {
    for (const CellOperand& o : task.operands) {
        if (o.is_list) {
            for (const PackedBox& e : o.list())
                findings_.note_uncertain(o.slot, o.polygon(e.id).facet);
        } else {
            note_all(o.slot, *o.node);
        }
    }
}

// All facets that the leaves below a node list.
void Worker::note_all(std::int32_t slot, const CellNode& node) {
    if (node.is_leaf()) {
        for (const PolygonRef& r : node.polygons()) findings_.note_uncertain(slot, r.facet);
        return;
    }
    for (int i = 0; i < 2; ++i) with_enough_stack([&] { note_all(slot, *node.child(i).node); });
}

// --- Step 2: the first rule that serves.

std::optional<CellRef> Worker::first_of(std::span<const Rule> rules, const CellView& view,
                                        CellTask& task) {
    Listed listed;
    for (const Rule& rule : rules) {
        std::optional<CellRef> cell;
        if (const auto* const whole = std::get_if<CellRule>(&rule.how)) {
            if (whole->applies(view)) cell = (this->*whole->take)(task);
        } else if (const auto& leaf = std::get<LeafRule>(rule.how); leaf.may_serve(view)) {
            if (listed.operands.empty()) list(task, listed);
            cell = arrange(leaf, task, listed);
        }
        if (!cell) continue;
        ++(findings_.stats.*rule.counter);
        return cell;
    }
    return std::nullopt;
}

std::optional<CellRef> Worker::make_constant(CellTask& task) {
    const bool inside = task.formula->kind == Residual::Kind::Constant
                            ? task.formula->value
                            : values_of_one(*task.formula, task.operands[0].slot, values_).inside;
    return CellRef{CellNode::leaf(PolygonList(), task.reference, inside ? 1 : 0, false), false};
}

// The formula is the operand or its complement.
std::optional<CellRef> Worker::share(CellTask& task) {
    const CellOperand& o = task.operands[0];
    const bool negated = values_of_one(*task.formula, o.slot, values_).outside;
    if (!o.is_list) return CellRef{o.node->shared_from_this(), o.complemented != negated};
    PolygonList list = shared_list(task, o, negated, bench_, arena_);
    shared_.memory.keep(list.bytes());
    return CellRef{CellNode::leaf(std::move(list), task.reference,
                                  complemented_winding(o.winding, negated), o.node->is_mixed()),
                   false};
}

// --- Arranged polygons.

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

void Worker::list(CellTask& task, Listed& out) {
    lists_.make_leaves(task);
    out.operands = list_operands(task);
    arrangers_->largest_leaf = std::max(arrangers_->largest_leaf, polygons_.size());
    out.inside = is_inside_at_reference(task);
    out.problem = {task.cell,          task.reference, out.operands,
                   task.formula.get(), &options_,      !task.is_part};
}

bool Worker::is_inside_at_reference(const CellTask& task) {
    for (const CellOperand& o : task.operands)
        values_[static_cast<std::size_t>(o.slot)] = is_inside(o.winding, options_.winding) ? 1 : 0;
    const bool inside = value_of(*task.formula, values_);
    for (const CellOperand& o : task.operands) values_[static_cast<std::size_t>(o.slot)] = -1;
    return inside;
}

std::optional<CellRef> Worker::arrange(const LeafRule& rule, const CellTask& task,
                                       const Listed& listed) {
    std::optional<LeafResult> made =
        rule.arrangement(*arrangers_).arrange(listed.problem, findings_);
    if (!made) return std::nullopt;
    ++findings_.stats.mixed_leaves;
    return std::visit([&](auto& kind) { return keep(std::move(kind), task, listed.inside); },
                      *made);
}

// A list that keeps its fragments, whatever is thrown from here on.
PolygonList Worker::kept_list(std::vector<PolygonRef> polygons) {
    const std::uint64_t bytes = bytes_of_result(polygons);
    PolygonList list(std::move(polygons));
    shared_.memory.keep(bytes);
    return list;
}

CellRef Worker::keep(LeafPolygons made, const CellTask& task, bool inside) {
    return {
        CellNode::leaf(kept_list(std::move(made.polygons)), task.reference, inside ? 1 : 0, true),
        false};
}

// A leaf whose crossed facets are cut when someone needs it.
CellRef Worker::keep(LeafUncrossed made, const CellTask& task, bool inside) {
    PolygonList uncrossed = kept_list(std::move(made.polygons));
    auto leaf = problem_of(task);
    const std::uint64_t size = uncrossed.size() + made.crossed;
    leaf->known = std::move(uncrossed);
    return {CellNode::deferred(std::move(leaf), inside ? 1 : 0, size), false};
}

CellRef Worker::keep(LeafPicture made, const CellTask& task, bool inside) {
    auto leaf = problem_of(task);
    shared_.memory.keep(made.occupancy->bytes());
    const std::uint64_t size = made.occupancy->facets.size();
    leaf->known = std::move(made.occupancy);
    return {CellNode::deferred(std::move(leaf), inside ? 1 : 0, size), false};
}

CellRef Worker::keep(LeafOutlines, const CellTask&, bool) {
    TRISECT_EXPECTS(false, "outlines are of whole formulas");
    return {};
}

// Operands are imported meshes, refined or not, or look like that here: of one source, no facet
// turned over.
std::unique_ptr<DeferredLeaf> Worker::problem_of(const CellTask& task) {
    auto leaf = std::make_unique<DeferredLeaf>();
    leaf->cell = task.cell;
    leaf->reference = task.reference;
    leaf->formula = task.formula;
    leaf->rule = options_.winding;
    leaf->arrange = &arrange_deferred;
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

// --- Step 3: halve the formula.

// The cell with a part of its formula. Its operands are in the arena.
CellTask Worker::part_of(const CellTask& task, const Residual::Ref& part) {
    used_.assign(values_.size(), 0);
    for_each_slot(*part, [&](std::int32_t s) { used_[static_cast<std::size_t>(s)] = 1; });
    CellTask out = task;
    out.formula = part;
    out.is_part = true;
    auto* const operands = arena_.take<CellOperand>(task.operands.size());
    std::size_t n = 0;
    for (const CellOperand& o : task.operands)
        if (used_[static_cast<std::size_t>(o.slot)] != 0) ::new (&operands[n++]) CellOperand(o);
    out.operands = {operands, n};
    return out;
}

// What one half of the formula makes of the cell is an operand like any other: few polygons are
// left of it for the other half to be compared with. It gets the slot of its first operand.
std::optional<CellRef> Worker::halve(CellTask& task) {
    const std::optional<FormulaHalves> halves = halves_of(*task.formula);
    if (!halves) return std::nullopt;
    if (collects(task)) note_listed(task);
    std::array<CellTask, 2> parts;
    for (std::size_t i = 0; i < 2; ++i) parts[i] = part_of(task, halves->terms[i]);
    CellTask whole = task;
    whole.is_part = true;
    whole.has_frame = false;
    whole.stalled = 0;
    auto* const operands = arena_.take<CellOperand>(2);
    whole.operands = {operands, 2};
    whole.formula = halves->joined(parts[0].operands[0].slot, parts[1].operands[0].slot);
    std::array<CellRef, 2> made;  // lives as long as they are operands
    for (std::size_t i = 0; i < 2; ++i) {
        CellOperand& o = *::new (&operands[i]) CellOperand(parts[i].operands[0]);
        if (parts[i].formula->kind == Residual::Kind::Slot) {
            whole.has_frame = whole.has_frame || (task.has_frame && o.is_list);
            continue;
        }
        o = {};
        o.slot = parts[i].operands[0].slot;
        o.winding = is_inside_at_reference(parts[i]) ? 1 : 0;
        o.embedded = true;
        o.has_fractions = std::ranges::any_of(parts[i].operands, &CellOperand::has_fractions);
        made[i] = deep_solve(parts[i]);
        o.complemented = made[i].complemented;
        o.node = unfolded(made[i].node.get());
        if (i == 0 && o.size() == 0)
            if (const int value = value_with(*whole.formula, o); value >= 0)
                return CellRef{CellNode::leaf(PolygonList(), task.reference, value, false), false};
    }
    return deep_solve(whole);
}

// Of a formula where one operand has no polygons; -1 where that does not decide it.
int Worker::value_with(const Residual& formula, const CellOperand& o) {
    auto& value = values_[static_cast<std::size_t>(o.slot)];
    value = is_inside(o.winding, options_.winding) ? 1 : 0;
    const int decided = bounded_value_of(formula, values_);
    value = -1;
    return decided;
}

// --- Step 4: divide.

std::optional<SplittingPlane> splitter_of_trees(const CellTask& task) {
    const CellOperand* largest = nullptr;
    for (const CellOperand& o : task.operands)
        if (!o.is_list && !o.node->is_leaf() && (largest == nullptr || o.size() > largest->size()))
            largest = &o;
    if (largest == nullptr) return std::nullopt;
    return SplittingPlane{largest->node->axis(), largest->node->splitter()};
}

// A leaf of a solid that outnumbers everything else in the cell is refined for good.
void refine_large(CellTask& task, std::uint32_t threads) {
    const std::uint64_t total = task.size();
    for (CellOperand& o : task.operands) {
        if (o.is_list || !o.node->is_leaf()) continue;
        const std::uint64_t n = o.size();
        if (o.node->refinement() == nullptr &&
            (n < refinable_leaf || n < outnumbering * (total - n)))
            continue;
        if (const CellNode* node = refined(*o.node, task.cell, threads)) o.node = node;
    }
}

// Both children of a cell. Their lists are in the arena.
Worker::Children Worker::children_of(const CellTask& task, const SplittingPlane& splitter) {
    Children out;
    for (std::size_t i = 0; i < 2; ++i) {
        CellTask& c = out[i];
        c.cell = i == 0 ? task.cell.below(splitter.axis, splitter.position)
                        : task.cell.above(splitter.axis, splitter.position);
        c.frame = task.frame;
        c.has_frame = task.has_frame;
        c.formula = task.formula;
        c.depth = task.depth + 1;
        c.is_part = task.is_part;
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
    partition(task, splitter, cells, arena_, threads(), {out[0].operands, out[1].operands});
    for (int i = 0; i < 2; ++i)
        TRISECT_EXPECTS(place_reference(task, splitter, i, out),
                        "no reference point found in a cell");
    return out;
}

std::optional<CellRef> Worker::divide(CellTask& task) {
    refine_large(task, threads());
    std::optional<SplittingPlane> splitter = splitter_of_trees(task);
    lists_.make(task, splitter, threads());
    if (!splitter) {
        lists_.refine_frame(task);
        if (!splitters_have_failed(task))
            splitter = choose_splitting_plane(task, options_.splitting_offset);
    }
    if (!splitter) return std::nullopt;
    Children children = children_of(task, *splitter);
    const int stalled = stalled_after(task, children[0].size(), children[1].size());
    for (CellTask& c : children) c.stalled = stalled;
    return solve_children(task, *splitter, children);
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
CellRef merged(const CellTask& task, const SplittingPlane& splitter,
               std::array<CellRef, 2> results) {
    if (auto node = unchanged(task, results)) return *std::move(node);
    if (is_homogeneous(results[0]) && is_homogeneous(results[1]) &&
        value_at_reference(results[0]) == value_at_reference(results[1]))
        return {
            CellNode::leaf(PolygonList(), task.reference, value_at_reference(results[0]), false),
            false};
    return {CellNode::split(splitter.axis, splitter.position, std::move(results[0]),
                            std::move(results[1])),
            false};
}

CellRef Worker::solve_children(const CellTask& task, const SplittingPlane& splitter,
                               Children& children) {
    std::uint64_t listed = 0;
    for (const CellTask& c : children)
        for (const CellOperand& o : c.operands)
            if (o.is_list) listed += o.count;
    const auto held = shared_.memory.hold(listed * sizeof(PackedBox));
    std::array<CellRef, 2> results;
    const auto is_worth_a_thread = [](const CellTask& c) {
        return work_in(c.operands) >= parallel_polygons;
    };
    if (shared_.parallel && std::ranges::all_of(children, is_worth_a_thread)) {
        SharedFailure& failure = shared_.failure;
        fork_join([&] { failure.guard([&] { results[1] = shared_.worker().solve(children[1]); }); },
                  [&] { failure.guard([&] { results[0] = deep_solve(children[0]); }); });
        failure.check();
    } else {
        for (std::size_t i = 0; i < 2; ++i) results[i] = deep_solve(children[i]);
    }
    return merged(task, splitter, std::move(results));
}

CellRef Worker::solve(CellTask& task) {
    const auto mark = arena_.mark();
    struct Release {
        StackArena& arena;
        StackArena::Mark mark;
        ~Release() { arena.release(mark); }
    } release{arena_, mark};
    EvaluateStats& stats = findings_.stats;
    ++stats.cells;
    check_budget(options_, stats);
    shared_.failure.check();
    stats.depth = std::max(stats.depth, task.depth);
    if (options_.change != nullptr)
        if (auto cell = choose_formula(task)) return *std::move(cell);
    if (options_.winding == EvaluateOptions::Winding::Positive)
        for (CellOperand& o : task.operands)
            if (take_as_embedded(o, arena_)) ++stats.embedded_cells;
    prune(task);
    CellView view{task, options_, values_, collects(task)};
    if (auto cell = first_of(constant_rules(), view, task)) return *std::move(cell);
    view.size = task.size();
    for (const CellOperand& o : task.operands)
        if (o.is_list || o.node->is_leaf()) stats.listed_polygons += o.size();
    if (auto cell = first_of(polygon_rules(), view, task)) return *std::move(cell);
    view.undividable = true;
    auto cell = first_of(polygon_rules(), view, task);
    TRISECT_EXPECTS(cell.has_value(), "every leaf can be arranged exactly");
    return *std::move(cell);
}

// What is incomplete in an operand stays so in the result, wherever that shares its leaves. The
// longest list is merged and not sorted again: in a chain that is all but what the last step added.
std::vector<FacetName> all_incomplete(std::vector<FacetName> made, const SolidStates& states) {
    const auto longest = std::ranges::max_element(
        states, {}, [](const auto& state) { return state->tree().incomplete.size(); });
    for (auto s = states.begin(); s != states.end(); ++s)
        if (s != longest)
            made.insert(made.end(), (*s)->tree().incomplete.begin(), (*s)->tree().incomplete.end());
    std::ranges::sort(made);
    made.erase(std::unique(made.begin(), made.end()), made.end());
    if (longest == states.end() || (*longest)->tree().incomplete.empty()) return made;
    std::vector<FacetName> all;
    all.reserve(made.size() + (*longest)->tree().incomplete.size());
    std::ranges::set_union((*longest)->tree().incomplete, made, std::back_inserter(all));
    return all;
}

CellRef solve_root(Shared& shared, const Residual::Ref& formula,
                   std::span<const std::shared_ptr<const SolidState>> states, const Cell* cell) {
    Worker& worker = shared.worker();
    const auto mark = worker.arena().mark();
    CellTask task = cell != nullptr ? task_in_cell(formula, states, *cell, worker.arena())
                                    : root_task(formula, states, worker.arena());
    CellRef root = worker.solve(task);
    worker.arena().release(mark);
    return root;
}

}  // namespace

Evaluation evaluate_formula(const Residual::Ref& formula, const SolidStates& solids,
                            const EvaluateSettings& options, const Cell* cell) {
    std::optional<Crossings> crossings;
    if (cell == nullptr && options.change == nullptr) crossings = crossings_of(*formula, solids);
    Shared shared{options, solids.size(), MemoryBudget(options.max_memory), false,
                  crossings ? &*crossings : nullptr};
    // A work budget is counted by one thread, so that it is hit in the same place everywhere.
    shared.parallel = options.threads != 1 && options.budget == nullptr &&
                      work_in(solids) >= 2 * parallel_polygons;
    Evaluation result;
    if (shared.parallel) {
        try {
            in_arena(options.threads,
                     [&] { result.tree.root = solve_root(shared, formula, solids, cell); });
        } catch (const Abandoned&) {
            shared.failure.rethrow();
        }
    } else {
        result.tree.root = solve_root(shared, formula, solids, cell);
    }
    if (crossings) {
        ContainedCells covered;
        std::vector<std::uint32_t> seen;
        shared.workers.for_each([&](Worker& worker) {
            const LeafFindings& found = worker.findings();
            crossings->append(worker.take_crossings());
            covered.append(worker.covered());
            seen.insert(seen.end(), found.seen.begin(), found.seen.end());
        });
        covered.compare(seen, options, result.stats, *crossings);
        crossings->arrange();
        result.tree.crossings = std::make_shared<const Crossings>(*std::move(crossings));
    }
    std::vector<FacetName> incomplete;
    shared.workers.for_each([&](const Worker& worker) {
        const LeafFindings& found = worker.findings();
        result.stats += found.stats;
        incomplete.insert(incomplete.end(), found.incomplete.begin(), found.incomplete.end());
        if (found.may_have_straight_crossings) result.tree.may_have_straight_crossings = true;
    });
    for (const auto& s : solids)
        if (s->tree().may_have_straight_crossings) result.tree.may_have_straight_crossings = true;
    result.tree.incomplete = all_incomplete(std::move(incomplete), solids);
    shared.workers.for_each([](Worker& worker) { worker.give_back_arrangers(); });
    result.stats.memory = shared.memory.peak();
    return result;
}

}  // namespace trisect::detail
