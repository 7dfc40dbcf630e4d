// SPDX-License-Identifier: Apache-2.0
//
// Damaged and hostile native files are refused with the place, and cost no memory.

#include <trisect/bsp/native_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <utility>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/native/checksum.h>
#include <trisect/bsp/native/native_layout.h>
#include <trisect/kernel/error.h>

#include "support/solids.h"

namespace {

using trisect::NativeFile;
using trisect::Solid;
using trisect::detail::crc64;
using trisect::detail::NativeSection;
namespace place = trisect::detail::native_place;

std::string small_file() {
    return native_bytes(evaluate((solids::box(0, 4) - solids::ball(1.5, 1, {4, 4, 4})) &
                                 Solid::half_space({1, 0, 0.1, -3.5})));
}

// Why it is refused.
std::string refusal(std::string bytes) {
    try {
        (void)NativeFile::of_bytes(std::move(bytes), "file").solid();
    } catch (const trisect::InputError& e) {
        EXPECT_EQ(std::string(e.what()).find("file: byte "), 0U) << e.what();
        return e.what();
    } catch (const trisect::LimitError& e) {
        return e.what();
    }
    return "";
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
    std::uint64_t n = 0;
    std::memcpy(&n, bytes.data() + at, 8);
    return n;
}
void put_number(std::string& bytes, std::size_t at, std::uint64_t n) {
    std::memcpy(bytes.data() + at, &n, 8);
}

// As somebody would who means harm.
std::string with_checksums(std::string bytes) {
    const std::string_view view = bytes;
    put_number(bytes, place::checksum, crc64(view.substr(0, place::checksum)));
    std::size_t end = bytes.size() - 8;
    std::size_t blocks = 0;
    while (blocks * 65536 + 8 * blocks < end) ++blocks;  // of 64 KiB, and their checksums
    end -= 8 * blocks;
    for (std::size_t i = 0; i < blocks; ++i)
        put_number(bytes, end + 8 * i, crc64(view.substr(0, end).substr(i * 65536, 65536)));
    put_number(bytes, bytes.size() - 8, crc64(view.substr(end, 8 * blocks)));
    return bytes;
}

TEST(NativeDamage, TheHelperWritesTheSameChecksums) {
    const std::string bytes = small_file();
    EXPECT_EQ(with_checksums(bytes), bytes);
    EXPECT_EQ(refusal(bytes), "");
}

TEST(NativeDamage, EveryTruncationIsRefused) {
    const std::string bytes = small_file();
    for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_NE(refusal(bytes.substr(0, n)), "") << n;
    EXPECT_NE(refusal(bytes + '\0'), "");
}

TEST(NativeDamage, EveryFlippedByteIsFound) {
    std::string bytes = small_file();
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (const int flip : {1, 0x80, 0xff}) {
            bytes[i] = static_cast<char>(bytes[i] ^ flip);
            EXPECT_NE(refusal(bytes), "") << i;
            bytes[i] = static_cast<char>(bytes[i] ^ flip);
        }
    }
}

TEST(NativeDamage, OtherVersionsAreNamed) {
    std::string bytes = small_file();
    bytes[place::version] = 0;
    EXPECT_EQ(refusal(bytes),
              "file: byte 8: version 0 of native files; this program reads version 1");
    bytes[place::version] = 2;
    EXPECT_EQ(refusal(bytes),
              "file: byte 8: version 2 of native files; this program reads version 1");
}

TEST(NativeDamage, OtherFilesAreNone) {
    EXPECT_EQ(refusal("OFF\n0 0 0\n"), "file: byte 0: this is no native file");
    EXPECT_EQ(refusal(""), "file: byte 0: this is no native file");
    EXPECT_FALSE(trisect::is_native("OFF"));
    EXPECT_TRUE(trisect::is_native(small_file()));
}

TEST(NativeDamage, HostileCountsAreRefusedBeforeAnythingIsMade) {
    const std::string bytes = small_file();
    for (std::size_t i = 0; i < trisect::detail::native_sections; ++i) {
        for (const std::uint64_t n :
             {std::uint64_t{1} << 32, std::uint64_t{1} << 60, ~std::uint64_t{0}}) {
            std::string hostile = bytes;
            put_number(hostile, place::counts + 8 * i, n);
            EXPECT_NE(refusal(with_checksums(hostile)), "") << i;
        }
        std::string hostile = bytes;
        put_number(hostile, place::counts + 8 * i, number_at(bytes, place::counts + 8 * i) + 1);
        EXPECT_NE(refusal(with_checksums(hostile)), "") << i;
    }
}

TEST(NativeDamage, TooDeepTreesAreRefused) {
    const Solid ball = solids::ball(4, 4);
    const NativeFile file = NativeFile::of_bytes(native_bytes(ball, {.divided = true}), "file");
    ASSERT_GT(file.info().depth, 1U);
    EXPECT_THROW((void)file.solid({.depth = 1}), trisect::LimitError);
    EXPECT_NO_THROW((void)file.solid({.depth = file.info().depth}));
}

TEST(NativeDamage, AnOpenMeshIsRefused) {
    std::string bytes = native_bytes(solids::box(0, 4));
    trisect::detail::NativeHeader header;
    for (std::size_t i = 0; i < trisect::detail::native_sections; ++i)
        header.counts[i] = number_at(bytes, place::counts + 8 * i);
    const std::size_t triangle = header.offset(NativeSection::Triangles);
    std::swap_ranges(bytes.begin() + static_cast<std::ptrdiff_t>(triangle),
                     bytes.begin() + static_cast<std::ptrdiff_t>(triangle) + 4,
                     bytes.begin() + static_cast<std::ptrdiff_t>(triangle) + 4);
    EXPECT_NE(refusal(with_checksums(bytes)).find("a mesh that is not closed"), std::string::npos);
}

// Whatever one number says, the file is refused or read, and what was read can be used: an error is
// all that may come of it.
TEST(NativeDamage, HostileNumbersDoNoHarm) {
    const std::string bytes = small_file();
    std::mt19937_64 random(7);
    std::size_t read = 0;
    for (int run = 0; run < 4000; ++run) {
        std::string hostile = bytes;
        const std::size_t at = 24 + random() % (bytes.size() - 24 - 8);
        const int kind = static_cast<int>(random() % 3);
        if (kind == 0) hostile[at] = static_cast<char>(hostile[at] ^ (1 << random() % 8));
        if (kind == 1) put_number(hostile, at / 8 * 8, random() % 8);
        if (kind == 2) put_number(hostile, at / 8 * 8, random());
        try {
            const Solid solid = NativeFile::of_bytes(with_checksums(hostile), "file").solid();
            ++read;
            (void)solid.to_mesh(1);
            (void)solid.to_brep();
        } catch (const trisect::Error&) {
        }
    }
    EXPECT_GT(read, 0U);
}

}  // namespace
