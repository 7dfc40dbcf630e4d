// SPDX-License-Identifier: Apache-2.0
//
// FromWorld: the inverse map from the world to a placed solid.
// Its coefficients are fractions.
#pragma once

#include <array>

#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// Keeps references to both. For the search for certificates.
class FromWorld {
public:
    FromWorld(const InterferenceModelData& model, const Pose& pose);

    /// Where a point was before the pose, in the user's units.
    [[nodiscard]] ExactPoint moved_back(const ExactPoint& p) const;
    /// \pre not on the boundary
    [[nodiscard]] bool is_inside(const ExactPoint& p) const;

private:
    const InterferenceModelData* model_;
    const Pose* pose_;
    std::array<ExactPoint, 3> columns_;  // of the inverse matrix
};

}  // namespace trisect::detail
