// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/pairs_of_meshes.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/two_meshes/outward_moves.h>
#include <trisect/bsp/two_meshes/shift_along.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using Fate = EqualFacets::Fate;

// Those with an equal facet, or those without.
TwoLists select(const TwoLists& near, const EqualFacets& equal, std::array<bool, 2> with) {
    TwoLists out;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < near[i].size(); ++k)
            if ((equal.fates[i][k] != Fate::Own) == with[i]) out[i].push_back(near[i][k]);
    return out;
}

}  // namespace

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

class PairsOfMeshes::Search {
public:
    Search(const TwoMeshes& two, const TwoLists& near, const EvaluateSettings& options,
           MemoryBudget& memory, bool parallel, const Crossings& operands)
        : two_(two),
          near_(near),
          operands_(operands),
          search_(two.nodes, options, memory, parallel) {}

    // Where facets of both cover a part of one plane, it takes a move that is as wanted: of the
    // whole mesh along the axes; of each corner by itself, where planes want opposite directions;
    // or growth. Where none is as wanted, assembly takes out what is left between such facets.
    [[nodiscard]] std::optional<FoundPairs> find(const PairsOfMeshes::How& how,
                                                 EvaluateStats& stats) {
        recognises_equal_ = how.recognises_equal;
        leaves_sheets_ = how.leaves_sheets;
        if (are_flush_on_both_sides()) return find_without_direction(stats);
        bool is_certain = true;
        if (auto out = find_along_axes(stats, is_certain)) return out;
        return is_certain ? find_without_direction(stats) : std::nullopt;
    }

private:
    // Growth about the middle takes facets that face it the wrong way. Where few of them lie in
    // planes of the first mesh it costs less than moves of corners, and what that leaves.
    [[nodiscard]] std::optional<FoundPairs> find_without_direction(EvaluateStats& stats) {
        if (!is_middle_faced() || !have_walls_in_common())
            if (auto out = find_growing(stats, leaves_sheets_ ? few_sheets() : 0)) return out;
        if (auto out = find_by_corners(stats)) return out;
        if (!leaves_sheets_) return std::nullopt;
        return find_growing(stats, many_sheets * all_near());
    }

    [[nodiscard]] std::size_t all_near() const { return near_[0].size() + near_[1].size(); }
    [[nodiscard]] std::uint64_t few_sheets() const {
        constexpr std::uint64_t least = 256;
        return std::max<std::uint64_t>(least, all_near() / part_of_few);
    }
    static constexpr std::size_t part_of_few = 64;
    static constexpr std::uint64_t many_sheets = 64;  // by facet; then cells are as fast

    // Meshes of which some facets are equal mostly have more in common, of which growth would take
    // many the wrong way. Where nearly all are equal few pairs are left.
    [[nodiscard]] bool have_walls_in_common() const {
        const EqualFacets equal = equal_facets();
        const std::vector<Fate>& fates = equal.fates[1];
        const auto own = static_cast<std::size_t>(std::ranges::count(fates, Fate::Own));
        const std::size_t left_out = fates.size() - own;
        return part_of_few * left_out > fates.size() &&
               !(recognises_equal_ && 2 * own < fates.size());
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
        start();
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

    // The second mesh grows or shrinks about the middle of what both have in common, which leaves
    // it as free of contacts with itself as it is.
    [[nodiscard]] std::optional<FoundPairs> find_growing(EvaluateStats& stats,
                                                         std::uint64_t most_sheets) {
        start();
        search_.most_sheets = most_sheets;
        FoundPairs out;
        const PairSearch::Outcome outcome = search_without_equal(out, first_growth());
        if (outcome.is_hopeless || !outcome.is_certain) return std::nullopt;
        note_shared(outcome, out);
        return finish(out, stats);
    }

    // Each corner of the second mesh moves by itself. What is wanted of its facets is outwards, or
    // inwards, of all of them.
    [[nodiscard]] std::optional<FoundPairs> find_by_corners(EvaluateStats& stats) {
        const LatticeMesh& mesh = *two_.meshes[1];
        start();
        const auto& operands = operands_.operands;
        const bool is_difference = operands[0].inside_above != operands[1].inside_above;
        FoundPairs out;
        moves_ = outward_moves(mesh, near_[1], is_difference != operands[0].is_open_below());
        InfinitesimalShift shift;
        shift.moves = moves_.get();
        const PairSearch::Outcome outcome = search_without_equal(out, shift);
        if (outcome.is_hopeless || !outcome.is_certain) return std::nullopt;
        const auto special = special_of_second(out.crossings);
        if (!special.empty() && !are_embedded(mesh, special)) return std::nullopt;
        note_shared(outcome, out);
        out.crossings.moves = moves_;
        return finish(out, stats);
    }

    // Nothing depends on the moves of others: they meet the first mesh as they do without. Where
    // one of these touched another facet of its own mesh, that could pass through it once moved.
    [[nodiscard]] static std::vector<std::uint32_t> special_of_second(const Crossings& crossings) {
        const std::uint32_t first = crossings.operands[1].first;
        std::vector<std::uint32_t> out;
        for (const std::uint32_t number : crossings.special)
            if (number >= first) out.push_back(number - first);
        std::ranges::sort(out);
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    static void note_shared(const PairSearch::Outcome& outcome, FoundPairs& out) {
        out.has_sheets = outcome.has_sheets;
        out.shares_facets = out.shares_facets || outcome.has_wish || outcome.has_sheets;
    }

    void start() {
        search_.recognises_equal = recognises_equal_;
        search_.most_sheets = 0;
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

    // What is hopeless may end before equal facets are found, or after, as threads happen to run:
    // they are left out either way.
    [[nodiscard]] PairSearch::Outcome search_without_equal(FoundPairs& out,
                                                           const InfinitesimalShift& shift) {
        PairSearch::Outcome outcome = search(out, shift);
        if (!outcome.has_equal && outcome.is_hopeless && search_.recognises_equal) {
            const EqualFacets equal = equal_facets();
            if (std::ranges::count(equal.fates[1], Fate::Own) != std::ssize(equal.fates[1]))
                leave_out_equal(out);
            outcome.has_equal = out.equal.has_value();
        }
        if (outcome.has_equal) outcome = search(out, shift);
        return outcome;
    }
    [[nodiscard]] EqualFacets equal_facets() const {
        return {two_.meshes, near_, {operands_.operands[0], operands_.operands[1]}};
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
    bool leaves_sheets_ = true;
    std::shared_ptr<const CornerMoves> moves_;
};

PairsOfMeshes::PairsOfMeshes(const TwoMeshes& two, const TwoLists& near,
                             const EvaluateSettings& options, MemoryBudget& memory, bool parallel,
                             const Crossings& operands)
    : search_(std::make_unique<Search>(two, near, options, memory, parallel, operands)) {}

PairsOfMeshes::~PairsOfMeshes() = default;

std::optional<FoundPairs> PairsOfMeshes::find(const How& how, EvaluateStats& stats) {
    return search_->find(how, stats);
}

}  // namespace trisect::detail
