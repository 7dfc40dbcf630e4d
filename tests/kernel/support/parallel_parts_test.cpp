// SPDX-License-Identifier: Apache-2.0
//
// Work in parts: every number once, the failure of the first part that fails, and loops that give
// the same for any number of threads.

#include <trisect/kernel/support/parallel_parts.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>

namespace {

using trisect::detail::both_at_once;
using trisect::detail::on_threads;
using trisect::detail::ParallelParts;
using trisect::detail::PartsOfRanges;

TEST(ParallelParts, CoverEveryNumberOnce) {
    for (const std::size_t size : {0UL, 1UL, 2UL, 7UL, 1000UL, 4097UL}) {
        for (const std::uint32_t threads : {0U, 1U, 2U, 5U}) {
            const ParallelParts parts(size, threads, 3);
            std::vector<int> seen(size);
            std::vector<int> of_part(parts.count());
            parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
                ++of_part[part];
                for (std::size_t i = begin; i < end; ++i) ++seen[i];
            });
            EXPECT_EQ(seen, std::vector<int>(size, 1));
            EXPECT_EQ(of_part, std::vector<int>(parts.count(), 1));
        }
    }
}

TEST(PartsOfRanges, CoverEveryNumberOfEachRangeOnce) {
    const std::vector<std::size_t> sizes{0, 5, 4097, 1, 0, 300, 12, 2000};
    for (const std::uint32_t threads : {0U, 1U, 2U, 5U}) {
        const PartsOfRanges parts(
            sizes.size(), [&](std::size_t r) { return sizes[r]; }, threads, 100);
        std::vector<std::vector<int>> seen;
        for (const std::size_t size : sizes) seen.emplace_back(size);
        std::vector<PartsOfRanges::Part> in_order(parts.count());
        parts.for_each([&](std::size_t number, const PartsOfRanges::Part& p) {
            in_order[number] = p;
            EXPECT_EQ(p.is_whole, p.begin == 0 && p.end == sizes[p.range]);
            for (std::size_t i = p.begin; i < p.end; ++i) ++seen[p.range][i];
        });
        for (std::size_t r = 0; r < sizes.size(); ++r)
            EXPECT_EQ(seen[r], std::vector<int>(sizes[r], 1));
        for (std::size_t k = 1; k < in_order.size(); ++k)
            EXPECT_TRUE(in_order[k - 1].range < in_order[k].range ||
                        in_order[k - 1].end == in_order[k].begin);
        if (threads == 1) {
            EXPECT_EQ(parts.count(), sizes.size());
        }
    }
}

TEST(ParallelParts, FewNumbersAreOnePartOfTheCallingThread) {
    const auto caller = std::this_thread::get_id();
    for (const ParallelParts& parts : {ParallelParts(1999, 4, 1000), ParallelParts(9999, 1, 1)}) {
        EXPECT_EQ(parts.count(), 1U);
        parts.for_each([&](std::size_t, std::size_t, std::size_t) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
        });
    }
    EXPECT_EQ(ParallelParts(2000, 2, 1000).count(), 2U);
}

TEST(ParallelParts, ThrowWhatTheFirstPartThatFailsThrows) {
    for (int round = 0; round < 200; ++round) {
        const ParallelParts parts(1000, 4, 10);
        ASSERT_GT(parts.count(), 8U);
        try {
            parts.for_each([](std::size_t part, std::size_t, std::size_t) {
                if (part >= 3) throw std::runtime_error(std::to_string(part));
            });
            FAIL() << "no failure";
        } catch (const std::runtime_error& e) {
            ASSERT_STREQ(e.what(), "3");
        }
    }
}

TEST(ParallelParts, TwoThingsAtOnce) {
    on_threads(2, [](std::uint32_t) {
        for (int round = 0; round < 200; ++round) {
            int a = 0;
            int b = 0;
            both_at_once([&] { a = 1; }, [&] { b = 1; });
            EXPECT_EQ(a + b, 2);
            const auto fail = [](const char* what) { throw std::runtime_error(what); };
            try {
                both_at_once([&] { fail("first"); }, [&] { fail("second"); });
                ADD_FAILURE() << "no failure";
            } catch (const std::runtime_error& e) {
                EXPECT_STREQ(e.what(), "first");
            }
            EXPECT_THROW(both_at_once([] {}, [&] { fail("second"); }), std::runtime_error);
        }
        return 0;
    });
}

// Measured coordinates, numbers with a common unit, and one that has no place.
TEST(ParallelParts, LatticesDoNotDependOnThreads) {
    std::mt19937_64 random(1);
    for (const bool measured : {true, false}) {
        std::vector<std::array<double, 3>> points(60000);
        for (auto& p : points)
            for (double& c : p) {
                c = static_cast<double>(random() >> 40) * 0x1p-20;
                if (measured) c = std::sqrt(c);
            }
        points[50000][1] = 0x1p-22;
        const trisect::Lattice lattice = trisect::choose_lattice(points, 1);
        trisect::LatticeReport one;
        const auto expected = trisect::to_lattice(points, lattice, one, 1);
        for (const std::uint32_t threads : {0U, 2U, 8U}) {
            EXPECT_EQ(trisect::choose_lattice(points, threads), lattice);
            trisect::LatticeReport report;
            EXPECT_EQ(trisect::to_lattice(points, lattice, report, threads), expected);
            EXPECT_EQ(report.moved, one.moved);
            EXPECT_EQ(report.max_move, one.max_move);
            EXPECT_EQ(report.lossless, one.lossless);
        }
        EXPECT_EQ(one.lossless, !measured);
        points[59999][0] = points[40000][2] = HUGE_VAL;
        for (const std::uint32_t threads : {1U, 2U, 8U}) {
            EXPECT_EQ(trisect::choose_lattice(points, threads), lattice);
            trisect::LatticeReport report;
            try {
                (void)trisect::to_lattice(points, lattice, report, threads);
                ADD_FAILURE() << "no failure";
            } catch (const trisect::LimitError& e) {
                EXPECT_NE(std::string(e.what()).find("vertex 40000:"), std::string::npos);
            }
        }
    }
}

}  // namespace
