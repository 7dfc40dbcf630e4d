// SPDX-License-Identifier: Apache-2.0
//
// Solids come and go as on a stack: each half is a solid of the store of the thread that makes it,
// and what they have in common takes their place.

#include <trisect/bsp/many_meshes/balanced_tree.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include <trisect/bsp/many_meshes/beside_boundary.h>
#include <trisect/bsp/many_meshes/outlines/nested_formula.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/support/task_group.h>

namespace trisect::detail {

namespace {

// Fewer facets are not worth a thread of their own, nor are more parts than this: what a thread has
// made is copied when it comes to the other half.
constexpr std::size_t parallel_facets = 2000;
constexpr std::size_t most_parts = 256;

// Of fewer facets all are at hand.
constexpr std::size_t least_with_settled = 2000;

}  // namespace

BalancedTree::BalancedTree(const ManyMeshes& meshes, const SolidStates& solids,
                           const EvaluateSettings& options, bool parallel)
    : meshes_(meshes),
      options_(options),
      parallel_(parallel),
      least_in_parallel_(std::max(parallel_facets, meshes.facet_count() / most_parts)),
      order_(meshes, solids) {}

// What all operands leave open together.
std::optional<OutlineStore::Solid> BalancedTree::of_all(EvaluateStats& stats) const {
    if (meshes_.nested != nullptr) return of_node(NestedFormula::root, stats);
    if (!order_.first_is_last()) return of_rest(stats);
    if (order_.order().empty() && order_.clusters().empty()) return of_operand(0);
    return common_of(
        meshes_.facet_count(), stats, [&](EvaluateStats&) { return of_operand(0); },
        [&](EvaluateStats& s) { return of_rest(s); });
}

OutlineStore BalancedTree::take_store() { return std::move(common().store()); }

std::optional<OutlineStore::Solid> BalancedTree::of_operand(std::uint32_t slot) const {
    return common().store().add_operand(meshes_, slot, order_.is_open_far(slot));
}

std::optional<OutlineStore::Solid> BalancedTree::of_rest(EvaluateStats& stats) const {
    if (order_.clusters().empty()) return of(order_.order(), stats);
    if (order_.order().empty()) return of_clusters(order_.clusters(), stats);
    return common_of(
        meshes_.facet_count(), stats, [&](EvaluateStats& s) { return of(order_.order(), s); },
        [&](EvaluateStats& s) { return of_clusters(order_.clusters(), s); });
}

// What operands leave open together.
std::optional<OutlineStore::Solid> BalancedTree::of(Slots slots, EvaluateStats& stats) const {
    if (slots.size() == 1) return of_operand(slots[0]);
    const Slots first = slots.first(slots.size() / 2);
    const Slots second = slots.subspan(slots.size() / 2);
    return common_of(
        facets_of(slots), stats, [&](EvaluateStats& s) { return of(first, s); },
        [&](EvaluateStats& s) { return of(second, s); });
}

std::optional<OutlineStore::Solid> BalancedTree::of_clusters(Clusters clusters,
                                                             EvaluateStats& stats) const {
    std::size_t facets = 0;
    for (const auto& slots : clusters) facets += facets_of(slots);
    if (clusters.size() > 1 && parallel_ && facets >= least_in_parallel_) {
        const std::size_t half = clusters.size() / 2;
        const auto [one, other] = both(
            facets, stats, [&](EvaluateStats& s) { return of_clusters(clusters.first(half), s); },
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

std::optional<OutlineStore::Solid> BalancedTree::of_node(std::uint32_t number,
                                                         EvaluateStats& stats) const {
    const NestedFormula::Node& node = meshes_.nested->node(number);
    if (node.slot >= 0) return of_operand(static_cast<std::uint32_t>(node.slot));
    std::optional<Solid> out = of_node_with_settled(number, stats);
    // What comes last takes parts as they are.
    if (out && number != NestedFormula::root) join_settled(common().store(), *out);
    return out;
}

std::optional<OutlineStore::Solid> BalancedTree::of_node_with_settled(std::uint32_t number,
                                                                      EvaluateStats& stats) const {
    const NestedFormula::Node& node = meshes_.nested->node(number);
    std::optional<Solid> out =
        order_.has_neighbours(number)   ? of_terms_and_neighbours(number, stats)
        : has_one_of_neighbours(number) ? of_term_and_neighbours(number, stats)
                                        : of_terms(order_.terms(number), node.unites, stats);
    if (out && node.unites) out->open_far_out = !out->open_far_out;
    return out;
}

// Whether there are two terms, of which the second one is of neighbours alone.
bool BalancedTree::has_one_of_neighbours(std::uint32_t number) const {
    const Terms terms = order_.terms(number);
    return terms.size() == 2 && order_.has_neighbours(terms[1]) && order_.terms(terms[1]).empty();
}

// The two, or their complements.
std::optional<OutlineStore::Solid> BalancedTree::of_term_and_neighbours(
    std::uint32_t number, EvaluateStats& stats) const {
    const Terms terms = order_.terms(number);
    const bool unites = meshes_.nested->node(number).unites;
    std::optional<Solid> boundary = of_node(terms[0], stats);
    if (!boundary) return std::nullopt;
    boundary->open_far_out = boundary->open_far_out != unites;
    const bool neighbours_unite = meshes_.nested->node(terms[1]).unites;
    return of_boundary_and_neighbours(number, *boundary, order_.neighbours(terms[1]),
                                      unites != neighbours_unite, stats);
}

std::optional<OutlineStore::Solid> BalancedTree::of_terms_and_neighbours(
    std::uint32_t number, EvaluateStats& stats) const {
    if (order_.terms(number).empty())
        return of_neighbours(order_.neighbours(number), ClearBox(), {}, stats);
    const bool unites = meshes_.nested->node(number).unites;
    const std::optional<Solid> boundary = of_terms(order_.terms(number), unites, stats);
    if (!boundary) return std::nullopt;
    return of_boundary_and_neighbours(number, *boundary, order_.neighbours(number), false, stats);
}

// What a solid and many neighbours leave open, or the complement of what these do; with settled
// parts. One after the other, each on all threads: one that waits for the other one would do
// nothing else.
std::optional<OutlineStore::Solid> BalancedTree::of_boundary_and_neighbours(
    std::uint32_t number, const Solid& boundary, Slots slots, bool complements,
    EvaluateStats& stats) const {
    const std::uint32_t threads = parallel_ ? 0 : 1;
    BesideBoundary beside(common(), meshes_, boundary, slots, threads);
    // What comes last takes parts as they are.
    const Settling how{&beside.sides(), number == NestedFormula::root ? &meshes_ : nullptr};
    std::optional<Solid> neighbours = of_neighbours(slots, ClearBox(), how, stats);
    if (!neighbours) return std::nullopt;
    neighbours->open_far_out = neighbours->open_far_out != complements;
    const Solid near = beside.take(*neighbours);
    return common().of(boundary, near, stats, {beside.known(), threads});
}

// Of operands in the order of space, or of their complements, each of which leaves open what is
// far out. With settled parts.
std::optional<OutlineStore::Solid> BalancedTree::of_neighbours(Slots slots, const ClearBox& clear,
                                                               const Settling& how,
                                                               EvaluateStats& stats) const {
    if (slots.size() == 1) {
        Solid one = common().store().add_operand(meshes_, slots[0], true);
        if (how.sides != nullptr) one.united = slots;
        if (clear.is_all() && how.sides != nullptr) settle_rest(common().store(), one, how);
        return one;
    }
    const Slots first = slots.first(slots.size() / 2);
    const Slots second = slots.subspan(slots.size() / 2);
    const std::size_t facets = facets_of(slots);
    std::optional<Solid> out = common_of(
        facets, stats,
        [&](EvaluateStats& s) {
            const ClearBox rest = clear.without(order_.boxes(), second, first);
            return of_neighbours(first, rest, how, s);
        },
        [&](EvaluateStats& s) {
            const ClearBox rest = clear.without(order_.boxes(), first, second);
            return of_neighbours(second, rest, how, s);
        });
    if (!out) return std::nullopt;
    if (how.sides != nullptr) out->united = slots;
    if (!clear.is_all()) {
        if (facets >= least_with_settled && slots.size() >= 8)
            settle(common().store(), *out, clear, how);
    } else if (how.sides != nullptr) {
        settle_rest(common().store(), *out, how);
    }
    return out;
}

// Of a union what is complement to all its terms.
std::optional<OutlineStore::Solid> BalancedTree::of_terms(Terms terms, bool unites,
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

template <class Below, class Above>
BalancedTree::Pair BalancedTree::both(std::size_t facets, EvaluateStats& stats,
                                      const Below& below_by, const Above& above_by) const {
    Pair out;
    EvaluateStats of_above;
    if (parallel_ && facets >= least_in_parallel_) {
        out = both_in_parallel([&] { return below_by(stats); }, [&] { return above_by(of_above); });
    } else {
        out.first = below_by(stats);
        if (out.first) out.second = above_by(of_above);
    }
    stats += of_above;
    return out;
}

// What is above lies behind what is below where this thread comes to it, too. Else it comes from
// the store of the thread that made it. That may be this one, since a thread that waits makes other
// parts of the tree behind what it has, and takes them out.
template <class Below, class Above>
BalancedTree::Pair BalancedTree::both_in_parallel(const Below& below_by,
                                                  const Above& above_by) const {
    Pair out;
    std::optional<std::pair<SettledParts, Solid>> moved;
    std::atomic<bool> is_above_begun{false};
    FirstFailure failure;
    fork_join(
        [&] {
            if (is_above_begun.exchange(true)) return;
            failure.guard(0, [&] {
                const std::optional<Solid> made = or_nothing(above_by);
                if (made) moved.emplace(common().store().take_out(*made), *made);
            });
        },
        [&] {
            failure.guard(1, [&] { out.first = or_nothing(below_by); });
            if (is_above_begun.exchange(true)) return;
            failure.guard(0, [&] { out.second = or_nothing(above_by); });
        });
    failure.rethrow();
    HalfCounters& made = counters_of_thread<HalfCounters>;
    ++(moved ? made.moved : made.in_place);
    if (!moved || !out.first) return out;
    return {out.first, common().store().put(std::move(moved->first), moved->second)};
}

// Without leaving anything of what failed in the store, where others may follow.
template <class By>
std::optional<OutlineStore::Solid> BalancedTree::or_nothing(const By& by) const {
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
std::optional<OutlineStore::Solid> BalancedTree::common_of(std::size_t facets, EvaluateStats& stats,
                                                           const Below& below_by,
                                                           const Above& above_by) const {
    const auto [below, above] = both(facets, stats, below_by, above_by);
    if (!below || !above) return std::nullopt;
    // Most others wait for this one.
    const bool is_alone = parallel_ && facets > meshes_.facet_count() / 2;
    return common().of(*below, *above, stats, {{}, is_alone ? 0U : 1U});
}

// Of this thread.
CommonPart& BalancedTree::common() const {
    return common_.local([&] { return std::make_unique<CommonPart>(meshes_, options_); });
}

std::size_t BalancedTree::facets_of_terms(Terms terms) const {
    std::size_t n = 0;
    for (const std::uint32_t t : terms) {
        const std::int32_t slot = meshes_.nested->node(t).slot;
        n += slot >= 0 ? meshes_.sources[static_cast<std::size_t>(slot)]->facet_count()
                       : facets_of_terms(order_.terms(t));
        if (slot < 0 && order_.has_neighbours(t)) n += facets_of(order_.neighbours(t));
    }
    return n;
}

std::size_t BalancedTree::facets_of(Slots slots) const {
    std::size_t n = 0;
    for (const std::uint32_t s : slots) n += meshes_.sources[s]->facet_count();
    return n;
}

}  // namespace trisect::detail
