// SPDX-License-Identifier: Apache-2.0
#include "clash_id.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace trisect::app {
namespace {

// FNV-1a, from two beginnings side by side.
void add_to_hashes(std::uint64_t& high, std::uint64_t& low, std::string_view text) {
    constexpr std::uint64_t prime = 0x100000001b3U;
    for (const char c : text) {
        high = (high ^ static_cast<unsigned char>(c)) * prime;
        low = (low ^ static_cast<unsigned char>(c)) * prime;
    }
    high = (high ^ 0xffU) * prime;  // no byte of UTF-8
    low = (low ^ 0xffU) * prime;
}

}  // namespace

std::string clash_id(std::initializer_list<std::string> texts) {
    std::uint64_t high = 0xcbf29ce484222325U;
    std::uint64_t low = 0x9ae16a3b2f90404fU;
    for (const std::string& text : texts) add_to_hashes(high, low, text);
    high = (high & ~std::uint64_t{0xf000}) | 0x8000U;                    // version 8
    low = (low & ~(std::uint64_t{3} << 62)) | (std::uint64_t{2} << 62);  // the usual variant
    return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", high >> 32, (high >> 16) & 0xffffU,
                       high & 0xffffU, low >> 48, low & 0xffffffffffffU);
}

std::string long_text_id(std::string_view text) {
    std::vector<std::string> ids;
    for (; !text.empty(); text.remove_prefix(std::min(bytes_of_an_id_block, text.size())))
        ids.push_back(clash_id({std::string(text.substr(0, bytes_of_an_id_block))}));
    return long_text_id(ids);
}

std::string long_text_id(const std::vector<std::string>& ids_of_blocks) {
    std::string all;
    for (const std::string& id : ids_of_blocks) all += id;
    return clash_id({all});
}

}  // namespace trisect::app
