// SPDX-License-Identifier: Apache-2.0
//
// NearSearch: edges, or points, near a point.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <trisect/brep/mend/exact_distance.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

/// A tree over edges, or over points, which are edges from themselves to themselves. Refers to the
/// points. What a search finds may be farther away than the bound, but nothing nearer is missed.
class NearSearch {
public:
    NearSearch(std::span<const LatticePoint> points,
               std::span<const std::array<std::uint32_t, 2>> edges, const DistanceBound& bound)
        : triangles_(as_triangles(edges)),
          tree_(points, triangles_),
          bound_(bound),
          left_(most_of_each * edges.size() + most_of_all) {}

    /// Calls visit(index of the edge). \throw LimitError if all searches find too many
    template <class Visit>
    void for_each_near(const LatticePoint& p, Visit&& visit) {
        LatticeBox box;
        box.low = {lower(p.x), lower(p.y), lower(p.z)};
        box.high = {upper(p.x), upper(p.y), upper(p.z)};
        check_stop();
        tree_.for_each_in(box, [&](std::uint32_t i) {
            if (left_-- == 0)
                throw LimitError(
                    "mend: within the distance of seams lie too many vertices of open edges, "
                    "several hundred of each; a smaller distance has fewer");
            visit(i);
        });
    }

private:
    static constexpr std::uint64_t most_of_each = 256;
    static constexpr std::uint64_t most_of_all = 1'000'000;

    static std::vector<std::array<std::uint32_t, 3>> as_triangles(
        std::span<const std::array<std::uint32_t, 2>> edges) {
        std::vector<std::array<std::uint32_t, 3>> out;
        out.reserve(edges.size());
        for (const auto& [a, b] : edges) out.push_back({a, b, b});
        return out;
    }
    [[nodiscard]] Coordinate lower(Coordinate c) const {
        return Coordinate(std::nextafter(c.to_double() - bound_.above(),
                                         -std::numeric_limits<double>::infinity()));
    }
    [[nodiscard]] Coordinate upper(Coordinate c) const {
        return Coordinate(std::nextafter(c.to_double() + bound_.above(),
                                         std::numeric_limits<double>::infinity()));
    }

    std::vector<std::array<std::uint32_t, 3>> triangles_;
    TriangleTree tree_;
    const DistanceBound& bound_;
    std::uint64_t left_;
};

}  // namespace trisect::detail
