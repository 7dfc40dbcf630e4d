// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/exact_distance.h>

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <trisect/brep/exact_rational.h>

namespace trisect::detail {
namespace {

using Rationals = std::array<ExactRational, 3>;

Rationals rationals(const LatticePoint& p) {
    Rationals out;
    for (std::size_t k = 0; k < 3; ++k) out[k] = ExactRational::from_double(p.doubles()[k]);
    return out;
}

ExactRational product(const Rationals& a, const Rationals& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Rationals difference_of(const LatticePoint& a, const LatticePoint& b) {
    Rationals out = rationals(a);
    const Rationals other = rationals(b);
    for (std::size_t k = 0; k < 3; ++k) out[k] -= other[k];
    return out;
}

LatticePoint random_point(std::mt19937_64& random, int bits, int behind) {
    std::array<double, 3> c{};
    for (double& x : c)
        x = std::ldexp(static_cast<double>(static_cast<std::int64_t>(random()) >> (64 - bits)),
                       -behind);
    return {Coordinate(c[0]), Coordinate(c[1]), Coordinate(c[2])};
}

// Against rationals, on all ranges that coordinates may have.
TEST(ExactDistance, AgreesWithRationals) {
    std::mt19937_64 random(11);
    for (int i = 0; i < 3000; ++i) {
        const int bits = 3 + static_cast<int>(random() % 50);
        const int behind = static_cast<int>(random() % 74);
        const LatticePoint a = random_point(random, bits, behind);
        const LatticePoint b = random_point(random, bits, behind);
        const LatticePoint p = random_point(random, bits, i % 2 == 0 ? behind : 0);
        if (a == b) continue;
        const Lattice lattice{static_cast<int>(random() % 80) - 40};
        const Rationals edge = difference_of(b, a);
        const Rationals way = difference_of(p, a);
        const ExactRational place = product(way, edge) / product(edge, edge);
        const FootOnEdge foot = foot_on_edge(a, b, p);
        EXPECT_EQ(foot.is_inside, place > ExactRational(0) && place < ExactRational(1));
        const ExactRational to_point = product(way, way);
        const ExactRational to_edge = to_point - place * place * product(edge, edge);
        for (const auto& [wanted, found, known] :
             {std::tuple(to_point, squared_distance(a, p), true),
              std::tuple(to_edge, foot.distance, foot.is_inside)}) {
            if (!known) continue;
            const double root = lattice.to_double(std::sqrt(wanted.to_double()));
            for (const double bound :
                 {root, std::nextafter(root, 0), std::nextafter(root, HUGE_VAL), root / 3, root * 5,
                  0.0, 1e-300, 1e300}) {
                const ExactRational b1 =
                    ExactRational::from_double(bound).scaled(-lattice.exponent);
                EXPECT_EQ(DistanceBound(bound, lattice).covers(found), wanted <= b1 * b1);
            }
            EXPECT_NEAR(lattice.to_double(found.root()), root, root * 1e-12);
        }
    }
}

TEST(ExactDistance, OrderOfQuotients) {
    const LatticePoint a{0, 0, 0}, b{3, 0, 0}, c{7, 7, 0};
    const LatticePoint p{1, 1, 0};
    const FootOnEdge one = foot_on_edge(a, b, p);
    const FootOnEdge none = foot_on_edge(a, c, p);
    ASSERT_TRUE(one.is_inside && none.is_inside);
    EXPECT_TRUE(none.distance.numerator.is_zero());
    EXPECT_TRUE(none.distance < one.distance);
    EXPECT_FALSE(one.distance < none.distance);
    EXPECT_FALSE(one.distance < foot_on_edge(b, a, p).distance);
    EXPECT_EQ(one.distance.root(), 1);
}

}  // namespace
}  // namespace trisect::detail
