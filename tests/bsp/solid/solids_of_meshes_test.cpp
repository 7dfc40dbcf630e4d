// SPDX-License-Identifier: Apache-2.0
//
// Many meshes at once (solids_of_meshes.h), against one after the other.

#include <trisect/bsp/solids_of_meshes.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::Embedding;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::SolidOptions;

PolygonMesh moved(PolygonMesh mesh, double by) {
    for (trisect::Point3d& p : mesh.points) p[0] += by;
    return mesh;
}

// Boxes, whose faces are polygons, and spheres; one is empty, one meets itself.
std::vector<PolygonMesh> some_meshes(std::size_t count) {
    std::vector<PolygonMesh> out;
    for (std::size_t i = 0; i < count; ++i)
        out.push_back(moved(
            i % 2 == 0 ? trisect::make_icosphere(1, 1) : trisect::make_box({0, 0, 0}, {1, 2, 3}),
            0.1 * static_cast<double>(i)));
    out[count / 2] = {};
    PolygonMesh twice = trisect::make_box({0, 0, 0}, {2, 2, 2});
    const PolygonMesh other = trisect::make_box({1, 1, 1}, {3, 3, 3});
    const auto first = static_cast<std::uint32_t>(twice.points.size());
    twice.points.insert(twice.points.end(), other.points.begin(), other.points.end());
    for (std::size_t f = 0; f < other.face_count(); ++f) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t c : other.face(f)) corners.push_back(first + c);
        twice.add_face(corners);
    }
    out[count / 3] = twice;
    return out;
}

SolidOptions options_of(Embedding embedding, std::uint32_t threads) {
    SolidOptions out;
    out.embedding = embedding;
    out.import.threads = threads;
    return out;
}

std::string failure_of(const std::vector<PolygonMesh>& meshes, const SolidOptions& options) {
    try {
        static_cast<void>(trisect::solids_of_meshes(meshes, options));
    } catch (const trisect::Error& e) {
        return e.what();
    }
    return {};
}

TEST(SolidsOfMeshes, AreThoseOfOneAfterTheOther) {
    const std::vector<PolygonMesh> meshes = some_meshes(50);
    for (const Embedding embedding : {Embedding::Resolve, Embedding::Check})
        for (const std::uint32_t threads : {0U, 1U, 2U, 5U}) {
            const SolidOptions options = options_of(embedding, threads);
            const std::vector<Solid> made = trisect::solids_of_meshes(meshes, options);
            ASSERT_EQ(made.size(), meshes.size());
            for (std::size_t i = 0; i < meshes.size(); ++i) {
                const Solid alone = Solid::from_mesh(meshes[i], options);
                EXPECT_EQ(made[i].lattice().exponent, alone.lattice().exponent);
                const PolygonMesh mesh = made[i].to_mesh();
                const PolygonMesh wanted = alone.to_mesh();
                EXPECT_EQ(mesh.points, wanted.points) << i;
                EXPECT_EQ(mesh.corners, wanted.corners) << i;
            }
        }
}

// A mesh that has most faces is imported by all threads, the others beside each other.
TEST(SolidsOfMeshes, OneThatIsLargerThanAThreadsShareIsAsItIsAlone) {
    std::vector<PolygonMesh> meshes = some_meshes(6);
    meshes.insert(meshes.begin() + 2, trisect::make_icosphere(1, 6));
    meshes.push_back(trisect::make_icosphere(3, 6));
    for (const std::uint32_t threads : {1U, 2U, 3U, 8U}) {
        const SolidOptions options = options_of(Embedding::Check, threads);
        const std::vector<Solid> made = trisect::solids_of_meshes(meshes, options);
        ASSERT_EQ(made.size(), meshes.size());
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            const PolygonMesh mesh = made[i].to_mesh();
            const PolygonMesh wanted = Solid::from_mesh(meshes[i], options).to_mesh();
            EXPECT_EQ(mesh.points, wanted.points) << i;
            EXPECT_EQ(mesh.corners, wanted.corners) << i;
        }
    }
}

// Also where a later one is looked at first.
TEST(SolidsOfMeshes, AnEarlierFailureComesBeforeThatOfALargeMesh) {
    PolygonMesh open = trisect::make_icosphere(1, 1);
    open.corners.resize(open.corners.size() - 3);
    open.face_begin.pop_back();
    PolygonMesh wrong = trisect::make_icosphere(1, 6);
    wrong.corners[0] = 500000;
    const SolidOptions options = options_of(Embedding::Assume, 2);
    EXPECT_EQ(failure_of({open, wrong}, options), failure_of({open}, options));
    EXPECT_EQ(failure_of({wrong, open}, options), failure_of({wrong}, options));
}

TEST(SolidsOfMeshes, AreNumberedInOrder) {
    std::vector<PolygonMesh> meshes;
    for (int i = 0; i < 5000; ++i)
        meshes.push_back(moved(trisect::make_box({0, 0, 0}, {1, 1, 1}), i));
    const std::vector<Solid> made = trisect::solids_of_meshes(meshes);
    ASSERT_EQ(made.size(), meshes.size());
    for (std::size_t i = 1; i < made.size(); ++i)
        EXPECT_EQ(made[i].source_id(), made[0].source_id() + i);
}

TEST(SolidsOfMeshes, OfNoneAndOfOne) {
    EXPECT_TRUE(trisect::solids_of_meshes({}).empty());
    const std::vector<PolygonMesh> one{trisect::make_icosphere(1, 2)};
    const std::vector<Solid> made = trisect::solids_of_meshes(one);
    ASSERT_EQ(made.size(), 1U);
    EXPECT_EQ(made[0].to_mesh().corners, one[0].corners);
}

TEST(SolidsOfMeshes, TheFirstFailureIsThrown) {
    std::vector<PolygonMesh> meshes = some_meshes(40);
    PolygonMesh open = trisect::make_icosphere(1, 1);
    open.corners.resize(open.corners.size() - 3);
    open.face_begin.pop_back();
    PolygonMesh wrong = trisect::make_icosphere(1, 1);
    wrong.corners[0] = 5000;
    meshes[31] = open;
    meshes[33] = wrong;
    for (const std::uint32_t threads : {1U, 4U}) {
        const SolidOptions options = options_of(Embedding::Assume, threads);
        const std::string failure = failure_of(meshes, options);
        EXPECT_FALSE(failure.empty());
        EXPECT_EQ(failure, failure_of({open}, options));
    }
}

}  // namespace
