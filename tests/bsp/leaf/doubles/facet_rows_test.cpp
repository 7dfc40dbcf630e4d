// SPDX-License-Identifier: Apache-2.0
//
// What rows of facets in single precision part is apart, by exact orientations of the corners; and
// how two triangles lie to each other by doubles (triangle_relation.h).

#include <trisect/bsp/leaf/doubles/facet_rows.h>
#include <trisect/bsp/leaf/doubles/triangle_relation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace trisect::detail;

using Triangle = std::array<Vector3, 3>;

int sign(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    return exact_orientation(a, b, c, d).value();
}

// Whether all points are strictly on one side of a triangle's plane.
template <class Points>
bool is_beside(const Triangle& t, const Points& points) {
    int sum = 0;
    for (const Vector3& p : points) sum += sign(t[0], t[1], t[2], p);
    return static_cast<std::size_t>(sum < 0 ? -sum : sum) == points.size();
}

bool is_line_beside(const Triangle& t, const std::array<Vector3, 2>& line) {
    bool left = false;
    bool right = false;
    for (std::size_t c = 0; c < 3; ++c) {
        const int s = sign(line[0], line[1], t[c], t[(c + 1) % 3]);
        left = left || s > 0;
        right = right || s < 0;
    }
    return left && right;
}

// Where an edge of one of two triangles goes through the other.
struct Piercing {
    bool of_second;
    bool up;
    std::int8_t edge;
};
enum class Contact : std::uint8_t { Apart, Crossing, Special };

// Edges of `t` through `o`. False where one meets an edge or a corner.
bool add_piercings(const Triangle& t, const Triangle& o, bool of_second,
                   std::vector<Piercing>& out) {
    for (std::size_t c = 0; c < 3; ++c) {
        const Vector3& p = t[c];
        const Vector3& q = t[(c + 1) % 3];
        const int from = sign(o[0], o[1], o[2], p);
        const int to = sign(o[0], o[1], o[2], q);
        if (from == to) continue;
        std::array<int, 3> turns;
        for (std::size_t k = 0; k < 3; ++k) turns[k] = sign(p, q, o[k], o[(k + 1) % 3]);
        const auto [least, most] = std::ranges::minmax(turns);
        if (least * most < 0) continue;
        if (least * most == 0) return false;
        // det(a - d, b - d, c - d) is negative where d is above the plane of a, b and c.
        out.push_back({of_second, from > to, static_cast<std::int8_t>(c)});
    }
    return true;
}

Contact contact_of(const Triangle& t, const Triangle& o, std::vector<Piercing>& piercings) {
    piercings.clear();
    if (is_beside(t, o) || is_beside(o, t)) return Contact::Apart;
    for (std::size_t c = 0; c < 3; ++c)
        if (sign(t[0], t[1], t[2], o[c]) == 0 || sign(o[0], o[1], o[2], t[c]) == 0)
            return Contact::Special;
    if (!add_piercings(t, o, false, piercings) || !add_piercings(o, t, true, piercings))
        return Contact::Special;
    return piercings.empty() ? Contact::Apart : Contact::Crossing;
}

// Triangles with small coordinates often touch, lie in one plane or have common corners.
class FacetRowsOf : public testing::TestWithParam<int> {
protected:
    Vector3 point() {
        std::uniform_int_distribution<std::int64_t> at(0, (std::int64_t{1} << GetParam()) - 1);
        return {static_cast<double>(at(random_)), static_cast<double>(at(random_)),
                static_cast<double>(at(random_))};
    }
    FacetRowsOf() {
        const double side = static_cast<double>(std::int64_t{1} << GetParam());
        const Vector3 extent{side, side, side};
        rows_.start(extent);
        for (int i = 0; i < 240; ++i) {
            Triangle t{point(), point(), point()};
            // Some in the plane of the one before.
            if (i % 5 == 1) t = {triangles_.back()[0], triangles_.back()[2], t[0]};
            triangles_.push_back(t);
            rows_.add(t, FilteredFacets::plane_of(t, extent));
        }
    }
    // Both for every facet.
    template <class Parted, class IsApart>
    void compare(const Parted& parted, const IsApart& is_apart) {
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const bool found = (parted(i / 4) >> i % 4 & 1U) != 0;
            const bool apart = is_apart(triangles_[i]);
            ASSERT_TRUE(apart || !found) << i;
            apart_ += apart ? 1 : 0;
            found_ += found ? 1 : 0;
        }
    }

    std::mt19937_64 random_{20};
    std::vector<Triangle> triangles_;
    FacetRows rows_;
    std::size_t apart_ = 0;
    std::size_t found_ = 0;
};

TEST_P(FacetRowsOf, PartFacetsThatDoNotMeet) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const FacetRows::Probe probe = rows_.probe(i);
        const Triangle& t = triangles_[i];
        compare([&](std::size_t row) { return rows_.parted(row, probe); },
                [&](const Triangle& o) { return is_beside(t, o) || is_beside(o, t); });
    }
    EXPECT_GT(found_, apart_ * 98 / 100);
}

TEST_P(FacetRowsOf, PartSegmentsFromFacetsBesideThem) {
    for (int i = 0; i < 200; ++i) {
        std::array<Vector3, 2> line{point(), point()};
        if (i % 3 == 1) line[1] = triangles_[static_cast<std::size_t>(i)][0];
        const FacetRows::Segment segment = rows_.segment({line[0], 0}, {line[1], 0});
        compare([&](std::size_t row) { return rows_.parted(row, segment); },
                [&](const Triangle& t) { return is_beside(t, line) || is_line_beside(t, line); });
    }
    EXPECT_GT(found_, apart_ * 98 / 100);
}

TEST_P(FacetRowsOf, PartSegmentsWithinTheErrorsOfTheirEnds) {
    std::uniform_real_distribution<double> factor(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const std::array<Vector3, 2> line{point(), point()};
        const double error =
            static_cast<double>(std::int64_t{1} << GetParam()) * (i % 2 == 0 ? 0x1p-6 : 0x1p-12);
        std::array<trisect::Approximation, 2> ends;
        for (std::size_t end = 0; end < 2; ++end) {
            ends[end].error = error;
            for (std::size_t k = 0; k < 3; ++k)
                ends[end].c[k] = line[end][k] + factor(random_) * error;
        }
        const FacetRows::Segment segment = rows_.segment(ends[0], ends[1]);
        compare([&](std::size_t row) { return rows_.parted(row, segment); },
                [&](const Triangle& t) { return is_beside(t, line) || is_line_beside(t, line); });
    }
    EXPECT_GT(found_, 0U);
}

TEST_P(FacetRowsOf, KnowWhichFacetsCrossAndAtWhoseEdgesTheSegmentEnds) {
    std::size_t crossing = 0;
    std::size_t found_crossing = 0;
    std::vector<Piercing> piercings;
    const auto count = static_cast<std::uint32_t>(triangles_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t j = 0; j < count; j += 4) {
            const FacetRows::Relation r =
                rows_.relate({{{i, j}, {j + 1, i}, {i, j + 2}, {i, j + 3}}});
            for (std::uint32_t k = 0; k < 4; ++k) {
                const bool turned = k == 1;
                const Triangle& a = triangles_[turned ? j + k : i];
                const Triangle& b = triangles_[turned ? i : j + k];
                const bool apart = (r.apart >> k & 1U) != 0;
                const bool crosses = (r.crosses >> k & 1U) != 0;
                const Contact contact = contact_of(a, b, piercings);
                ASSERT_FALSE(apart && crosses);
                ASSERT_TRUE(!apart || contact == Contact::Apart) << i << ' ' << j + k;
                ASSERT_TRUE(!crosses || contact == Contact::Crossing) << i << ' ' << j + k;
                apart_ += contact == Contact::Apart ? 1 : 0;
                found_ += apart ? 1 : 0;
                crossing += contact == Contact::Crossing ? 1 : 0;
                if (!crosses) continue;
                ++found_crossing;
                ASSERT_EQ(piercings.size(), 2U);
                for (const Piercing& p : piercings) {
                    const bool starts = p.up != p.of_second;
                    ASSERT_EQ(((starts ? r.starts : r.ends) >> k & 1U) != 0, p.of_second);
                }
                for (std::size_t c = 0; c < 3; ++c) {
                    ASSERT_EQ((r.above[0][c] >> k & 1U) != 0, sign(b[0], b[1], b[2], a[c]) < 0);
                    ASSERT_EQ((r.above[1][c] >> k & 1U) != 0, sign(a[0], a[1], a[2], b[c]) < 0);
                }
            }
        }
    }
    EXPECT_GT(found_, apart_ * 98 / 100);
    EXPECT_GT(found_crossing, crossing * 95 / 100);
}

TEST_P(FacetRowsOf, AreRelatedByDoublesWhereNothingIsNear) {
    const double side = static_cast<double>(std::int64_t{1} << GetParam());
    std::array<std::size_t, 4> kinds{};
    std::vector<Piercing> piercings;
    for (const Triangle& a : triangles_) {
        const FilteredPlane of_a = FilteredFacets::plane_of(a, {side, side, side});
        for (const Triangle& b : triangles_) {
            const FilteredPlane of_b = FilteredFacets::plane_of(b, {side, side, side});
            const TriangleRelation r = relate_triangles({a, of_a}, {b, of_b});
            const Contact contact = contact_of(a, b, piercings);
            ++kinds[static_cast<std::size_t>(r.kind)];
            ASSERT_TRUE(r.kind != TriangleRelation::Kind::Apart || contact == Contact::Apart);
            if (r.kind != TriangleRelation::Kind::Crossing) continue;
            ASSERT_EQ(contact, Contact::Crossing);
            ASSERT_EQ(piercings.size(), 2U);
            for (std::size_t k = 0; k < 2; ++k) {
                const TriangleRelation::End end = r.end(k);
                const TriangleRelation::End turned = r.turned().end(1 - k);
                ASSERT_EQ(turned.of_second, !end.of_second);
                ASSERT_EQ(turned.edge.edge(turned.up), end.edge.edge(end.up));
                ASSERT_TRUE(std::ranges::any_of(piercings, [&](const Piercing& p) {
                    return p.of_second == end.of_second && p.up == end.up &&
                           p.edge == end.edge.edge(end.up) && (p.up != p.of_second) == (k == 0);
                }));
                trisect::Approximation at;
                if (find_end({a, of_a}, {b, of_b}, end, at)) {
                    const FilteredPlane& other = end.of_second ? of_a : of_b;
                    ASSERT_LE(std::fabs(other.value(at.c)), 4 * other.error(at));
                }
            }
        }
    }
    for (const TriangleRelation::Kind kind :
         {TriangleRelation::Kind::Apart, TriangleRelation::Kind::Crossing})
        EXPECT_GT(kinds[static_cast<std::size_t>(kind)], 0U);
}

INSTANTIATE_TEST_SUITE_P(Bits, FacetRowsOf, testing::Values(2, 4, 10, 20, 40));

}  // namespace
