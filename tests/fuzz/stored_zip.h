// SPDX-License-Identifier: Apache-2.0
//
// An archive whose entries are not packed, made without libzip: packing takes longer than reading.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fuzz {

inline std::uint32_t zip_checksum(std::string_view bytes) {
    static const std::vector<std::uint32_t> table = [] {
        std::vector<std::uint32_t> out(256);
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit)
                value = (value >> 1) ^ ((value & 1U) != 0 ? 0xedb88320U : 0U);
            out[i] = value;
        }
        return out;
    }();
    std::uint32_t sum = ~0U;
    for (const char c : bytes)
        sum = table[(sum ^ static_cast<unsigned char>(c)) & 255U] ^ (sum >> 8);
    return ~sum;
}

inline void put_little(std::string& out, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>(value >> (8 * i) & 255U));
}

inline std::string stored_zip(
    const std::vector<std::pair<std::string_view, std::string_view>>& entries) {
    std::string out;
    std::string directory;
    for (const auto& [name, bytes] : entries) {
        std::string facts;  // the same words in front of the bytes and in the directory
        put_little(facts, 20, 2);
        put_little(facts, 0, 4);                     // no flag, stored
        put_little(facts, (1U << 5 | 1U) << 16, 4);  // 1 January 1980
        put_little(facts, zip_checksum(bytes), 4);
        put_little(facts, static_cast<std::uint32_t>(bytes.size()), 4);
        put_little(facts, static_cast<std::uint32_t>(bytes.size()), 4);
        put_little(facts, static_cast<std::uint32_t>(name.size()), 2);
        put_little(facts, 0, 2);
        directory += "PK\1\2";
        put_little(directory, 20, 2);
        directory += facts;
        directory.append(10, '\0');
        put_little(directory, static_cast<std::uint32_t>(out.size()), 4);
        directory += name;
        out += "PK\3\4";
        out += facts;
        out += name;
        out += bytes;
    }
    const auto begin = static_cast<std::uint32_t>(out.size());
    const auto count = static_cast<std::uint32_t>(entries.size());
    out += directory;
    out += "PK\5\6";
    put_little(out, 0, 4);
    put_little(out, count, 2);
    put_little(out, count, 2);
    put_little(out, static_cast<std::uint32_t>(directory.size()), 4);
    put_little(out, begin, 4);
    put_little(out, 0, 2);
    return out;
}

}  // namespace fuzz
