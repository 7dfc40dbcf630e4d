// SPDX-License-Identifier: Apache-2.0
//
// Seeded random operands and expressions for property tests. Coordinates are small integers (0..15
// before solids are moved against each other), so that coplanar faces, shared edges, T-junctions
// and touching corners occur in almost every sample; random doubles never make them.
//
// The same seed gives the same solids on every platform: no standard distribution is used.
#pragma once

#include <cstdint>
#include <vector>

#include "naive_boolean.h"

namespace reference {

// splitmix64 (Steele, Lea, Flood 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next();
    // Uniform enough for tests; low <= high, both included.
    std::int64_t between(std::int64_t low, std::int64_t high);
    std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(between(0, static_cast<std::int64_t>(count) - 1));
    }
    bool chance(std::int64_t part, std::int64_t whole) { return between(1, whole) <= part; }

private:
    std::uint64_t state_;
};

// Building blocks, all closed, free of self-intersection and with outward normals.
Operand box(const LatticePoint& low, const LatticePoint& high);
Operand tetrahedron(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                    const LatticePoint& d);  // in any orientation, not coplanar
// The simple polygon (in x and y, either orientation) between two heights low < high. Corners may
// lie on the middle of straight sides.
using LatticePolygon = std::vector<std::array<std::int64_t, 2>>;
Operand prism(const LatticePolygon& polygon, std::int64_t low, std::int64_t high);
// The cone from the polygon at the height `base` to an apex at another height.
Operand pyramid(const LatticePolygon& polygon, std::int64_t base, const LatticePoint& apex);

Operand translated(Operand operand, const LatticePoint& by);
Operand reversed(Operand operand);  // inside out
// Coordinate i of the result is coordinate (i + turns) mod 3 of the operand.
Operand axes_rotated(Operand operand, std::size_t turns);
Operand concatenated(Operand a, const Operand& b);

// The same set with up to `most` triangles of it added once more, together with their reverses, at
// random places of the list: sheets that are folded back onto themselves.
Operand with_folds(Random& random, const Operand& operand, std::size_t most);

// A solid with outward normals that does not intersect or touch itself: tetrahedron, box, prism,
// pyramid, octahedron or extruded polygon (L, T, U and cross shapes, monotone lattice polygons).
Operand random_embedded_solid(Random& random);

// Any operand: an embedded solid, several overlapping ones in one list, nested shells, shells with
// a cavity, coincident copies, or inside-out shells.
Operand random_operand(Random& random);

// Several operands; about half of them are made to touch an earlier one: the same solid again, a
// copy moved corner to corner or side by side, or a box that shares part of a side of the earlier
// one's bounding box. With embedded = true none of them intersects itself.
std::vector<Operand> random_family(Random& random, std::size_t count, bool embedded = false);

// An expression over operands 0..operand_count-1, each used at least once, with the given number of
// binary operations (at least operand_count - 1); with complements, any part may be complemented.
Expression random_expression(Random& random, std::size_t operand_count, std::size_t operations,
                             bool with_complements = true);

}  // namespace reference
