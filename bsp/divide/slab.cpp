// SPDX-License-Identifier: Apache-2.0
//
// Many parts often share a plane: plates on a table, gears side by side. Away from their outlines
// each of them is the same half-space there, and to cut all by all would find that out at the price
// of all pairs. A union needs one of them. That an operand is a slab in a cell follows as in
// axis_leaf.cpp: the boundary of an embedded operand turns only where it leaves its plane, so a
// plane that it enters the cell in it crosses the whole cell in.

#include <trisect/bsp/divide/slab.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include <trisect/bsp/cells/axis_polygon.h>
#include <trisect/bsp/cells/trace/axis_trace.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

// More polygons are hardly all perpendicular to one axis.
constexpr std::uint32_t most_polygons = 16;

class Covering {
public:
    Covering(const CellTask& task, SlotValues& values, std::vector<FacetName>& incomplete)
        : task_(task), values_(values), incomplete_(incomplete) {}

    bool run();

private:
    void walk(const Residual& formula);
    void cover_terms(const std::vector<std::int32_t>& slots);
    [[nodiscard]] bool containments(const Slab& slab, const CellOperand& o) const;
    [[nodiscard]] bool is_outside_at(const CellOperand& o, std::size_t axis,
                                     std::int64_t position) const;
    void drop(const Slab& slab, const CellOperand& o);

    const CellTask& task_;
    SlotValues& values_;
    std::vector<FacetName>& incomplete_;
    std::vector<Slab> slabs_;
    std::unordered_map<std::int32_t, const CellOperand*> operands_;
    std::unordered_map<std::int32_t, int> uses_;
    std::unordered_set<const Residual*> seen_;
    std::vector<std::vector<std::int32_t>> unions_;
    bool any_ = false;
};

bool Covering::run() {
    if (std::ranges::any_of(task_.operands, &CellOperand::has_fractions)) return false;
    for (const CellOperand& o : task_.operands)
        if (const auto s = slab_of(o, task_)) slabs_.push_back(*s);
    if (slabs_.empty()) return false;
    for (const CellOperand& o : task_.operands) operands_.emplace(o.slot, &o);
    walk(*task_.formula);
    for (const auto& slots : unions_) cover_terms(slots);
    return any_;
}

// Unions, and what an intersection takes away.
void Covering::walk(const Residual& formula) {
    using Kind = Residual::Kind;
    if (formula.kind == Kind::Slot) {
        ++uses_[formula.slot];
        return;
    }
    if (!seen_.insert(&formula).second) {
        // A part of the formula that is used twice: what it names is not looked at.
        for_each_slot(formula, [&](std::int32_t s) { ++uses_[s]; });
        return;
    }
    std::vector<std::int32_t> slots;
    for (const Residual::Ref& c : formula.children) {
        if (formula.kind == Kind::Or && c->kind == Kind::Slot) slots.push_back(c->slot);
        if (formula.kind == Kind::And && c->kind == Kind::Not && c->children[0]->kind == Kind::Slot)
            slots.push_back(c->children[0]->slot);
        with_enough_stack([&] { walk(*c); });
    }
    if (slots.size() > 1) unions_.push_back(std::move(slots));
}

// Of equal slabs the first one stays.
void Covering::cover_terms(const std::vector<std::int32_t>& slots) {
    const auto is_term = [&](std::int32_t s) {
        return std::find(slots.begin(), slots.end(), s) != slots.end();
    };
    for (std::size_t i = 0; i < slabs_.size(); ++i) {
        const Slab& slab = slabs_[i];
        if (!is_term(slab.slot)) continue;
        for (const std::int32_t s : slots) {
            if (s == slab.slot || values_[static_cast<std::size_t>(s)] >= 0 || uses_[s] != 1)
                continue;
            const auto other = std::ranges::find(slabs_, s, &Slab::slot);
            if (other != slabs_.end() && other - slabs_.begin() < static_cast<std::ptrdiff_t>(i) &&
                other->axis == slab.axis && other->lo == slab.lo && other->hi == slab.hi)
                continue;
            if (const CellOperand& o = *operands_.at(s); containments(slab, o)) drop(slab, o);
        }
    }
}

bool Covering::containments(const Slab& slab, const CellOperand& o) const {
    const std::size_t k = slab.axis;
    if (o.unbounded || !o.embedded || !o.is_list) return false;
    const bool has_lo = slab.lo != task_.cell.lo[k];
    const bool has_hi = slab.hi != task_.cell.hi[k];
    for (const PackedBox& e : o.list()) {
        const Box box = o.polygon(e.id).box();
        if (has_lo && box.lo[k] * splitting_scale < slab.lo) return false;
        if (has_hi && box.hi[k] * splitting_scale > slab.hi) return false;
    }
    // Nothing of the operand's boundary is beyond the slab, so one point there decides.
    const auto between = [](std::int64_t a, std::int64_t b) { return a + (b - a) / 2; };
    return (!has_lo || is_outside_at(o, k, between(task_.cell.lo[k], slab.lo))) &&
           (!has_hi || is_outside_at(o, k, between(slab.hi, task_.cell.hi[k])));
}

bool Covering::is_outside_at(const CellOperand& o, std::size_t axis, std::int64_t position) const {
    FinePoint p = task_.reference;
    if (p.c[axis] == position) return o.winding == 0;
    p.c[axis] = position;
    AxisTrace trace(task_.reference, p, static_cast<int>(axis));
    for (const PackedBox& e : o.list()) trace.add(o.polygon(e.id));
    const auto change = trace.change(o.complemented);
    return change && o.winding + *change == 0;
}

void Covering::drop(const Slab& slab, const CellOperand& o) {
    values_[static_cast<std::size_t>(o.slot)] = 0;
    any_ = true;
    for (const PackedBox& e : o.list()) {
        const PolygonRef r = o.polygon(e.id);
        AxisPolygon<std::int64_t> p;
        if (p.read(r) && p.plane.axis == slab.axis && !task_.cell.contains(r.box()) &&
            (p.plane.position == slab.lo || p.plane.position == slab.hi))
            incomplete_.push_back({r.source->serial(), r.facet});
    }
}

}  // namespace

std::optional<Slab> slab_of(const CellOperand& operand, const CellTask& task) {
    if (!operand.embedded || !operand.is_list || operand.count > most_polygons) return std::nullopt;
    const Cell& cell = task.cell;
    const auto box = AxisBox<std::int64_t>::of(cell);
    std::vector<std::int64_t> positions;
    Slab slab{operand.slot, 3, 0, 0};
    for (const PackedBox& e : operand.list()) {
        AxisPolygon<std::int64_t> p;
        if (!p.read(operand.polygon(e.id))) return std::nullopt;
        // Of a slanted fragment only a box is known that may be too large.
        if (p.ref.fragment != nullptr && p.slanted_count != 0) return std::nullopt;
        if (!p.meets(box)) continue;
        if (slab.axis != 3 && slab.axis != p.plane.axis) return std::nullopt;
        slab.axis = p.plane.axis;
        positions.push_back(p.plane.position);
    }
    std::ranges::sort(positions);
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    if (positions.empty() || positions.size() > 2) return std::nullopt;
    const std::int64_t at = task.reference.c[slab.axis];
    const auto below =
        static_cast<std::size_t>(std::ranges::lower_bound(positions, at) - positions.begin());
    const bool inside_first = (operand.winding > 0) == (below % 2 == 0);
    slab.lo = cell.lo[slab.axis];
    slab.hi = cell.hi[slab.axis];
    if (positions.size() == 2) {
        if (inside_first) return std::nullopt;
        slab.lo = positions[0];
        slab.hi = positions[1];
    } else if (inside_first) {
        slab.hi = positions[0];
    } else {
        slab.lo = positions[0];
    }
    return slab;
}

bool find_contained(const CellTask& task, SlotValues& values, std::vector<FacetName>& incomplete) {
    return Covering(task, values, incomplete).run();
}

}  // namespace trisect::detail
