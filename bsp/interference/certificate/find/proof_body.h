// SPDX-License-Identifier: Apache-2.0
//
// ProofBody: a solid, for the search for certificates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/triangle_distance.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// Corners of a boundary in the user's units, exactly and as the nearest doubles, and its
/// triangles: halving a range of them, again and again, halves the longest extent of the centres.
struct ProofBody {
    std::vector<ExactPoint> points;  ///< by vertex
    std::vector<std::array<double, 3>> near;
    std::vector<CertifiedTriangle> triangles;

    /// Where it was modelled.
    explicit ProofBody(const InterferenceModelData& model);
    /// In the world.
    ProofBody(const InterferenceModelData& model, const Pose& pose);

    /// In doubles: the mean of vertices, and the square of the distance of the farthest from it.
    [[nodiscard]] std::array<double, 3> middle(std::span<const std::uint32_t> vertices) const;
    [[nodiscard]] double squared_size(std::span<const std::uint32_t> vertices) const;

    /// The vertices of a range of triangles, each once, in ascending order.
    [[nodiscard]] std::vector<std::uint32_t> corners(std::size_t from, std::size_t to) const;

private:
    void add(ExactPoint point);
    void order(std::size_t from, std::size_t to);
    [[nodiscard]] double centre(const CertifiedTriangle& t, std::size_t axis) const;
};

/// The least and the greatest product of a direction with some of a body's vertices.
/// \pre there are any.
[[nodiscard]] ExactRational lowest_along(const ExactPoint& direction,
                                         std::span<const std::uint32_t> vertices,
                                         const ProofBody& body);
[[nodiscard]] ExactRational highest_along(const ExactPoint& direction,
                                          std::span<const std::uint32_t> vertices,
                                          const ProofBody& body);

/// Normals of planes that may keep far bodies apart: the way between them, and the axes.
[[nodiscard]] std::vector<std::array<double, 3>> proof_directions(const std::array<double, 3>& way);

/// Puts the way between the closest points of two triangles in front of `directions`, and the
/// normals of both, either way round, at its end: normals of planes that may keep them apart.
void add_proof_directions(const TriangleCorners& p, const TriangleCorners& q,
                          std::vector<std::array<double, 3>>& directions);

}  // namespace trisect::detail
