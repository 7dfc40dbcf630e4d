// SPDX-License-Identifier: Apache-2.0
//
// EventModel: the triangles of a moving boundary as searches of events see them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/relation/boundary.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/number/ball.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect::detail {

/// Exact triangles that together are a boundary. Every vertex and every edge belongs to one
/// triangle that has it, so that a pair of features is looked at with one pair of triangles only.
/// Sides that belong to none are within a face, and no event is there that others do not have.
///
/// What boxes are around are parts, of which each is one or several of these triangles.
class EventModel {
public:
    using Corners = std::array<BallVector, 3>;
    /// Numbers of triangles.
    struct Range {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
    };

    explicit EventModel(const Boundary& boundary) : boundary_(boundary) {}
    EventModel(const EventModel&) = delete;
    EventModel& operator=(const EventModel&) = delete;
    virtual ~EventModel() = default;

    [[nodiscard]] const Boundary& boundary() const { return boundary_; }
    [[nodiscard]] bool owns_vertex(std::uint32_t t, std::size_t i) const {
        return (owned_[t] >> i & 1U) != 0;
    }
    [[nodiscard]] bool owns_edge(std::uint32_t t, std::size_t i) const {
        return (owned_[t] >> (3 + i) & 1U) != 0;
    }

    /// Whether several triangles of the boundary may belong to one part.
    [[nodiscard]] virtual bool has_common_parts() const = 0;
    /// The part of a triangle of the boundary.
    [[nodiscard]] virtual std::uint32_t part_of(std::uint32_t boundary_triangle) = 0;
    [[nodiscard]] virtual Range triangles_of(std::uint32_t part) = 0;
    /// The number of triangles of the boundary, all of which can be given to `part_of` then.
    [[nodiscard]] virtual std::uint32_t open_all() = 0;

    /// The corners of a triangle, counter-clockwise seen from outside.
    [[nodiscard]] virtual Corners corners(std::uint32_t t) const = 0;
    [[nodiscard]] virtual const Point& point(std::uint32_t t, std::size_t i) const = 0;
    /// Outward.
    [[nodiscard]] virtual const Plane& plane(std::uint32_t t) const = 0;

protected:
    void set_owns_vertex(std::uint32_t t, std::size_t i) {
        owned_[t] |= static_cast<std::uint8_t>(1U << i);
    }
    void set_owns_edge(std::uint32_t t, std::size_t i) {
        owned_[t] |= static_cast<std::uint8_t>(1U << (3 + i));
    }
    void resize(std::size_t triangles) { owned_.resize(triangles); }

private:
    const Boundary& boundary_;
    std::vector<std::uint8_t> owned_;
};

/// Of an InterferenceModel, whose triangles these are.
class ModelEvents final : public EventModel {
public:
    explicit ModelEvents(const InterferenceModelData& data);

    [[nodiscard]] const InterferenceModelData& data() const { return data_; }
    [[nodiscard]] const ModelTriangle& triangle(std::uint32_t t) const {
        return data_.triangles[t];
    }

    [[nodiscard]] bool has_common_parts() const override { return false; }
    [[nodiscard]] std::uint32_t part_of(std::uint32_t boundary_triangle) override {
        return boundary_triangle;
    }
    [[nodiscard]] Range triangles_of(std::uint32_t part) override { return {part, part + 1}; }
    [[nodiscard]] std::uint32_t open_all() override {
        return static_cast<std::uint32_t>(data_.triangles.size());
    }
    [[nodiscard]] Corners corners(std::uint32_t t) const override;
    [[nodiscard]] const Point& point(std::uint32_t t, std::size_t i) const override {
        return data_.brep.point(triangle(t).vertex[i]);
    }
    [[nodiscard]] const Plane& plane(std::uint32_t t) const override {
        return data_.brep.plane(triangle(t).face);
    }

private:
    const InterferenceModelData& data_;
};

}  // namespace trisect::detail
