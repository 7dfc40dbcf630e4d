// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/lattice.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <trisect/kernel/error.h>

#include "support/gmp_oracle.h"
#include "support/lattice_arithmetic.h"

namespace {

using trisect::choose_lattice;
using trisect::Fractions;
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

// ---------------------------------------------------------------- fractions

std::uint64_t bits(double v) { return std::bit_cast<std::uint64_t>(v + 0.0); }

// The definition: the lattice of whole coordinates where it loses nothing or 73 bits behind the
// point are enough, else the coarsest multiple of 8 that is fine enough, else any exponent.
int expected_exponent_of_fractions(const Coordinates& points) {
    const int whole = expected_exponent(points);
    int lowest = std::numeric_limits<int>::max();
    int top = std::numeric_limits<int>::min();
    for (const auto& p : points)
        for (const double c : p) {
            if (c == 0) continue;
            lowest = std::min(lowest, lowest_bit(c));
            top = std::max(top, std::ilogb(c) + 1);
        }
    if (lowest >= whole - trisect::fraction_limit) return whole;
    const auto fits = [&](int e) { return lowest >= e - 73 && top <= e + 53; };
    for (int e = whole; e > whole - 32; e -= 8)
        if (fits(e)) return e;
    for (int e = whole; e > whole - 32; --e)
        if (fits(e)) return e;
    return top - 53;
}

Coordinates spread_points(oracle::Source& random, int bits) {
    const int middle = static_cast<int>(random.between(-1100, 1023 - bits));
    Coordinates points(static_cast<std::size_t>(random.between(1, 5)));
    for (auto& p : points)
        for (double& c : p) {
            const int size = static_cast<int>(random.between(1, 53));
            c = std::ldexp(static_cast<double>(random.coordinate(size)),
                           middle + static_cast<int>(random.between(0, bits - size)));
        }
    return points;
}

TEST(LatticeFractions, WholeSetsStayAsTheyAre) {
    oracle::Source random(11);
    for (int round = 0; round < 20000; ++round) {
        const Coordinates points = spread_points(random, 53);
        const Lattice lattice = choose_lattice(points);
        LatticeReport rounded;
        const auto whole = to_lattice(points, lattice, rounded);
        if (!rounded.lossless) continue;
        ASSERT_EQ(choose_lattice(points, 0, Fractions::Kept), lattice);
        LatticeReport kept;
        ASSERT_EQ(to_lattice(points, lattice, kept, 0, Fractions::Kept), whole);
        ASSERT_TRUE(kept.lossless);
    }
}

TEST(LatticeFractions, SetsOf126BitsComeBackBitForBit) {
    oracle::Source random(12);
    std::array<int, 3> ways{};  // the unit of whole coordinates, a finer one, no multiple of 8
    for (int round = 0; round < 40000; ++round) {
        const Coordinates points = spread_points(random, 126);
        if (trisect::span_bits(points) > 126) continue;
        const Lattice lattice = choose_lattice(points, 0, Fractions::Kept);
        ASSERT_EQ(lattice.exponent, expected_exponent_of_fractions(points));
        ++ways[lattice == choose_lattice(points) ? 0U : (lattice.exponent % 8 == 0 ? 1U : 2U)];
        LatticeReport report;
        const auto found = to_lattice(points, lattice, report, 0, Fractions::Kept);
        ASSERT_TRUE(report.lossless);
        ASSERT_EQ(report.moved, 0U);
        ASSERT_EQ(report.max_move, 0);
        for (std::size_t i = 0; i < points.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const double c = points[i][static_cast<std::size_t>(k)];
                const double units = found[i][k].to_double();
                ASSERT_EQ(bits(lattice.to_double(units)), bits(c));
                ASSERT_FALSE(std::signbit(units) && units == 0);
                ASSERT_LT(std::fabs(units), 0x1p53);
                ASSERT_EQ(std::fmod(units, 0x1p-73), 0);
            }
    }
    for (const int n : ways) EXPECT_GT(n, 1000);
}

TEST(LatticeFractions, LongerSetsLoseWhatDoesNotFitAndSaySo) {
    oracle::Source random(13);
    int lossy = 0;
    for (int round = 0; round < 20000; ++round) {
        const Coordinates points = spread_points(random, 180);
        const Lattice lattice = choose_lattice(points, 0, Fractions::Kept);
        ASSERT_EQ(lattice.exponent, expected_exponent_of_fractions(points));
        LatticeReport report;
        const auto found = to_lattice(points, lattice, report, 0, Fractions::Kept);
        ASSERT_EQ(report.lossless, trisect::span_bits(points) <= 126);
        lossy += report.lossless ? 0 : 1;
        std::size_t moved = 0;
        double largest_move = 0;
        const mpq_class scale(mpz_class(1) << 1300U);
        for (std::size_t i = 0; i < points.size(); ++i) {
            bool any = false;
            for (int k = 0; k < 3; ++k) {
                const double c = points[i][static_cast<std::size_t>(k)];
                // In units of 2^-73 of the lattice's.
                mpq_class exact(c);
                const int e = lattice.exponent - 73;
                if (e < 0)
                    exact <<= static_cast<unsigned long>(-e);
                else
                    exact >>= static_cast<unsigned long>(e);
                mpq_class units(found[i][k].to_double());
                units <<= 73U;
                ASSERT_EQ(units.get_den(), 1);
                const mpq_class distance = abs(units - exact);
                ASSERT_LE(distance, mpq_class(1, 2));
                if (distance == mpq_class(1, 2)) {
                    ASSERT_EQ(mpz_class(units.get_num() % 2), 0);
                }
                if (distance == 0) continue;
                any = true;
                mpq_class move = distance;
                if (e < 0)
                    move >>= static_cast<unsigned long>(-e);
                else
                    move <<= static_cast<unsigned long>(e);
                largest_move = std::max(largest_move, move.get_d());
            }
            moved += any ? 1 : 0;
        }
        ASSERT_EQ(report.moved, moved);
        ASSERT_EQ(report.max_move, largest_move);
    }
    EXPECT_GT(lossy, 1000);
}

TEST(LatticeFractions, ExtremesOfDouble) {
    const auto kept = [](const Coordinates& points) {
        LatticeReport report;
        const Lattice lattice = choose_lattice(points, 0, Fractions::Kept);
        const auto found = to_lattice(points, lattice, report, 0, Fractions::Kept);
        for (std::size_t i = 0; i < points.size() && report.lossless; ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(bits(lattice.to_double(found[i][k].to_double())),
                          bits(points[i][static_cast<std::size_t>(k)]));
        return report;
    };
    EXPECT_TRUE(kept({}).lossless);
    EXPECT_TRUE(kept({{0, -0.0, 0}}).lossless);
    EXPECT_TRUE(kept({{least, 0, -least}}).lossless);
    EXPECT_TRUE(kept({{least, 0x1.fffffffffffffp-1022, -0x1p-1000}}).lossless);
    EXPECT_TRUE(kept({{least, 0x1p-949, 0}}).lossless) << "126 bits";
    EXPECT_FALSE(kept({{least, 0x1p-948, 0}}).lossless) << "127 bits";
    EXPECT_TRUE(kept({{greatest, -greatest, 0}}).lossless) << "nothing is rounded up";
    EXPECT_TRUE(kept({{greatest, 0x1p898, 0}}).lossless);
    const LatticeReport wide = kept({{greatest, 0x1p897, 0}});
    EXPECT_EQ(wide.moved, 1U);
    EXPECT_EQ(wide.max_move, 0x1p897);
    const LatticeReport decimals = kept({{1e308, 1, 0}});
    EXPECT_EQ(decimals.moved, 1U);
    EXPECT_EQ(decimals.max_move, 1);
    EXPECT_EQ(kept({{greatest, least, 1}}).moved, 1U);
    EXPECT_TRUE(kept({{0.1, 1e-10, 1000.7}}).lossless);
    for (const double bad :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(kept({{0.1, 1e-10, bad}}), trisect::LimitError);
}

// Points are scaled many at once where that changes nothing.
TEST(LatticeFractions, OneOddCoordinateAmongMany) {
    oracle::Source random(14);
    const std::array<double, 6> odd{0x1p-74, -0x1.8p-73, 0x1p-1074, 0x1.0000000000001p-22, -0.0, 7};
    for (int round = 0; round < 3000; ++round) {
        const Lattice lattice{static_cast<int>(random.between(-9, 9))};
        Coordinates points(static_cast<std::size_t>(random.between(1, 600)));
        for (auto& p : points)
            for (double& c : p)
                c = std::ldexp(static_cast<double>(random.coordinate(53)),
                               lattice.exponent - static_cast<int>(random.between(0, 73)));
        const auto last = static_cast<std::int64_t>(points.size()) - 1;
        const auto at = static_cast<std::size_t>(random.between(0, last));
        const double c = odd[static_cast<std::size_t>(random.between(0, 5))];
        points[at][static_cast<std::size_t>(random.between(0, 2))] =
            c == 0x1p-1074 ? c : std::ldexp(c, lattice.exponent);
        const bool moves = c != 7 && c != 0;
        for (const std::uint32_t threads : {1U, 4U}) {
            LatticeReport report;
            const auto out = to_lattice(points, lattice, report, threads, Fractions::Kept);
            EXPECT_EQ(report.moved, moves ? 1U : 0U) << c;
            for (std::size_t i = 0; i < points.size(); ++i)
                for (int k = 0; k < 3; ++k) {
                    const double units =
                        std::ldexp(points[i][static_cast<std::size_t>(k)], -lattice.exponent);
                    const double expected = std::ldexp(std::nearbyint(std::ldexp(units, 73)), -73);
                    ASSERT_EQ(bits(out[i][k].to_double()), bits(expected));
                }
        }
    }
}

TEST(LatticeFractions, AnyNumberOfThreads) {
    oracle::Source random(15);
    Coordinates points(100000);
    for (auto& p : points)
        for (double& c : p) c = static_cast<double>(random.coordinate(53)) * 0x1p-60;
    for (const double odd : {0x1p-20, 0x1p-120, 0x1p-150}) {
        points[99999][2] = odd;
        const Lattice expected = choose_lattice(points, 1, Fractions::Kept);
        LatticeReport report;
        const auto one = to_lattice(points, expected, report, 1, Fractions::Kept);
        EXPECT_EQ(report.lossless, odd != 0x1p-150);
        for (const std::uint32_t threads : {2U, 5U}) {
            EXPECT_EQ(choose_lattice(points, threads, Fractions::Kept), expected);
            LatticeReport again;
            EXPECT_EQ(to_lattice(points, expected, again, threads, Fractions::Kept), one);
            EXPECT_EQ(again.moved, report.moved);
        }
    }
}

}  // namespace
