// SPDX-License-Identifier: Apache-2.0
//
// SolidSketch: small solids for the tests of the boundary, drawn face by face over lattice points.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <trisect/brep/brep_builder.h>

#include "support/lattice_arithmetic.h"

namespace trisect::test {

using Polygon = std::vector<LatticePoint>;

/// Collects faces; equal points become one vertex.
class SolidSketch {
public:
    explicit SolidSketch(Lattice lattice = {}) : builder_(lattice) {}

    /// The plane runs through the first three corners of the outer loop that are not collinear;
    /// draw convex corners first.
    SolidSketch& face(const std::vector<Polygon>& loops) {
        const Polygon& outer = loops.front();
        std::size_t k = 2;
        while (are_collinear(outer[0], outer[1], outer[k])) ++k;
        return face(Plane::through(outer[0], outer[1], outer[k]), loops);
    }
    SolidSketch& face(const Plane& plane, const std::vector<Polygon>& loops) {
        std::vector<std::vector<std::uint32_t>> ids;
        for (const Polygon& loop : loops) {
            ids.emplace_back();
            for (const LatticePoint& p : loop) ids.back().push_back(vertex(p));
        }
        builder_.add_face(plane, ids, {0, static_cast<std::uint32_t>(builder_.face_count())});
        return *this;
    }
    /// Six quads, outward, or inward for a cavity.
    SolidSketch& box(LatticePoint lo, LatticePoint hi, bool outward = true) {
        const auto corner = [&](int i) {
            return LatticePoint{(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y,
                                (i & 4) != 0 ? hi.z : lo.z};
        };
        constexpr std::array<std::array<int, 4>, 6> quads{
            {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
        for (const auto& q : quads) {
            Polygon loop{corner(q[0]), corner(q[1]), corner(q[2]), corner(q[3])};
            if (!outward) loop = {loop[3], loop[2], loop[1], loop[0]};
            face({loop});
        }
        return *this;
    }
    /// The walls between two congruent loops: `bottom` counter-clockwise seen from above, moved up
    /// by `height`; outward for a prism, inward when the loop runs clockwise.
    SolidSketch& walls(const Polygon& bottom, std::int64_t height) {
        for (std::size_t i = 0; i < bottom.size(); ++i) {
            const LatticePoint a = bottom[i];
            const LatticePoint b = bottom[(i + 1) % bottom.size()];
            face({{a, b, b + LatticePoint{0, 0, height}, a + LatticePoint{0, 0, height}}});
        }
        return *this;
    }
    std::uint32_t vertex(const LatticePoint& p) {
        const auto [at, is_new] = vertices_.try_emplace(p, 0U);
        if (is_new) at->second = builder_.add_vertex(p);
        return at->second;
    }
    BrepBuilder& builder() { return builder_; }
    Brep build() { return std::move(builder_).build(); }

private:
    BrepBuilder builder_;
    std::map<LatticePoint, std::uint32_t> vertices_;
};

inline Polygon reversed(const Polygon& p) { return {p.rbegin(), p.rend()}; }

inline Polygon lifted(const Polygon& p, std::int64_t height) {
    Polygon out;
    for (const LatticePoint& q : p) out.push_back(q + LatticePoint{0, 0, height});
    return out;
}

/// A prism over polygons with holes: loops[0] counter-clockwise seen from above, holes clockwise.
inline Brep prism(const std::vector<Polygon>& loops, std::int64_t height, Lattice lattice = {}) {
    SolidSketch sketch(lattice);
    std::vector<Polygon> top;
    std::vector<Polygon> bottom;
    for (const Polygon& loop : loops) {
        top.push_back(lifted(loop, height));
        bottom.push_back(reversed(loop));
        sketch.walls(loop, height);
    }
    sketch.face(Plane(0, 0, 1, Plane::Coefficient(-(loops[0][0].z + height))), top);
    sketch.face(Plane(0, 0, -1, Plane::Coefficient(loops[0][0].z.to_integer())), bottom);
    return sketch.build();
}

inline Polygon rectangle(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
    return {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
}

inline Brep cube(std::int64_t size, Lattice lattice = {}) {
    return SolidSketch(lattice).box({0, 0, 0}, {size, size, size}).build();
}

}  // namespace trisect::test
