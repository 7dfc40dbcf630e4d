// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/conforming/beside_covering.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/bsp/two_meshes/conforming/edge_order.h>

namespace trisect::detail {

namespace {

// A facet's box is compared with those of all parts.
constexpr std::size_t most_parts = 64;

// Of a corner in which patches of several planes meet.
constexpr std::uint32_t several = ~std::uint32_t{1};

using Ends = std::array<std::uint32_t, 2>;

Ends ends_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

BesideCovering::BesideCovering(const CornerNames& names, const Patches& patches)
    : names_(names), patches_(patches) {
    list_covered();
    if (parts_.empty() || parts_.size() > most_parts) return;
    for (auto& edges : edges_) std::ranges::sort(edges);
    beside_.assign(names.item_count(), none);
    for (std::uint32_t item = 0; item < names.item_count(); ++item)
        if (!patches.is_covered(item)) beside_[item] = part_beside(item);
}

void BesideCovering::list_covered() {
    for (std::uint32_t item = 0; item < names_.item_count(); ++item) {
        if (!patches_.is_covered(item)) continue;
        if (parts_.empty()) {
            part_of_.assign(names_.item_count(), none);
            for (auto& around : around_) around.assign(names_.count(), none);
        }
        add(item);
        if (parts_.size() > most_parts) return;
    }
}

int BesideCovering::side_of(std::uint32_t part, std::uint32_t name) const {
    const CornerNames::Triple& t = names_.corners(parts_[part].item);
    return orientation(names_.point(t[0]), names_.point(t[1]), names_.point(t[2]),
                       names_.point(name));
}

// All of a patch lies in a plane.
std::uint32_t BesideCovering::part_of(std::uint32_t item) {
    std::uint32_t& known = part_of_[patches_.root(item)];
    if (known != none) return known;
    const CornerNames::Triple& t = names_.corners(item);
    for (known = 0; known < parts_.size(); ++known)
        if (std::ranges::all_of(t, [&](std::uint32_t v) { return side_of(known, v) == 0; }))
            return known;
    Part& part = parts_.emplace_back();
    part.item = item;
    part.lo.fill(HUGE_VAL);
    part.hi.fill(-HUGE_VAL);
    return known;
}

void BesideCovering::add(std::uint32_t item) {
    const std::uint32_t number = part_of(item);
    Part& part = parts_[number];
    const std::size_t mesh = names_.mesh_of(item);
    const CornerNames::Triple& t = names_.corners(item);
    for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& known = around_[mesh][t[k]];
        known = known == none || known == number ? number : several;
        edges_[mesh].push_back(ends_of(t[k], t[(k + 1) % 3]));
        const std::array<double, 3> at = names_.point(t[k]).doubles();
        for (std::size_t i = 0; i < 3; ++i) {
            part.lo[i] = std::min(part.lo[i], at[i]);
            part.hi[i] = std::max(part.hi[i], at[i]);
        }
    }
}

std::uint32_t BesideCovering::part_beside(std::uint32_t item) const {
    for (const std::uint32_t name : names_.corners(item)) {
        const std::uint32_t part = around_[0][name];
        if (part < several && around_[1][name] == part)
            return meets_in_edge(item, part) ? part : none;
    }
    return none;
}

// A corner of both patches, or an edge of the other mesh's, and the rest on one side.
bool BesideCovering::meets_in_edge(std::uint32_t item, std::uint32_t part) const {
    Ends in_plane{};
    std::size_t count = 0;
    int side = 0;
    for (const std::uint32_t name : names_.corners(item)) {
        const bool is_of_plane = is_of_both(name, part);
        const int s = is_of_plane ? 0 : side_of(part, name);
        if (s == 0) {
            if (!is_of_plane || count == 2) return false;
            in_plane[count++] = name;
        } else if (s == -side) {
            return false;
        } else {
            side = s;
        }
    }
    return count == 1 || std::ranges::binary_search(edges_[1 - names_.mesh_of(item)],
                                                    ends_of(in_plane[0], in_plane[1]));
}

bool BesideCovering::is_clear(std::uint32_t item) const {
    if (beside_.empty() || beside_[item] == none) return false;
    std::array<double, 3> lo;
    std::array<double, 3> hi;
    lo.fill(HUGE_VAL);
    hi.fill(-HUGE_VAL);
    for (const std::uint32_t name : names_.corners(item)) {
        const std::array<double, 3> at = names_.point(name).doubles();
        for (std::size_t i = 0; i < 3; ++i) {
            lo[i] = std::min(lo[i], at[i]);
            hi[i] = std::max(hi[i], at[i]);
        }
    }
    return std::ranges::all_of(parts_, [&](const Part& part) {
        if (&part == &parts_[beside_[item]]) return true;
        for (std::size_t i = 0; i < 3; ++i)
            if (hi[i] < part.lo[i] || lo[i] > part.hi[i]) return true;
        return false;
    });
}

}  // namespace trisect::detail
