// SPDX-License-Identifier: Apache-2.0
//
// What rows of facets in single precision part is apart, by exact orientations of the corners.

#include <trisect/bsp/detail/facet_rows.h>

#include <array>
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
            rows_.add(t, PlainFacets::plane_of(t, extent));
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

INSTANTIATE_TEST_SUITE_P(Bits, FacetRowsOf, testing::Values(2, 4, 10, 20, 40));

}  // namespace
