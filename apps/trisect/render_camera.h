// SPDX-License-Identifier: Apache-2.0
//
// Camera: rays in space for places in a picture.
#pragma once

#include <trisect/brep/polygon_mesh.h>

#include <Eigen/Core>

#include <span>
#include <string_view>

#include "png_file.h"

namespace trisect::app {

/// The rays of a picture are points and directions in doubles, in the user's units; the queries
/// take them exactly as they are.
struct ViewRay {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;  ///< of length 1 up to rounding
};

/// From where one looks. All vectors have length 1 and are perpendicular to each other.
struct View {
    Eigen::Vector3d forward;  ///< from the eye into the scene
    Eigen::Vector3d right;
    Eigen::Vector3d up;

    /// "iso", "front", "back", "left", "right", "top", "bottom", or "x,y,z": the direction from the
    /// scene to the eye. The model stands on the plane perpendicular to `up`, "x", "y" or "z"; the
    /// names of views mean the model as it stands, x,y,z its own axes. \throw UsageError
    [[nodiscard]] static View from_text(std::string_view text, std::string_view up);
    /// z is up; seen from above or below, y is. \throw UsageError for the zero vector
    [[nodiscard]] static View from_eye_direction(const Eigen::Vector3d& to_eye);
};

/// Orthographic with an opening of zero, otherwise perspective.
class Camera {
public:
    struct Lens {
        double opening = 0;    ///< angle of the shorter side in degrees, below 180
        double margin = 0.06;  ///< part of each side left free around the scene
    };

    /// The picture just holds all the points. \pre there is a point; the size is not empty.
    [[nodiscard]] static Camera fitted(const View& view, std::span<const Point3d> points,
                                       PixelSize size, Lens lens);

    /// The ray through (x, y), counted in pixels from the upper left corner of the picture; the
    /// centre of the first pixel is (0.5, 0.5). All rays begin outside of the scene.
    [[nodiscard]] ViewRay ray(double x, double y) const;
    /// Distance of the rays of neighbouring pixels at distance t from their origins, about.
    [[nodiscard]] double pixel_width(double t) const {
        return is_perspective_ ? t * pixel_ : pixel_;
    }
    [[nodiscard]] const View& view() const { return view_; }
    /// The eye, or for parallel rays the origin of the middle one.
    [[nodiscard]] const Eigen::Vector3d& eye() const { return eye_; }

private:
    Camera(const View& view, PixelSize size) : view_(view), size_(size) {}

    View view_;
    PixelSize size_;
    bool is_perspective_ = false;
    Eigen::Vector3d eye_ = Eigen::Vector3d::Zero();
    double pixel_ = 0;  // user's units a pixel, at distance 1 for perspective
};

}  // namespace trisect::app
