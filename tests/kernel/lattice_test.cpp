// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/lattice.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <trisect/kernel/error.h>

#include "support/gmp_oracle.h"
#include "support/lattice_arithmetic.h"

namespace {

using trisect::choose_lattice;
using trisect::Lattice;
using trisect::LatticePoint;
using trisect::LatticeReport;
using trisect::to_lattice;
using Coordinates = std::vector<std::array<double, 3>>;

constexpr double greatest = std::numeric_limits<double>::max();
constexpr double least = std::numeric_limits<double>::denorm_min();

LatticeReport import(const Coordinates& points, Lattice lattice) {
    LatticeReport report;
    (void)to_lattice(points, lattice, report);
    return report;
}

TEST(SpanBits, FromTheLeadingBitToTheLast) {
    using trisect::span_bits;
    EXPECT_EQ(span_bits({}), 0);
    EXPECT_EQ(span_bits(Coordinates{{0, -0.0, 0}}), 0);
    EXPECT_EQ(span_bits(Coordinates{{1, 0, -4}}), 3);
    EXPECT_EQ(span_bits(Coordinates{{6, 2, 4}}), 2) << "of 2";
    EXPECT_EQ(span_bits(Coordinates{{0.1, 0, 0}}), 52);
    EXPECT_EQ(span_bits(Coordinates{{0.1, 1, 0}}), 56);
    EXPECT_EQ(span_bits(Coordinates{{0x1p-1074, 0, 0x1p1023}}), 2098);
    EXPECT_EQ(span_bits(Coordinates{{std::numeric_limits<double>::infinity(), 3, 0}}), 2);
}

TEST(Lattice, NothingAndZeroGetUnitOne) {
    EXPECT_EQ(choose_lattice({}).exponent, 0);
    EXPECT_EQ(choose_lattice(Coordinates{{0, -0.0, 0}}).exponent, 0);
}

// The definitions, one coordinate at a time, with the functions of the C library.
int lowest_bit(double v) {
    int e = 0;
    double m = std::frexp(v, &e);
    while (m != std::nearbyint(m)) {
        m *= 2;
        --e;
    }
    while (std::fmod(m, 2) == 0) {
        m /= 2;
        ++e;
    }
    return e;
}

int expected_exponent(const Coordinates& points) {
    int lowest = std::numeric_limits<int>::max();
    double largest = 0;
    for (const auto& p : points)
        for (const double c : p) {
            if (c == 0 || !std::isfinite(c)) continue;
            lowest = std::min(lowest, lowest_bit(c));
            largest = std::max(largest, std::fabs(c));
        }
    if (largest == 0) return 0;
    int top = 0;
    std::frexp(largest, &top);
    const double room = top - (trisect::coordinate_bits - trisect::growth_bits);
    return static_cast<int>(std::max(8 * std::floor(lowest / 8.0), 8 * std::ceil(room / 8)));
}

TEST(Lattice, EveryCoordinateAsIfAlone) {
    oracle::Source random(7);
    for (int round = 0; round < 20000; ++round) {
        const int middle = static_cast<int>(random.between(-1100, 1000));
        const int spread = static_cast<int>(random.between(0, 60));
        Coordinates points(3);
        for (auto& p : points)
            for (double& c : p)
                c = std::ldexp(
                    static_cast<double>(random.coordinate(static_cast<int>(random.between(1, 53)))),
                    middle - static_cast<int>(random.between(0, spread)));
        Lattice lattice = choose_lattice(points);
        ASSERT_EQ(lattice.exponent, expected_exponent(points));
        lattice.exponent += 8 * static_cast<int>(random.between(-1, 2));
        LatticeReport report;
        std::vector<LatticePoint> found;
        bool refused = false;
        try {
            found = to_lattice(points, lattice, report);
        } catch (const trisect::LimitError&) {
            refused = true;
        }
        double largest_move = 0;
        std::size_t moved = 0;
        bool outside = false;
        for (std::size_t i = 0; i < points.size(); ++i) {
            bool any = false;
            for (int k = 0; k < 3; ++k) {
                const double c = points[i][static_cast<std::size_t>(k)];
                const double units = std::ldexp(c, -lattice.exponent);
                outside =
                    outside || !(std::fabs(units) < static_cast<double>(trisect::coordinate_limit));
                if (outside) break;
                const double r = std::nearbyint(units);
                ASSERT_TRUE(refused || found[i][k].to_double() == r);
                if (r == units && (r != 0 || c == 0)) continue;
                any = true;
                largest_move = std::max(
                    largest_move,
                    r == 0 ? std::fabs(c) : std::ldexp(std::fabs(r - units), lattice.exponent));
            }
            moved += any ? 1 : 0;
        }
        ASSERT_EQ(refused, outside);
        if (refused) continue;
        EXPECT_EQ(report.moved, moved);
        EXPECT_EQ(report.max_move, largest_move);
        EXPECT_EQ(report.lossless, moved == 0);
    }
}

TEST(Lattice, CoarsestWithoutLoss) {
    EXPECT_EQ(choose_lattice(Coordinates{{1, 2, 3}}).exponent, 0);
    EXPECT_EQ(choose_lattice(Coordinates{{256, 512, 0}}).exponent, 8);
    EXPECT_EQ(choose_lattice(Coordinates{{128, 512, 0}}).exponent, 0);
    EXPECT_EQ(choose_lattice(Coordinates{{0.5, 1, 0}}).exponent, -8);
    EXPECT_EQ(choose_lattice(Coordinates{{0x1p-8, 1, 0}}).exponent, -8);
    EXPECT_EQ(choose_lattice(Coordinates{{0x1p-9, 1, 0}}).exponent, -16);
    EXPECT_EQ(choose_lattice(Coordinates{{0.1F, 0.2F, 0.3F}}).exponent, -32);
}

TEST(Lattice, ExponentIsAMultipleOf8AndLeavesRoom) {
    oracle::Source random(1);
    for (int round = 0; round < 20000; ++round) {
        Coordinates points;
        const int scale = static_cast<int>(random.between(-900, 900));
        for (int k = 0; k < 3; ++k) {
            std::array<double, 3> p{};
            for (double& c : p)
                c = std::ldexp(static_cast<double>(random.coordinate(30)),
                               scale + static_cast<int>(random.between(-12, 12)));
            points.push_back(p);
        }
        const Lattice lattice = choose_lattice(points);
        EXPECT_EQ(lattice.exponent % 8, 0);
        double largest = 0;
        bool fits = true;
        bool coarser_fits = true;
        for (const auto& p : points) {
            for (const double c : p) {
                largest = std::max(largest, std::fabs(c));
                const double u = std::ldexp(c, -lattice.exponent);
                fits = fits && u == std::nearbyint(u);
                const double v = std::ldexp(c, -lattice.exponent - 8);
                coarser_fits = coarser_fits && v == std::nearbyint(v);
            }
        }
        if (largest == 0) continue;
        const double room = std::ldexp(1.0, trisect::coordinate_bits - trisect::growth_bits);
        EXPECT_LT(std::ldexp(largest, -lattice.exponent), room);
        if (fits) {
            EXPECT_FALSE(coarser_fits);  // the coarsest
        } else {                         // no finer one has the room
            EXPECT_GE(std::ldexp(largest, 8 - lattice.exponent), room);
        }
        const LatticeReport report = import(points, lattice);
        EXPECT_EQ(report.lossless, fits);
        EXPECT_EQ(report.moved == 0, fits);
    }
}

TEST(Lattice, FloatsOfAModelAreLossless) {
    oracle::Source random(2);
    Coordinates points(1000);
    for (auto& p : points)
        for (double& c : p)  // floats between 1/16 and 100, as a scanner writes them
            c = static_cast<float>(0.0625 + 99.9 * (static_cast<double>(random.below(1U << 30)) /
                                                    static_cast<double>(1U << 30)));
    const LatticeReport report = import(points, choose_lattice(points));
    EXPECT_TRUE(report.lossless);
    EXPECT_EQ(report.max_move, 0);
}

// Points are rounded many at once where that changes nothing.
TEST(Lattice, OneOddCoordinateAmongManyIntegers) {
    oracle::Source random(8);
    const std::array<double, 5> odd{0.25, 0x1.fp51, -0x1.fp51, 0x1p-1074, 7};
    for (int round = 0; round < 3000; ++round) {
        const Lattice lattice{8 * static_cast<int>(random.between(-1, 1))};
        Coordinates points(static_cast<std::size_t>(random.between(1, 600)));
        for (auto& p : points)
            for (double& c : p)
                c = std::ldexp(static_cast<double>(random.coordinate(40)), lattice.exponent);
        const auto last = static_cast<std::int64_t>(points.size()) - 1;
        const auto at = static_cast<std::size_t>(random.between(0, last));
        const double c = odd[static_cast<std::size_t>(random.between(0, 4))];
        points[at][static_cast<std::size_t>(random.between(0, 2))] =
            c == 0x1p-1074 ? c : std::ldexp(c, lattice.exponent);
        LatticeReport report;
        const auto out = to_lattice(points, lattice, report);
        EXPECT_EQ(report.moved, std::fabs(c) < 1 ? 1U : 0U);
        EXPECT_EQ(report.lossless, std::fabs(c) >= 1);
        for (std::size_t i = 0; i < points.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const double units =
                    std::ldexp(points[i][static_cast<std::size_t>(k)], -lattice.exponent);
                ASSERT_EQ(out[i][k].to_double(), std::nearbyint(units));
            }
    }
}

TEST(Lattice, ReportsWhatItRounds) {
    LatticeReport report;
    const Coordinates points{{0.5, 1.5, 2.5}, {1, 2, 3}, {-0.5, 7.25, 0}};
    const auto out = to_lattice(points, Lattice{0}, report);
    EXPECT_EQ(out[0], (LatticePoint{0, 2, 2}));  // ties to even
    EXPECT_EQ(out[1], (LatticePoint{1, 2, 3}));
    EXPECT_EQ(out[2], (LatticePoint{0, 7, 0}));
    EXPECT_FALSE(report.lossless);
    EXPECT_EQ(report.moved, 2U);
    EXPECT_EQ(report.max_move, 0.5);
    EXPECT_EQ(report.lattice, Lattice{0});
}

TEST(Lattice, AMoveThatUnderflowsIsReported) {
    const Coordinates points{{0x1p996, 1e-300, 0}};
    const Lattice lattice = choose_lattice(points);
    const LatticeReport report = import(points, lattice);
    EXPECT_FALSE(report.lossless);
    EXPECT_EQ(report.moved, 1U);
    EXPECT_EQ(report.max_move, 1e-300);
}

TEST(Lattice, ExtremesOfDouble) {
    const Coordinates tiny{{least, 0, -least}};
    EXPECT_EQ(choose_lattice(tiny).exponent, -1080);
    LatticeReport report;
    const auto p = to_lattice(tiny, choose_lattice(tiny), report);
    EXPECT_TRUE(report.lossless);
    EXPECT_EQ(p[0], (LatticePoint{64, 0, -64}));
    EXPECT_EQ(Lattice{-1080}.to_double(64), least);

    const Coordinates huge{{greatest, -greatest, 0}};
    const Lattice lattice = choose_lattice(huge);
    EXPECT_EQ(lattice.exponent, 984);
    // Up to 2^1024, which is no double.
    EXPECT_THROW(import(huge, lattice), trisect::Error);
    EXPECT_THROW(import(huge, Lattice{976}), trisect::Error);
    EXPECT_THROW(import(huge, Lattice{968}), trisect::LimitError);
    const double large = greatest - 0x1p983;
    const LatticeReport rounded = import(Coordinates{{large, -large, 0}}, lattice);
    EXPECT_FALSE(rounded.lossless);
    EXPECT_EQ(rounded.max_move, 0x1p983 - 0x1p971);

    const Coordinates both{{large, least, 1}};
    EXPECT_EQ(choose_lattice(both).exponent, 984);
    EXPECT_EQ(import(both, Lattice{984}).moved, 1U);
}

TEST(Lattice, RangeIsChecked) {
    const double limit = 0x1p53;
    EXPECT_NO_THROW(import({{limit - 1, 1 - limit, 0}}, Lattice{0}));
    EXPECT_THROW(import({{limit, 0, 0}}, Lattice{0}), trisect::LimitError);
    EXPECT_THROW(import({{0, -limit, 0}}, Lattice{0}), trisect::LimitError);
    EXPECT_NO_THROW(import({{limit, 0, 0}}, Lattice{8}));
    EXPECT_THROW(import({{1, 0, 0}}, Lattice{-56}), trisect::LimitError);
    EXPECT_THROW(import({{greatest, 0, 0}}, Lattice{-1000}), trisect::LimitError);
    for (const double bad :
         {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(import({{0, 0, bad}}, Lattice{0}), trisect::LimitError);
}

TEST(Lattice, RoundTripIsExact) {
    oracle::Source random(3);
    for (int round = 0; round < 1000; ++round) {
        const Lattice lattice{static_cast<int>(8 * random.between(-100, 100))};
        const std::int64_t c = random.coordinate(53);
        const double user = lattice.to_double(static_cast<double>(c));
        LatticeReport report;
        const auto p = to_lattice(Coordinates{{user, 0, 0}}, lattice, report);
        EXPECT_EQ(p[0].x, c);
        EXPECT_TRUE(report.lossless);
    }
}

}  // namespace
