// SPDX-License-Identifier: Apache-2.0
//
// Points to locate, most of them where it is delicate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/msp_tree.h>

namespace trisect::test {

/// Points of every kind, `count` of them, a quarter each: vertices and points of edges and faces;
/// common points of three planes of faces; points on one or two planes of faces, and else
/// anywhere; lattice points around the solid.
[[nodiscard]] std::vector<Point> probes(const Brep& brep, std::size_t count, std::mt19937& random);

struct Probe {
    Point point;
    MspTree::Ref expected;  ///< by brute force
};
[[nodiscard]] std::vector<Probe> answered_probes(const Brep& brep, std::size_t count,
                                                 std::uint32_t seed);

/// The first probe that the tree answers differently, in words, or nothing.
[[nodiscard]] std::string first_difference(const MspTree& tree, const std::vector<Probe>& probes);

[[nodiscard]] std::string to_string(MspTree::Ref leaf);

}  // namespace trisect::test
