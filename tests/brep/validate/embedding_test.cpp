// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/embedding.h>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/sphere.h>

#include "support/mesh_builders.h"

namespace {

using trisect::is_embedded;
using trisect::PolygonMesh;
using trisect::test::cuboid;
using trisect::test::flipped;
using trisect::test::together;

bool embedded(const PolygonMesh& mesh) { return is_embedded(trisect::import_mesh(mesh).mesh); }

TEST(Embedding, SolidsAndTheirCavities) {
    EXPECT_TRUE(embedded(cuboid()));
    EXPECT_TRUE(embedded(trisect::make_icosphere(1, 4)));
    EXPECT_TRUE(embedded(together(cuboid(), cuboid({2, 2, 2}, {3, 3, 3}))));
    EXPECT_TRUE(
        embedded(together(cuboid({0, 0, 0}, {3, 3, 3}), flipped(cuboid({1, 1, 1}, {2, 2, 2})))));
}

TEST(Embedding, WhatMeetsItself) {
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({0.5, 0.5, 0.5}, {2, 2, 2})))) << "crosses";
    EXPECT_FALSE(embedded(together(cuboid(), cuboid()))) << "coincides";
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 0, 0}, {2, 1, 1})))) << "flush";
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 0.25, 0.25}, {2, 0.5, 0.5}))))
        << "on a face";
}

// Winding numbers of 2 and of -1.
TEST(Embedding, ShellsThatAreNested) {
    EXPECT_FALSE(embedded(together(cuboid({0, 0, 0}, {3, 3, 3}), cuboid({1, 1, 1}, {2, 2, 2}))));
    EXPECT_FALSE(embedded(flipped(cuboid())));
}

// A solid may touch itself, but who asks has to look.
TEST(Embedding, TouchingInAnEdgeOrACorner) {
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 1, 0}, {2, 2, 1}))));
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 1, 1}, {2, 2, 2}))));
    EXPECT_FALSE(embedded(together(cuboid(), cuboid({1, 1, 0.5}, {2, 2, 2}))));
}

}  // namespace
