// SPDX-License-Identifier: Apache-2.0
//
// The bytes of a fuzzer as choices. When they are used up all choices are the first one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace fuzz {

class ByteSource {
public:
    ByteSource(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

    [[nodiscard]] bool is_empty() const { return at_ >= bytes_.size(); }
    std::uint8_t byte() { return at_ < bytes_.size() ? bytes_[at_++] : std::uint8_t{0}; }
    /// 0 to n - 1, n <= 256.
    unsigned below(unsigned n) { return byte() % n; }
    int between(int low, int high) {
        return low + static_cast<int>(below(static_cast<unsigned>(high - low + 1)));
    }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

}  // namespace fuzz
