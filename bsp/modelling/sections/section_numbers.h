// SPDX-License-Identifier: Apache-2.0
//
// SectionNumbers: coordinates of corners of a section.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/brep/primitives/point_2d.h>
#include <trisect/bsp/modelling/sections/mesh_section.h>
#include <trisect/kernel/number/double_pair.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

/// Corners of the section of a mesh with one plane, in coordinates of the frame: in pairs of
/// doubles where these show the nearest double, in fractions else.
class SectionNumbers {
public:
    /// The ends below and above the plane of the edge that passes through it; or twice a corner of
    /// the mesh that is in the plane.
    using Name = std::array<std::uint32_t, 2>;

    /// Refers to the mesh.
    SectionNumbers(const MeshSection& mesh, double height) : mesh_(mesh), height_(height) {}

    /// To the nearest doubles.
    [[nodiscard]] Point2d rounded(const Name& name) const;
    /// Whether a corner is where its doubles are.
    [[nodiscard]] bool is_exact(const Name& name, const Point2d& rounded) const;
    /// Whether the way from a to c by b is straight and goes on at b.
    [[nodiscard]] bool goes_straight(const Name& a, const Name& b, const Name& c) const;

    /// Normal . point of a corner of the mesh, less the height: its sign.
    [[nodiscard]] static int exact_side(const MeshSection& mesh, std::uint32_t v, double height);

private:
    using Numbers = std::array<mpq_class, 2>;
    struct Pairs {
        std::array<DoublePair, 2> at;
        double error = 0;  // of a coordinate
    };

    [[nodiscard]] Numbers exact(const Name& name) const;
    [[nodiscard]] std::optional<Pairs> in_pairs(const Name& name) const;
    [[nodiscard]] bool turns_by_pairs(const Name& a, const Name& b, const Name& c) const;

    const MeshSection& mesh_;
    double height_;
};

/// Whether corners that were rounded once surely turn at b.
[[nodiscard]] bool surely_turns(const Point2d& a, const Point2d& b, const Point2d& c);
/// Whether the side from b goes on as the one to b does, 1, or comes back, -1; 0 for unknown.
[[nodiscard]] int sure_direction(const Point2d& a, const Point2d& b, const Point2d& c);

}  // namespace trisect::detail
