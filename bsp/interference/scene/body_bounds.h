// SPDX-License-Identifier: Apache-2.0
//
// BodyBounds: a world box of a posed body, in constant time.
#pragma once

#include <array>
#include <vector>

#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// Some boxes, in the body's own coordinates, that contain all of its boundary. Value type.
class BodyBounds {
public:
    /// Of a model that is not empty. O(n).
    explicit BodyBounds(const InterferenceModelData& model);
    /// Of a solid that is not empty.
    explicit BodyBounds(const SolidBoundary& solid);

    /// Contains the body under the pose: every rounding is outwards. Unbounded where the numbers
    /// leave the doubles. At most 64 boxes are looked at, whatever the size of the model.
    [[nodiscard]] BodyBox under(const Pose& pose) const { return under(pose.approximate()); }
    /// The same for a matrix, row by row, each number with a relative error below 2^-50.
    [[nodiscard]] BodyBox under(const std::array<double, 12>& rows) const;

private:
    /// A box by its centre and half its sides, in the user's units.
    struct Part {
        std::array<double, 3> centre{};
        std::array<double, 3> half{};
    };
    [[nodiscard]] static Part part_of(const BodyBox& box, Lattice lattice, double slack);

    std::vector<Part> parts_;
};

}  // namespace trisect::detail
