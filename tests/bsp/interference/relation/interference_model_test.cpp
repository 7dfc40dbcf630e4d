// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/solids.h"

namespace interference_model_test {
namespace {

using solids::box;
using trisect::BrepIndex;
using trisect::EdgeId;
using trisect::Expression;
using trisect::FaceId;
using trisect::InterferenceModel;
using trisect::Point;
using trisect::ShellId;
using trisect::Solid;
using trisect::VertexId;
using trisect::detail::InterferenceModelData;
using trisect::detail::ModelTriangle;

VertexId place(const InterferenceModelData& d, VertexId v) { return d.place[v.index]; }

// Diagonals are shared by two triangles of one face, edges by two triangles in all; sides of edges
// join the edge's ends; every halfedge of the B-rep is a side once.
void expect_sides_match(const InterferenceModelData& d) {
    std::map<std::array<std::uint32_t, 3>, int> diagonals;  // face, from, to: once each way
    std::vector<int> uses(d.brep.counts().edges, 0);
    for (const ModelTriangle& t : d.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexId u = place(d, t.vertex[i]);
            const VertexId v = place(d, t.vertex[(i + 1) % 3]);
            if (!t.edge[i].is_valid()) {
                ++diagonals[{t.face.index, u.index, v.index}];
                continue;
            }
            ++uses[t.edge[i].index];
            const auto h = d.brep.halfedge(t.edge[i]);
            const auto a = place(d, d.brep.origin(h));
            const auto b = place(d, d.brep.target(h));
            EXPECT_TRUE((a == u && b == v && d.brep.face(h) == t.face) ||
                        (a == v && b == u && d.brep.face(d.brep.twin(h)) == t.face));
        }
    for (const int n : uses) EXPECT_EQ(n, 2);
    for (const auto& [side, n] : diagonals) {
        EXPECT_EQ(n, 1);
        EXPECT_EQ(diagonals.count({side[0], side[2], side[1]}), 1U);
    }
}

// Of each face: as many triangles as its Euler characteristic says, all turning with its normal.
void expect_triangles_fill_faces(const InterferenceModelData& d) {
    ASSERT_EQ(d.first_triangle.size(), d.brep.faces().size() + 1);
    for (const FaceId f : d.brep.faces()) {
        const auto triangles = d.triangles_of(f);
        EXPECT_EQ(triangles.size() + 2,
                  d.brep.halfedges(f).size() + 2 * d.brep.inner_loops(f).size());
        for (const ModelTriangle& t : triangles) EXPECT_EQ(t.face, f);
    }
}

void expect_sound(const InterferenceModelData& d) {
    expect_sides_match(d);
    expect_triangles_fill_faces(d);
    ASSERT_EQ(d.positions.size(), d.brep.vertices().size());
    for (const VertexId v : d.brep.vertices()) {
        const Point& p = d.brep.point(v);
        EXPECT_TRUE(d.brep.point(place(d, v)) == p);
        EXPECT_LE(place(d, v), v);
        const auto& a = p.approximation();
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_LE(std::abs(a.c[k] - d.position(v)[k]), a.error + d.position_error);
            EXPECT_LE(d.lo[k], d.position(v)[k]);
            EXPECT_GE(d.hi[k], d.position(v)[k]);
        }
    }
    ASSERT_EQ(d.shell_vertex.size(), d.brep.shells().size());
    for (const ShellId s : d.brep.shells())
        EXPECT_EQ(d.brep.shell(d.brep.face(d.brep.outgoing(d.shell_vertex[s.index]))), s);
}

TEST(InterferenceModel, MovedFromIsThatOfTheEmptySolid) {
    static_assert(std::is_nothrow_move_constructible_v<InterferenceModel>);
    InterferenceModel m(box(0, 0, 0, 1, 1, 1));
    const InterferenceModel taken = std::move(m);
    EXPECT_TRUE(m.is_empty());  // NOLINT(bugprone-use-after-move): that is the test
    EXPECT_EQ(m.triangle_count(), 0U);
    EXPECT_TRUE(m.solid().is_empty());
    EXPECT_EQ(taken.triangle_count(), 12U);
}

TEST(InterferenceModel, BoxHasTwoTrianglesAFaceAndOneDiagonal) {
    const InterferenceModel m(box(0, 0, 0, 1, 2, 3));
    EXPECT_EQ(m.triangle_count(), 12U);
    EXPECT_EQ(m.stats().faces, 6U);
    EXPECT_TRUE(trisect::detail::data_of(m).all_lattice);
    EXPECT_EQ(trisect::detail::data_of(m).position_error, 0);
    int diagonals = 0;
    for (const auto& t : trisect::detail::data_of(m).triangles)
        for (const EdgeId e : t.edge) diagonals += e.is_valid() ? 0 : 1;
    EXPECT_EQ(diagonals, 12);
    expect_sound(trisect::detail::data_of(m));
}

TEST(InterferenceModel, EmptySolidAndDefaultModelAreEmpty) {
    for (const InterferenceModel& m : {InterferenceModel(), InterferenceModel(Solid())}) {
        EXPECT_TRUE(m.is_empty());
        EXPECT_EQ(m.triangle_count(), 0U);
        EXPECT_EQ(m.index().stats().polygons, 0U);
        expect_sound(trisect::detail::data_of(m));
    }
}

TEST(InterferenceModel, UnboundedSolidsAreRefused) {
    EXPECT_THROW(InterferenceModel{Solid::whole_space()}, trisect::UnsupportedError);
    EXPECT_THROW(InterferenceModel{evaluate(~Expression(box(0, 0, 0, 1, 1, 1)))},
                 trisect::UnsupportedError);
    const auto below = trisect::Plane::axis_aligned(2, 1, 0);
    EXPECT_THROW(InterferenceModel{Solid::half_space(below, {})}, trisect::UnsupportedError);
}

TEST(InterferenceModel, BlockWithHoleBoredThroughIt) {
    const InterferenceModel m(evaluate(Expression(box(0, 0, 0, 4, 4, 4)) - box(1, 1, -1, 3, 3, 5)));
    EXPECT_EQ(m.stats().faces, 10U);
    EXPECT_EQ(m.triangle_count(), 8U * 2 + 2 * 8);
    expect_sound(trisect::detail::data_of(m));
}

TEST(InterferenceModel, BoxesThatShareAnEdgeHaveCopiesOfItWithOnePlace) {
    const InterferenceModel m(evaluate(Expression(box(0, 0, 0, 1, 1, 1)) | box(1, 1, 0, 2, 2, 1)));
    EXPECT_EQ(m.stats().shells, 2U);
    EXPECT_EQ(m.brep().edge_contact_count(), 1U);
    std::size_t shared = 0;
    for (const VertexId v : m.brep().vertices())
        shared += place(trisect::detail::data_of(m), v) == v ? 0 : 1;
    EXPECT_EQ(shared, 2U);
    expect_sound(trisect::detail::data_of(m));
}

TEST(InterferenceModel, FaceWhoseHoleTouchesItsOutline) {
    // Two holes that touch each other and the side of the block in single lines.
    const InterferenceModel m(evaluate(
        (Expression(box(0, 0, 0, 6, 6, 2)) - box(1, 1, -1, 3, 3, 3)) - box(3, 3, -1, 6, 5, 3)));
    expect_sound(trisect::detail::data_of(m));
}

TEST(InterferenceModel, HollowBoxHasTwoShells) {
    const InterferenceModel m(evaluate(Expression(box(0, 0, 0, 4, 4, 4)) - box(1, 1, 1, 3, 3, 3)));
    EXPECT_EQ(m.stats().shells, 2U);
    EXPECT_EQ(m.triangle_count(), 24U);
    expect_sound(trisect::detail::data_of(m));
}

TEST(InterferenceModel, CutPointsOffTheLatticeHaveACertifiedPosition) {
    const InterferenceModel m(
        evaluate(Expression(Solid::from_mesh(trisect::make_torus(1, 0.25, 12, 8))) -
                 Solid::from_mesh(trisect::make_torus(1.125, 0.25, 10, 9))));
    EXPECT_FALSE(trisect::detail::data_of(m).all_lattice);
    EXPECT_GT(trisect::detail::data_of(m).position_error, 0);
    expect_sound(trisect::detail::data_of(m));
    for (const VertexId v : m.brep().vertices()) {
        const auto h = m.brep().point(v).homogeneous();
        const trisect::ExactRational w(h.w);
        const auto error =
            trisect::ExactRational::from_double(trisect::detail::data_of(m).position_error);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto off =
                trisect::ExactRational(h.xyz[k]) / w -
                trisect::ExactRational::from_double(trisect::detail::data_of(m).position(v)[k]);
            EXPECT_LE(off, error);
            EXPECT_LE(-off, error);
        }
    }
}

TEST(InterferenceModel, IndexIsKeptOrMadeOnceByManyThreads) {
    const Solid solid = box(0, 0, 0, 1, 1, 1);
    const InterferenceModel kept(BrepIndex(solid).with_brep());
    EXPECT_TRUE(kept.index().has_brep());
    const InterferenceModel lazy(solid);
    std::vector<const BrepIndex*> seen(8, nullptr);
    std::vector<std::thread> threads;
    for (auto& s : seen) threads.emplace_back([&s, &lazy] { s = &lazy.index(); });
    for (auto& t : threads) t.join();
    for (const auto* s : seen) EXPECT_EQ(s, &lazy.index());
    EXPECT_EQ(lazy.index().locate(std::array<double, 3>{0.5, 0.5, 0.5}).location,
              trisect::Location::Inside);
}

TEST(InterferenceModel, VolumesBelowTheLeastDoubleAreBounded) {
    // Such a solid was refused as unbounded, and its boundary as inside out.
    const trisect::PolygonMesh mesh =
        trisect::make_box({0, 0, 0}, {0x1p-1000, 0x1p-1000, 0x1p-1000});
    const Solid solid = Solid::from_mesh(mesh);
    const InterferenceModel model(solid);
    EXPECT_EQ(interfere(model, {}, model, {}).relation, trisect::Relation::Equal);
    EXPECT_FALSE(Solid::from_brep(solid.to_brep()).is_empty());
}

TEST(InterferenceModel, RandomSolidsThatTouchThemselves) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed);
        const InterferenceModel m(
            evaluate(Expression(engines::solid(reference::random_operand(random))) |
                     engines::solid(reference::random_operand(random))));
        SCOPED_TRACE(seed);
        expect_sound(trisect::detail::data_of(m));
    }
}

}  // namespace
}  // namespace interference_model_test
