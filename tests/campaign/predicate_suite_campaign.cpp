// SPDX-License-Identifier: Apache-2.0
//
// The suite of kernel/predicate_suite.h over CGAL's predicates and ours:
//
//     predicate_suite_campaign [--seed S] [--cases N]
//
// N cases in each family. CGAL's exact-predicates kernel has to be right wherever no product leaves
// the range of doubles; its exact-constructions kernel everywhere; side_of of ours everywhere.
// Exits with 1 when one of these is not. CGAL's plain doubles are shown for comparison. Prints a
// row a predicate: cases, zeros, wrong.

#include <trisect/kernel/predicate_suite.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <trisect/kernel/predicate_suite_side.h>

namespace {

namespace suite = trisect::predicate_suite;
using suite::PlaneEquation;
using suite::Point2;
using suite::Point3;

template <class Kernel>
int orient2d(const Point2& a, const Point2& b, const Point2& c) {
    const auto p = [](const Point2& x) { return typename Kernel::Point_2(x[0], x[1]); };
    return static_cast<int>(CGAL::orientation(p(a), p(b), p(c)));
}

template <class Kernel>
int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    const auto p = [](const Point3& x) { return typename Kernel::Point_3(x[0], x[1], x[2]); };
    return static_cast<int>(CGAL::orientation(p(a), p(b), p(c), p(d)));
}

int side_by_cgal(const PlaneEquation& p, const PlaneEquation& q, const PlaneEquation& r,
                 const PlaneEquation& s) {
    using Number = CGAL::Epeck::FT;
    const auto number = [](double x) { return Number(x); };
    const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {
        return CGAL::determinant(number(p[i]), number(p[j]), number(p[k]), number(q[i]),
                                 number(q[j]), number(q[k]), number(r[i]), number(r[j]),
                                 number(r[k]));
    };
    const Number w = minor(0, 1, 2);
    const Number sum = number(s[3]) * w - number(s[2]) * minor(0, 1, 3) +
                       number(s[1]) * minor(0, 2, 3) - number(s[0]) * minor(1, 2, 3);
    return static_cast<int>(CGAL::sign(sum)) * static_cast<int>(CGAL::sign(w));
}

/// What has to be right.
enum class Claim { Nothing, InRange, Everything };

bool is_out_of_range(const std::string& family) { return family == "tiny" || family == "huge"; }

// Prints a row; whether the claim holds.
bool show(const char* name, Claim claim, const std::vector<suite::Row>& rows) {
    suite::Row sum;
    std::uint64_t broken = 0;
    for (const suite::Row& row : rows) {
        sum.cases += row.cases;
        sum.zeros += row.zeros;
        sum.wrong += row.wrong;
        const bool counts =
            claim == Claim::Everything || (claim == Claim::InRange && !is_out_of_range(row.family));
        if (!counts || row.wrong + row.inconsistent == 0) continue;
        broken += row.wrong + row.inconsistent;
        std::fprintf(stderr, "%s, %s: %s\n", name, row.family, row.first.c_str());
    }
    std::printf("| %s | %llu | %llu | %llu |\n", name, static_cast<unsigned long long>(sum.cases),
                static_cast<unsigned long long>(sum.zeros),
                static_cast<unsigned long long>(sum.wrong));
    return broken == 0;
}

suite::Options parse(int argc, char** argv) {
    suite::Options options;
    for (int i = 1; i + 1 < argc; i += 2) {
        const auto value = std::strtoull(argv[i + 1], nullptr, 10);
        if (std::strcmp(argv[i], "--seed") == 0) {
            options.seed = value;
        } else if (std::strcmp(argv[i], "--cases") == 0) {
            options.cases = value;
        } else {
            std::fprintf(stderr, "usage: predicate_suite_campaign [--seed S] [--cases N]\n");
            std::exit(2);
        }
    }
    return options;
}

}  // namespace

int main(int argc, char** argv) {
    using Doubles = CGAL::Simple_cartesian<double>;
    const suite::Options o = parse(argc, argv);
    std::printf("| predicate | cases | zeros | wrong |\n|---|---:|---:|---:|\n");
    bool good = true;
    const auto row = [&good](const char* name, Claim claim, const std::vector<suite::Row>& rows) {
        good = show(name, claim, rows) && good;
    };
    row("orient2d, doubles", Claim::Nothing, suite::test_orient2d(orient2d<Doubles>, o));
    row("orient2d, CGAL Epick", Claim::InRange, suite::test_orient2d(orient2d<CGAL::Epick>, o));
    row("orient2d, CGAL Epeck", Claim::Everything, suite::test_orient2d(orient2d<CGAL::Epeck>, o));
    row("orient3d, doubles", Claim::Nothing, suite::test_orient3d(orient3d<Doubles>, o));
    row("orient3d, CGAL Epick", Claim::InRange, suite::test_orient3d(orient3d<CGAL::Epick>, o));
    row("orient3d, CGAL Epeck", Claim::Everything, suite::test_orient3d(orient3d<CGAL::Epeck>, o));
    row("side, CGAL Epeck", Claim::Everything, suite::test_side(side_by_cgal, o));
    row("side, Trisect", Claim::Everything, suite::test_side(suite::side_by_trisect, o));
    return good ? 0 : 1;
}
