// SPDX-License-Identifier: Apache-2.0
//
// Lines of files, and that a line costs what its length is: the time of a file of a million lines
// is not asserted, but that nobody looks behind the line feed.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include "trisect/line_words.h"

namespace {

using trisect::app::take_line;
using trisect::app::without_comment;
using trisect::app::words_of;

TEST(TakeLine, LeavesTheRest) {
    std::string_view text = "1 2\n\n# 3\r\n4";
    EXPECT_EQ(take_line(text), "1 2");
    EXPECT_EQ(take_line(text), "");
    EXPECT_EQ(without_comment(take_line(text)), "");
    EXPECT_EQ(take_line(text), "4");
    EXPECT_TRUE(text.empty());
    EXPECT_EQ(take_line(text), "");
}

TEST(TakeLine, WordsHaveColumns) {
    const auto words = words_of(without_comment(" 1.5,\t-2 # 3"));
    ASSERT_EQ(words.size(), 2U);
    EXPECT_EQ(words[1].text, "-2");
    EXPECT_EQ(words[1].column, 7U);
}

// The text goes on in a page that nobody may read.
TEST(TakeLine, NobodyLooksBehindTheLineFeed) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    void* pages =
        ::mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(pages, MAP_FAILED);
    char* const end = static_cast<char*>(pages) + page;
    ASSERT_EQ(::mprotect(end, page, PROT_NONE), 0);
    const std::string_view line = "0.25 1 -7\n";
    std::memcpy(end - line.size(), line.data(), line.size());
    std::string_view text(end - line.size(), line.size() + page);
    const auto words = words_of(without_comment(take_line(text)));
    EXPECT_EQ(words.size(), 3U);
    EXPECT_EQ(text.size(), page);
    ::munmap(pages, 2 * page);
}

}  // namespace
