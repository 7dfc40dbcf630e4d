// SPDX-License-Identifier: Apache-2.0
//
// Round trips of native files: the solid that is read is the one that was written, in its mesh, its
// boundary, its names, its measures and its own file.

#include <trisect/bsp/native_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/point.h>

#include "support/mesh_files.h"
#include "support/random_result.h"
#include "support/solids.h"

namespace {

using trisect::evaluate;
using trisect::native_bytes;
using trisect::NativeFile;
using trisect::NativeNames;
using trisect::Solid;

Solid again(const Solid& solid, const trisect::NativeWriteOptions& options = {}) {
    return NativeFile::of_bytes(native_bytes(solid, options), "memory").solid();
}

// Nothing for an unbounded one.
std::optional<trisect::Brep> boundary(const Solid& solid) {
    try {
        return solid.to_brep();
    } catch (const trisect::UnsupportedError&) {
        return std::nullopt;
    }
}

// A face by its source and the ranks of its corners, however the boundary numbers them.
using Face = std::tuple<trisect::FaceSource, std::vector<std::vector<std::uint32_t>>>;

struct NumberedBoundary {
    std::vector<trisect::Point> points;  // in lexicographic order
    std::vector<Face> faces;             // in order
};

NumberedBoundary numbered(const trisect::Brep& brep) {
    NumberedBoundary out;
    std::vector<std::uint32_t> order;
    for (const trisect::VertexId v : brep.vertices()) order.push_back(v.index);
    std::ranges::stable_sort(order, [&brep](std::uint32_t a, std::uint32_t b) {
        return compare_lexicographic(brep.point(trisect::VertexId(a)),
                                     brep.point(trisect::VertexId(b))) < 0;
    });
    std::vector<std::uint32_t> rank(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        const trisect::Point& p = brep.point(trisect::VertexId(order[i]));
        // Copies of a vertex have one rank.
        if (out.points.empty() || !(out.points.back() == p)) out.points.push_back(p);
        rank[order[i]] = static_cast<std::uint32_t>(out.points.size() - 1);
    }
    for (const trisect::FaceId f : brep.faces()) {
        Face face{brep.source(f), {}};
        for (const trisect::LoopId l : brep.loops(f)) {
            auto& loop = std::get<1>(face).emplace_back();
            for (const trisect::HalfedgeId h : brep.halfedges(l))
                loop.push_back(rank[brep.origin(h).index]);
            std::vector<std::uint32_t> least = loop;  // begin where that comes first
            for (std::size_t i = 0; i < loop.size(); ++i) {
                std::ranges::rotate(loop, loop.begin() + 1);
                least = std::min(least, loop);
            }
            loop = least;
        }
        std::ranges::sort(std::get<1>(face));
        out.faces.push_back(face);
    }
    std::ranges::sort(out.faces);
    return out;
}

// Points may be named by other planes and have other numbers: crossings of imports, by which facets
// that were not cut yet name theirs, are not in the file.
void expect_equal_boundaries(const Solid& a, const Solid& b) {
    const std::optional<trisect::Brep> of_a = boundary(a);
    const std::optional<trisect::Brep> of_b = boundary(b);
    ASSERT_EQ(of_a.has_value(), of_b.has_value());
    if (!of_a) return;
    const NumberedBoundary first = numbered(*of_a);
    const NumberedBoundary second = numbered(*of_b);
    EXPECT_TRUE(first.points == second.points);
    EXPECT_TRUE(first.faces == second.faces);
}

// All that a solid shows, of both.
void expect_equal(const Solid& a, const Solid& b) {
    EXPECT_EQ(a.lattice(), b.lattice());
    EXPECT_EQ(a.source_id(), b.source_id());
    EXPECT_EQ(a.is_empty(), b.is_empty());
    EXPECT_EQ(a.is_whole_space(), b.is_whole_space());
    expect_equal_boundaries(a, b);
    trisect::PolygonMesh mesh;
    trisect::MeshMap map;
    try {
        mesh = a.to_mesh(map);
    } catch (const trisect::UnsupportedError&) {
        EXPECT_THROW((void)b.to_mesh(), trisect::UnsupportedError);
        return;
    }
    trisect::MeshMap other;
    EXPECT_EQ(mesh, b.to_mesh(other));
    EXPECT_EQ(map.source, other.source);
    EXPECT_EQ(exact_volume(a), exact_volume(b));
    const trisect::BrepIndex of_a(a);
    const trisect::BrepIndex of_b(b);
    for (int i = 0; i < 60; ++i) {
        const trisect::Point3d p{0.25 * (i % 17), 0.5 * (i % 23), 0.125 * (i % 29) + i % 7};
        EXPECT_TRUE(of_a.locate(p) == of_b.locate(p));
    }
}

void expect_round_trip(const Solid& solid) {
    const std::string bytes = native_bytes(solid);
    const Solid read = NativeFile::of_bytes(bytes, "memory").solid();
    EXPECT_EQ(native_bytes(read), bytes);
    expect_equal(solid, read);
}

Solid carved_plate() {
    const Solid plate = Solid::from_mesh(trisect::make_box({0, 0, 0}, {12, 10, 3}));
    trisect::Expression formula = plate;
    for (int i = 0; i < 3; ++i) {
        const auto drill =
            transformed(trisect::make_cylinder(1.1, 5, 24),
                        trisect::AffineMap::translation({2.0 + 3.5 * i, 4.0 + i, -1}));
        formula = formula - Solid::from_mesh(drill);
    }
    return evaluate(formula);
}

TEST(NativeFile, SpecialSets) {
    expect_round_trip(Solid());
    expect_round_trip(Solid::whole_space());
    expect_round_trip(Solid::half_space({1, 2, -3, 0.75}));
    expect_round_trip(evaluate(~Solid::half_space({0, 0, 1, -4})));
}

TEST(NativeFile, AnImport) { expect_round_trip(Solid::from_mesh(trisect::make_icosphere(3, 3))); }

TEST(NativeFile, AComplement) { expect_round_trip(evaluate(~solids::box(0, 4))); }

TEST(NativeFile, ABoundaryThatMeetsItself) {
    trisect::PolygonMesh two = trisect::make_box({0, 0, 0}, {4, 4, 4});
    trisect::append(two, trisect::make_box({2, 1, 1}, {6, 3, 3}));
    const Solid solid = Solid::from_mesh(two, {.embedding = trisect::Embedding::Resolve});
    expect_round_trip(solid);
    expect_round_trip(evaluate(solid - solids::box(3, 3.5)));
}

TEST(NativeFile, CutByHalfSpaces) {
    const Solid ball = solids::ball(4, 2);
    const Solid slice = evaluate(ball & Solid::half_space({0.3, 0.1, 1, -1}));
    expect_round_trip(slice);
    expect_round_trip(evaluate(slice & Solid::half_space({0, 1, 0.01, -0.5})));
    expect_round_trip(evaluate(Solid::half_space({1, 0, 0, -2}) | slice));
}

TEST(NativeFile, ACavity) { expect_round_trip(evaluate(solids::ball(4, 2) - solids::ball(2, 2))); }

// With facets that were not yet cut when it was written.
TEST(NativeFile, MeshesInGeneralPosition) {
    expect_round_trip(evaluate(solids::ball(4, 3) | solids::ball(4, 3, {1.3, 0.4, 2.1})));
    expect_round_trip(carved_plate());
}

TEST(NativeFile, AChainOfCutsAndMoves) {
    Solid part = carved_plate();
    for (int i = 0; i < 12; ++i) {
        part = evaluate(part - solids::ball(0.7, 1, {i * 1.0, i * 0.8, 3}));
        if (i % 4 == 3) part = transformed(part, trisect::Pose::from_translation({0, 0, 1.0}));
        if (i % 3 == 0) expect_round_trip(part);
    }
    expect_round_trip(part);
    const Solid turned = transformed(part, trisect::Pose::from_quaternion({1, 0, 0, 1}));
    expect_round_trip(turned);
    expect_round_trip(evaluate(turned - solids::box(-2, 2)));
}

TEST(NativeFile, WideCoordinates) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(1, 2);
    for (auto& p : mesh.points) p[0] += 0x1p40;
    mesh.points[0][1] += 0x1p-70;
    const Solid wide = Solid::from_mesh(mesh);
    expect_round_trip(wide);
    const Solid tool = solids::box({0x1p40, -3, -3}, {0x1p40 + 3, 3, 0.1});
    expect_round_trip(evaluate(wide - tool));
}

TEST(NativeFile, AnExactBoundary) {
    const Solid part = evaluate(solids::ball(4, 1) - solids::ball(4, 1, {1.3, 0.4, 2.1}));
    expect_round_trip(Solid::from_brep(part.to_brep()));
}

TEST(NativeFile, RandomResults) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        const int bits = seed % 5 == 4 ? 30 : 0;
        expect_round_trip(brute::random_result_solid(seed, 4, seed % 3 == 0, bits));
    }
}

TEST(NativeFile, DividedCells) {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(3, 5));
    const trisect::NativeWriteOptions divided{.divided = true};
    const std::string bytes = native_bytes(ball, divided);
    const NativeFile file = NativeFile::of_bytes(bytes, "memory");
    EXPECT_GT(file.info().cells, 16U);
    const Solid read = file.solid();
    EXPECT_EQ(native_bytes(read), bytes);
    EXPECT_EQ(native_bytes(read, divided), bytes);
    EXPECT_EQ(read.to_mesh(), ball.to_mesh());
    expect_equal_boundaries(read, ball);
    EXPECT_EQ(evaluate(read - solids::box(0, 4)).to_mesh(),
              evaluate(ball - solids::box(0, 4)).to_mesh());
}

TEST(NativeFile, BytesDoNotDependOnThreads) {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(3, 6));
    EXPECT_EQ(native_bytes(ball, {.threads = 1}), native_bytes(ball, {.threads = 4}));
    EXPECT_EQ(native_bytes(ball, {.divided = true, .threads = 1}),
              native_bytes(ball, {.divided = true, .threads = 4}));
}

// What is read goes on as the original does, names included.
TEST(NativeFile, OperandsOfFurtherFormulas) {
    const Solid part = carved_plate();
    const Solid tool = solids::ball(2, 3, {6, 5, 3});
    expect_equal_boundaries(evaluate(part - tool), evaluate(again(part) - tool));
    expect_equal_boundaries(evaluate(part | tool), evaluate(again(part) | tool));
}

TEST(NativeFile, FreshNamesAreNobodyElses) {
    const Solid part = carved_plate();
    const std::string bytes = native_bytes(part);
    const NativeFile file = NativeFile::of_bytes(bytes, "memory");
    const Solid fresh = file.solid({.names = NativeNames::Fresh});
    trisect::MeshMap kept_names;
    trisect::MeshMap fresh_names;
    EXPECT_EQ(part.to_mesh(kept_names), fresh.to_mesh(fresh_names));
    ASSERT_EQ(kept_names.source.size(), fresh_names.source.size());
    for (std::size_t i = 0; i < kept_names.source.size(); ++i) {
        EXPECT_EQ(kept_names.source[i].face, fresh_names.source[i].face);
        EXPECT_GT(fresh_names.source[i].operand, kept_names.source[i].operand);
    }
    const Solid later = solids::box(0, 1);
    for (const trisect::FaceSource& s : fresh_names.source) EXPECT_NE(s.operand, later.source_id());
}

TEST(NativeFile, LaterImportsGetOtherNumbers) {
    const Solid ball = solids::ball(1, 1);
    const std::string bytes = native_bytes(ball);
    EXPECT_EQ(NativeFile::of_bytes(bytes, "memory").solid().source_id(), ball.source_id());
    EXPECT_GT(solids::box(0, 1).source_id(), ball.source_id());
}

TEST(NativeFile, OnTheDisk) {
    const trisect::io_test::TemporaryFolder folder;
    const auto path = folder.path() / "part.trisect";
    const Solid part = carved_plate();
    write_native(part, path);
    EXPECT_EQ(folder.entries(), 1U);
    EXPECT_EQ(trisect::read_file(path, 1U << 30U).view(), native_bytes(part));
    expect_equal(part, trisect::read_native(path));
    write_native(Solid(), path);  // over it
    EXPECT_TRUE(trisect::read_native(path).is_empty());
    EXPECT_THROW(write_native(part, folder.path() / "no" / "folder.trisect"), trisect::Error);
    EXPECT_THROW((void)trisect::read_native(folder.path() / "missing"), trisect::InputError);
    EXPECT_THROW((void)trisect::read_native(folder.path()), trisect::InputError);
}

// A file that was replaced while it is open stays what it was.
TEST(NativeFile, AnOpenFileOutlivesItsReplacement) {
    const trisect::io_test::TemporaryFolder folder;
    const auto path = folder.path() / "part.trisect";
    const Solid part = carved_plate();
    write_native(part, path);
    const NativeFile file = NativeFile::open(path);
    write_native(Solid(), path);
    std::filesystem::remove(path);
    expect_equal(part, file.solid());
}

TEST(NativeFile, ManyReadersOfOneFile) {
    const std::string bytes = native_bytes(carved_plate(), {.divided = true});
    const NativeFile file = NativeFile::of_bytes(bytes, "memory");
    std::array<std::string, 4> read;
    std::vector<std::thread> threads;
    for (std::string& out : read)
        threads.emplace_back([&out, &file] {
            for (std::uint64_t c = 0; c < file.info().cells; ++c) (void)file.cell(c);
            out = native_bytes(file.solid());
        });
    for (std::thread& t : threads) t.join();
    for (const std::string& r : read) EXPECT_EQ(r, bytes);
}

}  // namespace
