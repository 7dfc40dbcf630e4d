// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/hull_faces.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/disjoint_sets.h>

namespace trisect::detail {
namespace {

using Facets = std::span<const HullFacets::Facet>;
using Triangle = HullFacets::Triangle;

constexpr std::uint32_t none = 0xffffffff;

// For each facet the first one of its face: facets of one plane are connected by edges.
std::vector<std::uint32_t> firsts_of_faces(Facets facets) {
    DisjointSets sets;
    sets.start(facets.size());
    for (std::uint32_t f = 0; f < facets.size(); ++f)
        for (const std::uint32_t g : facets[f].neighbours)
            if (g < f && is_same_plane(facets[f].plane, facets[g].plane)) sets.join(f, g);
    std::vector<std::uint32_t> out(facets.size());
    for (std::uint32_t f = 0; f < facets.size(); ++f) out[f] = sets.root(f);
    return out;
}

class MeshOfFaces {
public:
    MeshOfFaces(std::span<const LatticePoint> points, Lattice lattice)
        : points_(points), names_(points.size(), none), next_(points.size(), none) {
        out_.lattice = lattice;
    }

    LatticeMesh run(Facets facets) {
        const std::vector<std::uint32_t> first = firsts_of_faces(facets);
        // Facets in the order of their faces, those of one face together.
        std::vector<std::uint32_t> order(facets.size());
        for (std::uint32_t f = 0; f < order.size(); ++f) order[f] = f;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t f, std::uint32_t g) { return first[f] < first[g]; });
        for (std::size_t i = 0; i < order.size();) {
            const std::uint32_t face = first[order[i]];
            std::uint32_t from = none;
            for (; i < order.size() && first[order[i]] == face; ++i)
                from = std::min(from, add_outline(facets[order[i]], first, face));
            add_face(corners_of_outline(from));
        }
        return std::move(out_);
    }

private:
    // Edges to other faces; returns the least corner that begins one.
    std::uint32_t add_outline(const HullFacets::Facet& f, const std::vector<std::uint32_t>& first,
                              std::uint32_t face) {
        std::uint32_t least = none;
        for (std::size_t k = 0; k < 3; ++k) {
            if (first[f.neighbours[k]] == face) continue;
            next_[f.corners[k]] = f.corners[(k + 1) % 3];
            least = std::min(least, f.corners[k]);
        }
        return least;
    }
    // Counter-clockwise, without those where the outline goes straight on.
    [[nodiscard]] std::vector<std::uint32_t> corners_of_outline(std::uint32_t from) const {
        std::vector<std::uint32_t> out;
        std::uint32_t at = from;
        do {
            const std::uint32_t middle = next_[at];
            if (!are_collinear(points_[at], points_[middle], points_[next_[middle]]))
                out.push_back(middle);
            at = middle;
        } while (at != from);
        return out;
    }
    void add_face(const std::vector<std::uint32_t>& outline) {
        std::size_t low = 0;
        std::size_t high = outline.size() - 1;
        for (bool at_low = true; high - low > 1; at_low = !at_low) {
            const std::size_t middle = at_low ? low + 1 : high - 1;
            add_triangle({outline[low], outline[middle], outline[high]});
            (at_low ? low : high) = middle;
        }
        ++face_;
    }
    void add_triangle(Triangle t) {
        for (std::uint32_t& corner : t) {
            std::uint32_t& name = names_[corner];
            if (name == none) {
                name = static_cast<std::uint32_t>(out_.points.size());
                out_.points.push_back(points_[corner]);
            }
            corner = name;
        }
        out_.triangles.push_back(t);
        out_.face_of_triangle.push_back(face_);
    }

    std::span<const LatticePoint> points_;
    std::vector<std::uint32_t> names_;  // in the result
    std::vector<std::uint32_t> next_;   // of a corner, along the outline of the present face
    std::uint32_t face_ = 0;
    LatticeMesh out_;
};

}  // namespace

LatticeMesh mesh_of_faces(std::span<const LatticePoint> points, Facets facets, Lattice lattice) {
    return MeshOfFaces(points, lattice).run(facets);
}

}  // namespace trisect::detail
