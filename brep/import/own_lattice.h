// SPDX-License-Identifier: Apache-2.0
//
// Lattices of inputs that come without one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/kernel/lattice.h>

namespace trisect::detail {

/// The points on `given`, rounded to whole coordinates; or on the lattice that choose_lattice()
/// chooses for them. \throw as to_lattice
[[nodiscard]] inline std::vector<LatticePoint> points_on_lattice(
    std::span<const Point3d> points, const std::optional<Lattice>& given, Fractions fractions,
    LatticeReport& report, std::uint32_t threads = 0) {
    if (given) return to_lattice(points, *given, report, threads);
    return to_lattice(points, choose_lattice(points, threads, fractions), report, threads,
                      fractions);
}

}  // namespace trisect::detail
