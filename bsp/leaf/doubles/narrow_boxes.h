// SPDX-License-Identifier: Apache-2.0
//
// NarrowBoxes: boxes in 16 bits a number, sixteen at a time.
// Of two lists of some dozens, all of one are compared with all of the other without a branch.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/leaf/doubles/single_box.h>
#include <trisect/kernel/support/four_floats.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trisect::detail {

/// Boxes in the order in which they are added. Boxes that meet are found to meet; a few that do not
/// may be, where they are less apart than 2^-15 of a place in which all that matters lies. Lower
/// and upper ends are rounded by one monotonous function, so that is so wherever the place is.
class NarrowBoxes {
public:
    /// Boxes that meet, do so in a place that meets this box.
    void start(const SingleBox& place) {
        size_ = 0;
        blocks_.clear();
        lo_ = place.lo;
        for (std::size_t k = 0; k < 3; ++k) {
            const float extent = place.hi(k) - place.lo[k];
            scale_[k] = extent > 0 && extent < 0x1p120F ? most / extent : 0;
        }
    }
    void add(const SingleBox& box) {
        const std::size_t i = size_++ % sixteen;
        if (i == 0) blocks_.emplace_back();
        Block& b = blocks_.back();
        const Ends ends = narrow(box);
        for (std::size_t k = 0; k < 6; ++k) b[k][i] = ends[k];
    }
    [[nodiscard]] std::size_t size() const { return size_; }

    /// Three lower and three upper ends.
    using Ends = std::array<std::int16_t, 6>;
    [[nodiscard]] Ends narrow(const SingleBox& box) const {
        const auto lo = narrow(FourFloats(box.lo));
        const auto hi = narrow(FourFloats(0) - FourFloats(box.down));
        return {lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]};
    }
    /// 64 boxes a word, a bit for each that meets that one.
    [[nodiscard]] std::size_t word_count() const { return (blocks_.size() + 3) / 4; }
    void find_meeting(const Ends& box, std::span<std::uint64_t> words) const {
        std::ranges::fill(words, 0);
        for (std::size_t i = 0; i < blocks_.size(); ++i)
            words[i / 4] |= std::uint64_t{meeting(blocks_[i], box)} << 16 * (i % 4);
    }

private:
    static constexpr std::size_t sixteen = 16;
    static constexpr float most = 0x7fff;
    struct alignas(16) Row {
        std::array<std::int16_t, sixteen> of{};
        [[nodiscard]] std::int16_t& operator[](std::size_t i) { return of[i]; }
    };
    // Places without a box meet nothing.
    struct Block {
        std::array<Row, 6> rows;
        Block() {
            for (std::size_t k = 0; k < 3; ++k) {
                rows[k].of.fill(0x7fff);
                rows[k + 3].of.fill(-1);
            }
        }
        [[nodiscard]] Row& operator[](std::size_t k) { return rows[k]; }
    };
    [[nodiscard]] std::array<std::int16_t, 3> narrow(FourFloats ends) const {
        const FourFloats at = (ends - FourFloats(lo_)) * FourFloats(scale_);
        const auto whole = smaller(larger(at, FourFloats(0)), FourFloats(most)).truncated();
        return {static_cast<std::int16_t>(whole[0]), static_cast<std::int16_t>(whole[1]),
                static_cast<std::int16_t>(whole[2])};
    }
    [[nodiscard]] static unsigned meeting(const Block& b, const Ends& box) {
#if defined(__SSE2__)
        const auto apart = [&](std::size_t half) {
            const auto load = [&](std::size_t k) {
                return _mm_load_si128(
                    reinterpret_cast<const __m128i*>(b.rows[k].of.data() + 8 * half));
            };
            __m128i out = _mm_setzero_si128();
            for (std::size_t k = 0; k < 3; ++k) {
                out = _mm_or_si128(out, _mm_cmpgt_epi16(load(k), _mm_set1_epi16(box[k + 3])));
                out = _mm_or_si128(out, _mm_cmpgt_epi16(_mm_set1_epi16(box[k]), load(k + 3)));
            }
            return out;
        };
        const __m128i both = _mm_packs_epi16(apart(0), apart(1));
        return ~static_cast<unsigned>(_mm_movemask_epi8(both)) & 0xffffU;
#else
        unsigned met = 0;
        for (std::size_t i = 0; i < sixteen; ++i) {
            bool meets = true;
            for (std::size_t k = 0; k < 3; ++k)
                meets = meets && b.rows[k].of[i] <= box[k + 3] && box[k] <= b.rows[k + 3].of[i];
            met |= (meets ? 1U : 0U) << i;
        }
        return met;
#endif
    }

    std::vector<Block> blocks_;
    alignas(16) SingleBox::Four lo_{};
    alignas(16) SingleBox::Four scale_{};
    std::size_t size_ = 0;
};

}  // namespace trisect::detail
