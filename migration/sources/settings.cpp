// SPDX-License-Identifier: Apache-2.0

#include "settings.h"

#include <algorithm>
#include <cmath>

#include "node.h"

namespace manifold {

ExecutionParams& ManifoldParams() {
    static ExecutionParams params;
    return params;
}

std::uint32_t Manifold::ReserveIDs(std::uint32_t n) {
    static std::atomic<std::uint32_t> next{1};
    return next.fetch_add(n);
}

double sind(double degrees) {
    if (!std::isfinite(degrees)) return std::nan("");
    int quarter = 0;
    const double rest = radians(std::remquo(degrees, 90.0, &quarter));
    switch (quarter & 3) {
        case 0:
            return std::sin(rest);
        case 1:
            return std::cos(rest);
        case 2:
            return -std::sin(rest);
        default:
            return -std::cos(rest);
    }
}

double cosd(double degrees) {
    if (!std::isfinite(degrees)) return std::nan("");
    int quarter = 0;
    const double rest = radians(std::remquo(degrees, 90.0, &quarter));
    switch (quarter & 3) {
        case 0:
            return std::cos(rest);
        case 1:
            return -std::sin(rest);
        case 2:
            return -std::cos(rest);
        default:
            return std::sin(rest);
    }
}

double smoothstep(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return (3 - 2 * t) * t * t;
}

namespace {

struct Circles {
    double angle = 10;
    double length = 1;
    int segments = 0;
};
Circles& circles() {
    static Circles c;
    return c;
}

}  // namespace

void Quality::SetMinCircularAngle(double angle) {
    if (angle > 0) circles().angle = angle;
}
void Quality::SetMinCircularEdgeLength(double length) {
    if (length > 0) circles().length = length;
}
void Quality::SetCircularSegments(int number) {
    if (number >= 3 || number == 0) circles().segments = number;
}
void Quality::ResetToDefaults() { circles() = {}; }

int Quality::GetCircularSegments(double radius) {
    const Circles& c = circles();
    if (c.segments > 0) return c.segments;
    // The fewer of both, in fours.
    const double sides = std::floor(std::min(360 / c.angle, kTwoPi * radius / c.length));
    return std::max(4, 4 * static_cast<int>(std::ceil(sides / 4)));
}

ExecutionContext::ExecutionContext() : impl_(std::make_shared<Impl>()) {}
void ExecutionContext::Cancel() { impl_->cancelled = true; }
bool ExecutionContext::Cancelled() const { return impl_->cancelled; }
double ExecutionContext::Progress() const { return 1; }

Manifold ExecutionContext::FromMeshGL(const MeshGL& mesh) {
    return Cancelled() ? Manifold(ManifoldNode::of_error(Manifold::Error::Cancelled))
                       : Manifold(mesh);
}
Manifold ExecutionContext::FromMeshGL(const MeshGL64& mesh) {
    return Cancelled() ? Manifold(ManifoldNode::of_error(Manifold::Error::Cancelled))
                       : Manifold(mesh);
}

}  // namespace manifold
