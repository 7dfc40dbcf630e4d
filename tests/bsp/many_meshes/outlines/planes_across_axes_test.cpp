// SPDX-License-Identifier: Apache-2.0
//
// Planes of facets across axes (planes_across_axes.h), of many meshes against one after the other.

#include <trisect/bsp/many_meshes/outlines/planes_across_axes.h>

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>

namespace {

using trisect::LatticeMesh;
using trisect::detail::PlanesAcrossAxes;

LatticeMesh lattice_mesh(const trisect::PolygonMesh& mesh) {
    trisect::ImportOptions options;
    options.lattice = trisect::Lattice{-20};
    return trisect::import_mesh(mesh, options).mesh;
}

std::vector<LatticeMesh> meshes_of(std::size_t boxes, std::size_t spheres) {
    std::vector<LatticeMesh> out;
    for (std::size_t i = 0; i < spheres; ++i)
        out.push_back(lattice_mesh(trisect::make_icosphere(1 + 0.01 * static_cast<double>(i), 2)));
    for (std::size_t i = 0; i < boxes; ++i) {
        const auto x = static_cast<double>(i % 10);
        out.push_back(lattice_mesh(trisect::make_box({x, 0, 0}, {x + 1, 2, 3})));
    }
    return out;
}

void expect_same(const std::vector<LatticeMesh>& meshes, std::uint32_t threads) {
    std::vector<const LatticeMesh*> all;
    PlanesAcrossAxes wanted;
    std::uint32_t count = 0;
    for (const LatticeMesh& m : meshes) {
        all.push_back(&m);
        wanted.add(m);
        count += static_cast<std::uint32_t>(m.triangles.size());
    }
    PlanesAcrossAxes made;
    made.add_all(all, threads);
    for (std::uint32_t f = 0; f < count; ++f) {
        EXPECT_EQ(made.of(f).way, wanted.of(f).way);
        EXPECT_EQ(made.of(f).axis, wanted.of(f).axis);
        EXPECT_EQ(made.of(f).first, wanted.of(f).first);
        EXPECT_EQ(made.are_same(f, count / 2), wanted.are_same(f, count / 2));
    }
}

TEST(PlanesAcrossAxes, OfManyAreThoseOfOneAfterTheOther) {
    for (const std::uint32_t threads : {1U, 3U}) {
        expect_same(meshes_of(300, 20), threads);
        expect_same(meshes_of(0, 150), threads);
        expect_same(meshes_of(1, 0), threads);
    }
}

}  // namespace
