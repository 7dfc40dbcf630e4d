// SPDX-License-Identifier: Apache-2.0
//
// Booleans in slabs: equal as sets to those in one piece, and closed across the walls.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/native_file.h>
#include <trisect/kernel/error.h>

#include "pieces/slab_run.h"
#include "scratch.h"

namespace {

using trisect::evaluate;
using trisect::Expression;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::app::SlabOptions;
using trisect::app::SlabRun;

bool are_equal(const Solid& a, const Solid& b) { return evaluate(Expression(a) ^ b).is_empty(); }

Expression formula(const std::string& operation, const Solid& a, const Solid& b) {
    if (operation == "union") return a | b;
    return operation == "intersection" ? a & b : a - b;
}

// Boxes on a small grid: faces, edges and corners coincide.
PolygonMesh boxes(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto at = [&] { return static_cast<double>(random() % 8); };
    Solid out;
    for (int i = 0; i < 4; ++i) {
        const Point3d low{at(), at(), at()};
        const Point3d high{low[0] + 1 + at(), low[1] + 1 + at(), low[2] + 1 + at()};
        out = evaluate(out | Solid::from_mesh(trisect::make_box(low, high)));
    }
    return out.to_mesh();
}

class SlabRunTest : public trisect::test::Scratch {
protected:
    std::string write_mesh_file(const std::string& name, const PolygonMesh& mesh) const {
        trisect::write_mesh(path(name), mesh);
        return path(name);
    }
    SlabOptions options(const std::string& operation, const std::string& a,
                        const std::string& b) const {
        SlabOptions out;
        out.operation = operation;
        out.inputs = {a, b};
        out.output = path("out.ply");
        out.folder = path("out.slabs");
        out.natives = path("natives");
        return out;
    }
    static std::size_t finish(SlabRun& run, std::size_t shares) {
        bool fits = false;
        while (!fits) {
            fits = true;
            for (std::size_t s = 0; s < shares; ++s) fits = run.distribute(s, shares) && fits;
            if (!fits) run.move_walls();
        }
        for (const std::size_t slab : run.order()) run.evaluate(slab, shares, {});
        (void)run.join();
        return run.count();
    }
    /// The union of the native files of all slabs, exactly.
    [[nodiscard]] Solid joined() const {
        std::vector<Solid> parts;
        for (const auto& entry : std::filesystem::directory_iterator(path("natives")))
            parts.push_back(trisect::read_native(entry.path()));
        return evaluate(Expression::any_of(std::span(parts)));
    }
    /// All operations: native files are the set to the last bit, and the mesh is a solid.
    void compare(const PolygonMesh& first, const PolygonMesh& second, std::uint64_t slabs) {
        const std::string a = write_mesh_file("a.ply", first);
        const std::string b = write_mesh_file("b.ply", second);
        const Solid solid_a = Solid::from_mesh(first);
        const Solid solid_b = Solid::from_mesh(second);
        for (const std::string operation : {"union", "intersection", "difference"}) {
            SlabOptions asked = options(operation, a, b);
            asked.slabs = slabs;
            SlabRun run(asked);
            run.plan();
            EXPECT_GT(finish(run, 1), 1U);
            EXPECT_TRUE(are_equal(joined(), evaluate(formula(operation, solid_a, solid_b))))
                << operation;
            const PolygonMesh mesh = trisect::read_mesh(asked.output);
            EXPECT_NO_THROW((void)Solid::from_mesh(mesh)) << operation;
            run.clean();
            EXPECT_FALSE(exists("out.slabs"));
            std::filesystem::remove_all(asked.natives);
        }
    }
};

TEST_F(SlabRunTest, SpecialPositionsOnASmallGrid) {
    for (std::uint32_t seed = 0; seed < 10; ++seed)
        compare(boxes(2 * seed), boxes(2 * seed + 1), 2 + seed % 4);
}

TEST_F(SlabRunTest, BallsInGeneralPosition) {
    const PolygonMesh ball = trisect::make_icosphere(40, 3);
    PolygonMesh moved = ball;
    for (Point3d& p : moved.points) p = {p[1] + 9.5, p[2] - 3.25, p[0] + 17.125};
    compare(ball, moved, 7);
}

TEST_F(SlabRunTest, RingsThatWallsCutIntoSeveralCycles) {
    const PolygonMesh ring = trisect::make_torus(40, 11, 48, 24);
    PolygonMesh turned = ring;
    for (Point3d& p : turned.points) p = {p[0] + 21.25, 0.125 - p[2], p[1]};
    compare(ring, turned, 9);
}

TEST_F(SlabRunTest, SharesDoNotShow) {
    const std::string a = write_mesh_file("a.ply", trisect::make_icosphere(40, 3));
    const std::string b = write_mesh_file("b.ply", trisect::make_torus(30, 9, 40, 20));
    std::vector<std::string> bytes;
    for (const std::size_t shares : {1U, 2U, 5U}) {
        SlabOptions asked = options("union", a, b);
        asked.natives = "";
        asked.slabs = 5;
        SlabRun run(asked);
        run.plan();
        (void)finish(run, shares);
        run.clean();
        bytes.push_back(read(asked.output));
    }
    EXPECT_EQ(bytes[0], bytes[1]);
    EXPECT_EQ(bytes[0], bytes[2]);
}

TEST_F(SlabRunTest, AnInterruptedRunGoesOn) {
    const std::string a = write_mesh_file("a.ply", trisect::make_icosphere(40, 3));
    const std::string b = write_mesh_file("b.ply", trisect::make_torus(30, 9, 40, 20));
    SlabOptions asked = options("difference", a, b);
    asked.natives = "";
    asked.slabs = 4;
    SlabRun whole(asked);
    whole.plan();
    (void)finish(whole, 1);
    const std::string expected = read(asked.output);
    whole.clean();

    {
        SlabRun first(asked);
        first.plan();
        ASSERT_TRUE(first.distribute(0, 1));
        first.note_distributed(1);
        first.evaluate(2, 1, {});
    }
    asked.resume = true;
    SlabRun second(asked);
    second.plan();
    ASSERT_EQ(second.distributed(), 1U);
    for (const std::size_t slab : second.order()) {
        EXPECT_EQ(second.is_done(slab), slab == 2);
        if (!second.is_done(slab)) second.evaluate(slab, 1, {});
    }
    (void)second.join();
    EXPECT_EQ(read(asked.output), expected);
}

TEST_F(SlabRunTest, OpenAndBrokenInputsAreRefused) {
    PolygonMesh open = trisect::make_icosphere(40, 2);
    PolygonMesh hole;
    hole.points = open.points;
    for (std::size_t f = 1; f < open.face_count(); ++f) hole.add_face(open.face(f));
    const std::string a = write_mesh_file("a.ply", hole);
    const std::string b = write_mesh_file("b.ply", open);
    SlabOptions asked = options("union", a, b);
    asked.slabs = 3;
    {
        SlabRun run(asked);
        run.plan();
        EXPECT_THROW((void)finish(run, 1), trisect::Error);
    }
    EXPECT_FALSE(exists("out.ply"));

    const std::string bytes = read(b);
    const std::string cut = write("cut.ply", bytes.substr(0, bytes.size() - 20));
    EXPECT_THROW(SlabRun(options("union", a, cut)).plan(), trisect::InputError);
    EXPECT_THROW(SlabRun(options("union", a, path("none.ply"))), trisect::Error);
}

}  // namespace
