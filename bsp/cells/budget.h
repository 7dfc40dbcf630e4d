// SPDX-License-Identifier: Apache-2.0
//
// MemoryBudget: memory held by one evaluation, where it grows with the operands.
//
// Counted are the lists of cells that wait to be solved and the lists and fragments of the result.
// The operands were there before and are shared; the scratch memory of a leaf is bounded by the
// leaf's size and not counted, nor are the nodes themselves. So the sum is less than what the
// system would say, by a factor that stays small, and it costs one addition for each list.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

/// Shared by the threads of one evaluation.
class MemoryBudget {
public:
    /// \param limit in bytes; 0 means none
    explicit MemoryBudget(std::uint64_t limit) : limit_(limit) {}
    MemoryBudget(const MemoryBudget&) = delete;
    MemoryBudget& operator=(const MemoryBudget&) = delete;

    /// Bytes that are given back when this goes.
    class Held {
    public:
        Held() = default;
        Held(Held&& o) noexcept
            : budget_(std::exchange(o.budget_, nullptr)), bytes_(std::exchange(o.bytes_, 0)) {}
        Held& operator=(Held&& o) noexcept {
            std::swap(budget_, o.budget_);
            std::swap(bytes_, o.bytes_);
            return *this;
        }
        ~Held() {
            if (budget_ != nullptr) budget_->bytes_.fetch_sub(bytes_, std::memory_order_relaxed);
        }

    private:
        friend class MemoryBudget;
        Held(MemoryBudget* budget, std::uint64_t bytes) : budget_(budget), bytes_(bytes) {}
        MemoryBudget* budget_ = nullptr;
        std::uint64_t bytes_ = 0;
    };

    /// \throw LimitError when that is too much.
    [[nodiscard]] Held hold(std::uint64_t bytes) {
        Held held(this, bytes);  // counted whether or not keep() throws
        keep(bytes);
        return held;
    }
    /// Bytes that belong to the result. \throw LimitError when that is too much.
    void keep(std::uint64_t bytes) {
        const std::uint64_t sum = bytes_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
        std::uint64_t peak = peak_.load(std::memory_order_relaxed);
        while (sum > peak && !peak_.compare_exchange_weak(peak, sum, std::memory_order_relaxed)) {
        }
        if (limit_ != 0 && sum > limit_)
            throw LimitError("the evaluation would hold more than " + std::to_string(limit_) +
                             " bytes");
    }
    /// The most that was held at once.
    [[nodiscard]] std::uint64_t peak() const { return peak_.load(std::memory_order_relaxed); }

private:
    std::uint64_t limit_;
    std::atomic<std::uint64_t> bytes_{0};
    std::atomic<std::uint64_t> peak_{0};
};

/// Of a list in a cell, without the fragments, which it may share.
[[nodiscard]] inline std::uint64_t bytes_of_list(std::span<const PolygonRef> list) {
    return list.size() * sizeof(PolygonRef);
}

/// Of a list that an arrangement made, and of the fragments made for it.
[[nodiscard]] inline std::uint64_t bytes_of_result(std::span<const PolygonRef> list) {
    std::uint64_t bytes = bytes_of_list(list);
    for (const PolygonRef& r : list)
        if (r.fragment != nullptr) bytes += r.fragment->bytes();
    return bytes;
}

}  // namespace trisect::detail
