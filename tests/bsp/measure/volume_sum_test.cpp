// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/measure/volume_sum.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>

#include <trisect/brep/exact_rational.h>

namespace volume_sum_test {
namespace {

using trisect::ExactRational;
using trisect::detail::SplitPoint;
using trisect::detail::VolumeSum;

using Exact = std::array<ExactRational, 3>;

Exact exact(const SplitPoint& p) {
    Exact out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = ExactRational(p.whole[k]) + ExactRational::from_double(p.rest[k]);
    return out;
}

ExactRational term(const SplitPoint& a, const SplitPoint& b, const SplitPoint& c) {
    const Exact o = exact(a);
    const Exact p = exact(b);
    const Exact q = exact(c);
    return (o[2] + p[2] + q[2]) * ((p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]));
}

class Points {
public:
    explicit Points(std::uint64_t seed) : random_(seed) {}
    SplitPoint operator()(int bits, bool rests) {
        SplitPoint p;
        for (std::size_t k = 0; k < 3; ++k) {
            p.whole[k] = static_cast<std::int64_t>(random_()) >> (63 - bits);
            if (rests) p.rest[k] = std::uniform_real_distribution<double>(-1, 1)(random_);
        }
        return p;
    }

private:
    std::mt19937_64 random_;
};

TEST(VolumeSum, OfWholePointsIsExact) {
    Points points(1);
    for (const int bits : {3, 30, 53, 60}) {
        VolumeSum sum;
        ExactRational expected;
        for (int n = 0; n < 300; ++n) {
            const SplitPoint o = points(bits, false);
            const SplitPoint p = points(bits, false);
            const SplitPoint q = points(bits, false);
            sum.add(o.whole, p.whole, q.whole);
            expected += term(o, p, q);
        }
        EXPECT_TRUE(sum.is_exact());
        EXPECT_EQ(ExactRational(sum.whole()), expected);
    }
}

TEST(VolumeSum, OfPointsWithRestsIsEnclosed) {
    Points points(2);
    for (const int bits : {3, 30, 53, 60}) {
        for (const int count : {1, 2, 3000}) {
            VolumeSum sum;
            ExactRational expected;
            for (int n = 0; n < count; ++n) {
                const SplitPoint o = points(bits, true);
                const SplitPoint p = points(bits, n % 2 == 0);
                const SplitPoint q = points(bits, true);
                VolumeSum one;
                one.add(o, p, q);
                sum.add(one);
                expected += term(o, p, q);
            }
            const ExactRational found =
                ExactRational(sum.whole()) + ExactRational::from_double(sum.rests());
            const ExactRational error = ExactRational::from_double(sum.error());
            SCOPED_TRACE(testing::Message()
                         << bits << " bits, " << count << " terms, off by "
                         << (found - expected).to_double() << " with a bound of " << sum.error());
            EXPECT_LE(found - error, expected);
            EXPECT_GE(found + error, expected);
        }
    }
}

}  // namespace
}  // namespace volume_sum_test
