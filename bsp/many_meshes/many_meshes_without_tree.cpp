// SPDX-License-Identifier: Apache-2.0
//
// In such a formula an operand bounds the result where all others are open (crossings.h), so it is
// an intersection, of what the operands leave open. It is made pair by pair, in a balanced tree:
// operands that fill one place cut each other down, and a facet is compared with what is left of
// the others. Where all were compared with all, most crossings would not be in the result.
//
// Intermediate results are parts of whole facets by name (outlined_solid.h), so nothing gets less
// exact on the way, and no polygon is cut.
//
// Of unions and intersections of each other the terms of the innermost come first. A union is the
// complement of what the complements of its terms have in common. Where something touches there,
// faces of the result may go straight across each other in a line that an outline lacks; assembly
// looks for such lines.
//
// Where meshes touch, operands are moved by less than any number (operand_shifts.h), which puts all
// in general position. Assembly moves them back: parts without an area are left out then. Facets
// that cover a part of a plane leave a sheet of no thickness if they are moved the wrong way; then
// all is done once more with other moves. Where no moves serve all of them, as for tubes within
// each other whose ends are flush, assembly takes the sheets out (sheets.h).

#include <trisect/bsp/many_meshes/many_meshes_without_tree.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/many_meshes/beside_boundary.h>
#include <trisect/bsp/many_meshes/common_part.h>
#include <trisect/bsp/many_meshes/crowd.h>
#include <trisect/bsp/many_meshes/decided_operands.h>
#include <trisect/bsp/many_meshes/formula_reach.h>
#include <trisect/bsp/many_meshes/operand_clusters.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/outlines/settled_parts.h>
#include <trisect/bsp/many_meshes/thin_facets.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/thread_pool.h>
#include <trisect/kernel/support/touched_room.h>

namespace trisect::detail {

namespace {

// Fewer facets are not worth a thread of their own, nor are more parts than this: what a thread has
// made is copied when it comes to the other half.
constexpr std::size_t parallel_facets = 2000;
constexpr std::size_t most_parts = 256;

const Source& source_of(const SolidState& solid) {
    return *solid.root().node->polygons().whole_source();
}

bool is_open_far_out(const SolidState& solid, const Crossings::Operand& operand) {
    return complemented_winding(solid.root().node->winding(), solid.root().complemented) ==
           operand.open;
}

// So few facets are compared pair by pair wherever they are, where enough operands may touch
// others: cells would be arranged exactly. More are where most may bound the result.
constexpr std::size_t few_facets = 20000;

std::vector<Box> boxes_of(const SolidStates& solids) {
    std::vector<Box> boxes;
    for (const auto& s : solids) boxes.push_back(source_of(*s).box());
    return boxes;
}

bool are_few(const SolidStates& solids) {
    std::size_t facets = 0;
    for (const auto& s : solids) facets += source_of(*s).facet_count();
    return facets <= few_facets;
}

// Whether facets are thin, by are_mostly_thin(): needles; of less thin ones, facets of formulas in
// two levels.
constexpr double thin = 40;
constexpr double thin_of_nested = 8;
constexpr std::size_t least_of_thin = 128;  // facets an operand

bool are_thin(const Residual& formula, const SolidStates& solids) {
    std::vector<const Source*> sources;
    std::size_t facets = 0;
    for (const auto& s : solids) {
        sources.push_back(&source_of(*s));
        facets += source_of(*s).facet_count();
    }
    if (facets < least_of_thin * sources.size()) return false;
    return are_mostly_thin(sources, crossings_of(formula, solids) ? thin : thin_of_nested);
}

// About how many facets of an imported mesh are beside a box, by some of them.
std::size_t facets_beside(const Source& source, const Box& box) {
    constexpr std::size_t most_looked_at = 64;
    const LatticeMesh& mesh = source.mesh();
    const std::size_t count = source.facet_count();
    if (!source.box().overlaps(box)) return count;
    if (box.intersected(source.box()) == source.box()) return 0;
    const std::size_t looked_at = std::min(count, most_looked_at);
    std::size_t beside = 0;
    for (std::size_t i = 0; i < looked_at; ++i) {
        Box facet;
        for (const std::uint32_t corner : mesh.triangles[i * count / looked_at])
            facet.add(mesh.points[corner]);
        if (!facet.overlaps(box)) ++beside;
    }
    return beside * count / looked_at;
}

// Whether most facets are beside all that the result may have, as in an intersection of what is
// scattered, or a small part less large ones: cells drop them at once.
bool are_mostly_beside(const Residual& formula, const SolidStates& solids) {
    const std::optional<Box> reach = reach_of(formula, solids);
    if (!reach) return false;
    if (reach->is_empty()) return true;
    std::size_t beside = 0;
    std::size_t all = 0;
    for (const auto& s : solids) {
        all += source_of(*s).facet_count();
        beside += facets_beside(source_of(*s), *reach);
    }
    return 2 * beside > all;
}

class BalancedTree {
public:
    using Solid = OutlineStore::Solid;

    BalancedTree(const ManyMeshes& meshes, const SolidStates& solids,
                 const EvaluateSettings& options, bool parallel)
        : meshes_(meshes),
          solids_(solids),
          options_(options),
          parallel_(parallel),
          least_in_parallel_(std::max(parallel_facets, meshes.facet_count() / most_parts)) {
        if (meshes.nested == nullptr)
            set_order();
        else
            set_terms();
    }

    // What all operands leave open together.
    [[nodiscard]] std::optional<Solid> of_all(EvaluateStats& stats) const {
        if (meshes_.nested != nullptr) return of_node(NestedFormula::root, stats);
        if (!first_is_last_) return of_rest(stats);
        if (order_.empty() && clusters_.empty()) return of_operand(0);
        return common_of(
            meshes_.facet_count(), stats, [&](EvaluateStats&) { return of_operand(0); },
            [&](EvaluateStats& s) { return of_rest(s); });
    }
    // With what that is of, once it is all. The lines of all threads are with it.
    [[nodiscard]] std::pair<OutlineStore, OutlineStore::Lines> take_store() {
        OutlineStore::Lines lines;
        common_.for_each([&](CommonPart& c) {
            for (auto& l : c.store().take_lines()) lines.push_back(std::move(l));
        });
        return {std::move(common().store()), std::move(lines)};
    }

    // Of all so far; in no order.
    template <class Each>
    void for_each_special(const Each& each) const {
        common_.for_each([&](const CommonPart& c) { each(c.special()); });
    }

private:
    using Slots = std::span<const std::uint32_t>;
    using Clusters = std::span<const std::vector<std::uint32_t>>;

    // Operands that leave open what is far out, as tools do, are clustered: of two that are apart
    // nothing is compared. Others cut down whatever they meet. Where all tools are in the first
    // operand, its facets stay whole until all of them come. Tools beside all that the others leave
    // open do nothing. Where operands do not fill one place neighbours come first: then most of a
    // solid is far from the other one.
    void set_order() {
        const std::vector<Box> boxes = boxes_of(solids_);
        const Crowd crowd = crowd_of(boxes);
        first_is_last_ = crowd == Crowd::InFirst;
        const std::optional<Box> reach = reach_of(boxes);
        std::vector<std::uint32_t> all;
        std::vector<std::uint32_t> bounded;
        for (std::uint32_t i = 0; i < solids_.size(); ++i) {
            if (first_is_last_ && i == 0) continue;
            if (reach && is_open_far(i) && !boxes[i].overlaps(*reach)) continue;
            all.push_back(i);
            (is_open_far(i) ? bounded : order_).push_back(i);
        }
        clusters_ = operand_clusters(boxes, bounded);
        if (crowd != Crowd::All) {
            for (auto& cluster : clusters_) order_in_space(boxes, cluster);
            if (bounded.size() == all.size()) order_in_space(boxes, all);
        }
        if (clusters_.size() > 1) return;
        clusters_.clear();
        order_ = std::move(all);
    }
    // Terms of nested operations.
    void set_terms() {
        const NestedFormula& nested = *meshes_.nested;
        for (std::uint32_t n = 0; n < nested.size(); ++n) terms_.push_back(nested.node(n).terms);
        if (!meshes_.neighbours_come_first) return;
        boxes_ = boxes_of(solids_);
        neighbours_.resize(terms_.size());
        for (std::uint32_t n = 0; n < terms_.size(); ++n)
            if (terms_[n].size() >= least_ordered) order_terms(n);
    }
    using Terms = std::vector<std::uint32_t>;
    static constexpr std::size_t least_ordered = 32;
    // Of fewer facets all are at hand.
    static constexpr std::size_t least_with_settled = 2000;

    // Operands first, or as neighbours.
    void order_terms(std::uint32_t node) {
        Terms& terms = terms_[node];
        std::vector<std::uint32_t> slots;
        Terms others;
        for (const std::uint32_t t : terms) {
            const std::int32_t slot = meshes_.nested->node(t).slot;
            if (slot < 0)
                others.push_back(t);
            else
                slots.push_back(static_cast<std::uint32_t>(slot));
        }
        order_in_space(boxes_, slots);
        terms.clear();
        for (const std::uint32_t s : slots) terms.push_back(meshes_.nested->leaf(s));
        terms.insert(terms.end(), others.begin(), others.end());
        const bool unites = meshes_.nested->node(node).unites;
        if (std::ranges::any_of(slots, [&](std::uint32_t s) { return is_open_far(s) == unites; }))
            return;
        neighbours_[node] = std::move(slots);
        terms = std::move(others);
    }

    // A box with what all leave open together: other operands leave all of it open, or none if it
    // is empty.
    [[nodiscard]] std::optional<Box> reach_of(std::span<const Box> boxes) const {
        std::optional<Box> out;
        for (std::uint32_t i = 0; i < solids_.size(); ++i)
            if (!is_open_far(i)) out = out ? out->intersected(boxes[i]) : boxes[i];
        if (out && out->is_empty()) out.reset();
        return out;
    }
    [[nodiscard]] bool is_open_far(std::uint32_t slot) const {
        return is_open_far_out(*solids_[slot], meshes_.operands->operands[slot]);
    }

    [[nodiscard]] std::optional<Solid> of_operand(std::uint32_t slot) const {
        return common().store().add_operand(meshes_, slot, is_open_far(slot));
    }
    [[nodiscard]] std::optional<Solid> of_rest(EvaluateStats& stats) const {
        if (clusters_.empty()) return of(order_, stats);
        if (order_.empty()) return of_clusters(clusters_, stats);
        return common_of(
            meshes_.facet_count(), stats, [&](EvaluateStats& s) { return of(order_, s); },
            [&](EvaluateStats& s) { return of_clusters(clusters_, s); });
    }
    // What operands leave open together.
    [[nodiscard]] std::optional<Solid> of(Slots slots, EvaluateStats& stats) const {
        if (slots.size() == 1) return of_operand(slots[0]);
        const Slots first = slots.first(slots.size() / 2);
        const Slots second = slots.subspan(slots.size() / 2);
        return common_of(
            facets_of(slots), stats, [&](EvaluateStats& s) { return of(first, s); },
            [&](EvaluateStats& s) { return of(second, s); });
    }
    [[nodiscard]] std::optional<Solid> of_clusters(Clusters clusters, EvaluateStats& stats) const {
        std::size_t facets = 0;
        for (const auto& slots : clusters) facets += facets_of(slots);
        if (clusters.size() > 1 && parallel_ && facets >= least_in_parallel_) {
            const std::size_t half = clusters.size() / 2;
            const auto [one, other] = both(
                facets, stats,
                [&](EvaluateStats& s) { return of_clusters(clusters.first(half), s); },
                [&](EvaluateStats& s) { return of_clusters(clusters.subspan(half), s); });
            if (!one || !other) return std::nullopt;
            return common().store().united_apart(*one, *other);
        }
        Solid out = common().store().empty_solid(true);
        for (const auto& slots : clusters) {
            const std::optional<Solid> solid = of(slots, stats);
            if (!solid) return std::nullopt;
            out = common().store().united_apart(out, *solid);
        }
        return out;
    }
    [[nodiscard]] std::optional<Solid> of_node(std::uint32_t number, EvaluateStats& stats) const {
        const NestedFormula::Node& node = meshes_.nested->node(number);
        if (node.slot >= 0) return of_operand(static_cast<std::uint32_t>(node.slot));
        std::optional<Solid> out = of_node_with_settled(number, stats);
        // What comes last takes parts as they are.
        if (out && number != NestedFormula::root) join_settled(common().store(), *out);
        return out;
    }
    [[nodiscard]] std::optional<Solid> of_node_with_settled(std::uint32_t number,
                                                            EvaluateStats& stats) const {
        const NestedFormula::Node& node = meshes_.nested->node(number);
        std::optional<Solid> out = has_neighbours(number) ? of_terms_and_neighbours(number, stats)
                                   : has_one_of_neighbours(number)
                                       ? of_term_and_neighbours(number, stats)
                                       : of_terms(terms_[number], node.unites, stats);
        if (out && node.unites) out->open_far_out = !out->open_far_out;
        return out;
    }
    [[nodiscard]] bool has_neighbours(std::uint32_t number) const {
        return number < neighbours_.size() && !neighbours_[number].empty();
    }
    // Whether there are two terms, of which the second one is of neighbours alone.
    [[nodiscard]] bool has_one_of_neighbours(std::uint32_t number) const {
        const std::vector<std::uint32_t>& terms = terms_[number];
        return terms.size() == 2 && has_neighbours(terms[1]) && terms_[terms[1]].empty();
    }
    // The two, or their complements.
    [[nodiscard]] std::optional<Solid> of_term_and_neighbours(std::uint32_t number,
                                                              EvaluateStats& stats) const {
        const Terms& terms = terms_[number];
        const bool unites = meshes_.nested->node(number).unites;
        std::optional<Solid> boundary = of_node(terms[0], stats);
        if (!boundary) return std::nullopt;
        boundary->open_far_out = boundary->open_far_out != unites;
        const bool neighbours_unite = meshes_.nested->node(terms[1]).unites;
        return of_boundary_and_neighbours(number, *boundary, neighbours_[terms[1]],
                                          unites != neighbours_unite, stats);
    }
    [[nodiscard]] std::optional<Solid> of_terms_and_neighbours(std::uint32_t number,
                                                               EvaluateStats& stats) const {
        if (terms_[number].empty())
            return of_neighbours(neighbours_[number], ClearBox(), {}, stats);
        const bool unites = meshes_.nested->node(number).unites;
        const std::optional<Solid> boundary = of_terms(terms_[number], unites, stats);
        if (!boundary) return std::nullopt;
        return of_boundary_and_neighbours(number, *boundary, neighbours_[number], false, stats);
    }
    // What a solid and many neighbours leave open, or the complement of what these do; with settled
    // parts. One after the other, each on all threads: one that waits for the other one would do
    // nothing else.
    [[nodiscard]] std::optional<Solid> of_boundary_and_neighbours(std::uint32_t number,
                                                                  const Solid& boundary,
                                                                  Slots slots, bool complements,
                                                                  EvaluateStats& stats) const {
        const std::uint32_t threads = parallel_ ? 0 : 1;
        BesideBoundary beside(common(), meshes_, boundary, slots, threads);
        // What comes last takes parts as they are.
        const Settling how{&beside.sides(), number == NestedFormula::root};
        std::optional<Solid> neighbours = of_neighbours(slots, ClearBox(), how, stats);
        if (!neighbours) return std::nullopt;
        neighbours->open_far_out = neighbours->open_far_out != complements;
        const Solid near = beside.take(*neighbours);
        const std::optional<Solid> out = common().of(boundary, near, stats, beside.known());
        if (out) beside.drop(*out);
        return out;
    }
    // Of operands in the order of space, or of their complements, each of which leaves open what is
    // far out. With settled parts.
    [[nodiscard]] std::optional<Solid> of_neighbours(Slots slots, const ClearBox& clear,
                                                     const Settling& how,
                                                     EvaluateStats& stats) const {
        if (slots.size() == 1) {
            Solid one = common().store().add_operand(meshes_, slots[0], true);
            if (clear.is_all() && how.sides != nullptr) settle_rest(common().store(), one, how);
            return one;
        }
        const Slots first = slots.first(slots.size() / 2);
        const Slots second = slots.subspan(slots.size() / 2);
        const std::size_t facets = facets_of(slots);
        std::optional<Solid> out = common_of(
            facets, stats,
            [&](EvaluateStats& s) {
                const ClearBox rest = clear.without(boxes_, second, first);
                return of_neighbours(first, rest, how, s);
            },
            [&](EvaluateStats& s) {
                const ClearBox rest = clear.without(boxes_, first, second);
                return of_neighbours(second, rest, how, s);
            });
        if (!out) return std::nullopt;
        if (!clear.is_all()) {
            if (facets >= least_with_settled && slots.size() >= 8)
                settle(common().store(), *out, clear, how);
        } else if (how.sides != nullptr) {
            settle_rest(common().store(), *out, how);
        }
        return out;
    }

    // Of a union what is complement to all its terms.
    [[nodiscard]] std::optional<Solid> of_terms(std::span<const std::uint32_t> terms, bool unites,
                                                EvaluateStats& stats) const {
        if (terms.empty()) return common().store().empty_solid(true);
        if (terms.size() == 1) {
            std::optional<Solid> out = of_node(terms[0], stats);
            if (out && unites) out->open_far_out = !out->open_far_out;
            return out;
        }
        const std::size_t half = terms.size() / 2;
        const std::size_t facets = facets_of_terms(terms);
        return common_of(
            facets, stats, [&](EvaluateStats& s) { return of_terms(terms.first(half), unites, s); },
            [&](EvaluateStats& s) { return of_terms(terms.subspan(half), unites, s); });
    }

    using Pair = std::pair<std::optional<Solid>, std::optional<Solid>>;
    template <class Below, class Above>
    [[nodiscard]] Pair both(std::size_t facets, EvaluateStats& stats, const Below& below_by,
                            const Above& above_by) const {
        Pair out;
        EvaluateStats of_above;
        if (parallel_ && facets >= least_in_parallel_) {
            out = both_in_parallel([&] { return below_by(stats); },
                                   [&] { return above_by(of_above); });
        } else {
            out.first = below_by(stats);
            if (out.first) out.second = above_by(of_above);
        }
        stats += of_above;
        return out;
    }
    // What is above comes from the store of the thread that made it. What is below stays where it
    // is: a thread that waits makes other parts of the tree behind it, and takes them out.
    template <class Below, class Above>
    [[nodiscard]] Pair both_in_parallel(const Below& below_by, const Above& above_by) const {
        std::optional<Solid> below;
        std::optional<std::pair<SettledParts, Solid>> above;
        FirstFailure failure;
        fork_join(
            [&] {
                failure.guard(0, [&] {
                    const std::optional<Solid> made = or_nothing(above_by);
                    if (made) above.emplace(common().store().take_out(*made), *made);
                });
            },
            [&] { failure.guard(1, [&] { below = or_nothing(below_by); }); });
        failure.rethrow();
        if (!below || !above) return {};
        return {below, common().store().put(std::move(above->first), above->second)};
    }
    // Without leaving anything of what failed in the store, where others may follow.
    template <class By>
    [[nodiscard]] std::optional<Solid> or_nothing(const By& by) const {
        OutlineStore& store = common().store();
        const Solid before = store.empty_solid(true);
        try {
            std::optional<Solid> out = by();
            if (!out) store.cut_off(before);
            return out;
        } catch (...) {
            store.cut_off(before);
            throw;
        }
    }
    template <class Below, class Above>
    [[nodiscard]] std::optional<Solid> common_of(std::size_t facets, EvaluateStats& stats,
                                                 const Below& below_by,
                                                 const Above& above_by) const {
        const auto [below, above] = both(facets, stats, below_by, above_by);
        if (!below || !above) return std::nullopt;
        return common().of(*below, *above, stats);
    }
    // Of this thread.
    [[nodiscard]] CommonPart& common() const {
        return common_.local([&] { return std::make_unique<CommonPart>(meshes_, options_); });
    }

    [[nodiscard]] std::size_t facets_of_terms(std::span<const std::uint32_t> terms) const {
        std::size_t n = 0;
        for (const std::uint32_t t : terms) {
            const std::int32_t slot = meshes_.nested->node(t).slot;
            n += slot >= 0 ? meshes_.sources[static_cast<std::size_t>(slot)]->facet_count()
                           : facets_of_terms(terms_[t]);
            if (slot < 0 && has_neighbours(t)) n += facets_of(neighbours_[t]);
        }
        return n;
    }
    [[nodiscard]] std::size_t facets_of(Slots slots) const {
        std::size_t n = 0;
        for (const std::uint32_t s : slots) n += meshes_.sources[s]->facet_count();
        return n;
    }
    const ManyMeshes& meshes_;
    const SolidStates& solids_;
    const EvaluateSettings& options_;
    bool parallel_;
    std::size_t least_in_parallel_;  // facets
    // Of formulas that are not nested: the first operand with what all others leave open, these in
    // order, and clusters, if there are several.
    bool first_is_last_ = false;
    std::vector<std::uint32_t> order_;
    std::vector<std::vector<std::uint32_t>> clusters_;
    // Of formulas that are nested, by node: its terms but neighbours, and the slots of these. Each
    // of them, or its complement in a union, leaves open what is far out.
    std::vector<std::vector<std::uint32_t>> terms_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
    std::vector<Box> boxes_;
    mutable PerThread<CommonPart> common_;
};

std::int64_t size_of(const Box& b) {
    return (b.hi[0] - b.lo[0]) + (b.hi[1] - b.lo[1]) + (b.hi[2] - b.lo[2]);
}

// What is left open gets smaller. But in a union of differences, where some meet as in a union and
// others as in a difference, all grow, and those that are subtracted more than the others.
OperandShifts::Growth growth_of(const ManyMeshes& meshes, std::uint32_t slot) {
    OperandShifts::Growth out;
    const bool shrinks = meshes.operands->operands[slot].is_open_below();
    out.sign = static_cast<std::int8_t>(shrinks ? -1 : 1);
    if (meshes.nested == nullptr) return out;
    out.cuts = !meshes.nested->is_positive(slot);
    if (!out.cuts && !meshes.nested->is_intersected(slot)) out.sign = 1;
    return out;
}

std::vector<OperandShifts::Growth> growths_of(const ManyMeshes& meshes) {
    std::vector<OperandShifts::Growth> out;
    for (std::size_t i = 0; i < meshes.sources.size(); ++i) {
        const Box& b = meshes.sources[i]->box();
        const auto middle = [&](std::size_t k) { return b.lo[k] + (b.hi[k] - b.lo[k]) / 2; };
        out.push_back(growth_of(meshes, static_cast<std::uint32_t>(i)));
        out.back().centre = {middle(0), middle(1), middle(2)};
        out.back().size = size_of(b);
    }
    return out;
}

// How often all may be done, and whether meshes grow and shrink the wrong way.
struct Turns {
    int most = 4;
    bool are_backwards = false;
};

// Sheets cost little beside another turn where so many facets come to each move that is wanted.
constexpr std::size_t facets_to_leave_sheets = 24;

// What all operands leave open together, and the facets in special position.
struct CommonOfAll {
    OutlineStore store;
    OutlineStore::Lines lines;           // that edges lie in
    std::vector<std::uint32_t> special;  // ascending
    bool has_sheets = false;             // or may have
};

// Facets in special position get vertices of others into their edges; then those that share an edge
// with them need the same.
void add_sharing(CommonOfAll& common, std::size_t facet_count) {
    if (common.special.empty()) return;
    std::vector<std::uint8_t> is_special(facet_count);
    for (const std::uint32_t f : common.special) is_special[f] = 1;
    common.special.clear();
    for (std::uint32_t f = 0; f < facet_count; ++f)
        if (is_special[f] != 0) common.special.push_back(f);
    const auto look = [&](const OutlinedSolid& part) {
        for (const OutlinedSolid::Facet& f : part.facets) {
            if (is_special[f.number] != 0) continue;
            const auto edges = part.edges_of(f);
            if (std::ranges::any_of(edges, [&](const OutlinedSolid::Edge& e) {
                    const FacetCrossing* line = e.origin.line();
                    return line != nullptr &&
                           (is_special[line->facets[0]] != 0 || is_special[line->facets[1]] != 0);
                }))
                common.special.push_back(f.number);
        }
    };
    const OutlinedSolid solid = common.store.view({});
    look(solid);
    for (const auto& part : solid.settled) look(part->view());
    std::ranges::sort(common.special);
}

// Nothing where it cannot be found. Sheets of no thickness are left where they are few, once no
// other moves are found, and after the last turn.
std::optional<CommonOfAll> common_of_all(ManyMeshes& meshes, const SolidStates& solids,
                                         const EvaluateSettings& options, const Turns& turns,
                                         std::uint32_t threads, EvaluateStats& stats) {
    std::vector<OperandShifts::Growth> growths = growths_of(meshes);
    for (OperandShifts::Growth& g : growths)
        if (turns.are_backwards) g.sign = static_cast<std::int8_t>(-g.sign);
    std::optional<OperandShifts> shifts(growths);
    std::vector<OperandShifts::Wanted> wanted;
    for (int turn = 0;; ++turn) {
        meshes.shifts = &*shifts;
        BalancedTree tree(meshes, solids, options, threads != 1);
        EvaluateStats made;
        if (!tree.of_all(made)) return std::nullopt;
        CommonOfAll out;
        bool as_wanted = true;
        tree.for_each_special([&](const SpecialPosition& s) {
            out.special.insert(out.special.end(), s.facets().begin(), s.facets().end());
            for (const OperandShifts::Wanted& w : s.wanted()) {
                as_wanted = as_wanted && shifts->satisfies(w);
                wanted.push_back(w);
            }
        });
        std::ranges::sort(wanted);
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        const bool leaves_sheets =
            turn + 1 == turns.most || facets_to_leave_sheets * wanted.size() < meshes.facet_count();
        std::optional<OperandShifts> next;
        if (!as_wanted && !leaves_sheets) next = OperandShifts::satisfying(growths, wanted);
        if (!next) {
            std::tie(out.store, out.lines) = tree.take_store();
            add_sharing(out, meshes.facet_count());
            out.has_sheets = !as_wanted;
            stats = made;
            return out;
        }
        shifts = std::move(next);
    }
}

using Parts = std::vector<OutlinedSolid>;

// Settled ones, and what is not, with these once more.
Parts parts_of(const OutlineStore& store) {
    Parts out;
    const OutlinedSolid solid = store.view({});
    for (const auto& part : solid.settled) out.push_back(part->view());
    out.push_back(solid);
    return out;
}

// Those vertices of parts that are wanted: most are of whole facets.
void take_vertices(OutlinedFacets& outlined, const Parts& parts, std::uint32_t threads) {
    constexpr std::uint32_t unused = ~std::uint32_t{0};
    std::size_t all = 0;
    for (const OutlinedSolid& p : parts) all += p.vertices.size();
    PoolVector<std::uint32_t> numbers(all, unused);
    for (const OutlinedFacets::Edge& e : outlined.edges) numbers[e.from] = numbers[e.to] = 0;
    reserve_touched(outlined.vertices,
                    static_cast<std::size_t>(std::ranges::count(numbers, std::uint32_t{0})),
                    threads);
    FlatMap shared;
    std::uint32_t* number = numbers.data();
    const auto take = [&](const OutlineVertex& v) {
        const auto next = static_cast<std::uint32_t>(outlined.vertices.size());
        *number = next;
        if (v.is_shared)
            *number = static_cast<std::uint32_t>(
                shared.insert(name_of(v), static_cast<std::int32_t>(next)).first);
        if (*number == next) outlined.vertices.push_back(v);
    };
    for (const OutlinedSolid& p : parts)
        for (const OutlineVertex& v : p.vertices) {
            if (*number != unused) take(v);
            ++number;
        }
    for (OutlinedFacets::Edge& e : outlined.edges) {
        e.from = numbers[e.from];
        e.to = numbers[e.to];
    }
}

// A facet of which there is a part.
struct CutFacet {
    std::uint32_t number = 0;
    std::uint32_t slot = 0;
    std::uint32_t part = 0;
    std::uint32_t first = 0;  // of its edges
    std::uint32_t count = 0;
};

// Groups of operands leave them in an order of their own, those of one operand mostly ascending.
void sort_by_number(PoolVector<CutFacet>& facets, std::size_t slots) {
    if (std::ranges::is_sorted(facets, {}, &CutFacet::number)) return;
    PoolVector<std::uint32_t> next(slots + 1, 0);
    for (const CutFacet& f : facets) ++next[f.slot + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    PoolVector<CutFacet> sorted(facets.size());
    for (const CutFacet& f : facets) sorted[next[f.slot]++] = f;
    facets.swap(sorted);
    if (!std::ranges::is_sorted(facets, {}, &CutFacet::number))
        std::ranges::sort(facets, {}, &CutFacet::number);
}

// Whole ones go to their operands. Groups of operands leave all in an order of their own.
PoolVector<CutFacet> sort_facets(const Parts& parts, const Crossings& operands,
                                 UndividedMeshes& out) {
    PoolVector<CutFacet> cut;
    std::size_t count = 0;
    for (const OutlinedSolid& p : parts)
        count += static_cast<std::size_t>(
            std::ranges::count(p.facets, false, &OutlinedSolid::Facet::whole));
    cut.reserve(count);
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        for (const OutlinedSolid::Facet& f : parts[i].facets)
            if (f.whole)
                out.uncrossed[f.slot].facets.push_back(f.number - operands.operands[f.slot].first);
            else
                cut.push_back({f.number, f.slot, i, f.first, f.count});
    for (const auto& part : parts.back().settled)
        for (const SettledPart::Whole& w : part->whole_open)
            out.uncrossed[w.slot].facets.push_back(w.number - operands.operands[w.slot].first);
    for (UncrossedFacets& u : out.uncrossed)
        if (!std::ranges::is_sorted(u.facets)) std::ranges::sort(u.facets);
    sort_by_number(cut, operands.operands.size());
    return cut;
}

// With vertices by their numbers among those of all parts.
void add_cut_facets(OutlinedFacets& outlined, const Parts& parts, std::span<const CutFacet> cut,
                    const ManyMeshes& meshes, std::uint32_t threads) {
    outlined.facets.reserve(cut.size());
    std::uint32_t edge_count = 0;
    for (const CutFacet& f : cut) {
        outlined.facets.push_back({f.number, edge_count, f.count});
        edge_count += f.count;
    }
    outlined.edges.resize(edge_count);
    std::vector<std::uint32_t> first_vertices{0};
    for (const OutlinedSolid& p : parts)
        first_vertices.push_back(first_vertices.back() +
                                 static_cast<std::uint32_t>(p.vertices.size()));
    // Edges of a facet, and their lines, lie anywhere in memory.
    constexpr std::size_t ahead = 8;
    const auto look_ahead = [&](std::size_t i) {
        if (i + 2 * ahead < cut.size())
            __builtin_prefetch(&parts[cut[i + 2 * ahead].part].edges[cut[i + 2 * ahead].first]);
        if (i + ahead >= cut.size()) return;
        const CutFacet& f = cut[i + ahead];
        for (const OutlinedSolid::Edge& e : parts[f.part].edges.subspan(f.first, f.count))
            __builtin_prefetch(e.origin.line());
    };
    const auto add = [&](const CutFacet& f, OutlinedFacets::Edge* out) {
        const std::uint32_t vertex = first_vertices[f.part];
        for (const OutlinedSolid::Edge& e : parts[f.part].edges.subspan(f.first, f.count)) {
            const FacetCrossing* line = e.origin.line();
            const std::uint32_t cutter =
                line == nullptr ? 0 : line->facets[line->facets[0] == f.number ? 1 : 0];
            const bool open_below =
                line != nullptr && meshes.is_open_below(meshes.slot_of(cutter), f.slot);
            *out++ = {vertex + e.from, vertex + e.to, cutter, e.origin.own(), open_below};
        }
    };
    constexpr std::size_t least_facets = 8192;
    ParallelParts(cut.size(), threads, least_facets)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                look_ahead(i);
                add(cut[i], outlined.edges.data() + outlined.facets[i].first);
            }
        });
}

// By what assembly needs.
UndividedMeshes form_of(const OutlineStore& store, const ManyMeshes& meshes,
                        const Crossings& operands, std::shared_ptr<const LazyTree> tree,
                        std::uint32_t threads) {
    UndividedMeshes out;
    for (std::size_t i = 0; i < meshes.sources.size(); ++i)
        out.uncrossed.push_back({meshes.sources[i], operands.operands[i].inside_above, {}});
    auto outlined = std::make_shared<OutlinedFacets>();
    const Parts parts = parts_of(store);
    add_cut_facets(*outlined, parts, sort_facets(parts, operands, out), meshes, threads);
    take_vertices(*outlined, parts, threads);
    out.outlined = std::move(outlined);
    out.crossings = std::make_shared<const Crossings>(operands);
    out.tree = std::move(tree);
    return out;
}

// Operands as in an intersection, of what they are or their complements.
std::optional<Crossings> nested_crossings(const NestedFormula& nested, const SolidStates& solids) {
    std::optional<Crossings> out = crossing_operands(solids);
    if (!out) return std::nullopt;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        Crossings::Operand& o = out->operands[i];
        o.open = nested.is_positive(i) ? 1 : 0;
        o.inside_above = o.flipped == nested.is_positive(i);
    }
    return out;
}

bool is_nested(const Residual& formula, const SolidStates& solids) {
    const auto nested = NestedFormula::read(formula, solids.size());
    return nested && nested_crossings(*nested, solids);
}

// What is evaluated: all operands, but those of a nested formula that others decide.
struct Operands {
    SolidStates solids;
    std::optional<NestedFormula> nested;
    Crossings crossings;
    bool neighbours_come_first = false;
};

// Most of many small operands may be beside large ones: nothing is made for facets of these.
void leave_out_decided(Operands& all, std::uint32_t threads) {
    std::vector<const Source*> sources;
    std::vector<std::uint8_t> open_far_out;
    for (std::size_t i = 0; i < all.solids.size(); ++i) {
        sources.push_back(&source_of(*all.solids[i]));
        open_far_out.push_back(is_open_far_out(*all.solids[i], all.crossings.operands[i]) ? 1 : 0);
    }
    const std::vector<std::uint8_t> decided =
        decided_operands(*all.nested, sources, open_far_out, threads);
    SolidStates kept;
    for (std::size_t i = 0; i < all.solids.size(); ++i)
        if (decided[i] == 0) kept.push_back(all.solids[i]);
    if (kept.size() == all.solids.size() || kept.size() < 2) return;
    NestedFormula nested = all.nested->without(decided);
    std::optional<Crossings> crossings = nested_crossings(nested, kept);
    if (!crossings) return;
    all.solids = std::move(kept);
    all.nested = std::move(nested);
    all.crossings = *std::move(crossings);
}

// Where operands of a nested formula do not fill one place, neighbours among them come first, and
// those that others decide are left out.
Operands operands_of(const Residual& formula, const SolidStates& solids, std::uint32_t threads) {
    Operands out;
    out.solids = solids;
    if (auto flat = crossings_of(formula, solids)) {
        out.crossings = *std::move(flat);
        return out;
    }
    out.nested = NestedFormula::read(formula, solids.size());
    out.crossings = *nested_crossings(*out.nested, solids);
    out.neighbours_come_first = crowd_of(boxes_of(solids)) != Crowd::All;
    if (out.neighbours_come_first) leave_out_decided(out, threads);
    return out;
}

}  // namespace

bool may_be_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                        const EvaluateSettings& options) {
    if (solids.size() < 3 || options.budget != nullptr || options.max_memory != 0 ||
        (!crossings_of(*formula, solids) && !is_nested(*formula, solids)))
        return false;
    return std::ranges::all_of(solids, [](const auto& s) {
        return s->root().node->refinement() == nullptr &&
               lies_outside(s->root().node->reference(), source_of(*s).box());
    });
}

bool are_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                     const EvaluateSettings& options) {
    if (!may_be_many_meshes(formula, solids, options)) return false;
    const std::vector<Box> boxes = boxes_of(solids);
    const Crowd crowd = crowd_of(boxes);
    if (crowd == Crowd::All || crowd == Crowd::InFirst) return true;
    const bool few = are_few(solids);
    if (do_stand(boxes) || (few && may_touch_or_are_apart(boxes))) return true;
    if (are_mostly_beside(*formula, solids)) return false;
    // Few ones have been found not to touch.
    if (!crossings_of(*formula, solids) || (!few && may_touch_or_are_apart(boxes))) return true;
    return crowd == Crowd::Near || meets_many(boxes) || are_thin(*formula, solids);
}

bool do_fill_one_place(const SolidStates& solids) {
    return crowd_of(boxes_of(solids)) == Crowd::All;
}

bool do_stand_on_each_other(const SolidStates& solids) { return do_stand(boxes_of(solids)); }

bool are_nested(const SolidStates& solids) {
    std::vector<Box> boxes = boxes_of(solids);
    std::ranges::sort(boxes, {}, &size_of);
    return std::ranges::adjacent_find(boxes, [](const Box& inner, const Box& outer) {
               return size_of(inner) == size_of(outer) || outer.intersected(inner) != inner;
           }) == boxes.end();
}

namespace {

// The box is that of all operands, also those that are left out.
ManyMeshes meshes_of(const Operands& operands, const Box& all, std::uint32_t threads) {
    ManyMeshes out;
    out.nested = operands.nested ? &*operands.nested : nullptr;
    out.neighbours_come_first = operands.neighbours_come_first;
    out.operands = &operands.crossings;
    std::vector<const LatticeMesh*> meshes;
    std::size_t facets = 0;
    for (const auto& s : operands.solids) {
        const Source& source = source_of(*s);
        out.sources.push_back(&source);
        meshes.push_back(&source.mesh());
        facets += source.facet_count();
    }
    out.slots.reserve(facets);
    for (std::uint32_t slot = 0; slot < meshes.size(); ++slot)
        out.slots.insert(out.slots.end(), meshes[slot]->triangles.size(), slot);
    out.planes.add_all(meshes, threads);
    for (std::size_t k = 0; k < 3; ++k)
        out.extent[k] = static_cast<double>(all.hi[k] - all.lo[k] + 2);
    return out;
}

std::optional<SolidForm> evaluate_in_turns(const Turns& turns, const Residual::Ref& formula,
                                           const SolidStates& solids,
                                           const EvaluateSettings& options, EvaluateStats& stats,
                                           std::shared_ptr<const LazyTree> tree) {
    Operands operands = operands_of(*formula, solids, options.threads);
    Box all;
    for (const auto& s : solids) all.add(source_of(*s).box());
    ManyMeshes meshes = meshes_of(operands, all, options.threads);
    EvaluateStats made;
    auto result = on_threads(options.threads, [&](std::uint32_t threads) {
        return isolated(
            [&] { return common_of_all(meshes, operands.solids, options, turns, threads, made); });
    });
    if (!result) return std::nullopt;
    operands.crossings.special = std::move(result->special);
    UndividedMeshes form =
        form_of(result->store, meshes, operands.crossings, std::move(tree), options.threads);
    form.may_have_straight_crossings = operands.nested && !operands.crossings.special.empty();
    form.may_have_sheets = result->has_sheets;
    for (const UncrossedFacets& u : form.uncrossed) made.untouched_polygons += u.facets.size();
    stats = made;
    return form;
}

}  // namespace

std::optional<SolidForm> evaluate_many_without_tree(const Residual::Ref& formula,
                                                    const SolidStates& solids,
                                                    const EvaluateSettings& options,
                                                    EvaluateStats& stats,
                                                    std::shared_ptr<const LazyTree> tree) {
    return evaluate_in_turns({}, formula, solids, options, stats, std::move(tree));
}

std::optional<SolidForm> evaluate_many_with_sheets(const Residual::Ref& formula,
                                                   const SolidStates& solids,
                                                   const EvaluateSettings& options,
                                                   EvaluateStats& stats,
                                                   std::shared_ptr<const LazyTree> tree) {
    return evaluate_in_turns({.most = 1, .are_backwards = true}, formula, solids, options, stats,
                             std::move(tree));
}

}  // namespace trisect::detail
