// SPDX-License-Identifier: Apache-2.0
//
// Faces keep their names: every face of a result tells the operand and the face of it that it is
// part of.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/kernel/predicates.h>

#include "figures.h"

namespace provenance_test {
namespace {

using trisect::Brep;
using trisect::evaluate;
using trisect::FaceId;
using trisect::LatticePoint;
using trisect::PolygonMesh;
using trisect::Solid;

struct Operand {
    PolygonMesh mesh;
    Solid solid;

    explicit Operand(PolygonMesh m) : mesh(std::move(m)), solid(Solid::from_mesh(mesh)) {}
};

LatticePoint corner(const PolygonMesh& mesh, std::uint32_t i) {
    const auto& p = mesh.points[i];
    return {static_cast<std::int64_t>(p[0]), static_cast<std::int64_t>(p[1]),
            static_cast<std::int64_t>(p[2])};
}

// Faces by operand, after checking that each lies in the plane of the face that it names.
std::map<std::uint32_t, std::multiset<std::uint32_t>> named_faces(
    const Brep& brep, const std::vector<const Operand*>& operands) {
    std::map<std::uint32_t, std::multiset<std::uint32_t>> out;
    for (const FaceId f : brep.faces()) {
        const trisect::FaceSource source = brep.source(f);
        const auto at = std::find_if(operands.begin(), operands.end(), [&](const Operand* o) {
            return o->solid.source_id() == source.operand;
        });
        if (at == operands.end()) {
            ADD_FAILURE() << "a face names no operand";
            continue;
        }
        const PolygonMesh& mesh = (*at)->mesh;
        EXPECT_LT(source.face, mesh.face_count());
        for (const std::uint32_t c : mesh.face(source.face))
            EXPECT_EQ(trisect::side_of(trisect::Point(corner(mesh, c)), brep.plane(f)),
                      trisect::Side::On);
        out[source.operand].insert(source.face);
    }
    return out;
}

const Operand& block() {
    static const Operand o(trisect::make_box({4, 4, 4}));
    return o;
}

TEST(Provenance, OfAPocket) {
    const Operand tool(trisect::make_box({2, 1, 1}, {6, 3, 3}));
    const Brep brep = evaluate(block().solid - tool.solid).to_brep();
    const auto names = named_faces(brep, {&block(), &tool});
    EXPECT_EQ(names.at(block().solid.source_id()),
              (std::multiset<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    // All faces of the tool but the one outside of the block.
    EXPECT_EQ(names.at(tool.solid.source_id()).size(), 5U);
    EXPECT_EQ(std::set<std::uint32_t>(names.at(tool.solid.source_id()).begin(),
                                      names.at(tool.solid.source_id()).end())
                  .size(),
              5U);
}

TEST(Provenance, OfAFaceInSeveralPieces) {
    // A slot through the block leaves two pieces of two of its faces.
    const Operand tool(trisect::make_box({1, -1, -1}, {3, 5, 2}));
    const auto names =
        named_faces(evaluate(block().solid - tool.solid).to_brep(), {&block(), &tool});
    EXPECT_EQ(names.at(block().solid.source_id()).size(), 7U);
    EXPECT_EQ(names.at(tool.solid.source_id()).size(), 3U);
}

TEST(Provenance, OfFacesThatJoinIsThatOfOneOfThem) {
    const Operand neighbour(trisect::make_box({4, 0, 0}, {8, 4, 4}));
    const Brep brep = evaluate(block().solid | neighbour.solid).to_brep();
    EXPECT_EQ(brep.counts().faces, 6U);
    (void)named_faces(brep, {&block(), &neighbour});
}

TEST(Provenance, StaysAlongAChain) {
    std::vector<Operand> tools;
    for (const double x : {0.0, 2.0})
        for (const double y : {0.0, 2.0})
            tools.emplace_back(trisect::make_box({x, y, 3}, {x + 1, y + 1, 9}));
    Solid part = block().solid;
    std::vector<const Operand*> operands{&block()};
    trisect::EvaluateOptions options;
    options.leaf_polygons = 4;
    for (const Operand& t : tools) {
        part = evaluate(part - t.solid, options);
        operands.push_back(&t);
    }
    const auto names = named_faces(part.to_brep(), operands);
    EXPECT_EQ(names.size(), 5U);
    for (const Operand& t : tools) EXPECT_GE(names.at(t.solid.source_id()).size(), 3U);
}

TEST(Provenance, OfACopyIsThatOfTheOriginal) {
    const Solid copy = block().solid;
    const Brep brep = evaluate(copy & Solid::whole_space()).to_brep();
    EXPECT_EQ(named_faces(brep, {&block()}).size(), 1U);
}

TEST(Provenance, DoesNotDependOnTheTree) {
    const Operand tool(trisect::make_box({2, 2, 2}, {6, 6, 6}));
    const auto names = [&](std::uint32_t leaf) {
        trisect::EvaluateOptions options;
        options.leaf_polygons = leaf;
        return named_faces(evaluate(block().solid ^ tool.solid, options).to_brep(),
                           {&block(), &tool});
    };
    EXPECT_EQ(names(2), names(1000));
}

}  // namespace
}  // namespace provenance_test
