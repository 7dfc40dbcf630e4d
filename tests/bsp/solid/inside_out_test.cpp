// SPDX-License-Identifier: Apache-2.0
//
// Boundaries that are inside out: refused with a hint, or accepted and evaluated with the non-zero
// rule.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::Embedding;
using trisect::InsideOut;
using trisect::Solid;
using trisect::SolidOptions;

trisect::PolygonMesh inside_out_box() {
    trisect::PolygonMesh mesh = trisect::make_box({2, 2, 2});
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin[f],
                     mesh.corners.begin() + mesh.face_begin[f + 1]);
    return mesh;
}

std::string refusal(const SolidOptions& options) {
    try {
        (void)Solid::from_mesh(inside_out_box(), options);
    } catch (const trisect::Error& e) {
        EXPECT_EQ(e.code(), trisect::ErrorCode::InvalidSolid);
        return e.what();
    }
    return {};
}

TEST(InsideOut, IsRefusedHoweverTheEmbeddingIsTreated) {
    for (const Embedding e : {Embedding::Assume, Embedding::Resolve, Embedding::Check})
        EXPECT_NE(refusal({.embedding = e}), "");
    EXPECT_NE(refusal({.embedding = Embedding::Check}).find("nonzero"), std::string::npos);
    // It is no promise to keep that winding numbers are 0 and 1.
    EXPECT_NE(refusal({.embedding = Embedding::Assume, .inside_out = InsideOut::Accept}), "");
    trisect::ImportedMesh imported = trisect::import_mesh(inside_out_box());
    EXPECT_THROW((void)Solid::from_import(std::move(imported), Embedding::Resolve), trisect::Error);
}

TEST(InsideOut, IsAcceptedForTheNonZeroRule) {
    const Solid s = Solid::from_mesh(
        inside_out_box(), {.embedding = Embedding::Check, .inside_out = InsideOut::Accept});
    trisect::EvaluateOptions options;
    EXPECT_TRUE(trisect::evaluate(s, options).is_empty());
    options.winding = trisect::EvaluateOptions::Winding::NonZero;
    EXPECT_EQ(trisect::volume(trisect::evaluate(s, options)), 8);
}

TEST(InsideOut, OfABrep) {
    const Solid box = Solid::from_mesh(trisect::make_box({2, 2, 2}));
    const trisect::Brep outside = trisect::evaluate(~box).to_brep();
    EXPECT_THROW((void)Solid::from_brep(outside), trisect::Error);
    EXPECT_THROW((void)Solid::from_brep(outside, Embedding::Check), trisect::Error);
    const Solid s = Solid::from_brep(outside, Embedding::Check, InsideOut::Accept);
    trisect::EvaluateOptions options;
    options.winding = trisect::EvaluateOptions::Winding::NonZero;
    EXPECT_EQ(trisect::volume(trisect::evaluate(s, options)), 8);
}

}  // namespace
