// SPDX-License-Identifier: Apache-2.0
//
// ExactPlace: the rational coordinates of a contact, on demand.
#pragma once

#include <array>
#include <optional>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::detail {

struct MeetingPair;
struct PosedModels;

/// A point in the lattice units of one solid.
struct ExactPlace {
    std::array<ExactRational, 3> c;
    friend bool operator==(const ExactPlace&, const ExactPlace&) = default;
    friend std::strong_ordering operator<=>(const ExactPlace& a, const ExactPlace& b);
};

[[nodiscard]] ExactPlace exact_place(const Point& p);
[[nodiscard]] ExactPlace moved(const ExactPlace& p, const RelativePose& pose);
/// A point given in a solid's lattice, in the world and in the user's units.
[[nodiscard]] std::array<ExactRational, 3> in_world(const ExactPlace& p, Lattice lattice,
                                                    const Pose& pose);

/// Where a point of a pair's contact is, in A's lattice. \pre its features are not both interiors.
[[nodiscard]] ExactPlace place_of(const PosedModels& models, const MeetingPair& pair,
                                  const MeetingPoint& point);

[[nodiscard]] ExactPlace place_of(const PosedTriangle& a, const PosedTriangle& b,
                                  const PosedPair& poses, const MeetingPoint& point);

/// The feature of a triangle that a point in its solid's lattice is on, if it is in the triangle.
[[nodiscard]] std::optional<Feature> feature_at(const PosedTriangle& triangle,
                                                const ExactPlace& point);
[[nodiscard]] std::optional<Feature> feature_at(const InterferenceModelData& model,
                                                std::uint32_t triangle, const ExactPlace& point);

}  // namespace trisect::detail
