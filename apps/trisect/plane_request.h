// SPDX-License-Identifier: Apache-2.0
//
// PlaneRequest: a plane as users write it.
#pragma once

#include <trisect/brep/measure.h>

#include <array>
#include <optional>
#include <string_view>

namespace trisect::app {

/// "a,b,c,d": a x + b y + c z + d = 0; "z=0.5": that; "z": through the middle of the solid. Planes
/// of the two short forms look towards the eye of the view "iso", that is +x, -y and +z.
class PlaneRequest {
public:
    /// \throw UsageError naming the option.
    [[nodiscard]] static PlaneRequest from_text(std::string_view text, std::string_view option);

    /// The axis it is perpendicular to, for the short forms.
    [[nodiscard]] std::optional<int> axis() const { return axis_; }
    /// a, b, c, d. The plane is oriented by (a, b, c).
    [[nodiscard]] std::array<double, 4> coefficients(const Bounds& bounds) const;
    /// Of the short forms: the coordinate along the axis. \pre axis()
    [[nodiscard]] double position(const Bounds& bounds) const;

private:
    std::optional<int> axis_;
    std::optional<double> position_;
    std::array<double, 4> coefficients_{};
};

}  // namespace trisect::app
