// SPDX-License-Identifier: Apache-2.0
//
// Programs that are edited, evaluated again and from the beginning.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/csg/csg_session.h>
#include <trisect/bsp/solid_measure.h>

namespace {

using trisect::ChangeReport;
using trisect::CsgReport;
using trisect::CsgSession;
using trisect::evaluate;
using trisect::evaluate_csg;
using trisect::Expression;
using trisect::Solid;

trisect::CsgTree parse_csg(const std::string& text) { return trisect::parse_csg(text, "t.csg"); }

bool is_same(const Solid& a, const Solid& b) { return evaluate(Expression(a) ^ b).is_empty(); }

std::string at(int x, int y, int z, const std::string& what) {
    return "multmatrix([[1,0,0," + std::to_string(x) + "],[0,1,0," + std::to_string(y) +
           "],[0,0,1," + std::to_string(z) + "],[0,0,0,1]]) { " + what + " }\n";
}

std::string random_shape(std::mt19937& random) {
    const auto number = [&] { return std::to_string(1 + random() % 3); };
    switch (random() % 7) {
        case 0:
            return "cylinder($fn = 7, h = " + number() + ", r1 = 1, r2 = 1);";
        case 1:
            return "sphere($fn = 8, r = " + number() + ");";
        case 2:
            return "hull() { cube(size = 1); " + at(2, 1, 1, "cube(size = " + number() + ");") +
                   "}";
        case 3:
            return "linear_extrude(height = " + number() + ") { circle($fn = 6, r = 1); }";
        case 4:
            return "rotate_extrude($fn = 6) { " + at(2, 0, 0, "square(size = 1);") + "}";
        case 5:
            return "multmatrix([[0.6,-0.8,0,0],[0.8,0.6,0,0],[0,0,1,0],[0,0,0,1]]) { union() { "
                   "cube(size = 2); cylinder($fn = 5, h = " +
                   number() + ", r = 1); } }";
        default:
            return "cube(size = " + number() + ");";
    }
}

// A difference of groups, an edit of which replaces, adds or takes away one shape.
class Program {
public:
    explicit Program(unsigned seed) : random_(seed) {
        for (int i = 0; i < 14; ++i) shapes_.push_back(placed_shape());
    }
    void edit() {
        const auto place =
            shapes_.begin() + static_cast<std::ptrdiff_t>(random_() % shapes_.size());
        const auto what = random_() % 5;
        if (what == 0 && shapes_.size() > 8) {
            shapes_.erase(place);
        } else if (what == 1) {
            shapes_.insert(place, placed_shape());
        } else {
            *place = placed_shape();
        }
    }
    [[nodiscard]] std::string text() const {
        std::string out = "difference() { group() {\n";
        for (std::size_t i = 0; i < shapes_.size(); ++i)
            out += shapes_[i] + (i == shapes_.size() / 2 ? "}\n" : "");
        return out + "}\n";
    }

private:
    std::string placed_shape() {
        const auto place = [&] { return static_cast<int>(random_() % 9); };
        const int x = place();
        const int y = place();
        return at(x, y, place(), random_shape(random_));
    }
    std::mt19937 random_;
    std::vector<std::string> shapes_;
};

TEST(CsgSession, EditedProgramsAreWhatTheyAre) {
    std::size_t in_a_box = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        Program program(seed);
        CsgSession session;
        (void)session.evaluate(parse_csg(program.text()));
        for (int step = 0; step < 6; ++step) {
            program.edit();
            const auto tree = parse_csg(program.text());
            ChangeReport change;
            const Solid again = session.evaluate(tree, nullptr, &change);
            const Solid whole = evaluate_csg(tree);
            ASSERT_TRUE(is_same(again, whole)) << seed << ' ' << step;
            ASSERT_EQ(exact_volume(again), exact_volume(whole)) << seed << ' ' << step;
            in_a_box += change.box ? 1 : 0;
        }
    }
    EXPECT_GT(in_a_box, 36U);
}

TEST(CsgSession, OnlyNewShapesAreMade) {
    CsgSession session;
    const auto text = [](int r) {
        return "difference() { cube(size = 9);" + at(1, 1, 1, "sphere(r = 1);") +
               "hull() { cube(size = 1); " + at(4, 0, 0, "cube(size = 1);") + "} " +
               at(7, 7, 7, "sphere(r = " + std::to_string(r) + ");") + "}";
    };
    CsgReport report;
    (void)session.evaluate(parse_csg(text(2)), &report);
    EXPECT_GT(report.meshes, 4U);
    ChangeReport change;
    (void)session.evaluate(parse_csg(text(1)), &report, &change);
    EXPECT_EQ(report.meshes, 1U);
    EXPECT_EQ(change.changed_operands, 2U);
    EXPECT_FALSE(change.evaluated_all);
    // What the program before the last one had is gone.
    (void)session.evaluate(parse_csg(text(1)), &report, &change);
    EXPECT_EQ(report.meshes, 0U);
    EXPECT_EQ(change.changed_operands, 0U);
    (void)session.evaluate(parse_csg(text(2)), &report, &change);
    EXPECT_EQ(report.meshes, 1U);
}

TEST(CsgSession, AFailureKeepsTheLastSet) {
    CsgSession session;
    (void)session.evaluate(parse_csg("cube(size = 2);"));
    EXPECT_THROW((void)session.evaluate(parse_csg("import(file = \"/nowhere/x.stl\");")),
                 trisect::Error);
    EXPECT_EQ(volume(session.evaluate(parse_csg("cube(size = 2);"))), 8);
    EXPECT_EQ(volume(session.evaluate(parse_csg("cube(size = 3);"))), 27);
}

TEST(CsgSession, AFileThatChangedIsReadAgain) {
    const auto folder = std::filesystem::temp_directory_path() /
                        ("csg_session_" + std::to_string(std::random_device()()));
    std::filesystem::create_directory(folder);
    const auto file = folder / "part.off";
    const auto write = [&](double size) {
        (void)trisect::write_mesh(file, trisect::make_box({0, 0, 0}, {size, size, size}));
    };
    write(1);
    const auto tree =
        parse_csg("import(file = \"" + file.string() + "\");" + at(5, 5, 5, "cube(size = 1);"));
    CsgSession session;
    EXPECT_EQ(volume(session.evaluate(tree)), 2);
    EXPECT_FALSE(session.have_files_changed());
    write(2.5);
    EXPECT_TRUE(session.have_files_changed());
    EXPECT_EQ(volume(session.evaluate(tree)), 16.625);
    std::filesystem::remove_all(folder);
}

}  // namespace
