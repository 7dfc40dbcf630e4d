// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/native/checksum.h>

#include <gtest/gtest.h>

#include <boost/crc.hpp>

#include <cstdint>
#include <string>

namespace {

using trisect::detail::crc64;

// The check value of the catalogue of CRCs.
TEST(Checksum, OfTheUsualDigits) {
    EXPECT_EQ(crc64("123456789"), 0x995DC9BBDF1939FAU);
    EXPECT_EQ(crc64(""), 0U);
}

TEST(Checksum, IsThatOfAnotherProgramForEveryLength) {
    std::string bytes;
    for (int i = 0; i < 300; ++i) {
        boost::crc_optimal<64, 0x42F0E1EBA9EA3693U, ~std::uint64_t{0}, ~std::uint64_t{0}, true,
                           true>
            other;
        other.process_bytes(bytes.data(), bytes.size());
        EXPECT_EQ(crc64(bytes), other.checksum()) << i;
        bytes += static_cast<char>(i * 37 + i / 7);
    }
}

}  // namespace
