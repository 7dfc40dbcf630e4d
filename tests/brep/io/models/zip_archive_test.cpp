// SPDX-License-Identifier: Apache-2.0
#include "model_files.h"

namespace {

using namespace trisect;
using detail::zip_bytes;
using detail::ZipArchive;

TEST(ZipArchive, ComesBack) {
    const std::string bytes = zip_bytes({{"a", "first"}, {"b/c", std::string(100000, 'x')}});
    ZipArchive archive(bytes, "test", ReadLimits());
    EXPECT_EQ(archive.entries(), (std::vector<std::string>{"a", "b/c"}));
    EXPECT_EQ(archive.read("a"), "first");
    EXPECT_EQ(archive.read("B/C"), std::string(100000, 'x'));
    EXPECT_EQ(archive.read("d"), std::nullopt);
}

TEST(ZipArchive, EqualEntriesGiveEqualBytes) {
    EXPECT_EQ(zip_bytes({{"a", "first"}}), zip_bytes({{"a", "first"}}));
}

TEST(ZipArchive, Bombs) {
    const std::string bytes = zip_bytes({{"a", std::string(std::size_t{8} << 20, '\0')}});
    EXPECT_LT(bytes.size(), 20000U);
    ZipArchive archive(bytes, "test", ReadLimits());
    EXPECT_THROW((void)archive.read("a"), LimitError);
    ReadLimits limits;
    limits.unpacked_ratio = 2000;
    ZipArchive allowed(bytes, "test", limits);
    EXPECT_EQ(allowed.read("a")->size(), std::size_t{8} << 20);
    limits.unpacked_bytes = 1 << 20;
    ZipArchive small(bytes, "test", limits);
    EXPECT_THROW((void)small.read("a"), LimitError);
}

TEST(ZipArchive, LimitsHoldForAllEntriesTogether) {
    const std::string bytes =
        zip_bytes({{"a", std::string(600, 'x')}, {"b", std::string(600, 'y')}});
    ReadLimits limits;
    limits.unpacked_bytes = 1000;
    ZipArchive archive(bytes, "test", limits);
    EXPECT_EQ(archive.read("a")->size(), 600U);
    EXPECT_THROW((void)archive.read("b"), LimitError);
    limits.archive_entries = 1;
    EXPECT_THROW(ZipArchive(bytes, "test", limits), LimitError);
}

TEST(ZipArchive, TwoEntriesOfOneName) {
    std::string bytes = zip_bytes({{"name", "first"}, {"nbme", "second"}});
    for (std::size_t at = bytes.find("nbme"); at != std::string::npos; at = bytes.find("nbme"))
        bytes[at + 1] = 'A';
    EXPECT_THROW(ZipArchive(bytes, "test", ReadLimits()), InputError);
}

TEST(ZipArchive, Damage) {
    const std::string good = zip_bytes({{"a", "first, then second, then third"}});
    for (std::size_t n = 1; n < good.size(); ++n) {
        EXPECT_THROW(ZipArchive(good.substr(0, n), "test", ReadLimits()), InputError) << n;
    }
    std::string spoiled = good;
    spoiled[34] = static_cast<char>(spoiled[34] ^ 1);  // in the packed text
    ZipArchive archive(spoiled, "test", ReadLimits());
    EXPECT_THROW((void)archive.read("a"), InputError);
}

}  // namespace
