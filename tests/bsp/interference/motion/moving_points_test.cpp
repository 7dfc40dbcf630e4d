// SPDX-License-Identifier: Apache-2.0
//
// Vertex against face and edge against edge, both on straight paths: named configurations, and
// small grids against a search that knows no determinant.

#include <trisect/bsp/interference/moving_points.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

#include "support/numbers.h"

namespace {

using numbers::q;
using trisect::AlgebraicNumber;
using trisect::ExactRational;
using trisect::first_contact;
using trisect::LinearPath;

using Grid = std::array<int, 3>;

std::array<ExactRational, 3> place(const Grid& g) { return {g[0], g[1], g[2]}; }
LinearPath path(const Grid& from, const Grid& to) { return {place(from), place(to)}; }
LinearPath at_rest(const Grid& g) { return path(g, g); }
std::array<LinearPath, 3> triangle_at_rest(const Grid& a, const Grid& b, const Grid& c) {
    return {at_rest(a), at_rest(b), at_rest(c)};
}
std::array<LinearPath, 2> edge_at_rest(const Grid& a, const Grid& b) {
    return {at_rest(a), at_rest(b)};
}
std::array<LinearPath, 2> moved(const Grid& a, const Grid& b, const Grid& by) {
    return {path(a, {a[0] + by[0], a[1] + by[1], a[2] + by[2]}),
            path(b, {b[0] + by[0], b[1] + by[1], b[2] + by[2]})};
}

const auto floor_triangle = triangle_at_rest({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

void expect_at(const std::optional<AlgebraicNumber>& s, const char* expected) {
    ASSERT_TRUE(s.has_value());
    EXPECT_EQ(*s, AlgebraicNumber(q(expected)));
}

TEST(VertexAndFace, FallsThroughTheMiddle) {
    expect_at(first_contact(path({1, 1, 2}, {1, 1, -1}), floor_triangle), "2/3");
}

TEST(VertexAndFace, ArrivesExactlyAtTheEnd) {
    expect_at(first_contact(path({1, 1, 2}, {1, 1, 0}), floor_triangle), "1");
}

TEST(VertexAndFace, StartsInContactAndLeaves) {
    expect_at(first_contact(path({1, 1, 0}, {1, 1, 5}), floor_triangle), "0");
}

TEST(VertexAndFace, MeetsASideAndACorner) {
    expect_at(first_contact(path({2, 2, 1}, {2, 2, -1}), floor_triangle), "1/2");
    expect_at(first_contact(path({0, 0, 1}, {0, 0, -3}), floor_triangle), "1/4");
}

TEST(VertexAndFace, PassesBesideIt) {
    EXPECT_FALSE(first_contact(path({3, 3, 1}, {3, 3, -1}), floor_triangle));
    EXPECT_FALSE(first_contact(path({-1, 1, 1}, {-1, 1, -1}), floor_triangle));
}

TEST(VertexAndFace, SlidesInThePlaneOfTheFaceIntoIt) {
    expect_at(first_contact(path({-1, 1, 0}, {1, 1, 0}), floor_triangle), "1/2");
    EXPECT_FALSE(first_contact(path({-1, 1, 0}, {-1, 5, 0}), floor_triangle));
    // Along the line of a side, from outside to its end.
    expect_at(first_contact(path({-1, 0, 0}, {3, 0, 0}), floor_triangle), "1/4");
}

TEST(VertexAndFace, NothingMoves) {
    expect_at(first_contact(at_rest({1, 1, 0}), floor_triangle), "0");
    expect_at(first_contact(at_rest({0, 0, 0}), floor_triangle), "0");
    EXPECT_FALSE(first_contact(at_rest({1, 1, 1}), floor_triangle));
    EXPECT_FALSE(first_contact(at_rest({5, 5, 0}), floor_triangle));
}

TEST(VertexAndFace, FaceThatIsASegmentOrAPoint) {
    const auto segment = triangle_at_rest({0, 0, 0}, {2, 0, 0}, {4, 0, 0});
    expect_at(first_contact(path({3, 0, 1}, {3, 0, -1}), segment), "1/2");
    expect_at(first_contact(path({5, 0, 0}, {3, 0, 0}), segment), "1/2");
    EXPECT_FALSE(first_contact(path({3, 1, 1}, {3, 1, -1}), segment));
    const auto point = triangle_at_rest({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    expect_at(first_contact(path({0, 0, 0}, {2, 2, 2}), point), "1/2");
    EXPECT_FALSE(first_contact(path({0, 0, 0}, {2, 2, 1}), point));
}

TEST(VertexAndFace, FaceThatIsFlatAtTheContactOnly) {
    // The triangle folds to a segment at s = 1/2, when the vertex passes through it.
    const std::array<LinearPath, 3> face{at_rest({-2, 0, 0}), at_rest({2, 0, 0}),
                                         path({0, 2, 0}, {0, -2, 0})};
    expect_at(first_contact(path({1, 0, 1}, {1, 0, -1}), face), "1/2");
}

TEST(VertexAndFace, TwoPassagesTheFirstOneBesideTheFace) {
    // The face turns its plane over the vertex; cubic with several roots.
    const std::array<LinearPath, 3> face{path({1, -1, 0}, {-1, -1, 0}), path({1, 1, 1}, {-1, 1, 1}),
                                         path({1, 1, -1}, {-1, 1, -1})};
    expect_at(first_contact(at_rest({0, 0, 0}), face), "1/2");
    EXPECT_FALSE(first_contact(at_rest({0, 3, 0}), face));
}

TEST(EdgeAndEdge, CrossInTheMiddle) {
    expect_at(first_contact(moved({-1, 0, 1}, {1, 0, 1}, {0, 0, -2}),
                            edge_at_rest({0, -1, 0}, {0, 1, 0})),
              "1/2");
}

TEST(EdgeAndEdge, EndsMeetOrMiss) {
    const auto rest = edge_at_rest({0, 0, 0}, {0, 2, 0});
    expect_at(first_contact(moved({0, 2, 1}, {2, 2, 1}, {0, 0, -2}), rest), "1/2");
    EXPECT_FALSE(first_contact(moved({0, 3, 1}, {2, 3, 1}, {0, 0, -2}), rest));
    EXPECT_FALSE(first_contact(moved({1, 0, 1}, {1, 2, 1}, {0, 0, -2}), rest));
}

TEST(EdgeAndEdge, ParallelOnesThatOverlapWhenTheyMeet) {
    const auto rest = edge_at_rest({0, 0, 0}, {4, 0, 0});
    expect_at(first_contact(moved({1, 0, 1}, {2, 0, 1}, {0, 0, -4}), rest), "1/4");
    expect_at(first_contact(moved({4, 0, 1}, {6, 0, 1}, {0, 0, -4}), rest), "1/4");
    EXPECT_FALSE(first_contact(moved({5, 0, 1}, {6, 0, 1}, {0, 0, -4}), rest));
}

TEST(EdgeAndEdge, OnOneLine) {
    const auto rest = edge_at_rest({0, 0, 0}, {2, 0, 0});
    expect_at(first_contact(moved({3, 0, 0}, {4, 0, 0}, {-2, 0, 0}), rest), "1/2");
    EXPECT_FALSE(first_contact(moved({3, 0, 0}, {4, 0, 0}, {2, 0, 0}), rest));
    expect_at(first_contact(moved({1, 0, 0}, {4, 0, 0}, {2, 0, 0}), rest), "0");
}

TEST(EdgeAndEdge, InOnePlaneForGood) {
    const auto rest = edge_at_rest({0, 0, 0}, {2, 0, 0});
    expect_at(first_contact(moved({1, 3, 0}, {1, 1, 0}, {0, -2, 0}), rest), "1/2");
    expect_at(first_contact(moved({1, 3, 0}, {3, 1, 0}, {-1, -2, 0}), rest), "2/3");
    EXPECT_FALSE(first_contact(moved({3, 3, 0}, {3, 1, 0}, {0, -2, 0}), rest));
}

TEST(EdgeAndEdge, PointsForEdges) {
    const auto point = edge_at_rest({1, 0, 0}, {1, 0, 0});
    expect_at(first_contact(moved({0, 0, 1}, {2, 0, 1}, {0, 0, -2}), point), "1/2");
    expect_at(first_contact(moved({1, 0, 1}, {1, 0, 1}, {0, 0, -2}), point), "1/2");
    EXPECT_FALSE(first_contact(moved({1, 1, 1}, {1, 1, 1}, {0, 0, -2}), point));
}

TEST(EdgeAndEdge, NothingMoves) {
    expect_at(first_contact(edge_at_rest({0, 0, 0}, {2, 2, 0}), edge_at_rest({0, 2, 0}, {2, 0, 0})),
              "0");
    EXPECT_FALSE(
        first_contact(edge_at_rest({0, 0, 0}, {2, 2, 0}), edge_at_rest({0, 2, 1}, {2, 0, 1})));
}

TEST(EdgeAndEdge, IrrationalTime) {
    // Seen along the x axis b passes the height of a where s^2 + 2 s = 2.
    const std::array<LinearPath, 2> a{path({-4, 0, -1}, {-4, 0, 0}), path({4, 0, -1}, {4, 0, 0})};
    const std::array<LinearPath, 2> b{path({0, -1, 0}, {1, -2, -1}), at_rest({0, 1, 0})};
    const auto s = first_contact(a, b);
    ASSERT_TRUE(s.has_value());
    EXPECT_FALSE(s->is_rational());
    EXPECT_NEAR(s->to_double(), std::sqrt(3.0) - 1, 1e-15);
    EXPECT_EQ(s->sign_of(std::vector<ExactRational>{-2, 2, 1}), 0);
}

// The oracle solves for barycentric coordinates at given rational times; it knows no determinant
// and no polynomial. It can only look at some times, so small fractions of the unit interval are
// taken, where on grids of three points most contacts happen.
ExactRational coordinate(const LinearPath& p, std::size_t i, const ExactRational& s) {
    return p.from[i] + (p.to[i] - p.from[i]) * s;
}

using Vector = std::array<ExactRational, 3>;

Vector at(const LinearPath& p, const ExactRational& s) {
    return {coordinate(p, 0, s), coordinate(p, 1, s), coordinate(p, 2, s)};
}
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
ExactRational dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Squared distance of segments a + u d, b + v e at one time is zero: a linear system by Cramer's
// rule on the Gram matrix, the parallel case by the ends.
bool on_segment(const Vector& p, const Vector& a, const Vector& b) {
    const Vector d = minus(b, a);
    const Vector e = minus(p, a);
    const ExactRational length = dot(d, d);
    if (length.sign() == 0) return dot(e, e).sign() == 0;
    const ExactRational along = dot(d, e);
    return along * along == length * dot(e, e) && along.sign() >= 0 && along <= length;
}

bool segments_meet(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    if (on_segment(a, c, d) || on_segment(b, c, d) || on_segment(c, a, b) || on_segment(d, a, b))
        return true;
    const Vector x = minus(b, a);
    const Vector y = minus(d, c);
    const Vector w = minus(c, a);
    const ExactRational gram = dot(x, x) * dot(y, y) - dot(x, y) * dot(x, y);
    if (gram.sign() == 0) return false;
    const ExactRational u = (dot(w, x) * dot(y, y) - dot(w, y) * dot(x, y)) / gram;
    const ExactRational v = (dot(w, x) * dot(x, y) - dot(w, y) * dot(x, x)) / gram;
    if (u.sign() < 0 || v.sign() < 0 || u > ExactRational(1) || v > ExactRational(1)) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (a[i] + u * x[i] != c[i] + v * y[i]) return false;
    return true;
}

bool in_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
    if (on_segment(p, a, b) || on_segment(p, b, c) || on_segment(p, c, a)) return true;
    const Vector x = minus(b, a);
    const Vector y = minus(c, a);
    const Vector w = minus(p, a);
    const ExactRational gram = dot(x, x) * dot(y, y) - dot(x, y) * dot(x, y);
    if (gram.sign() == 0) return false;
    const ExactRational u = (dot(w, x) * dot(y, y) - dot(w, y) * dot(x, y)) / gram;
    const ExactRational v = (dot(w, y) * dot(x, x) - dot(w, x) * dot(x, y)) / gram;
    if (u.sign() < 0 || v.sign() < 0 || u + v > ExactRational(1)) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (a[i] + u * x[i] + v * y[i] != p[i]) return false;
    return true;
}

class Grids {
public:
    explicit Grids(unsigned seed) : random_(seed) {}
    LinearPath path() {
        const Grid from = point();
        switch (random_() % 4) {
            case 0:
                return at_rest(from);
            case 1:
                return ::path(from,
                              {from[0] + common_[0], from[1] + common_[1], from[2] + common_[2]});
            default:
                return ::path(from, point());
        }
    }
    void next() { common_ = point(); }

private:
    Grid point() {
        return {static_cast<int>(random_() % 3), static_cast<int>(random_() % 3),
                static_cast<int>(random_() % 3)};
    }
    std::mt19937 random_;
    Grid common_{};
};

std::vector<ExactRational> small_fractions() {
    std::vector<ExactRational> r;
    for (int d = 1; d <= 12; ++d)
        for (int n = 0; n <= d; ++n) r.push_back(ExactRational(n) / ExactRational(d));
    return r;
}

template <class Meets>
void compare_with_small_fractions(const std::optional<AlgebraicNumber>& s, const Meets& meets,
                                  const std::vector<ExactRational>& times, int& confirmed) {
    for (const ExactRational& t : times) {
        if (s && AlgebraicNumber(t) == *s) {
            EXPECT_TRUE(meets(t));
            ++confirmed;
        } else if (!s || AlgebraicNumber(t) < *s) {
            EXPECT_FALSE(meets(t)) << t.to_string();
        }
    }
}

TEST(SmallGrids, VertexAndFaceAgreeWithContactsAtSmallFractions) {
    const auto times = small_fractions();
    Grids grids(21);
    int confirmed = 0;
    for (int round = 0; round < 1500; ++round) {
        grids.next();
        const LinearPath v = grids.path();
        const std::array<LinearPath, 3> f{grids.path(), grids.path(), grids.path()};
        compare_with_small_fractions(
            first_contact(v, f),
            [&](const ExactRational& t) {
                return in_triangle(at(v, t), at(f[0], t), at(f[1], t), at(f[2], t));
            },
            times, confirmed);
    }
    EXPECT_GT(confirmed, 300);
}

TEST(SmallGrids, EdgeAndEdgeAgreeWithContactsAtSmallFractions) {
    const auto times = small_fractions();
    Grids grids(22);
    int confirmed = 0;
    for (int round = 0; round < 1500; ++round) {
        grids.next();
        const std::array<LinearPath, 2> a{grids.path(), grids.path()};
        const std::array<LinearPath, 2> b{grids.path(), grids.path()};
        compare_with_small_fractions(
            first_contact(a, b),
            [&](const ExactRational& t) {
                return segments_meet(at(a[0], t), at(a[1], t), at(b[0], t), at(b[1], t));
            },
            times, confirmed);
    }
    EXPECT_GT(confirmed, 300);
}

}  // namespace
