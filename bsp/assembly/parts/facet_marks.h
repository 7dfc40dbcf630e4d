// SPDX-License-Identifier: Apache-2.0
//
// FacetMarks: unmodified and modified facets of a source in a result.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

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
    void set_traced(std::uint32_t facet, bool flipped) { marks_[facet] |= bit(traced, flipped); }
    [[nodiscard]] bool is_traced(std::uint32_t facet, bool flipped) const {
        return (marks_[facet] & bit(traced, flipped)) != 0;
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
    /// The same, and visit_eight(facet) for a whole group that passes through, none of it flipped,
    /// in place of eight visits: most groups of a large mesh are of this kind, or empty.
    template <class VisitEight, class Visit>
    void for_each_whole(std::size_t first, std::size_t end, VisitEight&& visit_eight,
                        Visit&& visit) const {
        for (std::size_t i = first; i < end; ++i) {
            const std::uint64_t m = whole_in(eight_at(8 * i));
            if (m == ones) {
                visit_eight(static_cast<std::uint32_t>(8 * i));
            } else {
                for_each_bit(m, 8 * i, visit);
            }
        }
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
            if (m == 0) continue;  // most are, where little is left
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
    static constexpr std::uint64_t ones = 0x0101010101010101U;
    static constexpr std::uint64_t whole_in(std::uint64_t m) { return m & ~(m >> 2) & low_bits; }
    static constexpr std::uint64_t worked_in(std::uint64_t m) { return m & (m >> 2) & low_bits; }
    // Set bits among low_bits.
    static constexpr std::int32_t count(std::uint64_t m) {
        return static_cast<std::int32_t>((((m & ones) + (m >> 1 & ones)) * ones) >> 56);
    }

    // `select` makes two bits for each of eight facets, one for each orientation, out of their
    // marks.
    template <class Select, class Visit>
    void for_each(std::size_t first, std::size_t end, Select select, Visit&& visit) const {
        for (std::size_t i = 8 * first; i < 8 * end; i += 8)
            for_each_bit(select(eight_at(i)), i, visit);
    }
    template <class Visit>
    static void for_each_bit(std::uint64_t m, std::size_t first_facet, Visit&& visit) {
        for (; m != 0; m &= m - 1) {
            const int bit = std::countr_zero(m);
            visit(static_cast<std::uint32_t>(first_facet) + static_cast<std::uint32_t>(bit) / 8,
                  (bit & 1) != 0);
        }
    }
    static constexpr unsigned present = 1;
    static constexpr unsigned worked = 4;
    static constexpr unsigned traced = 16;
    static constexpr std::uint8_t bit(unsigned what, bool flipped) {
        return static_cast<std::uint8_t>(what << (flipped ? 1 : 0));
    }

    const Source* source_;
    std::vector<std::uint8_t> marks_;   // a byte for each facet, filled up to a multiple of eight
    PoolVector<std::int32_t> numbers_;  // of every eighth facet: the first number from it on
};

}  // namespace trisect::detail
