// SPDX-License-Identifier: Apache-2.0
//
// A facet in cells that hang together, and that the boundary is not in, is on one side of it, the
// same for all in these cells. A corner of an operand says which; cells without one stay unknown,
// and their facets count as being beside the boundary.

#include <trisect/bsp/many_meshes/beside_boundary.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/many_meshes/outlines/settled_parts.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

using Side = VertexSides::Side;
using CellPart = BoundarySides::Part;

constexpr std::uint32_t no_facet = ~std::uint32_t{0};
constexpr std::size_t least_vertices = 16384;  // for a thread

OutlineVertex first_corner(const ManyMeshes& meshes, std::uint32_t slot, std::uint32_t facet) {
    OutlineVertex out;
    out.at = {meshes.sources[slot]->corner(facet, 0).doubles(), 0.0};
    out.facets[0] = meshes.operands->operands[slot].first + facet;
    return out;
}

// By part of the cells: a facet of which the first corner is in it, the lowest one of all operands.
class FacetsInCells {
public:
    FacetsInCells(const ManyMeshes& meshes, const BoundarySides& sides)
        : meshes_(meshes), sides_(sides), facets_(sides.part_count(), no_facet) {}

    void add(std::uint32_t slot) {
        for (std::uint32_t f = 0; f < meshes_.sources[slot]->facet_count(); ++f) {
            const OutlineVertex corner = first_corner(meshes_, slot, f);
            OutlineBox box = OutlineBox::none();
            box.add(corner.at);
            std::uint32_t& lowest = facets_[sides_.part_of(box)];
            lowest = std::min(lowest, corner.facets[0]);
        }
    }
    void add(const FacetsInCells& others) {
        for (std::size_t i = 0; i < facets_.size(); ++i)
            facets_[i] = std::min(facets_[i], others.facets_[i]);
    }
    [[nodiscard]] std::uint32_t of(CellPart part) const { return facets_[part]; }

private:
    const ManyMeshes& meshes_;
    const BoundarySides& sides_;
    std::vector<std::uint32_t> facets_;
};

}  // namespace

BesideBoundary::BesideBoundary(CommonPart& common, const ManyMeshes& meshes, const Solid& boundary,
                               std::span<const std::uint32_t> slots, std::uint32_t threads)
    : common_(common), meshes_(meshes), threads_(threads), sides_(common.store().view(boundary)) {
    find_sides(common.store().view(boundary), slots);
}

void BesideBoundary::find_sides(const OutlinedSolid& boundary,
                                std::span<const std::uint32_t> slots) {
    const ParallelParts ranges = parts_by_thread(slots.size(), threads_, 64);
    std::vector<FacetsInCells> found(ranges.count(), FacetsInCells(meshes_, sides_));
    ranges.for_each([&](std::size_t range, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) found[range].add(slots[i]);
    });
    for (std::size_t i = 1; i < found.size(); ++i) found[0].add(found[i]);
    for (CellPart part = BoundaryCells::outside + 1; part < sides_.part_count(); ++part) {
        const std::uint32_t number = found[0].of(part);
        if (number == no_facet) continue;
        const std::uint32_t slot = meshes_.slot_of(number);
        const OutlineVertex corner =
            first_corner(meshes_, slot, number - meshes_.operands->operands[slot].first);
        sides_.set(part, common_.is_open_at_corner(corner, boundary) ? Side::Open : Side::Closed);
    }
}

Side BesideBoundary::side_at(const OutlineVertex& vertex) const {
    OutlineBox box = OutlineBox::none();
    box.add(vertex.at);
    return sides_.side_of(box);
}

// What is beside the boundary goes from the parts into a solid of its own.
OutlineStore::Solid BesideBoundary::join_near(SettledParts& parts) const {
    std::size_t facets = 0;
    std::size_t edges = 0;
    std::size_t lines = 0;
    for (const auto& part : parts) {
        lines += part->lines.size();
        for (std::size_t f = part->far; f < part->facets.size(); ++f) {
            ++facets;
            edges += part->facets[f].count;
        }
    }
    JoinedParts near(common_.store());
    near.reserve(facets, edges, edges / 3, lines, threads_);
    for (const auto& part : parts) {
        if (part->far == part->facets.size()) continue;
        near.begin(*part);
        for (std::size_t f = part->far; f < part->facets.size(); ++f) near.add(*part, f);
        part->facets.resize(part->far);
        part->boxes.resize(part->far);
        if (part->far == 0) {
            part->facets = {};
            part->boxes = {};
            part->edges = {};
            part->lines = {};
        }
    }
    return near.solid();
}

OutlineStore::Solid BesideBoundary::take(const Solid& solid) {
    OutlineStore& store = common_.store();
    SettledParts parts = store.take_out(solid);
    Solid near = join_near(parts);
    // What is outside of all parts is far out.
    for (const auto& part : parts) near.box.add(part->box);
    near.open_far_out = solid.open_far_out;
    near.united = solid.united;
    const std::span vertices = std::span(store.vertices()).subspan(near.vertices);
    known_.resize(vertices.size());
    ParallelParts(vertices.size(), threads_, least_vertices)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) known_[i] = side_at(vertices[i]);
        });
    for (auto& part : parts) store.add_settled(std::move(part));
    return near;
}

}  // namespace trisect::detail
