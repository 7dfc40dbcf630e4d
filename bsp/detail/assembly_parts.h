// SPDX-License-Identifier: Apache-2.0
//
// First half of assembly: from the polygons of the cells to directed edges between exact vertices.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/detail/assembly_stats.h>
#include <trisect/bsp/detail/flat_map.h>
#include <trisect/bsp/detail/solid_state.h>
#include <trisect/bsp/detail/workbench.h>

namespace trisect::detail {

/// A facet of a source as it appears in the result; `flipped` facets face the other way. Facets are
/// ordered by source, number and orientation, so that output does not depend on the tree's shape.
struct BoundaryFacet {
    const Source* source = nullptr;
    std::uint32_t facet = 0;
    bool flipped = false;
    PlaneId support = -1;
    std::int32_t leaf = -1;         ///< where parts of it were found
    bool in_several_cells = false;  ///< its parts were not all conformed in one leaf
    std::uint32_t parts = 0;        ///< how many; the edges of one come in the order of its loop
    bool unchanged = false;         ///< see mark_unchanged_facets
};

/// An edge of a part of a facet, directed so that the part lies to its left seen from outside.
struct BoundaryEdge {
    PointId from = -1;
    PointId to = -1;
    std::int32_t facet = -1;  ///< index of the BoundaryFacet
    WorkEdge line;            ///< the edge's line is support ∩ line.plane; the part's side of it
};

/// What the result has of the facets of one source: a byte for each facet.
class FacetMarks {
public:
    explicit FacetMarks(const Source* source)
        : source_(source), marks_((source->facet_count() + 7) / 8 * 8) {}
    [[nodiscard]] const Source* source() const { return source_; }

    /// The facet bounds the result somewhere.
    void set_present(std::uint32_t facet, bool flipped) { marks_[facet] |= bit(present, flipped); }
    /// The same where it `is_owned` or worked on.
    void add_present(std::uint32_t facet, bool flipped, bool is_owned) {
        const unsigned m = marks_[facet];
        const unsigned known = (m >> 2 >> (flipped ? 1 : 0) | (is_owned ? 1U : 0U)) & 1U;
        marks_[facet] = static_cast<std::uint8_t>(m | known << (flipped ? 1 : 0));
    }
    /// The same where several threads do so at once.
    void add_present_shared(std::uint32_t facet, bool flipped, bool is_owned) {
        const std::atomic_ref marks(marks_[facet]);
        if (is_owned || (marks.load(std::memory_order_relaxed) & bit(worked, flipped)) != 0)
            marks.fetch_or(bit(present, flipped), std::memory_order_relaxed);
    }
    /// The facet is cut or touched somewhere: it does not pass through as it is.
    void set_worked(std::uint32_t facet, bool flipped) { marks_[facet] |= bit(worked, flipped); }
    /// Its edges are known already: trace_facets().
    void set_traced(std::uint32_t facet) { marks_[facet] |= traced; }
    [[nodiscard]] bool is_traced(std::uint32_t facet) const {
        return (marks_[facet] & traced) != 0;
    }
    [[nodiscard]] bool is_present(std::uint32_t facet, bool flipped) const {
        return (marks_[facet] & bit(present, flipped)) != 0;
    }
    [[nodiscard]] bool is_worked(std::uint32_t facet, bool flipped) const {
        return (marks_[facet] & bit(worked, flipped)) != 0;
    }

    /// How many groups of eight facets there are; several threads may read different ones.
    [[nodiscard]] std::size_t group_count() const { return marks_.size() / 8; }
    /// Calls visit(facet, flipped) for the facets that pass through, in order.
    template <class Visit>
    void for_each_whole(Visit&& visit) const {
        for_each_whole(0, group_count(), visit);
    }
    /// The same for those in the groups [first, end).
    template <class Visit>
    void for_each_whole(std::size_t first, std::size_t end, Visit&& visit) const {
        for_each(
            first, end, [](std::uint64_t m) { return whole_in(m); }, visit);
    }
    /// The same for those that are present and do not pass through.
    template <class Visit>
    void for_each_worked(std::size_t first, std::size_t end, Visit&& visit) const {
        for_each(
            first, end, [](std::uint64_t m) { return worked_in(m); }, visit);
    }

    /// To be called once before number_worked().
    void make_numbers() { numbers_.resize(group_count()); }
    /// Numbers the facets of for_each_worked() in the groups [first, end), from `number` on.
    void number_worked(std::size_t first, std::size_t end, std::size_t number);
    /// Its number. \pre numbered, and the facet is present and worked on in this orientation.
    [[nodiscard]] std::int32_t number_of_worked(std::uint32_t facet, bool flipped) const {
        const std::uint64_t before = (std::uint64_t{flipped ? 2U : 1U} << (8 * (facet % 8))) - 1;
        return numbers_[facet / 8] +
               count(worked_in(eight_at(facet / 8 * std::size_t{8})) & before);
    }
    /// Whether it is present and worked on.
    [[nodiscard]] bool takes_part(std::uint32_t facet, bool flipped) const {
        const unsigned m = marks_[facet];
        return (m & (m >> 2) & bit(present, flipped)) != 0;
    }
    /// How many pass through, and how many are present and do not, in the groups [first, end).
    struct Counts {
        std::size_t whole = 0;
        std::size_t worked = 0;
    };
    [[nodiscard]] Counts counts(std::size_t first, std::size_t end) const {
        Counts n;
        for (std::size_t i = first; i < end; ++i) {
            const std::uint64_t m = eight_at(8 * i);
            n.whole += static_cast<std::size_t>(count(whole_in(m)));
            n.worked += static_cast<std::size_t>(count(worked_in(m)));
        }
        return n;
    }

private:
    // Marks of eight facets, the first one in the lowest byte; compilers make one load of this.
    [[nodiscard]] std::uint64_t eight_at(std::size_t i) const {
        std::uint64_t m = 0;
        for (std::size_t k = 0; k < 8; ++k) m |= std::uint64_t{marks_[i + k]} << (8 * k);
        return m;
    }
    static constexpr std::uint64_t low_bits = 0x0303030303030303U;
    static constexpr std::uint64_t whole_in(std::uint64_t m) { return m & ~(m >> 2) & low_bits; }
    static constexpr std::uint64_t worked_in(std::uint64_t m) { return m & (m >> 2) & low_bits; }
    // Set bits among low_bits.
    static constexpr std::int32_t count(std::uint64_t m) {
        constexpr std::uint64_t ones = 0x0101010101010101U;
        return static_cast<std::int32_t>((((m & ones) + (m >> 1 & ones)) * ones) >> 56);
    }

    // `select` makes two bits for each of eight facets, one for each orientation, out of their
    // marks.
    template <class Select, class Visit>
    void for_each(std::size_t first, std::size_t end, Select select, Visit&& visit) const {
        for (std::size_t i = 8 * first; i < 8 * end; i += 8) {
            for (std::uint64_t m = select(eight_at(i)); m != 0; m &= m - 1) {
                const int bit = std::countr_zero(m);
                visit(static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(bit) / 8,
                      (bit & 1) != 0);
            }
        }
    }
    static constexpr unsigned present = 1;
    static constexpr unsigned worked = 4;
    static constexpr std::uint8_t traced = 16;
    static constexpr std::uint8_t bit(unsigned what, bool flipped) {
        return static_cast<std::uint8_t>(what << (flipped ? 1 : 0));
    }

    const Source* source_;
    std::vector<std::uint8_t> marks_;    // a byte for each facet, filled up to a multiple of eight
    std::vector<std::int32_t> numbers_;  // of every eighth facet: the first number from it on
};

/// The boundary in pieces, conforming within each facet's cells but not yet joined.
struct BoundaryParts {
    Workbench bench;
    std::vector<FacetMarks> sources;  ///< by serial
    /// Number of a source, whose facets must be among the parts.
    [[nodiscard]] std::size_t table_of(const Source* source) const {
        return static_cast<std::size_t>(table_ids.find(key_of(source)));
    }
    static Key128 key_of(const Source* source) {
        return {reinterpret_cast<std::uintptr_t>(source), 0};
    }
    FlatMap table_ids;
    std::vector<BoundaryFacet> facets;  ///< cut, touched or spanning several cells; sorted
    std::vector<BoundaryEdge> edges;    ///< of these facets
    /// By point: the one that stands for all that equal it. Edges have no others.
    std::vector<PointId> representatives;
    AssemblyStats stats;
};

/// Facets that nothing cuts or touches are marked whole in `sources` and have no edges.
/// `by_planes`: the facets of a plane will be joined, so that they may come as one where that is
/// easier (axis_faces.h). `threads` as in ParallelParts.
void gather_parts(const SolidState& solid, BoundaryParts& parts, bool by_planes,
                  std::uint32_t threads = 1);

/// Whether all that the walls of a cell could cut off a fragment has been cut off: its box is
/// rounded outwards and says too much where it ends at a wall.
[[nodiscard]] bool ends_at_walls(const Fragment& fragment, const Cell& cell);

/// Splits edges at the candidate vertices that lie inside them. Holds scratch memory.
///
/// Edges and candidates should belong to one leaf or one facet: the cost is near linear in the
/// candidates whose range along the longest axis meets an edge's.
class EdgeSplitter {
public:
    EdgeSplitter(const Workbench& bench, const std::vector<BoundaryFacet>& facets)
        : bench_(bench), facets_(facets) {}
    void clear();
    void add_candidate(PointId p);
    /// Appends the parts of the edges to `out`, each edge's parts in order. \pre the ends of the
    /// edges are candidates.
    void split(std::span<const BoundaryEdge> edges, std::vector<BoundaryEdge>& out);

private:
    struct Candidate {
        std::array<double, 3> c{};  // approximate
        PointId point = -1;
    };
    void sort_candidates();
    void find_inside(const BoundaryEdge& e);
    void sort_inside(const BoundaryEdge& e, int axis);

    const Workbench& bench_;
    const std::vector<BoundaryFacet>& facets_;
    std::vector<Candidate> candidates_;
    std::vector<std::int32_t> rank_;  // by point: its place among the candidates, -1 is none
    std::size_t axis_ = 0;            // that they are sorted along
    double widest_ = 0;               // error of a candidate
    std::vector<PointId> inside_;
};

/// Order of two points along an axis: filtered, then exact.
[[nodiscard]] int compare_along(const Workbench& bench, PointId a, PointId b, int axis);

}  // namespace trisect::detail
