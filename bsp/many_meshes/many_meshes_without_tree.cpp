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
// cells are better: lines in which faces go straight across each other are edges of the result.
//
// Where meshes touch, operands are moved by less than any number (operand_shifts.h), which puts all
// in general position. Assembly moves them back: parts without an area are left out then. Facets
// that cover a part of a plane would leave a sheet of no thickness if they were moved the wrong
// way; then all is done once more with other moves.

#include <trisect/bsp/many_meshes/many_meshes_without_tree.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/many_meshes/common_part.h>
#include <trisect/bsp/many_meshes/outlined_solid.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>

namespace trisect::detail {

namespace {

// Fewer facets are not worth a thread of their own.
constexpr std::size_t parallel_facets = 2000;

const Source& source_of(const SolidState& solid) {
    return *solid.root().node->polygons().whole_source();
}

bool is_open_far_out(const SolidState& solid, const Crossings::Operand& operand) {
    return complemented_winding(solid.root().node->winding(), solid.root().complemented) ==
           operand.open;
}

// In how many boxes of operands a point of their common box lies, on average: so many, or this part
// of all where they are few.
constexpr double crowded_depth = 2.5;
constexpr double crowded_part = 0.3;

// The part of the common box that the first operand's has, where all others are tools in it.
constexpr double large_first_part = 0.5;

enum class Crowd : std::uint8_t { None, All, InFirst };

Crowd crowd_of(const SolidStates& solids) {
    Box all;
    for (const auto& s : solids) all.add(source_of(*s).box());
    const auto part_of = [&](const SolidState& solid) {
        const Box& box = source_of(solid).box();
        double part = 1;
        for (std::size_t k = 0; k < 3; ++k)
            part *= static_cast<double>(box.hi[k] - box.lo[k] + 1) /
                    static_cast<double>(all.hi[k] - all.lo[k] + 1);
        return part;
    };
    double sum = 0;
    for (const auto& s : solids) sum += part_of(*s);
    if (sum >= std::min(crowded_depth, crowded_part * static_cast<double>(solids.size())))
        return Crowd::All;
    return part_of(*solids[0]) >= large_first_part ? Crowd::InFirst : Crowd::None;
}

class BalancedTree {
public:
    BalancedTree(const ManyMeshes& meshes, const SolidStates& solids,
                 const EvaluateSettings& options, bool parallel)
        : meshes_(meshes),
          solids_(solids),
          options_(options),
          parallel_(parallel),
          first_is_last_(crowd_of(solids) == Crowd::InFirst) {}

    // What all operands leave open together.
    [[nodiscard]] std::optional<OutlinedSolid> of_all(EvaluateStats& stats) const {
        if (meshes_.nested != nullptr) return of_node(NestedFormula::root, stats);
        return of(0, static_cast<std::uint32_t>(solids_.size()), stats);
    }

    // Of all so far; in no order.
    template <class Each>
    void for_each_special(const Each& each) const {
        common_.for_each([&](const CommonPart& c) { each(c.special()); });
    }

private:
    // What operands [first, end) leave open together.
    [[nodiscard]] std::optional<OutlinedSolid> of(std::uint32_t first, std::uint32_t end,
                                                  EvaluateStats& stats) const {
        if (first + 1 == end)
            return whole_operand(
                meshes_, first,
                is_open_far_out(*solids_[first], meshes_.operands->operands[first]));
        const bool is_alone = first_is_last_ && first == 0;
        const std::uint32_t middle = is_alone ? 1 : first + (end - first) / 2;
        return common_of(
            facets_of(first, end), stats, [&](EvaluateStats& s) { return of(first, middle, s); },
            [&](EvaluateStats& s) { return of(middle, end, s); });
    }
    [[nodiscard]] std::optional<OutlinedSolid> of_node(std::uint32_t number,
                                                       EvaluateStats& stats) const {
        const NestedFormula::Node& node = meshes_.nested->node(number);
        if (node.slot >= 0) {
            const auto slot = static_cast<std::uint32_t>(node.slot);
            return of(slot, slot + 1, stats);
        }
        std::optional<OutlinedSolid> out = of_terms(node, 0, node.terms.size(), stats);
        if (out && node.unites) out->open_far_out = !out->open_far_out;
        return out;
    }
    // Of a union what is complement to all its terms.
    [[nodiscard]] std::optional<OutlinedSolid> of_terms(const NestedFormula::Node& node,
                                                        std::size_t first, std::size_t end,
                                                        EvaluateStats& stats) const {
        if (first + 1 == end) {
            std::optional<OutlinedSolid> out = of_node(node.terms[first], stats);
            if (out && node.unites) out->open_far_out = !out->open_far_out;
            return out;
        }
        const std::size_t middle = first + (end - first) / 2;
        std::optional<OutlinedSolid> out = common_of(
            facets_of_terms(node, first, end), stats,
            [&](EvaluateStats& s) { return of_terms(node, first, middle, s); },
            [&](EvaluateStats& s) { return of_terms(node, middle, end, s); });
        if (!out || is_special()) return std::nullopt;
        return out;
    }

    template <class Below, class Above>
    [[nodiscard]] std::optional<OutlinedSolid> common_of(std::size_t facets, EvaluateStats& stats,
                                                         const Below& below_by,
                                                         const Above& above_by) const {
        std::optional<OutlinedSolid> below;
        std::optional<OutlinedSolid> above;
        EvaluateStats of_above;
        const auto find_below = [&] { below = below_by(stats); };
        const auto find_above = [&] { above = above_by(of_above); };
        if (parallel_ && facets >= parallel_facets) {
            both_at_once(find_above, find_below);
        } else {
            find_below();
            if (below) find_above();
        }
        stats += of_above;
        if (!below || !above) return std::nullopt;
        CommonPart& common =
            common_.local([&] { return std::make_unique<CommonPart>(meshes_, options_); });
        return common.of(*std::move(below), *std::move(above), stats);
    }

    // Of this thread so far.
    [[nodiscard]] bool is_special() const {
        return !common_.local([&] { return std::make_unique<CommonPart>(meshes_, options_); })
                    .special()
                    .facets()
                    .empty();
    }
    [[nodiscard]] std::size_t facets_of_terms(const NestedFormula::Node& node, std::size_t first,
                                              std::size_t end) const {
        std::size_t n = 0;
        for (std::size_t i = first; i < end; ++i) {
            const NestedFormula::Node& term = meshes_.nested->node(node.terms[i]);
            n += term.slot >= 0
                     ? meshes_.sources[static_cast<std::size_t>(term.slot)]->facet_count()
                     : facets_of_terms(term, 0, term.terms.size());
        }
        return n;
    }
    [[nodiscard]] std::size_t facets_of(std::uint32_t first, std::uint32_t end) const {
        std::size_t n = 0;
        for (std::uint32_t i = first; i < end; ++i) n += meshes_.sources[i]->facet_count();
        return n;
    }
    const ManyMeshes& meshes_;
    const SolidStates& solids_;
    const EvaluateSettings& options_;
    bool parallel_;
    bool first_is_last_;  // with what all others leave open: its facets stay whole till then
    mutable PerThread<CommonPart> common_;
};

std::vector<OperandShifts::Growth> growths_of(const ManyMeshes& meshes) {
    std::vector<OperandShifts::Growth> out;
    for (std::size_t i = 0; i < meshes.sources.size(); ++i) {
        const Box& b = meshes.sources[i]->box();
        const auto middle = [&](std::size_t k) { return b.lo[k] + (b.hi[k] - b.lo[k]) / 2; };
        // What is left open gets smaller.
        out.push_back(
            {static_cast<std::int8_t>(meshes.operands->operands[i].is_open_below() ? -1 : 1),
             {middle(0), middle(1), middle(2)}});
    }
    return out;
}

// What all operands leave open together, and the facets in special position.
struct CommonOfAll {
    OutlinedSolid solid;
    std::vector<std::uint32_t> special;  // ascending
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
    for (const OutlinedSolid::Facet& f : common.solid.facets) {
        if (is_special[f.number] != 0) continue;
        const auto edges = common.solid.edges_of(f);
        if (std::ranges::any_of(edges, [&](const OutlinedSolid::Edge& e) {
                return e.line != nullptr &&
                       (is_special[e.line->facets[0]] != 0 || is_special[e.line->facets[1]] != 0);
            }))
            common.special.push_back(f.number);
    }
    std::ranges::sort(common.special);
}

// Nothing where it cannot be found.
std::optional<CommonOfAll> common_of_all(ManyMeshes& meshes, const SolidStates& solids,
                                         const EvaluateSettings& options, std::uint32_t threads,
                                         EvaluateStats& stats) {
    std::vector<OperandShifts::Growth> growths = growths_of(meshes);
    std::optional<OperandShifts> shifts(growths);
    std::vector<OperandShifts::Wanted> wanted;
    constexpr int most_turns = 4;
    for (int turn = 0; turn < most_turns && shifts; ++turn) {
        meshes.shifts = &*shifts;
        const BalancedTree tree(meshes, solids, options, threads != 1);
        EvaluateStats made;
        auto solid = tree.of_all(made);
        if (!solid) return std::nullopt;
        CommonOfAll out{*std::move(solid), {}};
        bool as_wanted = true;
        tree.for_each_special([&](const SpecialPosition& s) {
            out.special.insert(out.special.end(), s.facets().begin(), s.facets().end());
            for (const OperandShifts::Wanted& w : s.wanted()) {
                as_wanted = as_wanted && shifts->satisfies(w);
                wanted.push_back(w);
            }
        });
        if (meshes.nested != nullptr && !out.special.empty()) return std::nullopt;
        if (as_wanted) {
            add_sharing(out, meshes.facet_count());
            stats = made;
            return out;
        }
        std::ranges::sort(wanted);
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        shifts = OperandShifts::satisfying(growths, wanted);
    }
    return std::nullopt;
}

// By what assembly needs.
UndividedMeshes form_of(const OutlinedSolid& solid, const ManyMeshes& meshes,
                        const Crossings& operands, std::shared_ptr<const LazyTree> tree) {
    UndividedMeshes out;
    for (std::size_t i = 0; i < meshes.sources.size(); ++i)
        out.uncrossed.push_back({meshes.sources[i], operands.operands[i].inside_above, {}});
    auto outlined = std::make_shared<OutlinedFacets>();
    outlined->vertices = solid.vertices;
    for (const OutlinedSolid::Facet& f : solid.facets) {
        if (f.whole) {
            out.uncrossed[f.slot].facets.push_back(f.number - operands.operands[f.slot].first);
            continue;
        }
        outlined->facets.push_back(
            {f.number, static_cast<std::uint32_t>(outlined->edges.size()), f.count});
        for (const OutlinedSolid::Edge& e : solid.edges_of(f)) {
            const std::uint32_t cutter =
                e.line == nullptr ? 0 : e.line->facets[e.line->facets[0] == f.number ? 1 : 0];
            const std::uint32_t cutter_slot = meshes.slot_of(cutter);
            const bool open_below = e.line != nullptr && meshes.is_open_below(cutter_slot, f.slot);
            outlined->edges.push_back({e.from, e.to, cutter, e.own, open_below});
        }
    }
    out.outlined = std::move(outlined);
    out.crossings = std::make_shared<const Crossings>(operands);
    out.tree = std::move(tree);
    return out;
}

// Operands as in an intersection, of what they are or their complements.
std::optional<Crossings> nested_crossings(const Residual& formula, const SolidStates& solids) {
    const auto nested = NestedFormula::read(formula, solids.size());
    std::optional<Crossings> out = nested ? crossing_operands(solids) : std::nullopt;
    if (!out) return std::nullopt;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        Crossings::Operand& o = out->operands[i];
        o.open = nested->is_positive(i) ? 1 : 0;
        o.inside_above = o.flipped == nested->is_positive(i);
    }
    return out;
}

}  // namespace

bool may_be_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                        const EvaluateSettings& options) {
    if (solids.size() < 3 || options.budget != nullptr || options.max_memory != 0 ||
        (!crossings_of(*formula, solids) && !nested_crossings(*formula, solids)))
        return false;
    return std::ranges::all_of(solids, [](const auto& s) {
        return s->root().node->refinement() == nullptr &&
               lies_outside(s->root().node->reference(), source_of(*s).box());
    });
}

bool are_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                     const EvaluateSettings& options) {
    return may_be_many_meshes(formula, solids, options) && crowd_of(solids) != Crowd::None;
}

std::optional<SolidForm> evaluate_many_without_tree(const Residual::Ref& formula,
                                                    const SolidStates& solids,
                                                    const EvaluateSettings& options,
                                                    EvaluateStats& stats,
                                                    std::shared_ptr<const LazyTree> tree) {
    std::optional<Crossings> operands = crossings_of(*formula, solids);
    std::optional<NestedFormula> nested;
    if (!operands) {
        nested = NestedFormula::read(*formula, solids.size());
        operands = nested_crossings(*formula, solids);
    }
    ManyMeshes meshes;
    meshes.nested = nested ? &*nested : nullptr;
    meshes.operands = &*operands;
    Box all;
    for (const auto& s : solids) {
        meshes.sources.push_back(&source_of(*s));
        all.add(source_of(*s).box());
    }
    for (std::size_t k = 0; k < 3; ++k)
        meshes.extent[k] = static_cast<double>(all.hi[k] - all.lo[k] + 2);
    EvaluateStats made;
    auto result = on_threads(options.threads, [&](std::uint32_t threads) {
        return common_of_all(meshes, solids, options, threads, made);
    });
    if (!result) return std::nullopt;
    operands->special = std::move(result->special);
    UndividedMeshes form = form_of(result->solid, meshes, *operands, std::move(tree));
    for (const UncrossedFacets& u : form.uncrossed) made.untouched_polygons += u.facets.size();
    stats = made;
    return form;
}

}  // namespace trisect::detail
