// SPDX-License-Identifier: Apache-2.0
//
// What the reader of parts takes is JSON, and it gives what a document has; what it leaves may be
// JSON.
#include "trisect/manifest_parts.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "trisect/outcome.h"

namespace {

using trisect::app::Json;
using trisect::app::WrittenPart;
using trisect::app::WrittenParts;

std::optional<std::vector<WrittenPart>> taken(std::string_view text) {
    WrittenParts parts(text);
    std::vector<WrittenPart> out;
    for (WrittenPart part; parts.next(part);) out.push_back(part);
    return parts.is_whole() ? std::optional(out) : std::nullopt;
}

// By a document, as the other reader takes it.
WrittenPart part_of(const Json& p) {
    WrittenPart out;
    out.file = p.at("file").get<std::string>();
    out.name = p.value("name", std::string());
    out.id = p.value("id", std::string());
    out.group = p.value("group", std::string());
    if (!p.contains("pose")) return out;
    const auto numbers = p.at("pose").get<std::vector<double>>();
    EXPECT_TRUE(numbers.size() == 3 || numbers.size() == 12);
    for (const double x : numbers) out.pose.at(out.numbers++) = x;
    return out;
}

// \return whether the text was taken
bool check(const std::string& text) {
    const auto found = taken(text);
    if (!found) return false;
    const Json document = Json::parse("[" + text + "]", nullptr, false);
    EXPECT_FALSE(document.is_discarded()) << text;
    if (document.is_discarded()) return true;
    EXPECT_EQ(document.size(), found->size()) << text;
    for (std::size_t i = 0; i < found->size(); ++i) {
        const WrittenPart& a = found->at(i);
        const WrittenPart b = part_of(document.at(i));
        EXPECT_EQ(a.file, b.file) << text;
        EXPECT_EQ(a.name, b.name) << text;
        EXPECT_EQ(a.id, b.id) << text;
        EXPECT_EQ(a.group, b.group) << text;
        EXPECT_EQ(a.numbers, b.numbers) << text;
        for (std::size_t k = 0; k < a.numbers; ++k)
            EXPECT_EQ(std::bit_cast<std::uint64_t>(a.pose.at(k)),
                      std::bit_cast<std::uint64_t>(b.pose.at(k)))
                << text;
    }
    return true;
}

TEST(WrittenParts, TakesWhatProgramsWrite) {
    for (const char* const text : {
             R"({"file": "a.off"})",
             R"( { "file" : "a.off" , "name":"x","id":"7" , "group" : "" } , {"file":""} )",
             R"({"file": "a.off", "pose": [1, 0, 0, -200, 0.6, -0.8, 0, 2.5e-3, 0, 0, 1E+2, -0]})",
             R"({"pose": [-0, -0.0, 0e5], "file": "\u00e4\ud83d\ude00 \"\\\/\b\f\n\r\t"})",
             "{\"file\": \"\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80\"}",
             R"({"file": "a", "pose": [9007199254740993, 123456789012345678901234567890, 1e-310]})",
             R"({"file": "a", "pose": [999999999999999, -9999999999999999, 18446744073709551617]})",
         })
        EXPECT_TRUE(check(text)) << text;
}

TEST(WrittenParts, LeavesWhatIsOddToOthers) {
    for (const char* const text : {
             "",
             ",",
             "{}",
             "7",
             R"({"name": "x"})",
             R"({"file": "a"},)",
             R"({"file": "a"} {"file": "b"})",
             R"({"file": "a", "file": "b"})",
             R"({"file": null})",
             R"({"file": "a", "name": 7})",
             R"({"file": "a", "pose": []})",
             R"({"file": "a", "pose": [1, 2]})",
             R"({"file": "a", "pose": [1, 2, 3, 4]})",
             R"({"file": "a", "pose": [1, 2, "3"]})",
             R"({"file": "a", "pose": [01, 2, 3]})",
             R"({"file": "a", "pose": [1., 2, 3]})",
             R"({"file": "a", "pose": [.5, 2, 3]})",
             R"({"file": "a", "pose": [+1, 2, 3]})",
             R"({"file": "a", "pose": [1e, 2, 3]})",
             R"({"file": "a", "pose": [1e999, 2, 3]})",
             R"({"file": "a", "pose": [inf, 2, 3]})",
             R"({"file": "a", "pose": [1, 2, 3,]})",
             R"({"file": "a",})",
             R"({"file": "\ud800"})",
             R"({"file": "\udc00"})",
             R"({"file": "\ud800\u0041"})",
             R"({"file": "\x"})",
             R"({"file": "\u12"})",
             R"({"file": "\u-123"})",
             "{\"file\": \"\xc0\x80\"}",
             "{\"file\": \"\xed\xa0\x80\"}",
             "{\"file\": \"\xf4\x90\x80\x80\"}",
             "{\"file\": \"\xe2\x82\"}",
             "{\"file\": \"a\nb\"}",
             R"({"file": "a)",
             R"({"file" "a"})",
             R"({"file": "a", "more": tru})",
             R"({"file": "a", "more": 1})",
         })
        EXPECT_FALSE(taken(text)) << text;
}

// Parts as they are written by programs, with some bytes changed.
TEST(WrittenParts, WhatIsTakenIsWhatADocumentHas) {
    std::mt19937 random(26);
    const auto below = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    const std::vector<std::string> pieces = {R"({"file": "a.off"})",
                                             R"({"file":"b","name":"n","id":"i","group":"g"})",
                                             R"({"file": "c", "pose": [1, 2.5, -3e-7]})",
                                             R"({"file": "d", "pose": [1,0,0,0,0,1,0,0,0,0,1,-0]})",
                                             R"({"file": "\u00e4\ud83d\ude00\n", "id": "\u0041"})",
                                             "{\"file\": \"\xc3\xa4\xf0\x9f\x98\x80\"}"};
    const std::string_view bytes = "{}[]\",:\\u0d8\xc3\xa4\xed\xf4\x80-+.eE019nt \n/";
    std::size_t count = 0;
    for (int i = 0; i < 40000; ++i) {
        std::string text = pieces[below(pieces.size())];
        if (below(2) == 0) text += ", " + pieces[below(pieces.size())];
        for (std::size_t n = below(4); n-- != 0;) {
            const std::size_t at = below(text.size());
            switch (below(3)) {
                case 0:
                    text[at] = bytes[below(bytes.size())];
                    break;
                case 1:
                    text.insert(at, 1, bytes[below(bytes.size())]);
                    break;
                default:
                    text.erase(at, 1 + below(3));
                    break;
            }
            if (text.empty()) break;
        }
        count += check(text) ? 1U : 0U;
        if (HasFailure()) return;
    }
    EXPECT_GT(count, 10000U);
}

}  // namespace
