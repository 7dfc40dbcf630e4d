// SPDX-License-Identifier: Apache-2.0
#include "clash_id.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

namespace trisect::app {
namespace {

// FNV-1a.
std::uint64_t hashed(std::uint64_t hash, std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return (hash ^ 0xffU) * 0x100000001b3U;  // no byte of UTF-8
}

}  // namespace

std::string clash_id(std::initializer_list<std::string> texts) {
    std::uint64_t high = 0xcbf29ce484222325U;
    std::uint64_t low = 0x9ae16a3b2f90404fU;
    for (const std::string& text : texts) {
        high = hashed(high, text);
        low = hashed(low, text);
    }
    high = (high & ~std::uint64_t{0xf000}) | 0x8000U;                    // version 8
    low = (low & ~(std::uint64_t{3} << 62)) | (std::uint64_t{2} << 62);  // the usual variant
    return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", high >> 32, (high >> 16) & 0xffffU,
                       high & 0xffffU, low >> 48, low & 0xffffffffffffU);
}

}  // namespace trisect::app
