// SPDX-License-Identifier: Apache-2.0
//
// Most facets of two large meshes do not come near the other mesh. To send them all down a tree
// takes half of an evaluation, and only queries of points, or later operations, need that tree. For
// a mesh of the result it is enough to find which facets cross, and on which side of the other mesh
// the others are.
//
// 1. A grid of a few thousand cubes shows which facets share a cube with the other mesh
//    (cube_grid.h): some of ten.
// 2. Where these meet in corners, edges and facets of both alone, nothing is cut: whole facets are
//    selected (conforming_meshes.h).
// 3. Else these alone are divided, down to cells with few of them, and compared there. Winding
// numbers
//    are not needed, so what does not meet the box of the other mesh's facets is left out.
// 4. Sides of facets follow from the crossings (facet_sides.cpp).
//
// An exclusive or is what either mesh has outside the other one, two results side by side. They
// touch in curves alone unless facets of opposite sides cover a part of one plane, and share the
// crossings where nothing is moved.
//
// Pairs that doubles leave open are decided by integers, as if one mesh were moved by less than any
// number (pair_search.cpp), or grew so. What is then still not known ends the attempt: the whole is
// evaluated as all else.

#include <trisect/bsp/two_meshes/two_meshes_without_tree.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/two_meshes/conforming/conforming_meshes.h>
#include <trisect/bsp/two_meshes/conforming_sides.h>
#include <trisect/bsp/two_meshes/cube_grid.h>
#include <trisect/bsp/two_meshes/equal_facets.h>
#include <trisect/bsp/two_meshes/facet_sides.h>
#include <trisect/bsp/two_meshes/pair_search.h>
#include <trisect/bsp/two_meshes/pairs_of_meshes.h>
#include <trisect/bsp/two_meshes/sides_of_both.h>
#include <trisect/bsp/two_meshes/two_meshes.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

// A box with a mesh of that many facets takes a third of the time that cells take where they touch,
// and nine tenths elsewhere.
constexpr std::size_t more_than_a_leaf = 64;
constexpr std::size_t facets_of_tetrahedron = 4;

std::size_t least_beside(std::size_t larger, std::size_t least_facets) {
    return larger < more_than_a_leaf ? least_facets : std::min(least_facets, facets_of_tetrahedron);
}

// All facets of both meshes that bound the result, where they are far from each other.
TwoLists facets_apart(const TwoMeshes& two, const SolidStates& solids, const Crossings& crossings) {
    TwoLists out;
    for (std::size_t i = 0; i < 2; ++i) {
        const Crossings::Operand& other = crossings.operands[1 - i];
        if (is_below_far_out(*solids[1 - i], other) != other.is_open_below()) continue;
        out[i].resize(two.meshes[i]->triangles.size());
        std::iota(out[i].begin(), out[i].end(), 0U);
    }
    return out;
}

// The facets that come near the other mesh, and what is found by them. Formulas over the same
// meshes are searched one after the other.
class TwoMeshSearch {
public:
    TwoMeshSearch(const TwoMeshes& two, const SolidStates& solids, const EvaluateSettings& options,
                  bool parallel)
        : two_(two),
          solids_(solids),
          options_(options),
          parallel_(parallel),
          memory_(options.max_memory) {
        if (two.common.is_empty()) return;
        both_.emplace(two, parallel);
        const auto& cubes = both_->cubes;
        held_[0] = memory_.hold(cubes[0]->bytes() + cubes[1]->bytes());
        do_both(
            parallel, [&] { near_[0] = cubes[0]->facets_in(cubes[1]->cubes(), threads()); },
            [&] { near_[1] = cubes[1]->facets_in(cubes[0]->cubes(), threads()); });
        held_[1] = memory_.hold((near_[0].size() + near_[1].size()) * sizeof(std::uint32_t));
    }

    // What bounds the result and is not crossed, of either mesh; nothing when that is not known.
    // `crossings` has the operands. Crossings are those of the formula before where both have them
    // in common.
    [[nodiscard]] std::optional<std::vector<UncrossedFacets>> find(Crossings& crossings,
                                                                   EvaluateStats& stats) {
        const bool is_first = std::exchange(is_first_, false);
        may_have_sheets_ = false;
        if (!both_) {
            times_shared_ += is_first ? 0 : 1;
            return keep(facets_apart(two_, solids_, crossings), crossings, stats);
        }
        if (auto facets = list_conforming(crossings)) {
            times_shared_ += is_first ? 0 : 1;
            ++stats.conforming_pairs;
            shares_facets_ = false;
            return keep(*std::move(facets), crossings, stats);
        }
        if (serves_again(crossings)) {
            if (auto facets = list_again(crossings)) {
                ++times_shared_;
                return keep(*std::move(facets), crossings, stats);
            }
        }
        PairsOfMeshes pairs(two_, near_, options_, memory_, parallel_, crossings);
        for (const bool recognises_equal : {true, false}) {
            EvaluateStats found;
            last_.reset();
            std::optional<FoundPairs> of_pairs = pairs.find({recognises_equal, !is_part_}, found);
            if (!of_pairs) return std::nullopt;
            last_.emplace(
                Last{*std::move(of_pairs), {two_, *both_, near_, solids_, parallel_}, crossings});
            auto facets = last_->sides.list(last_->found.crossings, last_->found.equal);
            // Where equal facets are all around others, nothing says on which side these are.
            if (!facets && last_->found.equal) continue;
            if (!facets) break;
            stats += found;
            last_->found.has_first_move = last_->found.has_first_move && recognises_equal;
            shares_facets_ = last_->found.shares_facets;
            may_have_sheets_ = last_->found.has_sheets;
            give(crossings);
            return keep(*std::move(facets), crossings, stats);
        }
        last_.reset();
        return std::nullopt;
    }

    // What a search in special position has found says nothing on shares_facets() of others.
    void forget_special_position() {
        if (last_ && !last_->found.is_general) last_.reset();
    }
    // Whether what is searched next is a part of a result beside another one.
    void set_part(bool is_part) { is_part_ = is_part; }
    // After this no other formula is searched.
    void end_with_next() { ends_with_next_ = true; }
    // Calls of find() with the crossings of the one before.
    [[nodiscard]] std::size_t times_shared() const { return times_shared_; }

    // Of the last formula that had a value.
    [[nodiscard]] std::shared_ptr<const EqualCorners> equal_corners() const {
        return conforming_ ? conforming_->found().equal_corners : nullptr;
    }

    // Whether some facet bounds the result for both meshes, which cover it from opposite sides.
    [[nodiscard]] bool shares_facets() const { return shares_facets_; }
    // Whether some do that would have to be moved out of each other.
    [[nodiscard]] bool may_have_sheets() const { return may_have_sheets_; }

private:
    [[nodiscard]] std::uint32_t threads() const { return threads_if(parallel_); }

    // Nothing where the meshes have to be cut. Found out once.
    [[nodiscard]] std::optional<TwoLists> list_conforming(const Crossings& crossings) {
        if (std::exchange(is_conforming_known_, true) && !conforming_) return std::nullopt;
        if (!conforming_) find_conforming(crossings);
        if (!conforming_) return std::nullopt;
        auto out = conforming_->list(crossings, is_part_);
        if (!out) conforming_.reset();
        return out;
    }

    void find_conforming(const Crossings& crossings) {
        const auto held = memory_.hold((near_[0].size() + near_[1].size()) * bytes_of_near);
        const auto search = [&](const PairsCheck& check, const std::vector<FacetLists>& lists) {
            PairSearch pairs(two_.nodes, options_, memory_, parallel_);
            pairs.parts = lists;
            pairs.check = &check;
            Crossings none = crossings;
            EvaluateStats stats;
            return !pairs.run(none, stats).is_hopeless;
        };
        if (auto found = trisect::detail::find_conforming(two_.meshes, {near_[0], near_[1]}, search,
                                                          threads()))
            conforming_.emplace(two_, *both_, near_, solids_, parallel_, *std::move(found));
    }

    // The last search.
    struct Last {
        FoundPairs found;
        SidesOfBoth sides;
        Crossings operands;
    };

    // Whether the crossings of the last search are those that another formula would find. In
    // general position nothing depends on it.
    [[nodiscard]] bool serves_again(const Crossings& crossings) const {
        if (!last_) return false;
        if (last_->found.is_general) return true;
        return last_->found.has_first_move &&
               crossings.operands[0].is_open_below() ==
                   last_->operands.operands[0].is_open_below() &&
               !are_flush_on_both_sides(two_, crossings);
    }

    [[nodiscard]] std::optional<TwoLists> list_again(Crossings& crossings) {
        FoundPairs& found = last_->found;
        if (found.equal)
            found.equal.emplace(two_.meshes, near_,
                                std::array{crossings.operands[0], crossings.operands[1]});
        found.crossings.operands = crossings.operands;
        auto facets = last_->sides.list(found.crossings, found.equal);
        if (facets) give(crossings);
        return facets;
    }

    // What was found, to the last formula without a copy.
    void give(Crossings& crossings) {
        if (ends_with_next_) {
            crossings = std::move(last_->found.crossings);
            last_.reset();
        } else {
            crossings = last_->found.crossings;
        }
    }

    std::vector<UncrossedFacets> keep(TwoLists facets, const Crossings& crossings,
                                      EvaluateStats& stats) {
        std::vector<UncrossedFacets> out;
        for (std::size_t i = 0; i < 2; ++i) {
            std::vector<std::uint32_t>& list = facets[i];
            stats.untouched_polygons += list.size();
            memory_.keep(list.size() * sizeof(std::uint32_t));
            out.push_back({&two_.source(i), crossings.operands[i].inside_above, std::move(list)});
        }
        stats.memory = memory_.peak();
        return out;
    }

    const TwoMeshes& two_;
    const SolidStates& solids_;
    const EvaluateSettings& options_;
    bool parallel_;
    MemoryBudget memory_;
    std::optional<CubesOfBoth> both_;  // where the boxes of both meet
    std::array<MemoryBudget::Held, 2> held_;
    TwoLists near_;
    static constexpr std::size_t bytes_of_near = 48;  // that find_conforming() holds

    std::optional<Last> last_;
    std::optional<ConformingSides> conforming_;
    bool is_conforming_known_ = false;
    bool is_part_ = false;
    std::size_t times_shared_ = 0;
    bool is_first_ = true;
    bool ends_with_next_ = false;
    bool shares_facets_ = false;
    bool may_have_sheets_ = false;
};

// The operations that a formula is the sum of, without a part of space in common: an exclusive or
// of two operands or complements is two differences.
std::vector<Residual::Ref> disjoint_parts(const Residual::Ref& formula) {
    if (formula->kind == Residual::Kind::Not && formula->children[0]->kind == Residual::Kind::Xor) {
        const auto& terms = formula->children[0]->children;
        if (terms.size() != 2) return {formula};
        return disjoint_parts(
            Residual::of_distinct(Residual::Kind::Xor, {Residual::negation(terms[0]), terms[1]}));
    }
    if (formula->kind != Residual::Kind::Xor || formula->children.size() != 2) return {formula};
    const Residual::Ref& a = formula->children[0];
    const Residual::Ref& b = formula->children[1];
    return {Residual::of_distinct(Residual::Kind::And, {a, Residual::negation(b)}),
            Residual::of_distinct(Residual::Kind::And, {Residual::negation(a), b})};
}

// The parts of an exclusive or, in which both meshes are turned the other way.
std::optional<UndividedMeshes> find_parts(std::span<const Residual::Ref> parts,
                                          const SolidStates& solids, TwoMeshSearch& search,
                                          bool is_last, EvaluateStats& stats) {
    const bool are_two = parts.size() > 1;
    if (is_last && !are_two) search.end_with_next();
    if (are_two) search.forget_special_position();
    search.set_part(are_two);
    Crossings crossings = *crossings_of(*parts[0], solids);
    auto uncrossed = search.find(crossings, stats);
    if (!uncrossed) return std::nullopt;
    crossings.has_other_sides = are_two;
    UndividedMeshes out{*std::move(uncrossed), nullptr, nullptr};
    out.equal_corners = search.equal_corners();
    out.may_have_sheets = search.may_have_sheets();
    if (are_two) {
        if (search.shares_facets()) return std::nullopt;
        if (is_last) search.end_with_next();
        Crossings others = *crossings_of(*parts[1], solids);
        auto beside = search.find(others, stats);
        if (!beside) return std::nullopt;
        others.has_other_sides = true;
        out.beside = std::make_shared<const UndividedMeshes>(UndividedMeshes{
            *std::move(beside), std::make_shared<const Crossings>(std::move(others)), nullptr});
    }
    out.crossings = std::make_shared<const Crossings>(std::move(crossings));
    return out;
}

}  // namespace

bool are_two_meshes(const Residual::Ref& formula, const SolidStates& solids,
                    const EvaluateSettings& options, std::size_t least_facets) {
    if (solids.size() != 2 || options.budget != nullptr ||
        !crossings_of(*disjoint_parts(formula)[0], solids))
        return false;
    const TwoMeshes two(solids);
    return two.smaller() >= least_beside(two.larger(), least_facets) && two.are_comparable() &&
           two.have_outer_references();
}

std::vector<std::optional<UndividedMeshes>> evaluate_all_without_tree(
    std::span<const Residual::Ref> formulas, const SolidStates& solids,
    const EvaluateSettings& options, EvaluateStats& stats, std::size_t* shared) {
    const TwoMeshes two(solids);
    const bool parallel =
        options.threads != 1 && two.larger() + two.smaller() >= 2 * parallel_facets;
    EvaluateStats made;
    std::vector<std::optional<UndividedMeshes>> out(formulas.size());
    on_threads(parallel ? options.threads : 1, [&](std::uint32_t) {
        TwoMeshSearch search(two, solids, options, parallel);
        for (std::size_t i = 0; i < formulas.size(); ++i) {
            EvaluateStats found;
            const std::size_t before = search.times_shared();
            const auto parts = disjoint_parts(formulas[i]);
            out[i] = find_parts(parts, solids, search, i + 1 == formulas.size(), found);
            if (out[i]) made += found;
            if (shared != nullptr && out[i] && search.times_shared() == before + parts.size())
                ++*shared;
        }
        return true;
    });
    const auto has_value = [](const auto& o) { return o.has_value(); };
    if (std::ranges::none_of(out, has_value)) return out;
    two.note_comparison();
    stats = made;
    return out;
}

std::optional<SolidForm> evaluate_without_tree(const Residual::Ref& formula,
                                               const SolidStates& solids,
                                               const EvaluateSettings& options,
                                               EvaluateStats& stats,
                                               std::shared_ptr<const LazyTree> tree) {
    auto found = std::move(
        evaluate_all_without_tree(std::span(&formula, 1), solids, options, stats, nullptr)[0]);
    if (!found) return std::nullopt;
    found->tree = std::move(tree);
    return *std::move(found);
}

}  // namespace trisect::detail
