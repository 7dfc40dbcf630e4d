// SPDX-License-Identifier: Apache-2.0

#include <algorithm>

#include <trisect/brep/measure.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/solid_regions.h>
#include <trisect/bsp/interference/tree/part_near.h>
#include <trisect/bsp/solid_transform.h>

namespace trisect {

namespace {

// Whether axes go to axes, at the same scale: transformed() keeps such solids exactly, if a lattice
// has them.
bool permutes_axes(const Pose& pose) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Pose::Number& m = pose.matrix(i, j);
            if (!m.is_zero() && !(m == pose.denominator()) && !(m == -pose.denominator()))
                return false;
        }
    return true;
}

bool is_imported(const Solid& solid) { return detail::state_of(solid)->source != 0; }

ExactRational number(const Pose::Number& n) { return ExactRational(n); }

// |det M| / S^3
ExactRational volume_factor(const Pose& pose) {
    const auto m = [&pose](std::size_t i, std::size_t j) { return number(pose.matrix(i, j)); };
    ExactRational det;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        det += m(0, i) * (m(1, j) * m(2, k) - m(1, k) * m(2, j));
    }
    const ExactRational s = number(pose.denominator());
    det /= s * s * s;
    return det.sign() < 0 ? -det : det;
}

}  // namespace

Overlap overlap(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b) {
    const detail::SolidBoundary boundary_a(a);
    const detail::SolidBoundary boundary_b(b);
    if (boundary_a.is_empty() || boundary_b.is_empty()) return {};
    const Solid part_a = detail::part_near(a, boundary_a, pose_a, boundary_b, pose_b);
    const Solid part_b = detail::part_near(b, boundary_b, pose_b, boundary_a, pose_a);
    if (part_a.is_empty() || part_b.is_empty()) return {};
    const Pose to_a = pose_a.inverse() * pose_b;
    if (permutes_axes(to_a)) {
        LatticeReport report;
        const Solid moved = transformed(part_b, to_a, &report);
        if (report.lossless) {
            Overlap result;
            result.scaled_solid = evaluate(Expression(part_a) & Expression(moved));
            result.volume = exact_volume(result.scaled_solid.to_brep()) * volume_factor(pose_a);
            return result;
        }
    }
    // Where a box cuts a mesh are corners that no lattice has.
    if (is_imported(a) && is_imported(b))
        return overlap(InterferenceModel(a), pose_a, InterferenceModel(b), pose_b);
    return overlap(InterferenceModel(part_a), pose_a, InterferenceModel(part_b), pose_b);
}

}  // namespace trisect
