// SPDX-License-Identifier: Apache-2.0
//
// Where two edges cross, each with two facets, four triples of planes name the point: one edge and
// either facet of the other one. Equal tools at equal steps meet like that in their plane of
// symmetry, all along it. Names say that three planes of such a point P are two that share an edge
// e, and one more, q; and that the plane in question shares an edge f with q. If the ends of e and
// f are coplanar, then e and f are parallel or meet. Parallel to f, e would be parallel to q, which
// it meets in P alone; so the lines meet, and as f lies in q they meet in P. So the plane passes
// through P, whatever else it is.

#include <trisect/bsp/assembly/parts/named_edges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/orientation.h>

namespace trisect::detail {

namespace {

/// An edge by the vertices of its source.
struct NamedEdge {
    const Source* source = nullptr;
    std::array<std::uint32_t, 2> ends{};

    [[nodiscard]] Vector3 end(std::size_t i) const {
        const LatticePoint& p = source->mesh().points[ends[i]];
        return p.doubles();
    }
};

/// The vertices of a source that a plane's name has.
class NamedVertices {
public:
    explicit NamedVertices(const PlaneName& plane) {
        if (plane.is_splitter() || plane.source()->is_half_space()) return;
        source_ = plane.source();
        const auto& corners = source_->mesh().triangles[plane.facet];
        if (!plane.is_edge()) {
            count_ = 3;
            vertices_ = {corners[0], corners[1], corners[2]};
            return;
        }
        count_ = 2;
        vertices_ = {corners[plane.kind], corners[plane.kind == 2 ? 0 : plane.kind + 1]};
    }
    [[nodiscard]] bool has(std::uint32_t vertex) const {
        const auto own = std::span(vertices_).first(count_);
        return std::ranges::find(own, vertex) != own.end();
    }
    [[nodiscard]] bool has(const NamedEdge& edge) const {
        return source_ == edge.source && has(edge.ends[0]) && has(edge.ends[1]);
    }
    [[nodiscard]] std::optional<NamedEdge> common(const NamedVertices& other) const {
        if (source_ == nullptr || source_ != other.source_) return std::nullopt;
        NamedEdge edge{source_};
        std::size_t found = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (!other.has(vertices_[i])) continue;
            if (found == 2) return std::nullopt;
            edge.ends[found++] = vertices_[i];
        }
        if (found != 2) return std::nullopt;
        return edge;
    }

private:
    const Source* source_ = nullptr;
    std::array<std::uint32_t, 3> vertices_{};
    std::size_t count_ = 0;
};

// False where coordinates span too many bits.
bool are_coplanar(const NamedEdge& e, const NamedEdge& f) {
    ++detail::counters_of_thread<PredicateCounters>.exact_short;
    const bool is_whole = e.source->is_whole() && f.source->is_whole();
    const auto orientation = is_whole ? exact_orientation : exact_orientation_of_fractions;
    return orientation(e.end(0), e.end(1), f.end(0), f.end(1)) == 0;
}

}  // namespace

bool passes_by_edges(const Workbench& bench, PointId point, PlaneId plane) {
    const auto& planes = bench.planes_of(point);
    const std::array<NamedVertices, 3> through{NamedVertices(bench.name(planes[0])),
                                               NamedVertices(bench.name(planes[1])),
                                               NamedVertices(bench.name(planes[2]))};
    const NamedVertices asked(bench.name(plane));
    for (std::size_t i = 0; i < 3; ++i) {
        const auto edge = through[(i + 1) % 3].common(through[(i + 2) % 3]);
        if (!edge) continue;
        if (asked.has(*edge)) return true;
        const auto other = through[i].common(asked);
        if (other && are_coplanar(*edge, *other)) return true;
    }
    return false;
}

}  // namespace trisect::detail
