// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_tree.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace trisect {
namespace {

TEST(CsgParser, NodesHaveNamesArgumentsChildrenAndPlaces) {
    const CsgTree tree = parse_csg(
        "// a comment\ndifference() {\n\tcube(size = [1, 2.5, -3e1]);\n"
        "\t/* another */ #text(\"a\\\"b\", true, undef, $fn = 8) ;\n}\n",
        "a.csg");
    ASSERT_EQ(tree.roots.size(), 1U);
    const CsgNode& root = tree.nodes[tree.roots[0]];
    EXPECT_EQ(root.name, "difference");
    EXPECT_EQ(root.place.line, 2U);
    ASSERT_EQ(root.children.size(), 2U);
    const CsgNode& cube = tree.nodes[root.children[0]];
    EXPECT_EQ(cube.place.line, 3U);
    EXPECT_EQ(cube.place.column, 2U);
    ASSERT_EQ(cube.arguments.size(), 1U);
    EXPECT_EQ(cube.arguments[0].name, "size");
    const CsgValue::List& size = *cube.arguments[0].value.list();
    EXPECT_EQ(*size[1].number(), 2.5);
    EXPECT_EQ(*size[2].number(), -30);
    EXPECT_EQ(size[2].place.column, 23U);
    const CsgNode& text = tree.nodes[root.children[1]];
    EXPECT_TRUE(text.modifiers.highlight);
    EXPECT_EQ(*text.arguments[0].value.text(), "a\"b");
    EXPECT_TRUE(*text.arguments[1].value.truth());
    EXPECT_TRUE(text.arguments[2].value.is_undefined());
    EXPECT_EQ(text.arguments[3].name, "$fn");
    // By OpenSCAD's parameter lists.
    EXPECT_EQ(text.arguments[0].name, "text");
    EXPECT_EQ(text.arguments[2].name, "font");
}

TEST(CsgParser, ChildWithoutBracesAndBlocksWithoutNames) {
    const CsgTree tree = parse_csg("group() !cube(); ; { %sphere(inf); *cylinder(-nan); }", "a");
    ASSERT_EQ(tree.roots.size(), 3U);
    EXPECT_TRUE(tree.nodes[tree.nodes[tree.roots[0]].children.at(0)].modifiers.root);
    const CsgNode& sphere = tree.nodes[tree.roots[1]];
    EXPECT_TRUE(sphere.modifiers.background);
    EXPECT_TRUE(std::isinf(*sphere.arguments[0].value.number()));
    EXPECT_TRUE(tree.nodes[tree.roots[2]].modifiers.disabled);
}

/// "line:column code".
std::string failure_of(const std::string& text, const CsgLimits& limits = {}) {
    try {
        (void)parse_csg(text, "f", limits);
    } catch (const CsgError& e) {
        return std::to_string(e.place().line) + ":" + std::to_string(e.place().column) + " " +
               std::to_string(static_cast<int>(e.code()));
    }
    return "none";
}

TEST(CsgParser, MalformedTextIsRefusedAtItsPlace) {
    EXPECT_EQ(failure_of("cube(\n  size = )"), "2:10 3");
    EXPECT_EQ(failure_of("cube(size = 1)"), "1:15 3");
    EXPECT_EQ(failure_of("group() {\n cube();\n"), "1:9 3");
    EXPECT_EQ(failure_of("text(\"abc"), "1:6 3");
    EXPECT_EQ(failure_of("text(\"abc\\"), "1:6 3");
    EXPECT_EQ(failure_of("/* abc"), "1:1 3");
    EXPECT_EQ(failure_of("cube(1e999);"), "1:6 3");
    EXPECT_EQ(failure_of("cube(1.2.3);"), "1:6 3");
    EXPECT_EQ(failure_of("cube(-);"), "1:6 3");
    EXPECT_EQ(failure_of("cube(1, true, 2);"), "1:15 3");
    EXPECT_EQ(failure_of("union(1);"), "1:7 3");
    EXPECT_EQ(failure_of("cube(sizes = 1);"), "1:14 7");
    EXPECT_EQ(failure_of("x = 3;"), "1:3 3");
    EXPECT_EQ(failure_of("cube(size = a);"), "1:13 3");
    EXPECT_EQ(failure_of("}"), "1:1 3");
    EXPECT_EQ(failure_of(std::string("cube(\0);", 8)), "1:6 3");
    EXPECT_EQ(failure_of("cube();\n\xc3\xa4"), "2:1 3");
    EXPECT_EQ(failure_of(""), "none");
}

std::string repeated(const std::string& text, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += text;
    return out;
}

TEST(CsgParser, DepthAndSizeAreLimited) {
    EXPECT_EQ(failure_of(repeated("group(){", 100000)).substr(0, 2), "1:");
    EXPECT_EQ(failure_of(repeated("group(){", 100000)).back(), '5');
    EXPECT_EQ(failure_of(repeated("group()", 100000)).back(), '5');
    EXPECT_EQ(failure_of(repeated("{", 100000)).back(), '5');
    EXPECT_EQ(failure_of("cube(" + repeated("[", 100000)).back(), '5');
    CsgLimits limits;
    limits.nodes = 3;
    EXPECT_EQ(failure_of(repeated("cube();", 3), limits), "none");
    EXPECT_EQ(failure_of(repeated("cube();", 4), limits).back(), '5');
    limits.values = 10;
    EXPECT_EQ(failure_of("cube([" + repeated("1,", 20) + "]);", limits).back(), '5');
}

}  // namespace
}  // namespace trisect
