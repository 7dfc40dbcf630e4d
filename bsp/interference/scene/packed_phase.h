// SPDX-License-Identifier: Apache-2.0
//
// PackedPhase: common base of broad phases with rebuilt cells.
// Cells are made anew when something moved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/broad_phase.h>

namespace trisect::hierarchies {

/// Boxes by slot, and the pairs of those that have a side at infinity. A derived class sees finite
/// boxes only, numbered in the order of their slots.
class PackedPhase : public detail::BroadPhase {
public:
    void insert(std::uint32_t slot, const detail::BodyBox& box) final;
    void update(std::uint32_t slot, const detail::BodyBox& box) final;
    void remove(std::uint32_t slot) final;
    void pairs(std::vector<detail::BodyPair>& out) final;
    [[nodiscard]] std::size_t bytes() const final;

protected:
    /// Makes cells for boxes(). Counts `cells`.
    virtual void pack() = 0;
    [[nodiscard]] virtual std::size_t cell_bytes() const = 0;
    /// Calls meet(i, j) for candidates, each pair once.
    virtual void find_pairs() = 0;

    [[nodiscard]] std::span<const detail::BodyBox> boxes() const { return finite_; }
    /// Compares two boxes by their numbers and keeps the pair if they meet.
    void compare(std::size_t i, std::size_t j) {
        ++counts_.box_tests;
        if (finite_[i].meets(finite_[j])) keep(slot_[i], slot_[j]);
    }
    /// The same where a pair comes up in every cell that both reach into: kept in one of them, the
    /// one for which `is_here(corner)` says that it contains the lower corner of the common part.
    template <class IsHere>
    void compare_in_cell(std::size_t i, std::size_t j, IsHere&& is_here) {
        ++counts_.box_tests;
        const detail::BodyBox& a = finite_[i];
        const detail::BodyBox& b = finite_[j];
        if (!a.meets(b)) return;
        std::array<double, 3> corner{};
        for (std::size_t k = 0; k < 3; ++k) corner[k] = a.lo[k] < b.lo[k] ? b.lo[k] : a.lo[k];
        if (is_here(corner)) keep(slot_[i], slot_[j]);
    }
    /// The length of the longest side.
    [[nodiscard]] static double extent(const detail::BodyBox& box);

private:
    void keep(std::uint32_t s, std::uint32_t t) {
        out_->push_back(s < t ? detail::BodyPair{s, t} : detail::BodyPair{t, s});
    }

    std::vector<std::optional<detail::BodyBox>> by_slot_;
    std::vector<detail::BodyBox> finite_;
    std::vector<std::uint32_t> slot_;       // of the finite ones
    std::vector<std::uint32_t> unbounded_;  // slots
    std::vector<detail::BodyPair>* out_ = nullptr;
    std::size_t cells_ = 0;
    bool stale_ = false;
};

}  // namespace trisect::hierarchies
