// SPDX-License-Identifier: Apache-2.0
//
// Parts that are set aside and put back (settled_parts.h): all facets stay as they are.

#include <trisect/bsp/many_meshes/outlines/settled_parts.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/many_meshes/outlines/boundary_sides.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>

namespace {

using trisect::detail::BoundarySides;
using trisect::detail::Box;
using trisect::detail::ClearBox;
using trisect::detail::name_of;
using trisect::detail::OutlinedSolid;
using trisect::detail::OutlineSide;
using trisect::detail::OutlineStore;
using trisect::detail::OutlineVertex;

using Position = trisect::detail::Vector3;
using Facets = std::map<std::uint32_t, std::vector<Position>>;  // by number: where its edges begin

void add_facets(const OutlinedSolid& solid, Facets& to) {
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        std::vector<Position>& at = to[solid.facets[f].number];
        ASSERT_TRUE(at.empty());
        for (const OutlinedSolid::Edge& e : solid.edges_of(solid.facets[f])) {
            at.push_back(solid.vertices[e.from].at.c);
            EXPECT_TRUE(solid.boxes[f].contains([&] {
                auto box = trisect::detail::OutlineBox::none();
                box.add(solid.vertices[e.to].at);
                return box;
            }()));
        }
    }
}

using Name = std::pair<std::uint64_t, std::uint64_t>;

std::set<Name> names_of(const OutlinedSolid& solid) {
    std::set<Name> out;
    for (const OutlinedSolid::Facet& f : solid.facets)
        for (const OutlinedSolid::Edge& e : solid.edges_of(f)) {
            const auto name = name_of(solid.vertices[e.from]);
            out.emplace(name.a, name.b);
        }
    return out;
}

class SettledParts : public testing::Test {
protected:
    SettledParts()
        : source_(trisect::detail::Source::make(
              trisect::import_mesh(trisect::make_icosphere(1, 4)).mesh)) {
        operands_.operands.emplace_back();
        meshes_.operands = &operands_;
        meshes_.sources.push_back(source_.get());
        meshes_.slots.assign(source_->facet_count(), 0);
        solid_ = store_.add_operand(meshes_, 0, true);
        add_facets(store_.view(solid_), facets_);
        names_ = names_of(store_.view(solid_));
        boxes_ = {source_->box(), source_->box()};
    }
    // What is below another operand that begins so far along an axis.
    [[nodiscard]] ClearBox below(std::size_t axis, double part) {
        Box& other = boxes_[1];
        other = boxes_[0];
        const auto length = static_cast<double>(other.hi[axis] - other.lo[axis]);
        other.lo[axis] += static_cast<std::int64_t>(part * length);
        other.hi[axis] = 2 * boxes_[0].hi[axis] - boxes_[0].lo[axis];
        const std::vector<std::uint32_t> those{1};
        const std::vector<std::uint32_t> own{0};
        return ClearBox().without(boxes_, those, own);
    }
    void expect_all_facets() {
        Facets now;
        const OutlinedSolid all = store_.view(solid_);
        add_facets(all, now);
        for (const auto& part : all.settled) add_facets(part->view(), now);
        EXPECT_EQ(now, facets_);
    }

    std::shared_ptr<const trisect::detail::Source> source_;
    trisect::detail::Crossings operands_;
    trisect::detail::ManyMeshes meshes_;
    OutlineStore store_;
    OutlineStore::Solid solid_;
    std::vector<Box> boxes_;
    Facets facets_;
    std::set<Name> names_;
};

TEST_F(SettledParts, AreWhatIsClear) {
    const ClearBox clear = below(0, 0.6);
    settle(store_, solid_, clear);
    const OutlinedSolid all = store_.view(solid_);
    ASSERT_EQ(all.settled.size(), 1U);
    for (const auto& box : all.settled[0]->boxes) EXPECT_TRUE(clear.has(box));
    for (const auto& box : all.boxes) EXPECT_FALSE(clear.has(box));
    EXPECT_GT(all.settled[0]->facets.size(), facets_.size() / 2);
    expect_all_facets();
}

TEST_F(SettledParts, HaveSharedVerticesWhereTheyMeetOthers) {
    settle(store_, solid_, below(1, 0.5));
    settle(store_, solid_, below(2, 0.5));
    const OutlinedSolid all = store_.view(solid_);
    ASSERT_EQ(all.settled.size(), 2U);
    std::map<Name, int> parts_with;
    std::map<Name, int> flagged;
    const auto look = [&](const OutlinedSolid& part) {
        std::set<Name> shared;
        for (const OutlineVertex& v : part.vertices)
            if (v.is_shared) {
                const auto name = name_of(v);
                shared.emplace(name.a, name.b);
            }
        for (const Name& name : names_of(part)) {
            ++parts_with[name];
            if (shared.contains(name)) ++flagged[name];
        }
    };
    look(all);
    for (const auto& part : all.settled) look(part->view());
    for (const auto& [name, count] : parts_with) {
        if (count > 1) {
            EXPECT_EQ(flagged[name], count);
        }
    }
    EXPECT_EQ(parts_with.size(), names_.size());
    expect_all_facets();
}

TEST_F(SettledParts, AreFewForNothing) {
    settle(store_, solid_, below(0, 0.05));
    EXPECT_TRUE(store_.view(solid_).settled.empty());
    expect_all_facets();
}

TEST_F(SettledParts, ArePutBackWithEachVertexOnce) {
    settle(store_, solid_, below(0, 0.7));
    settle(store_, solid_, below(1, 0.5));
    join_settled(store_, solid_);
    const OutlinedSolid all = store_.view(solid_);
    EXPECT_TRUE(all.settled.empty());
    EXPECT_TRUE(all.open_far_out);
    EXPECT_EQ(all.vertices.size(), source_->mesh().points.size());
    EXPECT_EQ(names_of(all), names_);
    expect_all_facets();
}

TEST_F(SettledParts, GoToAnotherStoreAndBack) {
    settle(store_, solid_, below(0, 0.7));
    const OutlineStore::Solid before = solid_;
    OutlineStore other;
    solid_ = other.put(store_.take_out(solid_), solid_);
    EXPECT_EQ(store_.facets().size(), before.facets);
    std::swap(store_, other);
    EXPECT_EQ(store_.view(solid_).settled.size(), 1U);
    expect_all_facets();
    join_settled(store_, solid_);
    EXPECT_EQ(names_of(store_.view(solid_)), names_);
    expect_all_facets();
}

// By a boundary that is beside some of them: a part of the same sphere, and all else is open.
TEST_F(SettledParts, LieOnSidesOfABoundary) {
    OutlineStore others;
    OutlineStore::Solid boundary = others.add_operand(meshes_, 0, true);
    settle(others, boundary, below(0, 0.8));
    const BoundarySides sides(others.view(boundary));
    settle_rest(store_, solid_, {&sides, &meshes_});
    const OutlinedSolid all = store_.view(solid_);
    EXPECT_TRUE(all.facets.empty());
    ASSERT_EQ(all.settled.size(), 1U);
    const auto& part = *all.settled[0];
    EXPECT_TRUE(part.kept.empty());  // those are whole
    EXPECT_EQ(part.far, 0U);
    EXPECT_GT(part.kept_whole.size(), facets_.size() / 2);
    EXPECT_EQ(part.kept_whole.size() + part.facets.size(), facets_.size());
    for (const auto& box : part.boxes) EXPECT_EQ(sides.side_of(box), OutlineSide::Unknown);
    for (const OutlineVertex& v : part.vertices) EXPECT_FALSE(v.is_shared);  // with no outline
    std::set<std::uint32_t> numbers;
    for (const auto& w : part.kept_whole) numbers.insert(w.number);
    for (const auto& f : part.facets) numbers.insert(f.number);
    EXPECT_EQ(numbers.size(), facets_.size());
}

TEST_F(SettledParts, GoWhereABoundaryDoesNotLeaveThemOpen) {
    OutlineStore others;
    OutlineStore::Solid boundary = others.add_operand(meshes_, 0, false);
    settle(others, boundary, below(0, 0.8));
    const BoundarySides sides(others.view(boundary));
    settle_rest(store_, solid_, {&sides, nullptr});
    const auto& part = *store_.view(solid_).settled[0];
    EXPECT_EQ(part.far, 0U);  // what is far out is closed
    EXPECT_GT(part.facets.size(), 0U);
    EXPECT_LT(part.facets.size(), facets_.size() / 2);
    for (const auto& box : part.boxes) EXPECT_EQ(sides.side_of(box), OutlineSide::Unknown);
}

TEST_F(SettledParts, HaveOutlinesWhereTheyAreJoinedAgain) {
    OutlineStore others;
    OutlineStore::Solid boundary = others.add_operand(meshes_, 0, true);
    settle(others, boundary, below(0, 0.8));
    const BoundarySides sides(others.view(boundary));
    settle_rest(store_, solid_, {&sides, nullptr});
    const auto& part = *store_.view(solid_).settled[0];
    EXPECT_GT(part.far, facets_.size() / 2);
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        EXPECT_EQ(sides.side_of(part.boxes[f]),
                  f < part.far ? OutlineSide::Open : OutlineSide::Unknown);
    expect_all_facets();
}

}  // namespace
