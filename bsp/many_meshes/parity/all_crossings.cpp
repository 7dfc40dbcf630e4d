// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/parity/all_crossings.h>

#include <cstdint>
#include <vector>

#include <trisect/bsp/many_meshes/crossed_facets.h>
#include <trisect/kernel/support/task_group.h>

namespace trisect::detail {

namespace {

// Fewer facets are not worth a thread of their own.
constexpr std::size_t facets_of_a_task = 2000;

}  // namespace

struct AllCrossings::Finder {
    Finder(const ManyMeshes& meshes, const EvaluateSettings& options)
        : special(meshes.facet_count()), pairs(meshes, options, special) {}
    SpecialPosition special;
    CrossedFacetsFinder pairs;
    std::array<std::vector<std::uint32_t>, 2> near;
};

AllCrossings::AllCrossings(const ManyMeshes& meshes, const OutlineStore& store,
                           std::span<const Solid> solids, const EvaluateSettings& options,
                           Touching touching, bool parallel)
    : meshes_(meshes),
      store_(store),
      solids_(solids),
      options_(options),
      touching_(touching),
      parallel_(parallel) {}

AllCrossings::~AllCrossings() = default;

const SpecialPosition& AllCrossings::special_of(const Finder& finder) { return finder.special; }

bool AllCrossings::find(Pairs& out, EvaluateStats& stats) {
    return find_among(0, solids_.size(), out, stats);
}

OutlinedSolid AllCrossings::view(std::size_t first, std::size_t end) const {
    Solid all = solids_[first];
    for (std::size_t i = first + 1; i < end; ++i) all.box.add(solids_[i].box);
    if (end < solids_.size()) return store_.view(all, solids_[end]);
    Solid behind = store_.empty_solid(true);
    behind.facets = meshes_.facet_count();
    return store_.view(all, behind);
}

bool AllCrossings::find_among(std::size_t first, std::size_t end, Pairs& out,
                              EvaluateStats& stats) {
    if (end - first < 2) return true;
    const std::size_t middle = first + (end - first) / 2;
    std::array<Pairs, 2> others;
    std::array<EvaluateStats, 2> made;
    std::array<bool, 3> done{};
    const auto below = [&] { done[0] = find_among(first, middle, out, made[0]); };
    const auto above = [&] { done[1] = find_among(middle, end, others[0], made[1]); };
    const auto between = [&] { done[2] = find_between(first, middle, end, others[1], stats); };
    const bool is_parallel =
        parallel_ && view(first, end).facets.size() >= facets_of_a_task && end - first > 2;
    if (is_parallel) {
        both_at_once([&] { both_at_once(above, between); }, below);
    } else {
        below();
        above();
        between();
    }
    for (const EvaluateStats& s : made) stats += s;
    for (const Pairs& pairs : others) out.insert(out.end(), pairs.begin(), pairs.end());
    return done[0] && done[1] && done[2];
}

bool AllCrossings::find_between(std::size_t first, std::size_t middle, std::size_t end, Pairs& out,
                                EvaluateStats& stats) {
    if (is_stopped_) return false;
    const std::array<OutlinedSolid, 2> sides{view(first, middle), view(middle, end)};
    if (!sides[0].box.meets(sides[1].box)) return true;
    Finder& finder = finders_.local([&] { return std::make_unique<Finder>(meshes_, options_); });
    for (std::size_t i = 0; i < 2; ++i) {
        finder.near[i].clear();
        const std::span<const OutlineBox> boxes = sides[i].boxes;
        for (std::uint32_t f = 0; f < boxes.size(); ++f)
            if (boxes[f].meets(sides[1 - i].box)) finder.near[i].push_back(f);
    }
    const bool is_known =
        finder.pairs.find(sides[0], sides[1], {finder.near[0], finder.near[1]}, 1, stats);
    if (!is_known || (touching_ == Touching::Stop && !finder.special.facets().empty())) {
        is_stopped_ = true;
        return false;
    }
    out.reserve(finder.pairs.pair_count());
    for (const CrossedFacetsFinder::Pairs& pairs : finder.pairs.pairs())
        for (const CrossedFacets& c : pairs) out.push_back(c.crossing);
    return true;
}

}  // namespace trisect::detail
