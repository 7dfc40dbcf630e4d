// SPDX-License-Identifier: Apache-2.0
//
// GrowingArray: a growing array of elements with stable addresses.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <trisect/kernel/contract.h>

namespace trisect::detail {

/// An array that grows by chunks, each twice as large as the one before. So elements never move,
/// and threads may read those that were made known to them while another one appends. Appending is
/// for one thread at a time. Elements are not initialised.
template <class T>
class GrowingArray {
public:
    /// The first chunk has 2^first_bits elements. \pre first_bits <= 10
    explicit GrowingArray(unsigned first_bits = 10) : first_bits_(first_bits) {}
    [[nodiscard]] T& operator[](std::uint32_t i) { return *address(i); }
    [[nodiscard]] const T& operator[](std::uint32_t i) const { return *address(i); }

    /// The number of the first of n new elements that are side by side in memory.
    [[nodiscard]] std::uint32_t append(std::size_t n) {
        TRISECT_EXPECTS(n < 0x70000000U && end_ < 0x70000000U, "too many polygons for an index");
        if (n == 0) return end_;
        for (;;) {
            const Place p = place(end_);
            const std::size_t room = chunk_size(p.chunk) - p.offset;
            if (n <= room) {
                std::unique_ptr<T[]>& memory = chunk_to_fill(p.chunk);
                if (!memory) memory = std::make_unique_for_overwrite<T[]>(chunk_size(p.chunk));
                const std::uint32_t first = end_;
                end_ += static_cast<std::uint32_t>(n);
                used_ += n;
                return first;
            }
            end_ += static_cast<std::uint32_t>(room);
        }
    }
    /// One more than the largest number. Without gaps when elements were appended one by one.
    [[nodiscard]] std::uint32_t end() const { return end_; }
    /// What elements take; the last chunk is counted as far as it is used.
    [[nodiscard]] std::size_t bytes() const { return used_ * sizeof(T); }

private:
    struct Place {
        unsigned chunk = 0;
        std::size_t offset = 0;
    };
    [[nodiscard]] std::size_t chunk_size(unsigned chunk) const {
        return std::size_t{1} << (first_bits_ + chunk);
    }
    [[nodiscard]] Place place(std::uint32_t i) const {
        const std::uint32_t j = i + (1U << first_bits_);
        const unsigned top = 31U - static_cast<unsigned>(std::countl_zero(j));
        return {top - first_bits_, j - (std::uint32_t{1} << top)};
    }
    [[nodiscard]] T* address(std::uint32_t i) const {
        const Place p = place(i);
        return (p.chunk < few ? chunks_[p.chunk] : (*more_)[p.chunk - few]).get() + p.offset;
    }
    [[nodiscard]] std::unique_ptr<T[]>& chunk_to_fill(unsigned chunk) {
        if (chunk < few) return chunks_[chunk];
        if (!more_) more_ = std::make_unique<std::array<std::unique_ptr<T[]>, 31 - few>>();
        return (*more_)[chunk - few];
    }

    // Most arrays are short; there are many of them.
    static constexpr unsigned few = 3;

    unsigned first_bits_;
    std::uint32_t end_ = 0;
    std::array<std::unique_ptr<T[]>, few> chunks_;
    std::unique_ptr<std::array<std::unique_ptr<T[]>, 31 - few>> more_;
    std::size_t used_ = 0;
};

}  // namespace trisect::detail
