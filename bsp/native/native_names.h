// SPDX-License-Identifier: Apache-2.0
//
// NativeNameMap: the numbers of operands of a file, in this process.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/native/native_records.h>

namespace trisect::detail {

/// Either the numbers that they are, or fresh ones in the same order.
class NativeNameMap {
public:
    NativeNameMap(const NativeView& view, std::span<const SourceRecord> sources, bool fresh);

    [[nodiscard]] std::uint32_t operator()(std::uint32_t operand) const {
        if (first_ == 0) return operand;
        const auto at = std::ranges::lower_bound(operands_, operand);
        return static_cast<std::uint32_t>(first_ +
                                          static_cast<std::uint64_t>(at - operands_.begin()));
    }

private:
    std::vector<std::uint32_t> operands_;  // sorted, each once
    std::uint64_t first_ = 0;              // fresh number of the first one; 0: all are kept
};

/// \pre the number of a name of the file
[[nodiscard]] FaceSource name_record(const NativeView& view, std::uint64_t number);

}  // namespace trisect::detail
