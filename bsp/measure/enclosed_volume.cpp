// SPDX-License-Identifier: Apache-2.0
//
// Facets that pass through are read where they lie. Those that were cut are fans over their edges,
// as assembly gathers them: neither do these have to be joined nor cut into triangles.

#include <trisect/bsp/measure/enclosed_volume.h>

#include <array>
#include <cmath>
#include <cstddef>

#include <trisect/bsp/assembly/assembly_parts.h>
#include <trisect/bsp/measure/split_vertices.h>
#include <trisect/bsp/measure/volume_sum.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Facets that pass through.
void add_whole_facets(const FacetMarks& marks, const SplitUnits& units, VolumeSum& sum) {
    const LatticeMesh& mesh = marks.source()->mesh();
    const bool is_held = units.holds(marks.source()->fraction_bits());
    std::size_t since_check = 0;
    marks.for_each_whole([&](std::uint32_t facet, bool flipped) {
        if (++since_check % 65536 == 0) check_stop();
        const auto& t = mesh.triangles[facet];
        const LatticePoint& a = mesh.points[t[0]];
        const LatticePoint& b = mesh.points[t[flipped ? 2 : 1]];
        const LatticePoint& c = mesh.points[t[flipped ? 1 : 2]];
        if (is_held) {
            sum.add(units.whole(a), units.whole(b), units.whole(c));
        } else {
            sum.add(units.split(a), units.split(b), units.split(c));
        }
    });
}

// Facets that were cut, by their edges. The facets of a plane across an axis may share what bounds
// them (axis_faces.h), so the fans of those of constant height are about the centre; the others
// have no projection.
void add_cut_facets(const BoundaryParts& parts, const SplitUnits& units,
                    const SplitVertices& vertices, VolumeSum& sum) {
    struct Fan {
        PointId apex = -1;
        int axis = -1;
    };
    PoolVector<Fan> fans(parts.facets.size());
    for (const BoundaryEdge& e : parts.edges) {
        Fan& fan = fans[as_index(e.facet)];
        if (fan.apex < 0) fan = {e.from, axis_across(parts.facets[as_index(e.facet)])};
        const SplitPoint& from = vertices[e.from];
        const SplitPoint& to = vertices[e.to];
        if (fan.axis < 0) {
            if (fan.apex != e.from && fan.apex != e.to) sum.add(vertices[fan.apex], from, to);
        } else if (fan.axis == 2) {
            const SplitWhole& centre = units.centre();
            sum.add({{centre[0], centre[1], from.whole[2]}, {0, 0, from.rest[2]}}, from, to);
        }
    }
}

EnclosedVolume in_user_units(const VolumeSum& sum, const SplitUnits& units, Lattice lattice) {
    const ExactRational whole(sum.whole());
    const auto volume = [&](double rest) {
        const ExactRational six = whole + ExactRational::from_double(rest);
        return (six / ExactRational(6)).scaled(3 * (lattice.exponent - units.shift()));
    };
    if (sum.is_exact()) {
        const ExactRational exact = volume(0);
        return {exact, exact};
    }
    // Two sums of doubles, rounded outwards.
    const double error = sum.error();
    const double size = 0x1p-50 * (std::fabs(sum.rests()) + error);
    return {volume(sum.rests() - error - size), volume(sum.rests() + error + size)};
}

}  // namespace

EnclosedVolume enclosed_volume(const SolidState& solid) {
    BoundaryParts parts;
    gather_parts(solid, parts, true);
    const SplitUnits units = units_of(parts);
    SplitVertices vertices(parts, units);
    vertices.make(parts.edges);
    VolumeSum sum(vertices.error(), units.centre()[2]);
    for (const FacetMarks& marks : parts.sources)
        if (!marks.source()->is_half_space()) add_whole_facets(marks, units, sum);
    add_cut_facets(parts, units, vertices, sum);
    return in_user_units(sum, units, solid.lattice);
}

}  // namespace trisect::detail
