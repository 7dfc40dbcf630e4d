// SPDX-License-Identifier: Apache-2.0
//
// A facet in cells that hang together, and that the boundary is not in, is on one side of it, the
// same for all in these cells. One corner of a whole facet says which; cells without one stay
// unknown, and their facets count as being beside the boundary.

#include <trisect/bsp/many_meshes/beside_boundary.h>

#include <algorithm>
#include <span>
#include <utility>

#include <trisect/bsp/many_meshes/outlines/settled_parts.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

using Side = VertexSides::Side;

BoundaryCells cells_of(const OutlinedSolid& solid) {
    BoundaryCells out(solid.box, solid.facets.size());
    for (const OutlineBox& b : solid.boxes) out.occupy(b);
    out.find_parts();
    return out;
}

}  // namespace

BesideBoundary::BesideBoundary(CommonPart& common, const Solid& other, const Solid& solid)
    : common_(common),
      solid_(solid),
      other_(common.store().view(other, solid)),
      cells_(cells_of(other_)) {
    sides_.assign(cells_.part_count(), Side::Unknown);
    sides_[BoundaryCells::outside] = other.open_far_out ? Side::Open : Side::Closed;
}

// Of parts of the solid.
void BesideBoundary::find_places(std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
        places_[i].reserve(parts_[i]->boxes.size());
        for (const OutlineBox& b : parts_[i]->boxes) places_[i].push_back(cells_.part_of(b));
    }
}

// Of cells in which a whole facet of the part is.
void BesideBoundary::find_sides(std::size_t number) {
    const SettledPart& part = *parts_[number];
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const BoundaryCells::Part place = places_[number][f];
        if (place == BoundaryCells::occupied || sides_[place] != Side::Unknown ||
            !part.facets[f].whole)
            continue;
        const OutlineVertex& corner = part.vertices[part.edges[part.facets[f].first].from];
        sides_[place] = common_.is_open_at_corner(corner, other_) ? Side::Open : Side::Closed;
    }
}

Side BesideBoundary::side_at(const OutlineVertex& vertex) const {
    OutlineBox box = OutlineBox::none();
    box.add(vertex.at);
    const BoundaryCells::Part place = cells_.part_of(box);
    return place == BoundaryCells::occupied ? Side::Unknown : sides_[place];
}

// Sorts facets: kept ones, those that are dropped, and those beside the boundary. Vertices of
// these are shared.
void BesideBoundary::sort(std::size_t number) {
    SettledPart& part = *parts_[number];
    PoolVector<Side> sides;
    sides.reserve(part.facets.size());
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const BoundaryCells::Part place = places_[number][f];
        sides.push_back(place == BoundaryCells::occupied ? Side::Unknown : sides_[place]);
        if (sides.back() != Side::Unknown) continue;
        const OutlinedSolid::Facet& facet = part.facets[f];
        for (std::uint32_t e = facet.first; e < facet.first + facet.count; ++e)
            part.vertices[part.edges[e].from].is_shared = true;
    }
    PoolVector<OutlinedSolid::Facet> facets;
    PoolVector<OutlineBox> boxes;
    facets.reserve(part.facets.size());
    boxes.reserve(part.facets.size());
    for (const Side side : {Side::Open, Side::Closed, Side::Unknown}) {
        for (std::size_t f = 0; f < sides.size(); ++f) {
            if (sides[f] != side) continue;
            facets.push_back(part.facets[f]);
            boxes.push_back(part.boxes[f]);
        }
        if (side == Side::Open) kept_[number] = facets.size();
        if (side == Side::Closed) far_[number] = facets.size();
    }
    part.facets = std::move(facets);
    part.boxes = std::move(boxes);
}

// What is beside the boundary goes from the parts into a solid of its own.
OutlineStore::Solid BesideBoundary::join_near() {
    std::size_t facets = 0;
    std::size_t edges = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i)
        for (std::size_t f = far_[i]; f < parts_[i]->facets.size(); ++f) {
            ++facets;
            edges += parts_[i]->facets[f].count;
        }
    JoinedParts near(common_.store());
    near.reserve(facets, edges, edges / 3);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        SettledPart& part = *parts_[i];
        if (far_[i] == part.facets.size()) continue;
        near.begin(part);
        for (std::size_t f = far_[i]; f < part.facets.size(); ++f) near.add(part, f);
        part.facets.resize(far_[i]);
        part.boxes.resize(far_[i]);
    }
    return near.solid();
}

OutlineStore::Solid BesideBoundary::take(std::uint32_t threads) {
    OutlineStore& store = common_.store();
    parts_ = store.take_out(solid_);
    places_.resize(parts_.size());
    kept_.assign(parts_.size(), 0);
    far_.assign(parts_.size(), 0);
    const ParallelParts ranges(parts_.size(), threads, 4);
    ranges.for_each(
        [&](std::size_t, std::size_t first, std::size_t end) { find_places(first, end); });
    for (std::size_t i = 0; i < parts_.size(); ++i) find_sides(i);
    ranges.for_each([&](std::size_t, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) sort(i);
    });
    Solid near = join_near();
    // What is outside of all parts is far out.
    for (const auto& part : parts_) near.box.add(part->box);
    near.open_far_out = solid_.open_far_out;
    const std::span vertices = std::span(store.vertices()).subspan(near.vertices);
    known_.reserve(vertices.size());
    for (const OutlineVertex& v : vertices) known_.push_back(side_at(v));
    for (auto& part : parts_) store.add_settled(std::move(part));
    return near;
}

// The result may have none of the parts, where boxes do not meet.
void BesideBoundary::drop(const Solid& result) const {
    const auto parts = common_.store().settled(result);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i]->facets.resize(kept_[i]);
        parts[i]->boxes.resize(kept_[i]);
    }
}

}  // namespace trisect::detail
