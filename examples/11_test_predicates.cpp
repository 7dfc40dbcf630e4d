// SPDX-License-Identifier: Apache-2.0
//
// How good are my predicates? Three of them before the suite of predicate_suite.h: the textbook
// determinant in doubles, the same in long doubles, and the library's. Replace one by your own.
//
//     11_test_predicates [CASES [SEED]]

#include <trisect/kernel/predicate_suite.h>

#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include <trisect/kernel/predicate_suite_side.h>

namespace {

namespace suite = trisect::predicate_suite;
using suite::Point2;
using suite::Point3;

template <class Number>
Number orient2d(const Point2& a, const Point2& b, const Point2& c) {
    const Number x = c[0];
    const Number y = c[1];
    return (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
}

template <class Number>
Number orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    const auto row = [&a](const Point3& p) {
        return std::array<Number, 3>{Number(p[0]) - a[0], Number(p[1]) - a[1], Number(p[2]) - a[2]};
    };
    const auto u = row(b);
    const auto v = row(c);
    const auto w = row(d);
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
           u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// The number of families with a wrong answer.
int print(const std::string& title, const std::vector<suite::Row>& rows) {
    std::cout << title << '\n';
    int bad = 0;
    for (const suite::Row& row : rows) {
        std::cout << "  " << std::left << std::setw(12) << row.family << std::right << std::setw(8)
                  << row.cases << " cases " << std::setw(8) << row.zeros << " zeros "
                  << std::setw(8) << row.wrong << " wrong " << std::setw(8) << row.inconsistent
                  << " inconsistent\n";
        if (row.wrong == 0) continue;
        std::cout << "    first: " << row.first << '\n';
        ++bad;
    }
    return bad;
}

}  // namespace

int main(int argc, char** argv) {
    suite::Options options;
    options.cases = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000;
    options.seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;

    (void)print("orient2d, doubles", suite::test_orient2d(orient2d<double>, options));
    (void)print("orient3d, doubles", suite::test_orient3d(orient3d<double>, options));
    (void)print("orient3d, long doubles", suite::test_orient3d(orient3d<long double>, options));
    const int exact =
        print("orient3d, exact", suite::test_orient3d(suite::exact_orient3d, options));
    return exact + print("side, Trisect", suite::test_side(suite::side_by_trisect, options));
}
