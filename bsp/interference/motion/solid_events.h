// SPDX-License-Identifier: Apache-2.0
//
// SolidEvents: the polygons of a solid's cells as an EventModel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <trisect/bsp/interference/motion/contact_event.h>
#include <trisect/bsp/interference/motion/event_model.h>
#include <trisect/bsp/interference/motion/exact_paths.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/interference/tree/exact_triangles.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/polygon_id.h>

namespace trisect::detail {

/// A part is a polygon; its triangles are the exact ones (ExactTriangles), made when a search comes
/// to it.
class SolidEvents final : public EventModel {
public:
    /// `solid` must outlive this.
    explicit SolidEvents(const SolidBoundary& solid) : EventModel(solid), solid_(solid) {}

    [[nodiscard]] const SolidBoundary& solid() const { return solid_; }
    /// What all polygons of the solid at a feature make of it.
    struct Entity {
        EntityName name;
        ExactLine line;  ///< of an edge
    };
    [[nodiscard]] Entity entity_of(const ContactFeature& feature) const;

    [[nodiscard]] bool has_common_parts() const override { return true; }
    [[nodiscard]] std::uint32_t part_of(std::uint32_t boundary_triangle) override {
        return exact_.number_of(solid_.origin(boundary_triangle).polygon());
    }
    [[nodiscard]] Range triangles_of(std::uint32_t part) override;
    [[nodiscard]] std::uint32_t open_all() override { return solid_.open_all(); }
    [[nodiscard]] Corners corners(std::uint32_t t) const override;
    [[nodiscard]] const Point& point(std::uint32_t t, std::size_t i) const override {
        return exact_[t].corner[i];
    }
    [[nodiscard]] const Plane& plane(std::uint32_t t) const override { return *exact_[t].plane; }

private:
    // Bits of coordinates.
    using Place = std::array<std::uint64_t, 3>;
    using Ends = std::array<Place, 2>;
    struct Hash {
        [[nodiscard]] std::size_t operator()(const Place& p) const;
        [[nodiscard]] std::size_t operator()(const Ends& e) const;
    };

    [[nodiscard]] std::vector<PolygonId> polygons_at(const IndexPoint& point) const;
    void own(const Range& fan);
    void own_vertex(std::uint32_t t, std::size_t i);
    void own_edge(std::uint32_t t, std::size_t i);

    const SolidBoundary& solid_;
    ExactTriangles exact_;
    std::uint32_t done_ = 0;  // triangles before have their owners
    std::unordered_set<Place, Hash> vertices_;
    std::unordered_set<Ends, Hash> edges_;
};

}  // namespace trisect::detail
