// SPDX-License-Identifier: Apache-2.0
//
// Programs as JSON: the same trees, and what is refused.
#include <trisect/bsp/csg/json/csg_json.h>

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace trisect {
namespace {

// Equal to the last bit of every number; of two arguments with a name the last one counts.
bool is_same(const CsgValue& a, const CsgValue& b) {
    if (a.data.index() != b.data.index()) return false;
    if (a.number() != nullptr)
        return std::bit_cast<std::uint64_t>(*a.number()) ==
                   std::bit_cast<std::uint64_t>(*b.number()) ||
               (*a.number() != *a.number() && *b.number() != *b.number());
    if (a.list() == nullptr)
        return a.text() != nullptr    ? *a.text() == *b.text()
               : a.truth() != nullptr ? *a.truth() == *b.truth()
                                      : true;
    if (a.list()->size() != b.list()->size()) return false;
    for (std::size_t i = 0; i < a.list()->size(); ++i)
        if (!is_same((*a.list())[i], (*b.list())[i])) return false;
    return true;
}

std::vector<CsgArgument> counting(const CsgNode& node) {
    std::set<std::string> seen;
    std::vector<CsgArgument> out;
    for (auto a = node.arguments.rbegin(); a != node.arguments.rend(); ++a)
        if (!a->name.empty() && seen.insert(a->name).second) out.insert(out.begin(), *a);
    for (const CsgArgument& a : node.arguments)
        if (a.name.empty()) out.push_back(a);
    return out;
}

void expect_same(const CsgNode& a, const CsgNode& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.place.line, b.place.line);
    EXPECT_EQ(a.place.column, b.place.column);
    EXPECT_EQ(a.children, b.children);
    EXPECT_EQ(a.modifiers.disabled, b.modifiers.disabled);
    EXPECT_EQ(a.modifiers.root, b.modifiers.root);
    EXPECT_EQ(a.modifiers.highlight, b.modifiers.highlight);
    EXPECT_EQ(a.modifiers.background, b.modifiers.background);
    const std::vector<CsgArgument> x = counting(a);
    const std::vector<CsgArgument> y = counting(b);
    ASSERT_EQ(x.size(), y.size()) << a.name;
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_EQ(x[i].name, y[i].name);
        EXPECT_TRUE(is_same(x[i].value, y[i].value)) << a.name << ' ' << x[i].name;
    }
}

void expect_same(const CsgTree& a, const CsgTree& b) {
    EXPECT_EQ(a.file, b.file);
    EXPECT_EQ(a.roots, b.roots);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (std::size_t n = 0; n < a.nodes.size(); ++n) expect_same(a.nodes[n], b.nodes[n]);
}

TEST(CsgJson, AProgramAndItsJsonAreOneTree) {
    const CsgTree tree = parse_csg(
        "group() {\n  difference() { cube([1, 0.1, -0], true); !sphere(r = 1e-300, $fn = 8); }\n"
        "  #text(\"a\\\"b\\\\\\n\xc3\xa4\xf0\x9f\x98\x80\x01\", size = undef);\n"
        "  *unknown(3, x = [inf, -inf, nan, [], [[1]]], 4); %cube(size = 1, size = 2); }\n"
        "polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], faces = [[0,1,2]]);",
        "f.csg");
    const std::string text = csg_json_text(tree);
    expect_same(tree, parse_csg_json(text, "f.json"));
    // Written again it is the same text.
    EXPECT_EQ(text, csg_json_text(parse_csg_json(text, "f.json")));
    expect_same(parse_csg("", "e"), parse_csg_json(csg_json_text(parse_csg("", "e")), "j"));
}

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// The 216 files of OpenSCAD's tests, where they are installed.
TEST(CsgJson, ProgramsOfOpenScadComeBack) {
    const char* const given = std::getenv("TRISECT_CSG");
    const std::filesystem::path folder = given != nullptr ? given : "/usr/share/openscad";
    std::error_code none;
    std::size_t count = 0;
    for (std::filesystem::recursive_directory_iterator it(folder, none), end; it != end; ++it) {
        if (it->path().extension() != ".csg") continue;
        CsgTree tree;
        try {
            tree = parse_csg(bytes_of(it->path()), it->path().string());
        } catch (const CsgError&) {
            continue;  // text that is no program
        }
        ++count;
        CsgTree moved = tree;
        moved.file = it->path().filename().string();
        expect_same(tree, parse_csg_json(csg_json_text(moved),
                                         (it->path().parent_path() / "p.json").string()));
    }
    if (count == 0) GTEST_SKIP() << "no .csg files below " << folder;
    RecordProperty("programs", static_cast<int>(count));
}

TEST(CsgJson, WhatIsWrittenByHand) {
    const CsgTree tree = parse_csg_json(R"({"nodes": [
  {"children": [{"node": "cube", "values": [[1, 2, 3]]}], "modifiers": "#!", "node": "union"},
  {"node": "import", "arguments": {"file": "\u00e4\ud83d\ude00\/.stl"}}]})",
                                        "a/b.json");
    ASSERT_EQ(tree.nodes.size(), 3U);
    EXPECT_EQ(tree.roots, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(tree.file, "a/b.json");
    EXPECT_TRUE(tree.nodes[0].modifiers.root);
    EXPECT_TRUE(tree.nodes[0].modifiers.highlight);
    EXPECT_EQ(tree.nodes[1].place.line, 2U);
    EXPECT_EQ(tree.nodes[1].place.column, 17U);
    EXPECT_EQ(tree.nodes[1].arguments.at(0).name, "size");
    EXPECT_EQ(*tree.nodes[2].arguments.at(0).value.text(), "\xc3\xa4\xf0\x9f\x98\x80/.stl");
}

TEST(CsgJson, FilesAreThoseOfTheTextThatItWasMadeOf) {
    const std::string text =
        R"({"file": "../m.csg", "nodes": [{"node": "cube", "place": [7, 3], "arguments": {"size": 1}}]})";
    const CsgTree tree = parse_csg_json(text, "a/b.json");
    EXPECT_EQ(tree.file, "a/../m.csg");
    EXPECT_EQ(tree.nodes[0].place.line, 7U);
    EXPECT_EQ(tree.nodes[0].arguments[0].value.place.line, 7U);
    EXPECT_EQ(tree.nodes[0].arguments[0].value.place.column, 3U);
}

/// "line:column code".
std::string failure_of(const std::string& text, const CsgLimits& limits = {}) {
    try {
        (void)parse_csg_json(text, "f", limits);
    } catch (const CsgError& e) {
        return std::to_string(e.place().line) + ":" + std::to_string(e.place().column) + " " +
               std::to_string(static_cast<int>(e.code()));
    }
    return "none";
}

std::string node(const std::string& members) { return "{\"nodes\": [\n{" + members + "}]}"; }

TEST(CsgJson, WhatIsMalformedIsRefusedAtItsPlace) {
    EXPECT_EQ(failure_of(""), "1:1 3");
    EXPECT_EQ(failure_of("[]"), "1:1 3");
    EXPECT_EQ(failure_of("{}"), "1:1 3");
    EXPECT_EQ(failure_of("{\"nodes\": []}"), "none");
    EXPECT_EQ(failure_of("{\"nodes\": []} x"), "1:15 3");
    EXPECT_EQ(failure_of("{\"nodes\": [],}"), "1:14 3");
    EXPECT_EQ(failure_of("{\"nodes\": [,]}"), "1:12 3");
    EXPECT_EQ(failure_of("{\"nodes\": [] // a\n}"), "1:14 3");
    EXPECT_EQ(failure_of("{'nodes': []}"), "1:2 3");
    EXPECT_EQ(failure_of("{\"nodes\": [], \"nodes\": []}"), "1:15 3");
    EXPECT_EQ(failure_of("{\"nodes\": [], \"units\": \"mm\"}"), "1:15 7");
    EXPECT_EQ(failure_of("{\"schema\": \"trisect.csg/2\", \"nodes\": []}"), "1:12 7");
    EXPECT_EQ(failure_of(node("")), "2:1 3");
    EXPECT_EQ(failure_of(node("\"node\": \"\"")), "2:10 3");
    EXPECT_EQ(failure_of(node("\"node\": 3")), "2:10 3");
    EXPECT_EQ(failure_of(node("\"node\": \"cube\", \"node\": \"cube\"")), "2:18 3");
    EXPECT_EQ(failure_of(node("\"node\": \"cube\", \"childs\": []")), "2:18 7");
    EXPECT_EQ(failure_of(node("\"node\": \"cube\", \"modifiers\": \"##\"")), "2:31 3");
    EXPECT_EQ(failure_of(node("\"node\": \"cube\", \"modifiers\": \"?\"")), "2:31 3");
    EXPECT_EQ(failure_of(node("\"node\": \"cube\", \"place\": [1, 1]")), "2:1 3");
    EXPECT_EQ(failure_of("{\"file\": \"a\", \"nodes\": [{\"node\": \"cube\"}]}"), "1:25 3");
    const auto argument = [](const std::string& text) {
        return failure_of(node("\"node\": \"cube\", \"arguments\": {" + text + "}"));
    };
    EXPECT_EQ(argument("\"size\": 1"), "none");
    EXPECT_EQ(argument("\"size\": 1, \"size\": 1"), "2:43 3");
    EXPECT_EQ(argument("\"\": 1"), "2:32 3");
    EXPECT_EQ(argument("\"sizes\": 1"), "2:41 7");
    for (const char* bad : {"01",
                            "+1",
                            "1.",
                            ".5",
                            "1e",
                            "0x1",
                            "NaN",
                            "inf",
                            "tru",
                            "--1",
                            "1e999",
                            "\"\\x\"",
                            "\"\\ud800\"",
                            "\"\\ud800\\u0020\"",
                            "\"\\udc00\"",
                            "\"\xff\"",
                            "\"\xc0\x80\"",
                            "\"\xed\xa0\x80\"",
                            "\"a\nb\"",
                            "\"\\u12g4\"",
                            "\"",
                            "{\"number\": \"Inf\"}",
                            "{}",
                            "{\"x\": 1}",
                            "[1 2]",
                            "[1,]",
                            "["})
        EXPECT_NE(argument("\"size\": " + std::string(bad)), "none") << bad;
    EXPECT_EQ(argument("\"size\": {\"number\": \"-inf\"}"), "none");
    EXPECT_EQ(failure_of(std::string("{\"nodes\": []\0}", 14)), "1:13 3");
}

// Wherever a text ends too early, that is an error.
TEST(CsgJson, EveryTruncationIsRefused) {
    const std::string text = csg_json_text(parse_csg(
        "difference() { cube([1, 2, 3]); #text(\"\xc3\xa4\", size = undef, $fn = inf); }", "f"));
    std::string whole = text;
    while (!whole.empty() && whole.back() != '}') whole.pop_back();
    for (std::size_t n = 0; n < whole.size(); ++n)
        EXPECT_NE(failure_of(whole.substr(0, n)), "none") << n;
}

std::string repeated(const std::string& text, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += text;
    return out;
}

TEST(CsgJson, DepthAndSizeAreLimited) {
    const std::string open = "{\"node\": \"group\", \"children\": [";
    EXPECT_EQ(failure_of("{\"nodes\": [" + repeated(open, 100000)).back(), '5');
    EXPECT_EQ(failure_of(node("\"node\": \"cube\", \"values\": [" + repeated("[", 100000))).back(),
              '5');
    EXPECT_EQ(failure_of(repeated("{\"nodes\": ", 100000)).back(), '3');
    CsgLimits limits;
    limits.nodes = 2;
    const std::string cube = "{\"node\": \"cube\"}";
    EXPECT_EQ(failure_of("{\"nodes\": [" + cube + "," + cube + "]}", limits), "none");
    EXPECT_EQ(failure_of("{\"nodes\": [" + cube + "," + cube + "," + cube + "]}", limits).back(),
              '5');
    limits.values = 10;
    EXPECT_EQ(
        failure_of(node("\"node\": \"cube\", \"values\": [[" + repeated("1,", 20) + "1]]"), limits)
            .back(),
        '5');
    // What the reader of the evaluated form takes, this one takes.
    const std::string deep = repeated("group(){", 199) + "cube();" + repeated("}", 199);
    (void)parse_csg_json(csg_json_text(parse_csg(deep, "f")), "f");
}

TEST(CsgJson, TextThatIsNotUtf8IsRefusedByTheWriter) {
    try {
        (void)csg_json_text(parse_csg("\ntext(\"\xff\");", "f"));
        ADD_FAILURE();
    } catch (const CsgError& e) {
        EXPECT_EQ(e.code(), ErrorCode::Unsupported);
        EXPECT_EQ(e.place().line, 2U);
    }
}

}  // namespace
}  // namespace trisect
