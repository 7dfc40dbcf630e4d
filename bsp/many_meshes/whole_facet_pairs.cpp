// SPDX-License-Identifier: Apache-2.0
//
// Boxes first, sixteen of the second list at once; then planes in single precision, four at once,
// which part most pairs or find how they cross; the rest is for doubles.
//
// In single precision coordinates are taken from a point near all facets. The difference carries a
// rounding of 2^-53 of itself, which is far below what single precision rounds: its bounds
// (facet_rows.cpp) have room for it.

#include <trisect/bsp/many_meshes/whole_facet_pairs.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/four_floats.h>

namespace trisect::detail {

namespace {

// So many are listed before they are related.
constexpr std::size_t pairs_at_once = 4096;

// Singles are off by less than 2^-23 of the extent, to which the point belongs that they are taken
// from.
constexpr double more_than_singles = 1 + 0x1p-20;

// Differences of coordinates up to this are exact.
constexpr double widest_extent = 0x1p53;

// Of the boxes of a row. Without a call, which std::popcount is on the oldest processors.
constexpr std::array<std::uint8_t, 16> boxes_met{0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

}  // namespace

void WholeFacetPairs::start(std::size_t count, const Vector3& near, const SingleBox& reach) {
    near_ = near;
    names_.clear();
    names_.reserve(count);
    if (facets_.size() < count) facets_.resize(count);
    second_ = 0;
    boxes_.start(reach);
    probes_.clear();
    known_planes_ = {};
    pairs_.clear();
    crossings_.clear();
    doubtful_.clear();
    box_pairs_listed_ = 0;
    box_pair_count_ = 0;
}

void WholeFacetPairs::add(std::uint32_t slot, std::uint32_t number, const SingleBox& box) {
    names_.push_back({slot, number});
    if (second_ == 0) {
        boxes_.add(box);
    } else {
        probes_.push_back(boxes_.narrow(box));
    }
}

bool WholeFacetPairs::find() {
    list_box_pairs();
    if (box_pairs_listed_ == 0) return true;
    if (!make_planes()) return false;
    compare_planes();
    relate_listed();
    return true;
}

void WholeFacetPairs::list_box_pairs() {
    met_.resize(boxes_.word_count());
    are_met_.assign(boxes_.word_count(), 0);
    has_partner_.assign(names_.size(), 0);
    for (std::size_t i = 0; i < probes_.size(); ++i) {
        boxes_.find_meeting(probes_[i], met_);
        list_met(second_ + i);
    }
    for (std::size_t j = 0; j < second_; ++j)
        has_partner_[j] = static_cast<std::uint8_t>(are_met_[j / 64] >> j % 64 & 1U);
}

// By four.
void WholeFacetPairs::list_met(std::size_t first) {
    const std::size_t before = box_pairs_listed_;
    if (box_pairs_.size() < before + 16 * met_.size())
        box_pairs_.resize(2 * (before + 16 * met_.size()));
    BoxPairs* next = box_pairs_.data() + before;
    for (std::size_t w = 0; w < met_.size(); ++w) {
        std::uint64_t met = met_[w];
        are_met_[w] |= met;
        while (met != 0) {
            const auto row = static_cast<std::uint32_t>(std::countr_zero(met)) / 4;
            const auto four = static_cast<unsigned>(met >> 4 * row & 15U);
            *next++ = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(16 * w) + row,
                       four};
            box_pair_count_ += boxes_met[four];
            met &= ~(std::uint64_t{15} << 4 * row);
        }
    }
    box_pairs_listed_ = static_cast<std::size_t>(next - box_pairs_.data());
    has_partner_[first] = box_pairs_listed_ > before ? 1 : 0;
}

// Of those that have a partner. False where they are too far apart.
bool WholeFacetPairs::make_planes() {
    FourFloats low(0);  // from the point near all of them
    FourFloats high(0);
    for (std::size_t i = 0; i < names_.size(); ++i) {
        if (has_partner_[i] == 0) continue;
        const auto [slot, number] = names_[i];
        Facet& f = facets_[i];
        f.corners = meshes_.corners(slot, number - meshes_.operands->operands[slot].first);
        for (std::size_t c = 0; c < 3; ++c) {
            const FourFloats single = singles_between(f.corners[c], near_);
            f.singles[c] = single.numbers();
            low = smaller(low, single);
            high = larger(high, single);
        }
    }
    const auto lowest = low.numbers();
    const auto highest = high.numbers();
    Vector3 extent;
    for (std::size_t k = 0; k < 3; ++k) {
        extent[k] =
            (static_cast<double>(highest[k]) - static_cast<double>(lowest[k])) * more_than_singles;
        if (!(extent[k] < widest_extent)) return false;
    }
    planes_.start(extent);
    for (std::size_t i = 0; i < names_.size(); ++i) {
        if (has_partner_[i] == 0) {
            planes_.skip();
            continue;
        }
        Facet& f = facets_[i];
        f.plane = FilteredFacets::plane_of(f.corners, extent);
        FilteredPlane plane = f.plane;
        plane.origin = minus(f.corners[0], near_);
        planes_.add(f.singles, plane);
    }
    return true;
}

void WholeFacetPairs::compare_planes() {
    FacetRows::Probe facet;
    std::size_t probed = names_.size();
    for (const BoxPairs& b : std::span(box_pairs_).first(box_pairs_listed_)) {
        const std::size_t i = b.first;
        if (i != probed) facet = planes_.probe(i);
        probed = i;
        const std::uint32_t plane = known_planes_.empty() ? 0 : known_planes_[i];
        for (unsigned met = b.met & ~planes_.parted(b.row, facet, b.met); met != 0;
             met &= met - 1) {
            const std::uint32_t j = 4 * b.row + static_cast<std::uint32_t>(std::countr_zero(met));
            if (plane == 0 || plane != known_planes_[j]) pairs_.push_back({b.first, j});
        }
        if (pairs_.size() >= pairs_at_once) relate_listed();
    }
}

// Four at once: single precision is enough for nearly all of them.
void WholeFacetPairs::relate_listed() {
    for (std::size_t first = 0; first < pairs_.size(); first += 4) {
        const std::size_t count = std::min<std::size_t>(4, pairs_.size() - first);
        std::array<FacetRows::Pair, 4> four;
        for (std::size_t i = 0; i < 4; ++i) four[i] = pairs_[first + (i < count ? i : 0)];
        const FacetRows::Relation relation = planes_.relate(four);
        for (unsigned i = 0; i < count; ++i) {
            if ((relation.apart >> i & 1U) != 0) continue;
            if ((relation.crosses >> i & 1U) != 0) {
                keep(four[i], TriangleRelation(relation, i));
            } else {
                relate(four[i]);
            }
        }
    }
    pairs_.clear();
}

void WholeFacetPairs::relate(const FacetRows::Pair& pair) {
    const TriangleRelation r = relate_triangles(triangle(pair[0]), triangle(pair[1]));
    if (r.kind == TriangleRelation::Kind::Apart) return;
    if (r.kind == TriangleRelation::Kind::Crossing) {
        keep(pair, r);
    } else {
        doubtful_.push_back(places(pair));
    }
}

void WholeFacetPairs::keep(const FacetRows::Pair& pair, const TriangleRelation& relation) {
    Crossing& made = crossings_.emplace_back();
    made.places = places(pair);
    for (std::size_t k = 0; k < 2; ++k) {
        const TriangleRelation::End end = relation.end(k);
        made.ends[k].of_second = end.of_second;
        made.ends[k].edge = end.edge.edge(end.up);
        if (find_end(triangle(pair[0]), triangle(pair[1]), end, made.ends[k].at)) continue;
        doubtful_.push_back(made.places);
        crossings_.pop_back();
        return;
    }
}

}  // namespace trisect::detail
