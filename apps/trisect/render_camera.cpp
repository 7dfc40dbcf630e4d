// SPDX-License-Identifier: Apache-2.0
//
// Fitting. In coordinates of the view (x to the right, y up, z forward) a point is in the picture
// iff |x - ex| <= s for parallel rays, where s is half the width, and iff |x - ex| <= (z - ez) s
// for rays from an eye at (ex, ey, ez), where s is the tangent of half the opening; the same for y.
// Both are linear: parallel rays need half the extent of x, and an eye needs
//     ex - s ez >= max(x - s z) =: p    and    -ex - s ez >= max(-x - s z) =: q,
// whence ex = (p - q) / 2 and ez = -(p + q) / (2 s), the smaller one of x and y.
#include "render_camera.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "values.h"

namespace trisect::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Extent of the scene in coordinates of the view.
struct Frame {
    Vector3d lower = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d upper = -lower;
};

Vector3d in_view(const View& view, const Point3d& point) {
    const Vector3d p(point[0], point[1], point[2]);
    return {p.dot(view.right), p.dot(view.up), p.dot(view.forward)};
}

Frame frame_of(const View& view, std::span<const Point3d> points) {
    Frame frame;
    for (const Point3d& point : points) {
        const Vector3d p = in_view(view, point);
        frame.lower = frame.lower.cwiseMin(p);
        frame.upper = frame.upper.cwiseMax(p);
    }
    return frame;
}

Vector3d in_space(const View& view, const Vector3d& p) {
    return p.x() * view.right + p.y() * view.up + p.z() * view.forward;
}

/// Eye for half openings with tangents s, in coordinates of the view.
Vector3d eye_that_sees(const View& view, std::span<const Point3d> points, const Vector2d& s) {
    Vector2d p = Vector2d::Constant(-std::numeric_limits<double>::infinity());
    Vector2d q = p;
    for (const Point3d& point : points) {
        const Vector3d v = in_view(view, point);
        p = p.cwiseMax(v.head<2>() - s * v.z());
        q = q.cwiseMax(-v.head<2>() - s * v.z());
    }
    const Vector2d middle = (p - q) / 2;
    const double z = (-(p + q).array() / (2 * s.array())).minCoeff();
    return {middle.x(), middle.y(), z};
}

/// `above` points up in the picture, or `behind` when one looks along it.
View looking_from(const Vector3d& to_eye, const Vector3d& above, const Vector3d& behind) {
    const double largest = to_eye.cwiseAbs().maxCoeff();
    if (!(largest > 0)) throw UsageError("--view: the direction must not be zero");
    View view;
    view.forward = -(to_eye / largest).normalized();
    const bool is_vertical = std::abs(view.forward.dot(above)) > 1 - 1e-12;
    view.right = view.forward.cross(is_vertical ? behind : above).normalized();
    view.up = view.right.cross(view.forward);
    return view;
}

}  // namespace

View View::from_eye_direction(const Vector3d& to_eye) {
    return looking_from(to_eye, Vector3d::UnitZ(), Vector3d::UnitY());
}

View View::from_text(std::string_view text, std::string_view up) {
    struct Name {
        std::string_view name;
        std::array<double, 3> to_eye;
    };
    static constexpr Name names[] = {
        {"iso", {1, -1, 1}},  {"front", {0, -1, 0}}, {"back", {0, 1, 0}},   {"left", {-1, 0, 0}},
        {"right", {1, 0, 0}}, {"top", {0, 0, 1}},    {"bottom", {0, 0, -1}}};
    // A quarter turn that stands the model up.
    const auto stood_up = [up](const std::array<double, 3>& v) {
        if (up == "x") return Vector3d(v[2], v[1], -v[0]);
        if (up == "y") return Vector3d(v[0], v[2], -v[1]);
        return Vector3d(v[0], v[1], v[2]);
    };
    const Vector3d above = stood_up({0, 0, 1});
    const Vector3d behind = stood_up({0, 1, 0});
    const auto found = std::find_if(std::begin(names), std::end(names),
                                    [&](const Name& n) { return n.name == text; });
    if (found != std::end(names)) return looking_from(stood_up(found->to_eye), above, behind);
    if (text.find(',') == std::string_view::npos) {
        throw UsageError(fmt::format(
            "--view: '{}' is none of iso, front, back, left, right, top, bottom, and no x,y,z",
            text));
    }
    const auto to_eye = parse_tuple<3>(text, "--view");
    return looking_from(Vector3d(to_eye[0], to_eye[1], to_eye[2]), above, behind);
}

Camera Camera::fitted(const View& view, std::span<const Point3d> points, PixelSize size,
                      Lens lens) {
    Camera camera(view, size);
    const Vector2d pixels(size.width, size.height);
    const Vector2d usable = pixels * (1 - 2 * lens.margin);
    const Frame frame = frame_of(view, points);
    const Vector3d extent = frame.upper - frame.lower;
    const double diagonal = extent.norm() > 0 ? extent.norm() : 1.0;
    if (lens.opening > 0) {
        camera.is_perspective_ = true;
        const double half = std::tan(lens.opening * std::numbers::pi / 360);
        camera.pixel_ = 2 * half / pixels.minCoeff();
        Vector3d eye = eye_that_sees(view, points, usable * (camera.pixel_ / 2));
        // Never within a scene that is a single point or seen edge-on.
        eye.z() = std::min(eye.z(), frame.lower.z() - diagonal / 100);
        camera.eye_ = in_space(view, eye);
        return camera;
    }
    camera.pixel_ = (extent.head<2>().array() / usable.array()).maxCoeff();
    if (!(camera.pixel_ > 0)) camera.pixel_ = diagonal / usable.minCoeff();
    Vector3d eye = (frame.lower + frame.upper) / 2;
    eye.z() = frame.lower.z() - diagonal;
    camera.eye_ = in_space(view, eye);
    return camera;
}

ViewRay Camera::ray(double x, double y) const {
    const double u = (x - size_.width / 2.0) * pixel_;
    const double v = (size_.height / 2.0 - y) * pixel_;
    const Vector3d offset = u * view_.right + v * view_.up;
    if (is_perspective_) return {eye_, (view_.forward + offset).normalized()};
    return {eye_ + offset, view_.forward};
}

}  // namespace trisect::app
