// SPDX-License-Identifier: Apache-2.0
//
// Boxes first, four of the second list at once; then planes in single precision, also four at once,
// which part most pairs or find how they cross; the rest is for doubles.
//
// In single precision coordinates are taken from a point near all facets. The difference carries a
// rounding of 2^-53 of itself, which is far below what single precision rounds: its bounds
// (facet_rows.cpp) have room for it, and so have those of boxes.

#include <trisect/bsp/many_meshes/whole_facet_pairs.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// So many are listed before they are related.
constexpr std::size_t pairs_at_once = 4096;

// Differences of coordinates up to this are exact.
constexpr double widest_extent = 0x1p53;

// Of the boxes of a row. Without a call, which std::popcount is on the oldest processors.
constexpr std::array<std::uint8_t, 16> boxes_met{0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

}  // namespace

void WholeFacetPairs::start(std::size_t count, const Vector3& near) {
    near_ = near;
    facets_.clear();
    facets_.reserve(count);
    second_ = 0;
    boxes_.clear();
    probes_.clear();
    known_planes_ = {};
    pairs_.clear();
    crossings_.clear();
    doubtful_.clear();
    box_pairs_.clear();
    box_pair_count_ = 0;
}

void WholeFacetPairs::add(std::uint32_t slot, std::uint32_t number, const OutlineBox& box) {
    Facet& f = facets_.emplace_back();
    f.corners = meshes_.corners(slot, number - meshes_.operands->operands[slot].first);
    const Vector3 lo = minus(box.lo, near_);
    const Vector3 hi = minus(box.hi, near_);
    if (second_ == 0) {
        boxes_.add(lo, hi, 1);
    } else {
        probes_.push_back(BoxRows::probe(lo, hi, 0));
    }
}

bool WholeFacetPairs::find() {
    list_box_pairs();
    if (box_pairs_.empty()) return true;
    if (!make_planes()) return false;
    compare_planes();
    relate_listed();
    return true;
}

void WholeFacetPairs::list_box_pairs() {
    boxes_.add_hulls();
    has_partner_.assign(std::max(4 * boxes_.row_count(), facets_.size()), 0);
    for (std::size_t i = 0; i < probes_.size(); ++i) {
        const std::size_t before = box_pairs_.size();
        static_cast<void>(boxes_.visit_meeting(0, probes_[i], [&](std::size_t row, unsigned met) {
            box_pairs_.push_back(
                {static_cast<std::uint32_t>(second_ + i), static_cast<std::uint32_t>(row), met});
            return true;
        }));
        for (std::size_t k = before; k < box_pairs_.size(); ++k) {
            box_pair_count_ += boxes_met[box_pairs_[k].met];
            for (unsigned met = box_pairs_[k].met; met != 0; met &= met - 1)
                has_partner_[4 * box_pairs_[k].row +
                             static_cast<std::size_t>(std::countr_zero(met))] = 1;
        }
        if (box_pairs_.size() > before) has_partner_[second_ + i] = 1;
    }
}

// Of those that have a partner. False where they are too far apart.
bool WholeFacetPairs::make_planes() {
    Vector3 low = near_;
    Vector3 high = near_;
    for (std::size_t i = 0; i < facets_.size(); ++i)
        for (std::size_t c = 0; c < 3 && has_partner_[i] != 0; ++c)
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], facets_[i].corners[c][k]);
                high[k] = std::max(high[k], facets_[i].corners[c][k]);
            }
    Vector3 extent;
    for (std::size_t k = 0; k < 3; ++k) {
        extent[k] = (high[k] - low[k]) * slightly_more;
        if (!(extent[k] < widest_extent)) return false;
    }
    planes_.start(extent);
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        if (has_partner_[i] == 0) {
            planes_.skip();
            continue;
        }
        Facet& f = facets_[i];
        f.plane = FilteredFacets::plane_of(f.corners, extent);
        FilteredPlane plane = f.plane;
        std::array<Vector3, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) corners[c] = minus(f.corners[c], near_);
        plane.origin = corners[0];
        planes_.add(corners, plane);
    }
    return true;
}

void WholeFacetPairs::compare_planes() {
    FacetRows::Probe facet;
    std::size_t probed = facets_.size();
    for (const BoxPairs& b : box_pairs_) {
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
