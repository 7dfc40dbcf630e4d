// SPDX-License-Identifier: Apache-2.0
//
// In an exclusive or each facet bounds the result all over, on the one side or the other. So all
// crossings of all meshes are in the result, and so are all points where three facets meet:
// nothing is left to cut away first, and facets are compared as they are. Parities of corners,
// and their changes along edges and segments, say which side is in the result.
//
// Where meshes touch, they are moved by less than any number (operand_shifts.h). Two facets that
// cover a part of a plane leave a sheet of no thickness, whichever way they are moved, and assembly
// takes all sheets out (sheets.h).

#include <trisect/bsp/many_meshes/parity/exclusive_or_without_tree.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/parity/all_crossings.h>
#include <trisect/bsp/many_meshes/parity/parity_outlines.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

const Source& mesh_of_operand(const SolidState& solid) {
    return *solid.root().node->polygons().whole_source();
}

// Whether every operand comes once in exclusive ors and complements; counts these.
class ParityFormula {
public:
    explicit ParityFormula(std::size_t slots) : seen_(slots, 0) {}

    [[nodiscard]] bool read(const Residual& formula) {
        return add(formula) && std::ranges::none_of(seen_, [](auto n) { return n == 0; });
    }
    [[nodiscard]] bool is_negated() const { return negated_; }

private:
    [[nodiscard]] bool add(const Residual& f) {
        if (f.kind == Residual::Kind::Slot)
            return std::exchange(seen_[static_cast<std::size_t>(f.slot)], std::uint8_t{1}) == 0;
        if (f.kind == Residual::Kind::Not) negated_ = !negated_;
        return (f.kind == Residual::Kind::Not || f.kind == Residual::Kind::Xor) &&
               std::ranges::all_of(f.children, [&](const Residual::Ref& c) {
                   return with_enough_stack([&] { return add(*c); });
               });
    }

    std::vector<std::uint8_t> seen_;
    bool negated_ = false;
};

class ExclusiveOr {
public:
    using Touching = AllCrossings::Touching;

    ExclusiveOr(Crossings operands, const SolidStates& solids, const EvaluateSettings& options,
                Touching touching)
        : operands_(std::move(operands)), options_(options), touching_(touching) {
        meshes_.operands = &operands_;
        add_meshes(solids);
        shifts_.emplace(growths());
        meshes_.shifts = &*shifts_;
    }

    [[nodiscard]] std::optional<UndividedMeshes> evaluate(bool negated, std::uint32_t threads,
                                                          EvaluateStats& stats) {
        add_operands(negated);
        if (!find_pairs(threads, stats)) return std::nullopt;
        SpecialPosition special(meshes_.facet_count());
        const ShiftedPoints exact(meshes_, special);
        PiercedEdges pierced(all_, exact);
        if (!pierced.find(operands_.pairs, store_.vertices())) return std::nullopt;
        SegmentMeetings meetings(meshes_, operands_.pairs, pierced.ends());
        if (!meetings.find(store_.vertices(), threads)) return std::nullopt;
        see();
        CornerParities parities(views_, all_, pierced, exact);
        if (!parities.find(is_crossed_)) return std::nullopt;
        meetings.for_each_special([&](const SpecialPosition& s) { touches(s); });
        touches(special);
        list_special();
        if (touching_ == Touching::Stop && !operands_.special.empty()) return std::nullopt;
        ParityOutlines outlines(all_, operands_.pairs, pierced, meetings, parities);
        if (!outlines.find(is_crossed_)) return std::nullopt;
        return form(parities, outlines.take(), stats);
    }

private:
    using Solid = OutlineStore::Solid;

    void add_meshes(const SolidStates& solids) {
        Box all;
        for (const auto& s : solids) {
            const Source& source = mesh_of_operand(*s);
            meshes_.slots.insert(meshes_.slots.end(), source.facet_count(),
                                 static_cast<std::uint32_t>(meshes_.sources.size()));
            meshes_.sources.push_back(&source);
            meshes_.planes.add(source.mesh());
            all.add(source.box());
            const int winding =
                complemented_winding(s->root().node->winding(), s->root().complemented);
            is_below_far_out_.push_back((winding == 1) !=
                                        operands_.operands[is_below_far_out_.size()].flipped);
        }
        for (std::size_t k = 0; k < 3; ++k)
            meshes_.extent[k] = static_cast<double>(all.hi[k] - all.lo[k] + 2);
    }
    [[nodiscard]] std::vector<OperandShifts::Growth> growths() const {
        std::vector<OperandShifts::Growth> out;
        for (const Source* source : meshes_.sources) {
            const Box& b = source->box();
            const auto middle = [&](std::size_t k) { return b.lo[k] + (b.hi[k] - b.lo[k]) / 2; };
            OperandShifts::Growth& g = out.emplace_back();
            g.centre = {middle(0), middle(1), middle(2)};
            for (std::size_t k = 0; k < 3; ++k) g.size += b.hi[k] - b.lo[k];
        }
        return out;
    }
    // Where an even number of other meshes is around a facet, what lies below it is in an odd
    // number.
    void add_operands(bool negated) {
        for (const Crossings::Operand& o : operands_.operands) negated = negated != o.flipped;
        for (Crossings::Operand& o : operands_.operands) o.inside_above = negated;
        store_.reserve(meshes_);
        for (std::uint32_t i = 0; i < meshes_.sources.size(); ++i)
            solids_.push_back(store_.add_operand(meshes_, i, is_below_far_out_[i]));
        see();
    }
    // The store has moved.
    void see() {
        all_ = store_.view(solids_[0]);
        views_.clear();
        for (std::size_t i = 0; i < solids_.size(); ++i) {
            const bool is_last = i + 1 == solids_.size();
            views_.push_back(is_last ? store_.view(solids_[i])
                                     : store_.view(solids_[i], solids_[i + 1]));
        }
    }
    [[nodiscard]] bool find_pairs(std::uint32_t threads, EvaluateStats& stats) {
        AllCrossings crossings(meshes_, store_, solids_, options_, touching_, threads != 1);
        if (!crossings.find(operands_.pairs, stats)) return false;
        crossings.for_each_special([&](const SpecialPosition& s) { touches(s); });
        operands_.arrange();
        is_crossed_.resize(meshes_.facet_count());
        for (const FacetCrossing& c : operands_.pairs)
            is_crossed_[c.facets[0]] = is_crossed_[c.facets[1]] = 1;
        return true;
    }
    void touches(const SpecialPosition& special) {
        if (special.facets().empty()) return;
        is_special_.resize(meshes_.facet_count());
        for (const std::uint32_t f : special.facets()) is_special_[f] = 1;
    }
    // Vertices of others may lie in their edges; then facets that they cross need the same.
    void list_special() {
        operands_.special.clear();
        if (is_special_.empty()) return;
        const std::vector<std::uint8_t> touches = is_special_;
        for (const FacetCrossing& c : operands_.pairs)
            for (std::size_t k = 0; k < 2; ++k)
                if (touches[c.facets[k]] != 0) is_special_[c.facets[1 - k]] = 1;
        for (std::uint32_t f = 0; f < is_special_.size(); ++f)
            if (is_special_[f] != 0) operands_.special.push_back(f);
    }
    // Each operand comes twice, the second time with its facets turned the other way.
    [[nodiscard]] std::shared_ptr<const Crossings> both_sides() const {
        auto out = std::make_shared<Crossings>();
        const auto facets = static_cast<std::uint32_t>(meshes_.facet_count());
        for (const bool odd : {false, true})
            for (Crossings::Operand o : operands_.operands) {
                if (odd) o.first += facets;
                o.inside_above = o.inside_above != odd;
                out->operands.push_back(o);
            }
        for (const std::uint32_t first : {0U, facets})
            for (const std::uint32_t f : operands_.special) out->special.push_back(first + f);
        return out;
    }
    [[nodiscard]] UndividedMeshes form(const CornerParities& parities,
                                       std::shared_ptr<const OutlinedFacets> outlined,
                                       EvaluateStats& stats) const {
        UndividedMeshes out;
        out.crossings = both_sides();
        const std::size_t n = meshes_.sources.size();
        for (std::size_t i = 0; i < 2 * n; ++i)
            out.uncrossed.push_back(
                {meshes_.sources[i % n], out.crossings->operands[i].inside_above, {}});
        for (const OutlinedSolid::Facet& f : all_.facets) {
            if (is_crossed_[f.number] != 0) continue;
            const bool odd = parities.of_corner(all_.edges[f.first].from);
            out.uncrossed[odd ? n + f.slot : f.slot].facets.push_back(
                f.number - operands_.operands[f.slot].first);
            ++stats.untouched_polygons;
        }
        out.may_have_straight_crossings = out.may_have_sheets = !operands_.special.empty();
        out.outlined = std::move(outlined);
        return out;
    }

    Crossings operands_;
    const EvaluateSettings& options_;
    Touching touching_;
    ManyMeshes meshes_;
    std::optional<OperandShifts> shifts_;
    std::vector<bool> is_below_far_out_;  // by slot
    OutlineStore store_;
    std::vector<Solid> solids_;
    OutlinedSolid all_;
    std::vector<OutlinedSolid> views_;
    std::vector<std::uint8_t> is_crossed_;  // by facet
    std::vector<std::uint8_t> is_special_;  // by facet, if there are some
};

std::optional<SolidForm> exclusive_or_of_meshes(
    const Residual::Ref& formula, const SolidStates& solids, const EvaluateSettings& options,
    AllCrossings::Touching touching, EvaluateStats& stats, std::shared_ptr<const LazyTree> tree) {
    ParityFormula parity(solids.size());
    if (!parity.read(*formula)) return std::nullopt;
    ExclusiveOr all(*crossing_operands(solids), solids, options, touching);
    EvaluateStats made;
    auto out = on_threads(options.threads, [&](std::uint32_t threads) {
        return all.evaluate(parity.is_negated(), threads, made);
    });
    if (!out) return std::nullopt;
    out->tree = std::move(tree);
    stats = made;
    return *std::move(out);
}

}  // namespace

bool is_exclusive_or_of_many(const Residual::Ref& formula, const SolidStates& solids,
                             const EvaluateSettings& options) {
    constexpr std::size_t most_facets = std::size_t{1} << 30;
    if (solids.size() < 3 || options.budget != nullptr || options.max_memory != 0 ||
        !crossing_operands(solids) || !ParityFormula(solids.size()).read(*formula))
        return false;
    std::size_t facets = 0;
    for (const auto& s : solids) facets += mesh_of_operand(*s).facet_count();
    return facets < most_facets && std::ranges::all_of(solids, [](const auto& s) {
               return s->root().node->refinement() == nullptr &&
                      lies_outside(s->root().node->reference(), mesh_of_operand(*s).box());
           });
}

std::optional<SolidForm> evaluate_exclusive_or_without_tree(const Residual::Ref& formula,
                                                            const SolidStates& solids,
                                                            const EvaluateSettings& options,
                                                            EvaluateStats& stats,
                                                            std::shared_ptr<const LazyTree> tree) {
    return exclusive_or_of_meshes(formula, solids, options, AllCrossings::Touching::Stop, stats,
                                  std::move(tree));
}

std::optional<SolidForm> evaluate_touching_exclusive_or(const Residual::Ref& formula,
                                                        const SolidStates& solids,
                                                        const EvaluateSettings& options,
                                                        EvaluateStats& stats,
                                                        std::shared_ptr<const LazyTree> tree) {
    return exclusive_or_of_meshes(formula, solids, options, AllCrossings::Touching::GoOn, stats,
                                  std::move(tree));
}

}  // namespace trisect::detail
