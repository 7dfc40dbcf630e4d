// SPDX-License-Identifier: Apache-2.0
//
// Crossings: intersections between the boundaries of operands.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/infinitesimal_shift.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

struct SolidState;

/// Two whole facets of different operands that cross in a segment. Its ends are where an edge of
/// one of them pierces the interior of the other; they come in the direction of the product of the
/// normals, first × second, as the sources turn them.
struct FacetCrossing {
    struct End {
        Approximation at;         ///< in lattice units
        bool of_second = false;   ///< whose edge it is
        std::int8_t edge = 0;     ///< from that corner to the next one
        std::int8_t corner = -1;  ///< of the edge's facet, where the end is just there
    };
    std::array<std::uint32_t, 2> facets{};  ///< numbers of Crossings, ascending
    std::array<End, 2> ends;
};

/// What an evaluation of a union, an intersection or a difference of imported meshes has found out
/// about whole facets; so assembly need not put together what the bounding planes of cells have cut
/// apart (traced_facets.h).
///
/// The facets of all operands are numbered, one operand after the other. Of a facet that is not
/// `uncertain` all crossings are known, and nothing else of another boundary touches it.
///
/// In such a formula an operand bounds the result just where all others are *open*: where none of
/// them has the value, inside for a union, that decides the formula by itself.
struct Crossings {
    struct Operand {
        std::uint64_t serial = 0;   ///< of its source
        std::uint32_t first = 0;    ///< number of its first facet
        bool flipped = false;       ///< the operand is the complement of the source's solid
        bool inside_above = false;  ///< where it bounds the result, that is above its facets
        std::int8_t open = 0;       ///< its winding number where it leaves others open
        [[nodiscard]] bool is_open_below() const { return (open == 1) != flipped; }
    };
    /// A facet with a part in a cell that is contained in an operand there without a crossing.
    struct Containment {
        std::uint32_t facet = 0;
        std::uint32_t operand = 0;
        friend auto operator<=>(const Containment&, const Containment&) = default;
    };
    std::vector<Operand> operands;          ///< by slot
    PoolVector<FacetCrossing> pairs;        ///< sorted by facets, each once
    std::vector<std::uint32_t> uncertain;   ///< facets, sorted
    std::vector<Containment> containments;  ///< until arrange()
    std::vector<std::uint32_t> hidden;  ///< facets that no leaf has seen crossed, until arrange()
    /// Made by arrange(): the pairs in the order of their second facets, and all facets of pairs
    /// but hidden ones and those that lie within an operand that does not cross them.
    std::vector<std::uint32_t> by_second;
    std::vector<std::uint32_t> shown;
    /// Of two meshes of which pairs were decided as if the second one were moved (shifted_pairs.h):
    /// facets that a facet of the other mesh touches otherwise than by an edge through the interior
    /// of one of the two, or crosses there. Sorted; some are here in vain. Empty where all are in
    /// general position.
    std::vector<std::uint32_t> special;
    InfinitesimalShift shift;
    std::shared_ptr<const CornerMoves> moves;  ///< those of the shift
    /// Whether another part of the result has the other sides of the same facets
    /// (UndividedMeshes::beside).
    bool has_other_sides = false;
    /// By shown facet, where there are special ones: whether the other mesh leaves open its first
    /// corner.
    enum class Corner : std::uint8_t { Unknown, Open, Contained };
    std::vector<Corner> first_corners;

    [[nodiscard]] std::uint32_t number_of(std::size_t slot, std::uint32_t facet) const {
        return operands[slot].first + facet;
    }
    /// The operand that a facet belongs to.
    [[nodiscard]] std::size_t operand_of(std::uint32_t number) const;

    /// What another thread has found of the same operands; arrange() is due afterwards.
    void append(Crossings&& part);
    /// Sorts, and leaves one of each pair: it was found in every cell that its segment runs
    /// through.
    void arrange();

private:
    void sort_pairs();
    void list_shown();
};

/// What crossings may be of.
enum class CrossingOperands : std::uint8_t {
    Meshes,
    WithHalfSpaces  ///< and half-spaces, each of which has one facet
};

/// The operands of any formula over different meshes as they were imported: without what depends on
/// the formula. Nothing where one is something else.
[[nodiscard]] std::optional<Crossings> crossing_operands(
    std::span<const std::shared_ptr<const SolidState>> states,
    CrossingOperands kinds = CrossingOperands::Meshes);

/// Crossings that an evaluation can collect, with the operands filled in: of different meshes as
/// they were imported, every one of them once in a union, an intersection or a difference. Nothing
/// for other formulas.
[[nodiscard]] std::optional<Crossings> crossings_of(
    const Residual& formula, std::span<const std::shared_ptr<const SolidState>> states,
    CrossingOperands kinds = CrossingOperands::Meshes);

}  // namespace trisect::detail
