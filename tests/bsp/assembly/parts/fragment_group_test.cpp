// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/fragment_group.h>

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::Approximation;
using trisect::detail::Box;
using trisect::detail::EdgeName;
using trisect::detail::Fragment;
using trisect::detail::FragmentGroup;
using trisect::detail::PlaneName;
using trisect::detail::PolygonList;
using trisect::detail::PolygonRef;
using trisect::detail::Source;

// A facet in the plane z = 0; all lines are walls, whose positions are coordinates here.
class FragmentGroups : public testing::Test {
protected:
    FragmentGroups()
        : source_(Source::half_space(trisect::Plane::axis_aligned(2, 1, 0), trisect::Lattice{0})) {}

    PolygonRef rectangle(int x0, int y0, int x1, int y1) const {
        const std::vector<EdgeName> edges{{PlaneName::splitter(1, y0), true},
                                          {PlaneName::splitter(0, x1), false},
                                          {PlaneName::splitter(1, y1), false},
                                          {PlaneName::splitter(0, x0), true}};
        const auto at = [](int x, int y) {
            return Approximation{{static_cast<double>(x), static_cast<double>(y), 0.0}, 0x1p-40};
        };
        const std::vector<Approximation> vertices{at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)};
        Box box;
        return {source_.get(), Fragment::make(edges, vertices, box), 0, false, false};
    }

    /// Length of all edges on a line, those with the part above less the others.
    static double length_on(const FragmentGroup& group, const PlaneName& line) {
        double sum = 0;
        for (const FragmentGroup::Edge& e : group.edges()) {
            if (group.lines()[e.line] != line) continue;
            const auto& a = group.approximation(e.from).c;
            const auto& b = group.approximation(e.to).c;
            sum += (b[0] - a[0]) + (b[1] - a[1]);
        }
        return sum;
    }

    std::shared_ptr<const Source> source_;
};

TEST_F(FragmentGroups, OneFragmentIsItsOwnBoundary) {
    const std::vector<PolygonRef> refs{rectangle(0, 0, 2, 1)};
    const PolygonList keep(refs);
    FragmentGroup group;
    ASSERT_TRUE(group.join(refs));
    EXPECT_EQ(group.edges().size(), 4U);
}

TEST_F(FragmentGroups, ACommonEdgeCancels) {
    const std::vector<PolygonRef> refs{rectangle(0, 0, 2, 1), rectangle(0, 1, 2, 2)};
    const PolygonList keep(refs);
    FragmentGroup group;
    ASSERT_TRUE(group.join(refs));
    EXPECT_EQ(group.edges().size(), 6U);
    EXPECT_EQ(length_on(group, PlaneName::splitter(1, 1)), 0);
}

TEST_F(FragmentGroups, AnEdgeCancelsAPartOfALongerOne) {
    const std::vector<PolygonRef> refs{rectangle(0, 0, 2, 1), rectangle(0, 1, 1, 2)};
    const PolygonList keep(refs);
    FragmentGroup group;
    ASSERT_TRUE(group.join(refs));
    EXPECT_EQ(group.edges().size(), 7U);
    EXPECT_EQ(length_on(group, PlaneName::splitter(1, 1)), -1);
}

TEST_F(FragmentGroups, TwoShortEdgesCancelPartsOfALongOne) {
    const std::vector<PolygonRef> refs{rectangle(0, 0, 5, 1), rectangle(0, 1, 1, 2),
                                       rectangle(3, 1, 5, 2)};
    const PolygonList keep(refs);
    FragmentGroup group;
    ASSERT_TRUE(group.join(refs));
    EXPECT_EQ(length_on(group, PlaneName::splitter(1, 1)), -2);
    for (const FragmentGroup::Edge& e : group.edges()) {
        const FragmentGroup::Edge& next = group.edges()[group.first_edge(e.to)];
        EXPECT_EQ(next.from, e.to);
    }
}

}  // namespace
