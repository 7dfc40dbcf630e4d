// SPDX-License-Identifier: Apache-2.0
//
// OutlinedSolid: a set that some operands leave open, by its boundary.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/many_meshes/outlines/nested_formula.h>
#include <trisect/bsp/many_meshes/outlines/operand_shifts.h>
#include <trisect/bsp/many_meshes/outlines/planes_across_axes.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// What an edge of a part of a facet lies in: a line with a cutter, by its number, or an edge of
/// the facet. There are many of them, so one word has either.
class EdgeOrigin {
public:
    EdgeOrigin() = default;
    /// From that corner of the facet to the next one.
    explicit EdgeOrigin(std::uint32_t own) : bits_(own) {}
    [[nodiscard]] static EdgeOrigin of_line(std::size_t number) {
        return EdgeOrigin(static_cast<std::uint32_t>(number) + first_line);
    }

    [[nodiscard]] bool has_line() const { return bits_ >= first_line; }
    /// \pre has_line()
    [[nodiscard]] std::uint32_t line() const { return bits_ - first_line; }
    /// -1 for a line.
    [[nodiscard]] std::int8_t own() const {
        return has_line() ? std::int8_t{-1} : static_cast<std::int8_t>(bits_);
    }

private:
    static constexpr std::uint32_t first_line = 3;
    std::uint32_t bits_ = 0;  // below that an edge of the facet
};

/// The operands of a union, an intersection or a difference of imported meshes, or of these of each
/// other, shared by all steps of its evaluation.
struct ManyMeshes {
    const Crossings* operands = nullptr;  ///< without pairs
    std::vector<const Source*> sources;   ///< by slot
    PoolVector<std::uint32_t> slots;      ///< by facet
    PlanesAcrossAxes planes;
    Vector3 extent{};  ///< of all together
    const OperandShifts* shifts = nullptr;
    const NestedFormula* nested = nullptr;  ///< if the formula is one; then all operands are as in
                                            ///< an intersection
    /// Of a nested formula: not where operands fill one place.
    bool neighbours_come_first = false;

    /// Whether an operand leaves open what is below its facets to those of another one.
    [[nodiscard]] bool is_open_below(std::uint32_t slot, std::uint32_t to) const {
        return operands->operands[slot].is_open_below() !=
               (nested != nullptr && nested->unites(slot, to));
    }
    [[nodiscard]] std::uint32_t slot_of(std::uint32_t number) const { return slots[number]; }
    [[nodiscard]] std::size_t facet_count() const { return slots.size(); }
    /// Of a facet by its number.
    [[nodiscard]] std::array<const LatticePoint*, 3> lattice_corners(std::uint32_t number) const {
        const std::uint32_t slot = slot_of(number);
        const Source& s = *sources[slot];
        const std::uint32_t facet = number - operands->operands[slot].first;
        return {&s.corner(facet, 0), &s.corner(facet, 1), &s.corner(facet, 2)};
    }
    [[nodiscard]] std::array<Vector3, 3> corners(std::uint32_t slot, std::uint32_t facet) const {
        const Source& s = *sources[slot];
        return {s.corner(facet, 0).doubles(), s.corner(facet, 1).doubles(),
                s.corner(facet, 2).doubles()};
    }
};

struct OutlineBox {
    Vector3 lo{};
    Vector3 hi{};

    /// A box that any other one enlarges.
    [[nodiscard]] static OutlineBox none() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    }
    void add(const Approximation& p) {
        const double rounding = rounding_of(p);
        for (std::size_t k = 0; k < 3; ++k) {
            const double margin = p.error + rounding * std::fabs(p.c[k]);
            lo[k] = std::min(lo[k], p.c[k] - margin);
            hi[k] = std::max(hi[k], p.c[k] + margin);
        }
    }
    void add(const OutlineBox& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], b.lo[k]);
            hi[k] = std::max(hi[k], b.hi[k]);
        }
    }
    /// Whether a point is surely outside: the box with it alone would not meet this one.
    [[nodiscard]] bool is_beside(const Approximation& p) const {
        bool beside = false;
        const double rounding = rounding_of(p);
        for (std::size_t k = 0; k < 3; ++k) {
            const double margin = p.error + rounding * std::fabs(p.c[k]);
            beside |= p.c[k] + margin < lo[k];
            beside |= p.c[k] - margin > hi[k];
        }
        return beside;
    }
    // Without branches: they would be foreseen wrongly.
    [[nodiscard]] bool contains(const OutlineBox& b) const {
        bool out = true;
        for (std::size_t k = 0; k < 3; ++k) {
            out &= lo[k] <= b.lo[k];
            out &= b.hi[k] <= hi[k];
        }
        return out;
    }
    [[nodiscard]] bool meets(const OutlineBox& b) const {
        bool out = true;
        for (std::size_t k = 0; k < 3; ++k) {
            out &= lo[k] <= b.hi[k];
            out &= b.lo[k] <= hi[k];
        }
        return out;
    }
    /// Of a coordinate after the error is added; nothing is rounded where there is none.
    [[nodiscard]] static double rounding_of(const Approximation& p) {
        return p.error == 0 ? 0 : 0x1p-51;
    }
};

struct SettledPart;

/// The set that all of some operands leave open (see Crossings). What bounds it is parts of their
/// facets: whole ones, and others by their outlines. All of it is in an OutlineStore, and good
/// until that changes.
struct OutlinedSolid {
    struct Edge {
        std::uint32_t from = 0;  ///< vertices; the part is to the left, seen from above the facet
        std::uint32_t to = 0;
        EdgeOrigin origin;
    };
    struct Facet {
        std::uint32_t number = 0;  ///< of Crossings
        std::uint32_t slot = 0;
        std::uint32_t first = 0;  ///< of its edges
        std::uint32_t count = 0;
        bool whole = false;  ///< then the edges are those of the facet, in their order
    };

    std::span<const Facet> facets;            ///< each once
    std::span<const OutlineBox> boxes;        ///< of their parts
    std::span<const Edge> edges;              ///< those of other solids, too
    std::span<const OutlineVertex> vertices;  ///< as well
    std::span<const FacetCrossing> lines;     ///< that edges lie in, as well
    OutlineBox box = OutlineBox::none();      ///< of all
    /// More of the boundary, which nothing will meet any more (settled_parts.h).
    std::span<const std::unique_ptr<SettledPart>> settled;
    bool open_far_out = false;
    /// Of a union, or its complement: the slots of what is united. Then facets that have settled
    /// need not be there. Else empty.
    std::span<const std::uint32_t> united;

    [[nodiscard]] std::span<const Edge> edges_of(const Facet& f) const {
        return edges.subspan(f.first, f.count);
    }
    /// Null for an edge of the facet.
    [[nodiscard]] const FacetCrossing* line_of(const Edge& e) const {
        return e.origin.has_line() ? &lines[e.origin.line()] : nullptr;
    }
    /// As assembly takes an edge of a facet.
    [[nodiscard]] OutlinedFacets::Edge for_assembly(const ManyMeshes& meshes, const Edge& e,
                                                    std::uint32_t number,
                                                    std::uint32_t slot) const {
        const FacetCrossing* const line = line_of(e);
        if (line == nullptr) return {e.from, e.to, 0, e.origin.own(), false};
        const std::uint32_t cutter = line->facets[line->facets[0] == number ? 1 : 0];
        return {e.from, e.to, cutter, -1, meshes.is_open_below(meshes.slot_of(cutter), slot)};
    }
};

}  // namespace trisect::detail
