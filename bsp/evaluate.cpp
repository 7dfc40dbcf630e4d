// SPDX-License-Identifier: Apache-2.0
//
// One recursion over (cell, formula) evaluates a whole boolean expression:
//
//   1. operands without boundary in the cell are constant there: replace them by their value;
//   2. nothing left: a homogeneous cell. One operand left: share its subtree or its complement;
//   3. few polygons: a leaf arrangement (detail/leaf_arrangement.cpp) decides which bound the
//   result;
//   4. otherwise cut the cell. Where an operand already has a tree its wall is taken, so that its
//      subtrees can be shared; else the wall that soonest parts the operands.
//
// The idea is EMBER's (Trettner, Nehring-Wirxel, Kobbelt 2022); keeping the cells, so that the next
// operation finds them, is Nehring-Wirxel, Trettner, Kobbelt 2021. Two things matter more than
// arithmetic. Walls lie off the lattice, so nothing is listed twice because its box ends at a wall.
// And every cell knows a reference point with all winding numbers, so that classification never
// leaves the cell.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/detail/budget.h>
#include <trisect/bsp/detail/facet_in_cell.h>
#include <trisect/bsp/detail/leaf_arrangement.h>
#include <trisect/bsp/detail/on_common_lattice.h>
#include <trisect/bsp/detail/residual.h>
#include <trisect/bsp/detail/solid_state.h>
#include <trisect/bsp/detail/translate.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::Box;
using detail::Cell;
using detail::CellNode;
using detail::CellRef;
using detail::FinePoint;
using detail::LeafArranger;
using detail::LeafOperand;
using detail::LeafProblem;
using detail::MemoryBudget;
using detail::PolygonList;
using detail::PolygonRef;
using detail::Residual;
using detail::SlotValues;
using detail::SolidState;
using detail::wall_bits;
using detail::wall_scale;

// An operand in a cell: a subtree whose cell is this cell, or a list of polygons.
struct Operand {
    std::int32_t slot = -1;
    bool embedded = false;
    bool mixed = false;    // the list holds results of arrangements
    CellRef tree;          // of a view by subtree; inner node
    bool flipped = false;  // of a list
    std::span<const PolygonRef> list;
    std::vector<PolygonRef> storage;       // behind `list`, unless a leaf node is
    std::shared_ptr<const CellNode> keep;  // the leaf node behind `list`
    Box box;                               // of a list: of the polygons' boxes, within the cell
    bool is_leaf = false;                  // the list is all of `keep`
    int winding = 0;

    [[nodiscard]] bool is_tree() const { return tree.node != nullptr; }
    [[nodiscard]] std::uint64_t size() const { return is_tree() ? tree.node->size() : list.size(); }
};

struct Task {
    Cell cell;
    FinePoint reference;
    Residual::Ref formula;
    std::vector<Operand> operands;
    int depth = 0;
    int stalled = 0;
    MemoryBudget::Held held;  // its lists
};

struct Wall {
    int axis = 0;
    std::int64_t position = 0;
};

int complemented_winding(int winding, bool complemented) {
    return complemented ? 1 - winding : winding;
}

class Evaluator {
public:
    Evaluator(const EvaluateOptions& options, EvaluateStats& stats, std::size_t slots)
        : options_(options), stats_(stats), memory_(options.max_memory), values_(slots, -1) {}

    CellRef solve(Task task);
    // An operand seen in the cell of `tree`, with its winding number at `reference`.
    std::optional<int> winding_at(const CellRef& tree, const FinePoint& reference) const;
    void attach(Operand& operand, const CellRef& tree, const Cell& cell) const;
    std::vector<detail::FacetName>& incomplete() { return incomplete_; }
    [[nodiscard]] std::uint64_t peak_memory() const { return memory_.peak(); }

private:
    // Steps of solve().
    bool prune(Task& task);
    CellRef constant(const Task& task, bool inside) const;
    CellRef share(Task& task);
    CellRef resolve(Task& task);
    CellRef divide(Task task);

    std::optional<Wall> choose_wall(const Task& task) const;
    std::optional<Wall> wall_of_trees(const Task& task) const;
    std::array<Task, 2> children_of(const Task& task, const Wall& wall) const;
    bool place_reference(const Task& task, const Wall& wall, int which, Task& out) const;
    bool windings_at(const Task& task, const FinePoint& p, Task& out) const;
    void flatten(const CellRef& tree, const Cell& cell, std::vector<PolygonRef>& out) const;
    void listed(Operand& operand, const Cell& cell) const;

    EvaluateOptions options_;
    EvaluateStats& stats_;
    mutable MemoryBudget memory_;
    SlotValues values_;
    LeafArranger arranger_;
    std::vector<detail::FacetName> incomplete_;
    mutable detail::Workbench bench_;
};

// Box of the bounded polygons of a list, within a cell.
Box bounded_box(std::span<const PolygonRef> list, const Cell& cell) {
    Box b;
    for (const PolygonRef& r : list) b.add(r.box());
    return b.intersected(cell.lattice_box());
}

void Evaluator::attach(Operand& operand, const CellRef& tree, const Cell& cell) const {
    if (!tree.node->is_leaf()) {
        operand.tree = tree;
        return;
    }
    operand.tree = {};
    operand.keep = tree.node;
    operand.storage.assign(tree.node->polygons().begin(), tree.node->polygons().end());
    operand.list = operand.storage;
    operand.is_leaf = true;
    operand.flipped = tree.complemented;
    operand.mixed = tree.node->is_mixed();
    operand.box = bounded_box(operand.list, cell);
}

std::optional<int> Evaluator::winding_at(const CellRef& tree, const FinePoint& p) const {
    const CellNode* node = tree.node.get();
    bool complemented = tree.complemented;
    while (!node->is_leaf()) {
        const auto& c =
            node->child(p.c[static_cast<std::size_t>(node->axis())] > node->wall() ? 1 : 0);
        complemented = complemented != c.complemented;
        node = c.node.get();
    }
    const std::vector<PolygonRef> refs(node->polygons().begin(), node->polygons().end());
    const auto change = detail::trace_winding(refs, false, node->reference(), p);
    if (!change) return std::nullopt;
    return complemented_winding(node->winding() + *change, complemented);
}

bool Evaluator::prune(Task& task) {
    bool any = false;
    for (const Operand& o : task.operands) {
        if (o.size() != 0) continue;
        values_[static_cast<std::size_t>(o.slot)] =
            detail::is_inside(o.winding, options_.winding) ? 1 : 0;
        any = true;
    }
    if (!any) return false;
    task.formula = detail::simplified(task.formula, values_);
    std::vector<bool> used(values_.size(), false);
    for_each_slot(*task.formula, [&](std::int32_t s) { used[static_cast<std::size_t>(s)] = true; });
    for (const Operand& o : task.operands) values_[static_cast<std::size_t>(o.slot)] = -1;
    std::erase_if(task.operands,
                  [&](const Operand& o) { return !used[static_cast<std::size_t>(o.slot)]; });
    return true;
}

CellRef Evaluator::constant(const Task& task, bool inside) const {
    ++stats_.constant_cells;
    return {CellNode::leaf(PolygonList(), task.reference, inside ? 1 : 0, false), false};
}

// One operand is left and the formula is that operand or its complement.
CellRef Evaluator::share(Task& task) {
    ++stats_.shared_cells;
    Operand& o = task.operands[0];
    const bool negated = task.formula->kind == Residual::Kind::Not;
    if (o.is_tree()) return {o.tree.node, o.tree.complemented != negated};
    if (o.keep && o.is_leaf) return {o.keep, o.flipped != negated};
    // Listed are the polygons whose boxes meet the cell. The result lists those that do themselves:
    // a leaf without polygons must be homogeneous, and a facet must not appear where it is not.
    std::vector<PolygonRef> refs;
    refs.reserve(o.list.size());
    for (const PolygonRef& r : o.list)
        if (detail::meets_cell(bench_, r, task.cell)) refs.push_back(r);
    const bool flip = o.flipped != negated;
    if (flip)
        for (PolygonRef& r : refs) r.flipped = !r.flipped;
    memory_.keep(detail::bytes_of_list(refs));
    const int winding = complemented_winding(o.winding, negated);
    return {CellNode::leaf(PolygonList(std::move(refs)), task.reference, winding, o.mixed), false};
}

CellRef Evaluator::resolve(Task& task) {
    for (Operand& o : task.operands) listed(o, task.cell);
    std::vector<LeafOperand> operands;
    for (const Operand& o : task.operands)
        operands.push_back({o.slot, o.list, o.flipped, o.embedded, o.winding});
    for (const Operand& o : task.operands)
        values_[static_cast<std::size_t>(o.slot)] =
            detail::is_inside(o.winding, options_.winding) ? 1 : 0;
    const bool inside = detail::value_of(*task.formula, values_);
    LeafProblem problem{task.cell, task.reference, operands, task.formula.get(), &options_};
    detail::LeafResult kept = arranger_.arrange(problem, values_, stats_);
    for (const Operand& o : task.operands) values_[static_cast<std::size_t>(o.slot)] = -1;
    const std::uint64_t bytes = detail::bytes_of_result(kept.polygons);
    PolygonList list(
        std::move(kept.polygons));  // from here on fragments are freed whatever is thrown
    memory_.keep(bytes);
    incomplete_.insert(incomplete_.end(), kept.incomplete.begin(), kept.incomplete.end());
    return {CellNode::leaf(std::move(list), task.reference, inside ? 1 : 0, true), false};
}

// Lists the polygons below a node. A polygon that also reaches into other leaves may be missing
// there, so it is clipped to the leaf that lists it.
void Evaluator::flatten(const CellRef& tree, const Cell& cell, std::vector<PolygonRef>& out) const {
    const CellNode& node = *tree.node;
    if (!node.is_leaf()) {
        for (int i = 0; i < 2; ++i) {
            CellRef c = node.child(i);
            c.complemented = c.complemented != tree.complemented;
            flatten(c,
                    i == 0 ? cell.below(node.axis(), node.wall())
                           : cell.above(node.axis(), node.wall()),
                    out);
        }
        return;
    }
    for (const PolygonRef& r : node.polygons()) {
        auto part = detail::clip_to_cell(bench_, r, cell);
        if (!part) continue;
        part->flipped = part->flipped != tree.complemented;
        out.push_back(*part);
    }
}

void Evaluator::listed(Operand& operand, const Cell& cell) const {
    if (!operand.is_tree()) return;
    const CellRef tree = std::exchange(operand.tree, {});
    bench_.clear();
    flatten(tree, cell, operand.storage);
    operand.list = operand.storage;
    operand.flipped = false;
    operand.mixed = true;
    operand.box = bounded_box(operand.list, cell);
    // New fragments live as long as the node that lists them: make one.
    operand.keep = CellNode::leaf(PolygonList(operand.storage), {}, 0, true);
}

std::optional<Wall> Evaluator::wall_of_trees(const Task& task) const {
    const Operand* largest = nullptr;
    for (const Operand& o : task.operands)
        if (o.is_tree() && (largest == nullptr || o.size() > largest->size())) largest = &o;
    if (largest == nullptr) return std::nullopt;
    return Wall{largest->tree.node->axis(), largest->tree.node->wall()};
}

bool is_half_space(const Operand& o) {
    return o.list.size() == 1 && o.list[0].source->is_half_space();
}

// Peel off a slab that only one operand enters when it is large, else halve the box of what at
// least two operands enter (or the one operand that has to be resolved by itself).
std::optional<Wall> Evaluator::choose_wall(const Task& task) const {
    std::vector<Box> boxes;
    Box all;
    for (const Operand& o : task.operands) {
        if (o.box.is_empty() || is_half_space(o)) continue;
        boxes.push_back(o.box);
        all.add(o.box);
    }
    if (all.is_empty()) return std::nullopt;
    Box contested;
    const bool alone = boxes.size() == 1 || boxes.size() > 64;
    for (std::size_t i = 0; i < boxes.size() && !alone; ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            const Box b = boxes[i].intersected(boxes[j]);
            if (!b.is_empty()) contested.add(b);
        }
    for (const Operand& o : task.operands) {
        if (o.embedded && !alone) continue;
        if (!o.box.is_empty() && !is_half_space(o)) contested.add(o.box);
    }
    if (alone) contested = all;
    const auto at = [&](int axis, std::int64_t last_below) {
        return Wall{axis, last_below * wall_scale + options_.wall_offset};
    };
    if (contested.is_empty()) {  // all boxes disjoint: cut in the middle
        contested = all;
    }
    double best_peel = 0.3;
    std::optional<Wall> wall;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const auto extent = static_cast<double>(all.hi[k] - all.lo[k]);
        if (extent <= 0) continue;
        const double low = static_cast<double>(contested.lo[k] - all.lo[k]) / extent;
        const double high = static_cast<double>(all.hi[k] - contested.hi[k]) / extent;
        if (low > best_peel) {
            best_peel = low;
            wall = at(axis, contested.lo[k] - 1);
        }
        if (high > best_peel) {
            best_peel = high;
            wall = at(axis, contested.hi[k]);
        }
    }
    if (wall) return wall;
    std::int64_t longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        if (contested.hi[k] - contested.lo[k] <= longest) continue;
        longest = contested.hi[k] - contested.lo[k];
        wall = at(axis, contested.lo[k] + (longest - 1) / 2);
    }
    return wall;
}

// Whether a box of polygons, rounded inwards to lattice positions, comes near a segment.
bool near_segment(const Box& box, const FinePoint& a, const FinePoint& b) {
    Box segment;
    for (std::size_t k = 0; k < 3; ++k) {
        segment.lo[k] = (std::min(a.c[k], b.c[k]) >> wall_bits) - 1;
        segment.hi[k] = (std::max(a.c[k], b.c[k]) >> wall_bits) + 2;
    }
    return box.overlaps(segment);
}

// Winding numbers of all operands at p, which lies in the task's cell.
bool Evaluator::windings_at(const Task& task, const FinePoint& p, Task& out) const {
    std::vector<int> windings;
    for (const Operand& o : task.operands) {
        std::optional<int> w;
        if (o.is_tree()) {
            w = winding_at(o.tree, p);
        } else if (!near_segment(o.box, task.reference, p)) {
            w = o.winding;
        } else if (const auto change =
                       detail::trace_winding(o.list, o.flipped, task.reference, p)) {
            w = o.winding + *change;
        }
        if (!w) return false;
        windings.push_back(*w);
    }
    out.reference = p;
    for (std::size_t i = 0; i < windings.size(); ++i) out.operands[i].winding = windings[i];
    return true;
}

bool Evaluator::place_reference(const Task& task, const Wall& wall, int which, Task& out) const {
    const auto k = static_cast<std::size_t>(wall.axis);
    if (out.cell.contains(task.reference)) {
        out.reference = task.reference;
        for (std::size_t i = 0; i < task.operands.size(); ++i)
            out.operands[i].winding = task.operands[i].winding;
        return true;
    }
    // First straight through the wall; the segment is short and hits little.
    FinePoint p = task.reference;
    for (const std::int64_t step : {3, 37, 59, 101}) {
        p.c[k] = wall.position + (which == 0 ? -step : step);
        if (out.cell.contains(p) && windings_at(task, p, out)) return true;
    }
    // Then anywhere near the polygons.
    Box around;
    for (const Operand& o : task.operands)
        if (!o.box.is_empty()) around.add(o.box);
    if (around.is_empty()) around = out.cell.lattice_box();
    for (std::uint64_t attempt = 1; attempt <= 200; ++attempt) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Near the polygons, or at the end of the cell that is nearest to them.
            std::int64_t lo = std::max(out.cell.lo[axis] + 1, (around.lo[axis] - 2) * wall_scale);
            std::int64_t hi = std::min(out.cell.hi[axis] - 1, (around.hi[axis] + 2) * wall_scale);
            if (hi - lo < wall_scale / 2) {
                const bool cell_is_above = (around.hi[axis] + 2) * wall_scale < out.cell.hi[axis];
                lo = cell_is_above ? out.cell.lo[axis] + 1
                                   : std::max(out.cell.lo[axis] + 1, out.cell.hi[axis] - 512);
                hi = std::min(out.cell.hi[axis] - 1, lo + 512);
            }
            const auto range = static_cast<std::uint64_t>(std::max<std::int64_t>(hi - lo, 1));
            const auto c =
                lo + static_cast<std::int64_t>(detail::mix64(attempt * 3 + axis) % range);
            p.c[axis] = (c & 1) != 0 ? c + 1 : c;
        }
        if (out.cell.contains(p) && windings_at(task, p, out)) return true;
    }
    return false;
}

double listed_in(const Task& task) {
    double n = 0;
    for (const Operand& o : task.operands) n += static_cast<double>(o.size());
    return n;
}

// Where the polygons of the lists are within the cell.
Box box_of_lists(const Task& task) {
    Box b;
    for (const Operand& o : task.operands)
        if (!o.is_tree() && !o.box.is_empty()) b.add(o.box);
    return b;
}

// Both children of a cell; every list is read once.
std::array<Task, 2> Evaluator::children_of(const Task& task, const Wall& wall) const {
    std::array<Task, 2> out;
    const auto k = static_cast<std::size_t>(wall.axis);
    const std::int64_t last_below = wall.position >> wall_bits;
    for (std::size_t i = 0; i < 2; ++i) {
        out[i].cell = i == 0 ? task.cell.below(wall.axis, wall.position)
                             : task.cell.above(wall.axis, wall.position);
        out[i].formula = task.formula;
        out[i].depth = task.depth + 1;
        out[i].operands.resize(task.operands.size());
    }
    const bool small = listed_in(task) < 20000;
    const Box extent = box_of_lists(task);
    const std::int64_t long_facet = (extent.hi[k] - extent.lo[k]) / 4;
    const std::array<Box, 2> cells{extent.intersected(out[0].cell.lattice_box()),
                                   extent.intersected(out[1].cell.lattice_box())};
    for (std::size_t n = 0; n < task.operands.size(); ++n) {
        const Operand& o = task.operands[n];
        std::array<Operand*, 2> c{&out[0].operands[n], &out[1].operands[n]};
        for (std::size_t i = 0; i < 2; ++i) {
            c[i]->slot = o.slot;
            c[i]->embedded = o.embedded;
            if (!o.is_tree()) {
                c[i]->mixed = o.mixed;
                c[i]->flipped = o.flipped;
                c[i]->keep = o.keep;
                // Memory that is never touched costs nothing, copying a list that grew does.
                c[i]->storage.reserve(o.list.size());
                continue;
            }
            CellRef t = o.tree.node->child(static_cast<int>(i));
            t.complemented = t.complemented != o.tree.complemented;
            attach(*c[i], t, out[i].cell);
        }
        if (o.is_tree()) continue;
        for (const PolygonRef& r : o.list) {
            const Box& b = r.box();
            const bool below = b.lo[k] <= last_below;
            const bool above = b.hi[k] > last_below;
            // A facet that is large for its cell may pass by a child that its box meets.
            const bool doubtful = small && below && above && b.hi[k] - b.lo[k] > long_facet;
            if (below && !(doubtful && detail::certainly_misses(r, cells[0]))) {
                c[0]->storage.push_back(r);
                c[0]->box.add(b);
            }
            if (above && !(doubtful && detail::certainly_misses(r, cells[1]))) {
                c[1]->storage.push_back(r);
                c[1]->box.add(b);
            }
        }
        for (std::size_t i = 0; i < 2; ++i) {
            c[i]->list = c[i]->storage;
            c[i]->box = c[i]->box.intersected(out[i].cell.lattice_box());
        }
    }
    for (Task& child : out) {
        std::uint64_t bytes = 0;
        for (const Operand& o : child.operands) bytes += detail::bytes_of_list(o.storage);
        child.held = memory_.hold(bytes);
    }
    for (int i = 0; i < 2; ++i)
        TRISECT_EXPECTS(place_reference(task, wall, i, out[static_cast<std::size_t>(i)]),
                        "no reference point found in a cell");
    return out;
}

CellRef Evaluator::divide(Task task) {
    std::optional<Wall> wall = wall_of_trees(task);
    if (wall) {
        for (Operand& o : task.operands)
            if (o.is_tree() &&
                (o.tree.node->axis() != wall->axis || o.tree.node->wall() != wall->position))
                listed(o, task.cell);
    } else {
        wall = choose_wall(task);
    }
    const bool too_deep = task.stalled >= (listed_in(task) > 400 ? 12 : 3) || task.depth > 400;
    if (!wall || (too_deep && !wall_of_trees(task))) return resolve(task);
    std::array<CellRef, 2> results;
    std::array<Task, 2> children = children_of(task, *wall);
    const double total = listed_in(task);
    // Pairs are what a leaf costs. A wall that leaves most of them on its sides was not worth it,
    // and after a few such walls none will be: long thin facets cross all of them. Where many
    // facets meet in a corner, though, walls around the corner cut off small cells at little cost.
    const double first = listed_in(children[0]);
    const double second = listed_in(children[1]);
    const double pairs = first * first + second * second;
    const bool worth_it = pairs < (total < 4000 ? 0.8 : 1.6) * total * total;
    const int price = std::min(first, second) > 0.5 * total ? 4 : 1;
    for (Task& c : children) c.stalled = worth_it ? 0 : task.stalled + price;
    // A subtree that comes back unchanged is shared as a whole.
    const CellRef driver = [&] {
        for (const Operand& o : task.operands)
            if (o.is_tree()) return o.tree;
        return CellRef{};
    }();
    const FinePoint reference = task.reference;
    task.operands.clear();
    task.held = {};
    for (std::size_t i = 0; i < 2; ++i) results[i] = solve(std::move(children[i]));
    if (driver.node) {
        for (const bool complemented : {false, true}) {
            bool same = true;
            for (int i = 0; i < 2; ++i) {
                const CellRef& c = driver.node->child(i);
                const CellRef& r = results[static_cast<std::size_t>(i)];
                same =
                    same && r.node == c.node && r.complemented == (c.complemented != complemented);
            }
            if (same) return {driver.node, complemented};
        }
    }
    const auto homogeneous = [](const CellRef& r) {
        return r.node->is_leaf() && r.node->polygons().empty();
    };
    const auto inside = [](const CellRef& r) {
        return complemented_winding(r.node->winding(), r.complemented);
    };
    if (homogeneous(results[0]) && homogeneous(results[1]) &&
        inside(results[0]) == inside(results[1]))
        return {CellNode::leaf(PolygonList(), reference, inside(results[0]), false), false};
    return {CellNode::split(wall->axis, wall->position, results[0], results[1]), false};
}

CellRef Evaluator::solve(Task task) {
    ++stats_.cells;
    detail::check_budget(options_, stats_);
    stats_.depth = std::max(stats_.depth, task.depth);
    prune(task);
    if (task.formula->kind == Residual::Kind::Constant) return constant(task, task.formula->value);
    if (task.operands.size() == 1) {
        Operand& o = task.operands[0];
        // With one unknown the formula is that unknown, its complement, or constant.
        const auto k = static_cast<std::size_t>(o.slot);
        values_[k] = 0;
        const bool at_outside = detail::value_of(*task.formula, values_);
        values_[k] = 1;
        const bool at_inside = detail::value_of(*task.formula, values_);
        values_[k] = -1;
        if (at_outside == at_inside) return constant(task, at_inside);
        task.formula = Residual::of_slot(o.slot);
        if (at_outside) task.formula = Residual::negation(task.formula);
        if (o.embedded) return share(task);
    }
    std::uint64_t total = 0;
    for (const Operand& o : task.operands) total += o.size();
    stats_.listed_polygons += total;
    if (total <= options_.leaf_polygons) return resolve(task);
    return divide(std::move(task));
}

// A point outside the boxes of all operands, three units beyond their common corner.
FinePoint outer_reference(const std::vector<std::shared_ptr<const SolidState>>& states) {
    Box all;
    const auto visit = [&](const auto& self, const CellNode& node) -> void {
        if (!node.is_leaf()) {
            self(self, *node.child(0).node);
            self(self, *node.child(1).node);
            return;
        }
        for (const PolygonRef& r : node.polygons())
            if (!r.source->is_half_space()) all.add(r.box());
    };
    for (const auto& s : states) {
        const CellNode* n = s->root.node.get();
        if (n->is_leaf()) {
            visit(visit, *n);
        } else {
            // The reference of any leaf will do as a start; it need not be outside.
            while (!n->is_leaf()) n = n->child(0).node.get();
            return n->reference();
        }
    }
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k)
        p.c[k] = all.is_empty() ? 0 : (all.lo[k] - 3) * wall_scale + 2 * static_cast<int>(k) + 12;
    return p;
}

}  // namespace

Solid evaluate(const Expression& expression, const EvaluateOptions& options, EvaluateStats* stats) {
    EvaluateStats local;
    detail::Translation t = detail::translate(expression);
    std::vector<std::shared_ptr<const SolidState>> states;
    for (const Solid& s : t.slots) states.push_back(s.state());
    const Lattice lattice = detail::move_to_common_lattice(states);

    Evaluator evaluator(options, local, states.size());
    Task task;
    task.formula = t.formula;
    task.reference = outer_reference(states);
    bool placed = false;
    for (int attempt = 0; attempt < 100 && !placed; ++attempt) {
        placed = true;
        task.operands.clear();
        for (std::size_t i = 0; i < states.size() && placed; ++i) {
            Operand o;
            o.slot = static_cast<std::int32_t>(i);
            o.embedded = states[i]->embedded;
            evaluator.attach(o, states[i]->root, task.cell);
            const auto w = evaluator.winding_at(states[i]->root, task.reference);
            placed = w.has_value();
            if (w) o.winding = *w;
            task.operands.push_back(std::move(o));
        }
        if (!placed)
            for (std::size_t k = 0; k < 3; ++k)
                task.reference.c[k] -= static_cast<std::int64_t>(
                    2 * (detail::mix64(static_cast<std::uint64_t>(attempt) * 3 + k) % 2000));
    }
    TRISECT_EXPECTS(placed, "no reference point for the operands");
    auto state = std::make_shared<SolidState>();
    state->lattice = lattice;
    state->root = evaluator.solve(std::move(task));
    state->embedded = true;
    auto& incomplete = evaluator.incomplete();
    for (const auto& s : states)
        incomplete.insert(incomplete.end(), s->incomplete.begin(), s->incomplete.end());
    std::sort(incomplete.begin(), incomplete.end());
    incomplete.erase(std::unique(incomplete.begin(), incomplete.end()), incomplete.end());
    state->incomplete = std::move(incomplete);
    local.memory = evaluator.peak_memory();
    if (stats != nullptr) *stats = local;
    return Solid(std::shared_ptr<const SolidState>(std::move(state)));
}

}  // namespace trisect
