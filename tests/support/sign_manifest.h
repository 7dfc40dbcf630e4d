// SPDX-License-Identifier: Apache-2.0
//
// Sign manifest: one number for a million signs of the kernel's predicates, which every build has
// to reproduce.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicate_suite.h>
#include <trisect/kernel/predicate_suite_side.h>
#include <trisect/kernel/predicates.h>

namespace sign_manifest {

namespace suite = trisect::predicate_suite;
using trisect::Plane;

inline Plane plane_of(const suite::PlaneEquation& e) {
    const auto n = [&e](std::size_t i) { return trisect::Int128{static_cast<std::int64_t>(e[i])}; };
    return {n(0), n(1), n(2), Plane::Coefficient(static_cast<std::int64_t>(e[3]))};
}

/// By the library: nothing where the points do not fit on one lattice, which import would report.
inline std::optional<int> orient3d_by_kernel(const std::array<suite::Point3, 4>& p) {
    // Import leaves growth_bits free. Here all 53 bits may be used.
    trisect::LatticeReport report;
    trisect::Lattice lattice = trisect::choose_lattice(p);
    std::vector<trisect::LatticePoint> q;
    try {
        q = trisect::to_lattice(p, lattice, report);
        if (!report.lossless) {
            report = {};
            lattice.exponent -= 8;
            q = trisect::to_lattice(p, lattice, report);
        }
    } catch (const trisect::LimitError&) {
        return std::nullopt;
    }
    if (!report.lossless) return std::nullopt;
    if (trisect::are_collinear(q[0], q[1], q[2])) return 0;
    return trisect::sign_of(side_of(q[3], Plane::through(q[0], q[1], q[2])));
}

/// FNV-1a over signs.
class SignHash {
public:
    void add(int sign) {
        hash_ = (hash_ ^ static_cast<std::uint64_t>(sign + 1)) * 0x100000001b3U;
        ++count_;
    }
    [[nodiscard]] std::uint64_t hash() const { return hash_; }
    [[nodiscard]] std::uint64_t count() const { return count_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325U;
    std::uint64_t count_ = 0;
};

inline SignHash of_all_families() {
    suite::Generator generator(2026);
    SignHash hash;
    for (std::size_t k = 0; k < suite::Generator::orient3d_families.size(); ++k) {
        for (int n = 0; n < 25'000; ++n) {
            const auto sign = orient3d_by_kernel(generator.orient3d(k));
            hash.add(sign.value_or(2));
        }
    }
    for (std::size_t k = 0; k < suite::Generator::side_families.size(); ++k) {
        for (int n = 0; n < 25'000; ++n) {
            const auto e = generator.planes(k);
            const std::array planes{plane_of(e[0]), plane_of(e[1]), plane_of(e[2]), plane_of(e[3])};
            const int det = sign_of_det(planes[0], planes[1], planes[2]);
            hash.add(det);
            if (!planes[3].is_valid()) continue;
            if (det != 0) hash.add(suite::side_by_trisect(e[0], e[1], e[2], e[3]));
            for (int axis = 0; axis < 3; ++axis)
                hash.add(sign_of_cross(planes[0], planes[3], axis));
            hash.add(sign_of_dot(planes[0], planes[3]));
        }
    }
    return hash;
}

}  // namespace sign_manifest
