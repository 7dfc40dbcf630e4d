// SPDX-License-Identifier: Apache-2.0
//
// Eight bytes a step: table k has the remainders of single bytes that k more bytes follow. One byte
// a step waits for each look-up before the next one.

#include <trisect/bsp/native/checksum.h>

#include <array>
#include <cstddef>

#include <trisect/brep/io/formats/binary.h>

namespace trisect::detail {

namespace {

using Tables = std::array<std::array<std::uint64_t, 256>, 8>;

constexpr Tables make_tables() {
    constexpr std::uint64_t polynomial = 0xC96C5795D7870F42U;
    Tables t{};
    for (std::size_t byte = 0; byte < 256; ++byte) {
        std::uint64_t r = byte;
        for (int bit = 0; bit < 8; ++bit) r = (r >> 1) ^ ((r & 1U) != 0 ? polynomial : 0);
        t[0][byte] = r;
    }
    for (std::size_t k = 1; k < 8; ++k)
        for (std::size_t byte = 0; byte < 256; ++byte)
            t[k][byte] = (t[k - 1][byte] >> 8) ^ t[0][t[k - 1][byte] & 0xffU];
    return t;
}

constexpr Tables tables = make_tables();

}  // namespace

std::uint64_t crc64(std::string_view bytes) noexcept {
    std::uint64_t r = ~std::uint64_t{0};
    while (bytes.size() >= 8) {
        r ^= load<std::uint64_t, false>(bytes.data());
        std::uint64_t next = 0;
        for (std::size_t k = 0; k < 8; ++k) next ^= tables[7 - k][(r >> (8 * k)) & 0xffU];
        r = next;
        bytes.remove_prefix(8);
    }
    for (const char c : bytes)
        r = (r >> 8) ^ tables[0][(r ^ static_cast<unsigned char>(c)) & 0xffU];
    return ~r;
}

}  // namespace trisect::detail
