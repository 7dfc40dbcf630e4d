// SPDX-License-Identifier: Apache-2.0
//
// NamedOutlines: faces of a result by named edges, before points are made.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Faces that did not come out of their operands as they were, each named after one facet of its
/// plane and bounded by edges between named points. Whoever keeps them keeps their sources.
struct NamedOutlines {
    /// The common point of three planes, or a corner of the facet whose support planes[0] is.
    struct Vertex {
        std::array<PlaneName, 3> planes;
        int corner = -1;

        [[nodiscard]] static Vertex corner_of(const Source* source, std::uint32_t facet, int i) {
            return {{PlaneName::support(source, facet), {}, {}}, i};
        }
        [[nodiscard]] static Vertex meet(const PlaneName& p, const PlaneName& q,
                                         const PlaneName& r) {
            return {{p, q, r}, -1};
        }
    };
    struct Face {
        const Source* source = nullptr;
        std::uint32_t facet = 0;
        bool flipped = false;
    };
    /// The face is to its left, seen from outside.
    struct Edge {
        Vertex from;
        Vertex to;
        EdgeName line;
        std::uint32_t face = 0;
    };

    PoolVector<Face> faces;  ///< each has edges
    PoolVector<Edge> edges;  ///< with all vertices of the result that lie on them
    /// Whatever part of a face is looked at, it comes from the operand's face that the facet is of,
    /// but for the planes of `first_facets`.
    bool names_hold_everywhere = true;
    /// Facets after which a plane is named in which several faces of one source were cut, and none
    /// of another: the first of those. The name holds for what such a facet has a part in.
    PoolVector<Face> first_facets;
};

}  // namespace trisect::detail
