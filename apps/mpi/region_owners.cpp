// SPDX-License-Identifier: Apache-2.0
#include "region_owners.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>

namespace trisect::app {
namespace {

constexpr std::uint32_t nobody = 0xffffffff;

// So many of all parts have to stay where they are read for neighbours to be torn apart.
constexpr double worth_it = 0.1;

// How many of the sample of a rank are in a region.
struct RegionShare {
    std::uint32_t region = 0;
    std::uint32_t rank = 0;
    std::size_t parts = 0;
};

std::vector<RegionShare> shares_of(const ClashDivision& regions,
                                   std::span<const PartSurvey> surveys) {
    std::vector<RegionShare> out;
    for (std::uint32_t rank = 0; rank < surveys.size(); ++rank) {
        std::map<std::uint32_t, std::size_t> parts;
        for (const SampledBox& sampled : surveys[rank].sample) {
            Bounds middle = sampled.box.box;
            for (std::size_t k = 0; k < 3; ++k)
                middle.lo[k] = middle.hi[k] = middle.lo[k] / 2 + middle.hi[k] / 2;
            regions.for_each_cell(middle, 0, [&](std::uint32_t region) { ++parts[region]; });
        }
        for (const auto& [region, count] : parts) out.push_back({region, rank, count});
    }
    return out;
}

std::size_t parts_that_stay(const std::vector<RegionShare>& shares,
                            const std::vector<std::uint32_t>& owners) {
    std::size_t out = 0;
    for (const RegionShare& s : shares) out += owners[s.region] == s.rank ? s.parts : 0;
    return out;
}

std::vector<std::uint32_t> neighbours_together(std::size_t regions, std::size_t ranks) {
    std::vector<std::uint32_t> out(regions);
    for (std::size_t r = 0; r < regions; ++r)
        out[r] = static_cast<std::uint32_t>(r * ranks / regions);
    return out;
}

// The largest shares first, as long as a rank has room.
std::vector<std::uint32_t> where_most_is(std::vector<RegionShare>& shares, std::size_t regions,
                                         std::size_t ranks) {
    std::ranges::sort(shares, [](const RegionShare& a, const RegionShare& b) {
        return std::tuple(b.parts, a.region, a.rank) < std::tuple(a.parts, b.region, b.rank);
    });
    std::vector<std::uint32_t> out(regions, nobody);
    std::vector<std::size_t> room(ranks);
    for (const std::uint32_t rank : neighbours_together(regions, ranks)) ++room[rank];
    for (const RegionShare& s : shares) {
        if (out[s.region] != nobody || room[s.rank] == 0) continue;
        out[s.region] = s.rank;
        --room[s.rank];
    }
    std::uint32_t next = 0;
    for (std::uint32_t& owner : out) {
        if (owner != nobody) continue;
        while (room[next] == 0) ++next;
        owner = next;
        --room[next];
    }
    return out;
}

}  // namespace

std::vector<std::uint32_t> region_owners(const ClashDivision& regions,
                                         std::span<const PartSurvey> surveys) {
    std::vector<std::uint32_t> together = neighbours_together(regions.size(), surveys.size());
    if (surveys.size() == 1) return together;
    std::vector<RegionShare> shares = shares_of(regions, surveys);
    std::vector<std::uint32_t> near = where_most_is(shares, regions.size(), surveys.size());
    std::size_t all = 0;
    for (const RegionShare& s : shares) all += s.parts;
    const std::size_t gain = parts_that_stay(shares, near);
    const double least = static_cast<double>(parts_that_stay(shares, together)) +
                         worth_it * static_cast<double>(all);
    return static_cast<double>(gain) > least ? near : together;
}

}  // namespace trisect::app
