// SPDX-License-Identifier: Apache-2.0
//
// Cost function of hierarchical queries: F = Nu Cu + Nbv Cbv + Np Cp.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trisect::hierarchies {

/// What a structure did, added up by every call that takes counters. The cost function is that of
/// Weghorst, Hooper and Greenberg (1984) for rays, of Gottschalk, Lin and Manocha (1996) for pairs;
/// the term for updates is Klosowski et al.'s (1998). For distances Np falls into two kinds: it
/// takes a few directions to see that a pair is farther than the nearest so far, and ten times as
/// long to find the closest points of one that is not.
struct CostCounters {
    std::uint64_t updates = 0;          ///< Nu: volumes or cells brought to a new place
    std::uint64_t volume_tests = 0;     ///< Nbv: pairs of volumes (or cells) compared
    std::uint64_t primitive_tests = 0;  ///< Np: pairs of triangles compared in doubles
    std::uint64_t closest_tests = 0;    ///< of these, whose closest points were computed
    std::uint64_t exact_tests = 0;      ///< of these, left to exact arithmetic

    CostCounters& operator+=(const CostCounters& o) {
        updates += o.updates;
        volume_tests += o.volume_tests;
        primitive_tests += o.primitive_tests;
        closest_tests += o.closest_tests;
        exact_tests += o.exact_tests;
        return *this;
    }
    friend bool operator==(const CostCounters&, const CostCounters&) = default;
};

/// What a structure took to build and what it holds, of both models together.
struct BuildReport {
    double seconds = 0;
    std::size_t bytes = 0;    ///< without the models
    std::size_t volumes = 0;  ///< or cells
    unsigned depth = 0;       ///< levels of the deeper one
};

}  // namespace trisect::hierarchies
