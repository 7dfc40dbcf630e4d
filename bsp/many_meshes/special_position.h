// SPDX-License-Identifier: Apache-2.0
//
// SpecialPosition: facets of many meshes that touch, and moves that are wanted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/bsp/many_meshes/outlines/operand_shifts.h>

namespace trisect::detail {

/// Facets by their numbers of Crossings. One thread's own.
class SpecialPosition {
public:
    explicit SpecialPosition(std::size_t facets) : facet_count_(facets) {}

    /// The facet, moved back, meets others otherwise than by edges that pierce facets.
    void note(std::uint32_t facet) {
        if (marks_.empty()) marks_.resize(facet_count_);
        if (std::exchange(marks_[facet], std::uint8_t{1}) == 0) facets_.push_back(facet);
    }
    [[nodiscard]] bool has(std::uint32_t facet) const {
        return !marks_.empty() && marks_[facet] != 0;
    }
    void want(const OperandShifts::Wanted& wanted) {
        const auto at = std::ranges::lower_bound(wanted_, wanted);
        if (at == wanted_.end() || *at != wanted) wanted_.insert(at, wanted);
    }
    /// What was found of other facets.
    void add(const SpecialPosition& other) {
        for (const std::uint32_t f : other.facets_) note(f);
        for (const OperandShifts::Wanted& w : other.wanted_) want(w);
    }

    /// In no order, each once.
    [[nodiscard]] const std::vector<std::uint32_t>& facets() const { return facets_; }
    [[nodiscard]] const std::vector<OperandShifts::Wanted>& wanted() const { return wanted_; }

private:
    std::size_t facet_count_;
    std::vector<std::uint8_t> marks_;  // by facet
    std::vector<std::uint32_t> facets_;
    std::vector<OperandShifts::Wanted> wanted_;  // sorted
};

}  // namespace trisect::detail
