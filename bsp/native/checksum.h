// SPDX-License-Identifier: Apache-2.0
//
// CRC-64 of bytes.
// The polynomial of ECMA-182, reflected, as in XZ files: 64 bits find every damage of one place up
// to eight bytes long, and any other with a probability of 1 - 2^-64.
#pragma once

#include <cstdint>
#include <string_view>

namespace trisect::detail {

[[nodiscard]] std::uint64_t crc64(std::string_view bytes) noexcept;

}  // namespace trisect::detail
