// SPDX-License-Identifier: Apache-2.0
//
// SpareOutlines: arrays of outlined solids that were used up, for the next ones.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <trisect/bsp/many_meshes/outlined_solid.h>
#include <trisect/bsp/many_meshes/spare_memory.h>

namespace trisect::detail {

class SpareOutlines {
public:
    /// An empty one with room for so many.
    [[nodiscard]] OutlinedSolid take(std::size_t facets, std::size_t edges, std::size_t vertices) {
        OutlinedSolid out;
        out.facets = facets_.take(facets);
        out.boxes = boxes_.take(facets);
        out.edges = edges_.take(edges);
        out.vertices = vertices_.take(vertices);
        return out;
    }
    /// Room for so many more.
    void make_room(OutlinedSolid& solid, std::size_t facets, std::size_t edges,
                   std::size_t vertices) {
        make_room(solid.facets, facets, facets_);
        make_room(solid.boxes, facets, boxes_);
        make_room(solid.edges, edges, edges_);
        make_room(solid.vertices, vertices, vertices_);
    }
    void give_back(OutlinedSolid&& solid) {
        facets_.give_back(std::move(solid.facets));
        boxes_.give_back(std::move(solid.boxes));
        edges_.give_back(std::move(solid.edges));
        vertices_.give_back(std::move(solid.vertices));
    }

private:
    template <class Vector>
    static void make_room(Vector& items, std::size_t more, SpareMemory<Vector>& spare) {
        const std::size_t all = items.size() + more;
        if (items.capacity() >= all) return;
        Vector larger = spare.take(all + all / 2);
        larger.assign(items.begin(), items.end());
        std::swap(items, larger);
        spare.give_back(std::move(larger));
    }

    SpareMemory<std::vector<OutlinedSolid::Facet>> facets_;
    SpareMemory<std::vector<OutlineBox>> boxes_;
    SpareMemory<std::vector<OutlinedSolid::Edge>> edges_;
    SpareMemory<std::vector<OutlineVertex>> vertices_;
};

}  // namespace trisect::detail
