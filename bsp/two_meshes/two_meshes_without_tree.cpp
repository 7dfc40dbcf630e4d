// SPDX-License-Identifier: Apache-2.0
//
// Most facets of two large meshes do not come near the other mesh. To send them all down a tree
// takes half of an evaluation, and only queries of points, or later operations, need that tree. For
// a mesh of the result it is enough to find which facets cross, and on which side of the other mesh
// the others are.
//
// 1. A grid of a few thousand cubes shows which facets share a cube with the other mesh
//    (cube_grid.h): some of ten.
// 2. These alone are divided, down to cells with few of them, and compared there. Winding numbers
//    are not needed, so what does not meet the box of the other mesh's facets is left out.
// 3. Sides of facets follow from the crossings (facet_sides.cpp).
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
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/two_meshes/conforming/conforming_meshes.h>
#include <trisect/bsp/two_meshes/cube_grid.h>
#include <trisect/bsp/two_meshes/equal_facets.h>
#include <trisect/bsp/two_meshes/facet_sides.h>
#include <trisect/bsp/two_meshes/growth_about.h>
#include <trisect/bsp/two_meshes/outward_moves.h>
#include <trisect/bsp/two_meshes/pair_search.h>
#include <trisect/bsp/two_meshes/shift_along.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

// About a facet in each cube that the surface meets.
int slabs_for(std::size_t facets) {
    return std::clamp(static_cast<int>(std::sqrt(static_cast<double>(facets) / 8)), 4, 62);
}

// Of an imported mesh.
int winding_far_out(const SolidState& solid) {
    return complemented_winding(solid.root().node->winding(), solid.root().complemented);
}

bool is_below_far_out(const SolidState& solid, const Crossings::Operand& operand) {
    return (winding_far_out(solid) == operand.open) == operand.is_open_below();
}

// As ParallelParts counts them.
std::uint32_t threads_if(bool parallel) { return parallel ? 0 : 1; }

// Both, at the same time where the search is done by several threads.
template <class First, class Second>
void do_both(bool parallel, const First& first, const Second& second) {
    if (parallel) {
        both_at_once(first, second);
    } else {
        first();
        second();
    }
}

// Meshes of so many times the facets of the other one cost more as a whole than by their index.
constexpr std::size_t of_a_size = 16;
// Fewer facets are looked at in two milliseconds; more are worth an index from the first time on.
constexpr std::size_t soon_compared = std::size_t{1} << 16;

// A box with a mesh of that many facets takes a third of the time that cells take where they touch,
// and nine tenths elsewhere.
constexpr std::size_t more_than_a_leaf = 64;
constexpr std::size_t facets_of_tetrahedron = 4;

std::size_t least_beside(std::size_t larger, std::size_t least_facets) {
    return larger < more_than_a_leaf ? least_facets : std::min(least_facets, facets_of_tetrahedron);
}

// The meshes, and whether they are worth it.
struct TwoMeshes {
    std::array<const CellNode*, 2> nodes;
    std::array<const LatticeMesh*, 2> meshes{};
    Box common;

    explicit TwoMeshes(const SolidStates& solids)
        : nodes{solids[0]->root().node.get(), solids[1]->root().node.get()} {
        common = source(0).box();
        for (std::size_t i = 0; i < 2; ++i) {
            meshes[i] = &source(i).mesh();
            common = common.intersected(source(i).box());
        }
    }
    [[nodiscard]] const Source& source(std::size_t i) const {
        return *nodes[i]->polygons().whole_source();
    }
    [[nodiscard]] std::size_t larger() const {
        return std::max(nodes[0]->size(), nodes[1]->size());
    }
    [[nodiscard]] std::size_t smaller() const {
        return std::min(nodes[0]->size(), nodes[1]->size());
    }
    [[nodiscard]] bool are_comparable() const {
        return nodes[0]->refinement() == nullptr && nodes[1]->refinement() == nullptr &&
               (are_of_a_size() || (larger() < soon_compared && !larger_node().was_compared()));
    }
    // A mesh that is far larger is looked at as a whole once, if at all. Then it gets an index
    // (evaluator.cpp), by which the next small one is found at once.
    void note_comparison() const {
        if (!are_of_a_size()) larger_node().note_comparison();
    }
    [[nodiscard]] bool are_of_a_size() const { return larger() < of_a_size * smaller(); }
    [[nodiscard]] const CellNode& larger_node() const {
        return nodes[0]->size() < nodes[1]->size() ? *nodes[1] : *nodes[0];
    }
    [[nodiscard]] bool have_outer_references() const {
        return lies_outside(nodes[0]->reference(), source(0).box()) &&
               lies_outside(nodes[1]->reference(), source(1).box());
    }
};

// Cubes that either mesh occupies, as many as its facets fill at a price. Where facets are long
// they are larger: of the least number each facet meets few.
struct CubesOfBoth {
    std::optional<CubeGrid> grid;
    std::array<std::optional<OccupiedCubes>, 2> cubes;

    CubesOfBoth(const TwoMeshes& two, bool parallel) {
        for (int slabs = slabs_for(two.larger()); !are_useful(); slabs = std::max(slabs / 2, 4)) {
            grid.emplace(two.common, slabs);
            do_both(
                parallel, [&] { cubes[0].emplace(*grid, *two.meshes[0], threads_if(parallel)); },
                [&] { cubes[1].emplace(*grid, *two.meshes[1], threads_if(parallel)); });
        }
    }
    [[nodiscard]] bool are_useful() const {
        return cubes[0] && cubes[0]->is_useful() && cubes[1]->is_useful();
    }
};

using Fate = EqualFacets::Fate;

// Whether one mesh is taken from the other one, on which it does not stand, and their boxes begin
// and end at the same places along an axis: facets there would want opposite directions.
bool are_flush_on_both_sides(const TwoMeshes& two, const Crossings& crossings) {
    if (crossings.operands[0].inside_above == crossings.operands[1].inside_above) return false;
    const Box& a = two.source(0).box();
    const Box& b = two.source(1).box();
    bool are_flush = false;
    for (std::size_t k = 0; k < 3; ++k) {
        if (a.lo[k] == b.hi[k] || b.lo[k] == a.hi[k]) return false;
        are_flush = are_flush || (a.lo[k] == b.lo[k] && a.hi[k] == b.hi[k]);
    }
    return are_flush;
}

// What has been found out about two meshes.
struct FoundPairs {
    Crossings crossings;
    std::optional<EqualFacets> equal;
    bool shares_facets = false;  ///< a facet bounds the result for both meshes
    bool is_general = false;     ///< all pairs are in general position
    /// The first move was as wanted and as wished. What one operation wants another one with the
    /// same value of the first mesh wishes: their first move is the same, and as they wish.
    bool has_first_move = false;
};

// Those with an equal facet, or those without.
TwoLists select(const TwoLists& near, const EqualFacets& equal, std::array<bool, 2> with) {
    TwoLists out;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < near[i].size(); ++k)
            if ((equal.fates[i][k] != Fate::Own) == with[i]) out[i].push_back(near[i][k]);
    return out;
}

// All pairs of facets that cross, arranged. Nothing when one cannot be decided.
class PairsOfMeshes {
public:
    PairsOfMeshes(const TwoMeshes& two, const TwoLists& near, const EvaluateSettings& options,
                  MemoryBudget& memory, bool parallel, const Crossings& operands)
        : two_(two),
          near_(near),
          operands_(operands),
          search_(two.nodes, options, memory, parallel) {}

    // Where facets of both cover a part of one plane, it takes a move that is as wanted: of the
    // whole mesh along the axes; of each corner by itself, where planes want opposite directions;
    // or growth, where some corner cannot go as all of its facets want.
    [[nodiscard]] std::optional<FoundPairs> find(bool recognises_equal, EvaluateStats& stats) {
        recognises_equal_ = recognises_equal;
        const bool wants_opposites = are_flush_on_both_sides();
        if (wants_opposites)
            if (auto out = find_without_direction(stats)) return out;
        bool is_certain = true;
        if (auto out = find_along_axes(stats, is_certain)) return out;
        if (wants_opposites || !is_certain) return std::nullopt;
        return find_without_direction(stats);
    }

private:
    // Growth about the middle takes facets that face it the wrong way, and where it serves all it
    // costs less.
    [[nodiscard]] std::optional<FoundPairs> find_without_direction(EvaluateStats& stats) {
        const bool is_faced = is_middle_faced() && !are_mostly_equal();
        if (is_faced)
            if (auto out = find_by_corners(stats)) return out;
        if (auto out = find_growing(stats, true)) return out;
        if (!is_faced)
            if (auto out = find_by_corners(stats)) return out;
        return find_growing(stats, false);
    }

    // Then few pairs are left, and moves cost more than they do.
    [[nodiscard]] bool are_mostly_equal() const {
        if (!recognises_equal_) return false;
        const EqualFacets equal(two_.meshes, near_, {operands_.operands[0], operands_.operands[1]});
        const auto own = std::ranges::count(equal.fates[1], Fate::Own);
        return 2 * static_cast<std::size_t>(own) < equal.fates[1].size();
    }

    // Whether more than a few facets of the second mesh face the middle, by a sample.
    [[nodiscard]] bool is_middle_faced() const {
        constexpr std::size_t sample = 256;
        const LatticeMesh& mesh = *two_.meshes[1];
        const Vector3 middle = first_growth().centre.doubles();
        const std::size_t step = std::max(near_[1].size() / sample, std::size_t{1});
        std::size_t looked = 0;
        std::size_t facing = 0;
        for (std::size_t i = 0; i < near_[1].size(); i += step) {
            const auto& t = mesh.triangles[near_[1][i]];
            const Vector3 a = mesh.points[t[0]].doubles();
            const Vector3 b = minus(mesh.points[t[1]].doubles(), a);
            const Vector3 c = minus(mesh.points[t[2]].doubles(), a);
            ++looked;
            facing += dot(cross(b, c), minus(a, middle)) < 0 ? 1U : 0U;
        }
        return 8 * facing > looked;
    }

    // Nothing where no direction is as wanted.
    [[nodiscard]] std::optional<FoundPairs> find_along_axes(EvaluateStats& stats,
                                                            bool& is_certain) {
        start(false);
        FoundPairs out;
        InfinitesimalShift shift = first_shift();
        out.has_first_move = true;
        // One finds equal facets, one another direction, which is as wanted.
        for (int turn = 0; turn < 3; ++turn) {
            const PairSearch::Outcome outcome = search(out, shift);
            if (outcome.has_equal) continue;
            if (outcome.is_hopeless) return std::nullopt;
            is_certain = outcome.is_certain;
            if (!is_certain) return std::nullopt;
            std::vector<std::array<int, 3>> all = outcome.wanted;
            all.insert(all.end(), outcome.wished.begin(), outcome.wished.end());
            out.shares_facets = out.shares_facets || !outcome.wished.empty();
            auto next = shift_along(all);
            out.has_first_move = out.has_first_move && outcome.is_as_wanted && outcome.is_as_wished;
            if (outcome.is_as_wanted && (outcome.is_as_wished || !next)) return finish(out, stats);
            if (!next) next = shift_along(outcome.wanted);
            if (!next) return std::nullopt;
            shift = *next;
        }
        return std::nullopt;
    }

    // The second mesh grows or shrinks about the middle of what both have in common, or where that
    // is not as wanted about another point.
    [[nodiscard]] std::optional<FoundPairs> find_growing(EvaluateStats& stats, bool about_middle) {
        start(!about_middle);
        FoundPairs out;
        InfinitesimalShift shift = first_growth();
        for (int turn = 0; turn < 3; ++turn) {
            const PairSearch::Outcome outcome = search(out, shift);
            if (outcome.has_equal) continue;
            if (outcome.is_hopeless || !outcome.is_certain) return std::nullopt;
            out.shares_facets = out.shares_facets || outcome.has_wish ||
                                std::ranges::any_of(outcome.sides, &WantedSide::is_wish);
            if (outcome.is_as_wanted) return finish(out, stats);
            const auto next = growth_about(*two_.meshes[0], outcome.sides);
            if (!next) return std::nullopt;
            shift = *next;
        }
        return std::nullopt;
    }

    // Each corner of the second mesh moves by itself. What is wanted of its facets is outwards, or
    // inwards, of all of them.
    [[nodiscard]] std::optional<FoundPairs> find_by_corners(EvaluateStats& stats) {
        const LatticeMesh& mesh = *two_.meshes[1];
        if (!are_embedded(mesh, near_[1])) return std::nullopt;
        start(false);
        const auto& operands = operands_.operands;
        const bool is_difference = operands[0].inside_above != operands[1].inside_above;
        FoundPairs out;
        moves_ = outward_moves(mesh, near_[1], is_difference != operands[0].is_open_below());
        InfinitesimalShift shift;
        shift.moves = moves_.get();
        for (int turn = 0; turn < 2; ++turn) {
            const PairSearch::Outcome outcome = search(out, shift);
            if (outcome.has_equal) continue;
            if (outcome.is_hopeless || !outcome.is_certain) return std::nullopt;
            out.shares_facets = out.shares_facets || outcome.has_wish;
            out.crossings.moves = moves_;
            return finish(out, stats);
        }
        return std::nullopt;
    }

    void start(bool keeps_sides) {
        search_.recognises_equal = recognises_equal_;
        search_.keeps_sides = keeps_sides;
        search_.parts = {near_};
    }

    [[nodiscard]] PairSearch::Outcome search(FoundPairs& out, const InfinitesimalShift& shift) {
        out.crossings = operands_;
        out.crossings.shift = shift;
        found_ = {};
        PairSearch::Outcome outcome = search_.run(out.crossings, found_);
        if (outcome.has_equal) leave_out_equal(out);
        return outcome;
    }

    [[nodiscard]] InfinitesimalShift first_growth() const {
        InfinitesimalShift shift;
        const Box& b = two_.common;
        const auto middle = [&](std::size_t k) { return b.lo[k] + (b.hi[k] - b.lo[k]) / 2; };
        shift.growth = are_flush_on_both_sides() && !operands_.operands[0].is_open_below() ? -1 : 1;
        shift.centre = {middle(0), middle(1), middle(2)};
        return shift;
    }

    [[nodiscard]] bool are_flush_on_both_sides() const {
        return trisect::detail::are_flush_on_both_sides(two_, operands_);
    }

    // Where one mesh stands on the other, the direction that will be wanted.
    [[nodiscard]] InfinitesimalShift first_shift() const {
        const bool wants_above = operands_.operands[0].is_open_below();
        std::vector<std::array<int, 3>> directions;
        for (std::size_t k = 0; k < 3; ++k) {
            const Box& a = two_.source(0).box();
            const Box& b = two_.source(1).box();
            const int up = b.lo[k] == a.hi[k] ? 1 : (b.hi[k] == a.lo[k] ? -1 : 0);
            if (up == 0) continue;
            directions.emplace_back()[k] = wants_above ? up : -up;
        }
        return shift_along(directions).value_or(InfinitesimalShift());
    }

    void leave_out_equal(FoundPairs& out) {
        out.equal.emplace(two_.meshes, near_,
                          std::array{operands_.operands[0], operands_.operands[1]});
        for (const std::vector<Fate>& fates : out.equal->fates)
            out.shares_facets = out.shares_facets || std::ranges::count(fates, Fate::Kept) != 0;
        search_.recognises_equal = false;
        search_.parts = {select(near_, *out.equal, {false, false}),
                         select(near_, *out.equal, {false, true}),
                         select(near_, *out.equal, {true, false})};
    }

    [[nodiscard]] FoundPairs finish(FoundPairs& out, EvaluateStats& stats) const {
        stats += found_;
        out.is_general = found_.doubtful_pairs == 0 && !out.equal && out.crossings.special.empty();
        for (std::size_t i = 0; out.equal && i < 2; ++i)
            for (std::size_t k = 0; k < near_[i].size(); ++k)
                if (out.equal->fates[i][k] != Fate::Own)
                    out.crossings.hidden.push_back(out.crossings.number_of(i, near_[i][k]));
        out.crossings.arrange();
        return std::move(out);
    }

    const TwoMeshes& two_;
    const TwoLists& near_;
    const Crossings& operands_;
    PairSearch search_;
    EvaluateStats found_;  // of the last search
    bool recognises_equal_ = true;
    std::shared_ptr<const CornerMoves> moves_;
};

// The sides of the facets of both meshes, for all operations with the same crossings.
class SidesOfBoth {
public:
    SidesOfBoth(const TwoMeshes& two, const CubesOfBoth& both, const TwoLists& near,
                const SolidStates& solids, bool parallel)
        : two_(two), both_(both), near_(near), solids_(solids), parallel_(parallel) {}

    // What bounds the result and is not crossed, of either mesh, and the first corners of all
    // others in special position; nothing when that is not known. `equal` outlives this.
    [[nodiscard]] std::optional<TwoLists> list(Crossings& crossings,
                                               const std::optional<EqualFacets>& equal) {
        std::array<std::optional<std::vector<std::uint32_t>>, 2> facets;
        std::array<std::vector<Crossings::Corner>, 2> corners;
        const auto find = [&](std::size_t i) {
            const bool below = crossings.operands[1 - i].is_open_below();
            const std::span<const Fate> fates =
                equal ? std::span<const Fate>(equal->fates[i]) : std::span<const Fate>();
            facets[i] = list_of(i, crossings, fates, below);
            if (facets[i] && !crossings.special.empty())
                corners[i] = sides_[i]->first_corners(below);
        };
        do_both(
            parallel_, [&] { find(0); }, [&] { find(1); });
        if (!facets[0] || !facets[1]) return std::nullopt;
        crossings.first_corners.clear();
        for (const auto& c : corners)
            crossings.first_corners.insert(crossings.first_corners.end(), c.begin(), c.end());
        return TwoLists{*std::move(facets[0]), *std::move(facets[1])};
    }

private:
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> list_of(std::size_t i,
                                                                    const Crossings& crossings,
                                                                    std::span<const Fate> fates,
                                                                    bool below) {
        if (sides_[i]) return sides_[i]->uncrossed_again(fates, below);
        sides_[i].emplace(*both_.grid, *two_.meshes[i], *both_.cubes[i],
                          both_.cubes[1 - i]->cubes(), near_[i], fates, threads_if(parallel_));
        return sides_[i]->uncrossed(crossings, i,
                                    is_below_far_out(*solids_[1 - i], crossings.operands[1 - i]),
                                    below, *two_.meshes[1 - i]);
    }

    const TwoMeshes& two_;
    const CubesOfBoth& both_;
    const TwoLists& near_;
    const SolidStates& solids_;
    bool parallel_;
    std::array<std::optional<FacetSides>, 2> sides_;
};

// Two meshes that nothing needs to cut, for all operations.
class ConformingSides {
public:
    ConformingSides(const TwoMeshes& two, const CubesOfBoth& both, const TwoLists& near,
                    const SolidStates& solids, bool parallel, ConformingMeshes found)
        : two_(two),
          both_(both),
          near_(near),
          solids_(solids),
          parallel_(parallel),
          found_(std::move(found)) {}

    // What bounds the result, of either mesh; nothing when that is not known. `is_part`: it is
    // beside another one, by which facets that face opposite ways vanish.
    [[nodiscard]] std::optional<TwoLists> list(const Crossings& crossings, bool is_part) {
        is_part_ = is_part;
        std::array<std::optional<std::vector<std::uint32_t>>, 2> facets;
        do_both(
            parallel_, [&] { facets[0] = list_of(0, crossings); },
            [&] { facets[1] = list_of(1, crossings); });
        if (!facets[0] || !facets[1]) return std::nullopt;
        return TwoLists{*std::move(facets[0]), *std::move(facets[1])};
    }
    [[nodiscard]] const ConformingMeshes& found() const { return found_; }

private:
    // The first mesh stands for both where they cover a part of a plane (equal_facets.cpp).
    [[nodiscard]] Fate fate_of(std::size_t i, FacetRelation relation,
                               const Crossings& crossings) const {
        const auto& operands = crossings.operands;
        bool is_kept = false;
        switch (relation) {
            case FacetRelation::Unknown:
                return Fate::Own;
            case FacetRelation::Above:
            case FacetRelation::Below:
                is_kept = (relation == FacetRelation::Below) == operands[1 - i].is_open_below();
                break;
            case FacetRelation::Same:
            case FacetRelation::Opposite: {
                const bool is_below =
                    (relation == FacetRelation::Same) == operands[0].is_open_below();
                is_kept = i == 0 && is_below == operands[1].is_open_below() &&
                          !(is_part_ && relation == FacetRelation::Opposite);
                break;
            }
        }
        return is_kept ? Fate::Kept : Fate::Dropped;
    }

    [[nodiscard]] std::optional<std::vector<std::uint32_t>> list_of(std::size_t i,
                                                                    const Crossings& crossings) {
        const ConformingMeshes::Mesh& mesh = found_.meshes[i];
        fates_[i].clear();
        for (const FacetRelation relation : mesh.relations)
            fates_[i].push_back(fate_of(i, relation, crossings));
        if (!found_.are_some_unknown && near_[i].size() == two_.meshes[i]->triangles.size())
            return list_kept(i);
        const bool below = crossings.operands[1 - i].is_open_below();
        if (sides_[i]) return sides_[i]->uncrossed_again(fates_[i], below);
        sides_[i].emplace(*both_.grid, *two_.meshes[i], *both_.cubes[i],
                          both_.cubes[1 - i]->cubes(), near_[i], fates_[i], threads_if(parallel_));
        sides_[i]->set_conforming(mesh);
        return sides_[i]->uncrossed(crossings, i,
                                    is_below_far_out(*solids_[1 - i], crossings.operands[1 - i]),
                                    below, *two_.meshes[1 - i]);
    }

    [[nodiscard]] std::vector<std::uint32_t> list_kept(std::size_t i) const {
        std::vector<std::uint32_t> out;
        out.reserve(static_cast<std::size_t>(std::ranges::count(fates_[i], Fate::Kept)));
        for (std::size_t k = 0; k < near_[i].size(); ++k)
            if (fates_[i][k] == Fate::Kept) out.push_back(near_[i][k]);
        return out;
    }

    const TwoMeshes& two_;
    const CubesOfBoth& both_;
    const TwoLists& near_;
    const SolidStates& solids_;
    bool parallel_;
    ConformingMeshes found_;
    std::array<std::vector<Fate>, 2> fates_;  // of the operation that is looked at
    bool is_part_ = false;                    // as that is
    std::array<std::optional<FacetSides>, 2> sides_;
};

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
            std::optional<FoundPairs> of_pairs = pairs.find(recognises_equal, found);
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
