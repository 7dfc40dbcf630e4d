// SPDX-License-Identifier: Apache-2.0
//
// OperandTable: the operand of a facet, by the facet's number.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Which operand a facet belongs to, of many: by a table of about twice as many equal ranges of
/// facets as there are operands, most of which are in one or two.
class OperandTable {
public:
    explicit OperandTable(const std::vector<Crossings::Operand>& operands) : operands_(operands) {
        const std::uint64_t end = operands.back().first;
        while (end >> shift_ > 2 * operands.size()) ++shift_;
        std::uint32_t at = 0;
        for (std::uint64_t number = 0; number <= end; number += std::uint64_t{1} << shift_) {
            while (at + 1 < operands.size() && operands[at + 1].first <= number) ++at;
            ranges_.push_back(at);
        }
        ranges_.push_back(static_cast<std::uint32_t>(operands.size() - 1));
    }
    [[nodiscard]] std::size_t operator()(std::uint32_t number) const {
        const std::size_t range = std::min(std::size_t{number >> shift_}, ranges_.size() - 2);
        const auto first = operands_.begin() + ranges_[range];
        const auto last = operands_.begin() + ranges_[range + 1] + 1;
        const auto next =
            std::ranges::upper_bound(first, last, number, {}, &Crossings::Operand::first);
        return static_cast<std::size_t>(next - operands_.begin()) - 1;
    }

private:
    const std::vector<Crossings::Operand>& operands_;
    PoolVector<std::uint32_t> ranges_;  // the operand of the first facet of each; then the last
    unsigned shift_ = 0;
};

}  // namespace trisect::detail
