// SPDX-License-Identifier: Apache-2.0
//
// Spheres: nothing is cheaper to move, one centre, whatever way it is turned; and nothing contains
// a flat piece of surface worse (Quinlan 1994, Hubbard 1995).
//
// Fitted after Ritter (Graphics Gems, 1990): from two points far apart, grown by whatever is
// outside, then shrunk by moving the centre a part of the way to the farthest point a few times
// (Bădoiu and Clarkson 2003). Whatever the centre, the radius is the distance of the farthest
// point, rounded up, so the sphere contains everything.
//
// Roundings, with numbers below 4 in units: a distance in doubles is off by less than 2^-49, a
// point by √3 of its error in each coordinate, the centre by nothing, because it is where it is.
// A moved centre is off by √3 of the map's error and of a float's 2^-24 of it; radii grow by
// `stretch` at most.

#include <trisect/bsp/hierarchies/volumes/sphere_kind.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/bsp/hierarchies/volumes/volume_hierarchies.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchy.h>
#include <trisect/kernel/support/float_above.h>

namespace trisect::hierarchies {

namespace {

using detail::Vector3;

const Vector3& farthest(std::span<const Vector3> points, const Vector3& from) {
    const Vector3* best = points.data();
    double most = -1;
    for (const Vector3& p : points) {
        const double d = squared_distance(p, from);
        if (d > most) {
            most = d;
            best = &p;
        }
    }
    return *best;
}

// Towards the farthest point by falling steps.
Vector3 center_of(std::span<const Vector3> points) {
    const Vector3& p = farthest(points, points.front());
    const Vector3& q = farthest(points, p);
    Vector3 c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = 0.5 * (p[k] + q[k]);
    Vector3 best = c;
    double least = squared_distance(farthest(points, c), c);
    for (int step = 2; step < 10; ++step) {
        const Vector3& f = farthest(points, c);
        for (std::size_t k = 0; k < 3; ++k) c[k] += (f[k] - c[k]) / (2 * step);
        const double reach = squared_distance(farthest(points, c), c);
        if (reach < least) {
            least = reach;
            best = c;
        }
    }
    return best;
}

}  // namespace

SphereKind::Moved SphereKind::Pose::moved(const Volume& v) const {
    const Vector3 c = map_(v.middle());
    Moved r;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        r.center[k] = static_cast<float>(c[k]);
        largest = std::max(largest, std::abs(c[k]));
    }
    r.radius =
        float_above(stretch_ * static_cast<double>(v.radius) + 1.8 * 0x1p-24 * largest + error_);
    return r;
}

SphereKind::Volume SphereKind::fit_about(const Vector3& center, std::span<const Vector3> corners,
                                         double error) {
    Volume r;
    for (std::size_t k = 0; k < 3; ++k) r.center[k] = static_cast<float>(center[k]);
    const Vector3 m = r.middle();
    r.radius = float_above(std::sqrt(squared_distance(farthest(corners, m), m)) + 0x1p-48 +
                           1.7321 * error);
    return r;
}

SphereKind::Volume SphereKind::fit(std::span<const Vector3> corners, double error) {
    return fit_about(center_of(corners), corners, error);
}

std::unique_ptr<PairStructure> make_sphere_tree(const InterferenceModel& a,
                                                const InterferenceModel& b) {
    return std::make_unique<VolumeHierarchy<SphereKind>>(a, b, TreeOptions{}, "sphere");
}

}  // namespace trisect::hierarchies
