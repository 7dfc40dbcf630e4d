// SPDX-License-Identifier: Apache-2.0
//
// The relation of two posed solids and the contacts of their boundaries by definition, in
// rationals: sets that are empty or not, and every triangle of one against every triangle of the
// other. No tree, no filter, no sign that the library computes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <trisect/bsp/interference/interference.h>
#include <trisect/kernel/pose.h>

#include "reference/naive_boolean.h"
#include "reference/random_solids.h"

namespace brute {

/// A set of points: a formula over operands on a small grid.
struct Body {
    std::vector<reference::Operand> operands;
    reference::Expression formula;

    [[nodiscard]] static Body of(reference::Operand operand);
    /// The same set for the library.
    [[nodiscard]] trisect::Solid solid() const;
};

struct Scene {
    Body a;
    Body b;
    trisect::Pose pose_a;
    trisect::Pose pose_b;
};

/// All contacts of the models' entities; empty when the boundaries do not meet.
[[nodiscard]] std::vector<trisect::Contact> contacts(const trisect::InterferenceModel& a,
                                                     const trisect::Pose& pose_a,
                                                     const trisect::InterferenceModel& b,
                                                     const trisect::Pose& pose_b);

/// Why regions do not cover what the boundaries have in common, or are of the wrong size or kind;
/// empty when they are right.
[[nodiscard]] std::string wrong_regions(const trisect::InterferenceModel& a,
                                        const trisect::Pose& pose_a,
                                        const trisect::InterferenceModel& b,
                                        const trisect::Pose& pose_b,
                                        const trisect::InterferenceResult& result);

/// Whether A ∩ B, A − B and B − A are empty. Nothing when moved corners do not fit the reference
/// engine's 64-bit corners on a common grid.
[[nodiscard]] std::optional<trisect::Relation> relation(const Scene& scene, bool boundaries_meet);

/// Random scenes in which things coincide: families on a small grid, flush blocks, nested shells,
/// filled cavities, equal solids; identity, translations, quarter turns, quaternions, doubles,
/// mirrors, alone or under a common pose that no double survives.
[[nodiscard]] Scene random_scene(reference::Random& random);

/// What differs between the library and brute force; empty when nothing does.
[[nodiscard]] std::string difference(const Scene& scene, trisect::Relation* expected = nullptr);

/// What differs where the solids are put on lattices of units 2^bits times as large; empty when
/// nothing does. Compared with the library's answers for the scene as it is.
[[nodiscard]] std::string difference_on_coarser_lattices(const Scene& scene,
                                                         const std::array<int, 2>& bits);

}  // namespace brute
