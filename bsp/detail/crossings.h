// SPDX-License-Identifier: Apache-2.0
//
// Crossings: where the boundaries of two operands pass through each other.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/detail/residual.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

struct SolidState;

/// Two whole facets that cross in a segment. Its ends are where an edge of one of them pierces the
/// interior of the other; they come in the direction of the product of the normals, first × second,
/// as the sources turn them.
struct FacetCrossing {
    struct End {
        Approximation at;        ///< in lattice units
        bool of_second = false;  ///< whose edge it is
        std::int8_t edge = 0;    ///< from that corner to the next one
    };
    std::array<std::uint32_t, 2> facets{};
    std::array<End, 2> ends;
};

/// What an evaluation of two imported meshes has found out about whole facets; so assembly need not
/// put together what the walls of cells have cut apart (traced_facets.h).
///
/// Of a facet that is not `doubtful` all crossings are known, and nothing else of the other
/// boundary touches it.
struct Crossings {
    struct Operand {
        std::uint64_t serial = 0;  ///< of its source
        bool flipped = false;      ///< the operand is the complement of the source's solid
        /// The winding number of the other operand where this one's boundary bounds the result.
        int keep = 0;
        bool inside_above = false;  ///< there the result is above the source's facets
    };
    std::array<Operand, 2> operands;
    std::vector<FacetCrossing> pairs;  ///< sorted by facets, each once
    /// By operand, sorted.
    std::array<std::vector<std::uint32_t>, 2> doubtful;

    /// What another thread has found of the same two operands; arrange() is due afterwards.
    void append(const Crossings& part);
    /// Sorts, and leaves one of each pair: it was found in every cell that its segment runs
    /// through.
    void arrange();
};

/// Crossings that an evaluation can collect: of two different meshes as they were imported, with
/// their operands filled in. Nothing where one of their boundaries may bound the result on both
/// sides of the other one, or on none.
[[nodiscard]] std::optional<Crossings> crossings_of(
    const Residual& formula, std::span<const std::shared_ptr<const SolidState>> states);

}  // namespace trisect::detail
