// SPDX-License-Identifier: Apache-2.0
//
// Tests of orientation predicates on inputs where doubles fail.
//
// This one file needs nothing but the standard library: copy it beside your own code, or include it
// from an installed Trisect. You pass a function, the suite passes it points or planes from named
// families, compares each answer with the exact sign, and says where the first wrong one was:
//
//     #include <trisect/kernel/predicate_suite.h>
//     using trisect::predicate_suite::Point3;
//     const auto mine = [](const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
//         return my_orient3d(a.data(), b.data(), c.data(), d.data());  // its sign counts
//     };
//     for (const auto& row : trisect::predicate_suite::test_orient3d(mine))
//         std::printf("%-16s %d of %d wrong\n", row.family, int(row.wrong), int(row.cases));
//
// The expected signs come from integers as long as they need to be (class Integer below: schoolbook
// products, no filter), so they are slow and simple. Inputs are made of integers and powers of two:
// the same seed gives the same bits on every machine, whatever the compiler does to doubles.
//
// The families go back to Kettner, Mehlhorn, Pion, Schirra and Yap, "Classroom examples of
// robustness problems in geometric computations" (2008), and to the limits that Shewchuk states for
// his predicates (1997): no product overflows or underflows. `tiny` and `huge` break these.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trisect::predicate_suite {

using Point2 = std::array<double, 2>;
using Point3 = std::array<double, 3>;
/// a x + b y + c z + d = 0 with integer coefficients below 2^53; Above is where the sum is
/// positive.
using PlaneEquation = std::array<double, 4>;

// ---------------------------------------------------------------- exact signs

/// A signed integer of any length. Slow on purpose: it is what the fast ones are compared with.
class Integer {
public:
    Integer() = default;
    /// mantissa · 2^shift, shift >= 0.
    Integer(std::int64_t mantissa, int shift) : negative_(mantissa < 0) {
        std::uint64_t m = negative_ ? std::uint64_t{0} - static_cast<std::uint64_t>(mantissa)
                                    : static_cast<std::uint64_t>(mantissa);
        if (m == 0) return;
        digits_.assign(static_cast<std::size_t>(shift / 32), 0);
        std::uint64_t carry = 0;
        for (const int bits = shift % 32; m != 0 || carry != 0; m >>= 32) {
            const std::uint64_t v = ((m & 0xffffffffU) << bits) | carry;
            digits_.push_back(static_cast<std::uint32_t>(v));
            carry = v >> 32;
        }
        trim();
    }

    [[nodiscard]] int sign() const { return digits_.empty() ? 0 : (negative_ ? -1 : 1); }

    friend Integer operator-(Integer a) {
        a.negative_ = !a.negative_;
        return a;
    }
    friend Integer operator+(const Integer& a, const Integer& b) {
        if (a.negative_ == b.negative_) return sum(a, b);
        return compare(a, b) >= 0 ? difference(a, b) : difference(b, a);
    }
    friend Integer operator-(const Integer& a, const Integer& b) { return a + (-b); }
    friend Integer operator*(const Integer& a, const Integer& b) {
        Integer out;
        out.negative_ = a.negative_ != b.negative_;
        out.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
        for (std::size_t i = 0; i < a.digits_.size(); ++i) {
            std::uint64_t carry = 0;
            for (std::size_t j = 0; j < b.digits_.size(); ++j) {
                carry += out.digits_[i + j] + std::uint64_t{a.digits_[i]} * b.digits_[j];
                out.digits_[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32;
            }
            out.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
        }
        out.trim();
        return out;
    }

private:
    // Of magnitudes.
    static int compare(const Integer& a, const Integer& b) {
        if (a.digits_.size() != b.digits_.size())
            return a.digits_.size() < b.digits_.size() ? -1 : 1;
        for (std::size_t i = a.digits_.size(); i-- > 0;)
            if (a.digits_[i] != b.digits_[i]) return a.digits_[i] < b.digits_[i] ? -1 : 1;
        return 0;
    }
    // Of magnitudes; the sign is a's.
    static Integer sum(const Integer& a, const Integer& b) {
        Integer out = a;
        out.digits_.resize(std::max(a.digits_.size(), b.digits_.size()) + 1, 0);
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < out.digits_.size(); ++i) {
            carry += std::uint64_t{out.digits_[i]} + (i < b.digits_.size() ? b.digits_[i] : 0U);
            out.digits_[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        out.trim();
        return out;
    }
    // |a| - |b| for |a| >= |b|; the sign is a's.
    static Integer difference(const Integer& a, const Integer& b) {
        Integer out = a;
        std::int64_t borrow = 0;
        for (std::size_t i = 0; i < out.digits_.size(); ++i) {
            borrow += std::int64_t{out.digits_[i]} -
                      (i < b.digits_.size() ? std::int64_t{b.digits_[i]} : 0);
            out.digits_[i] = static_cast<std::uint32_t>(borrow & 0xffffffff);
            borrow = borrow < 0 ? -1 : 0;
        }
        out.trim();
        return out;
    }
    void trim() {
        while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
        if (digits_.empty()) negative_ = false;
    }

    bool negative_ = false;
    std::vector<std::uint32_t> digits_;  // the lowest first
};

namespace detail {

/// The doubles as integers in one common unit, which does not change a sign.
template <std::size_t Rows, std::size_t Columns>
std::array<std::array<Integer, Columns>, Rows> integers(
    const std::array<std::array<double, Columns>, Rows>& m) {
    const auto exponent_of = [](double x) {
        int e = 0;
        (void)std::frexp(x, &e);
        return e - 53;
    };
    int unit = 2000;
    for (const auto& row : m)
        for (const double x : row)
            if (x != 0) unit = std::min(unit, exponent_of(x));
    std::array<std::array<Integer, Columns>, Rows> out;
    for (std::size_t i = 0; i < Rows; ++i) {
        for (std::size_t j = 0; j < Columns; ++j) {
            const double x = m[i][j];
            if (x == 0) continue;
            const int e = exponent_of(x);
            out[i][j] = Integer(static_cast<std::int64_t>(std::ldexp(x, -e)), e - unit);
        }
    }
    return out;
}

inline Integer det2(const Integer& a, const Integer& b, const Integer& c, const Integer& d) {
    return a * d - b * c;
}

inline Integer det3(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b,
                    const std::array<Integer, 3>& c) {
    return a[0] * det2(b[1], b[2], c[1], c[2]) - a[1] * det2(b[0], b[2], c[0], c[2]) +
           a[2] * det2(b[0], b[1], c[0], c[1]);
}

inline std::array<Integer, 3> minus(const std::array<Integer, 3>& a,
                                    const std::array<Integer, 3>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline std::array<Integer, 3> without(const std::array<Integer, 4>& a, std::size_t left_out) {
    std::array<Integer, 3> out;
    for (std::size_t i = 0, k = 0; i < 4; ++i)
        if (i != left_out) out[k++] = a[i];
    return out;
}

}  // namespace detail

/// 1 when a, b, c turn to the left, -1 to the right, 0 when they are on one line.
[[nodiscard]] inline int exact_orient2d(const Point2& a, const Point2& b, const Point2& c) {
    const auto m = detail::integers<3, 2>({a, b, c});
    return detail::det2(m[0][0] - m[2][0], m[0][1] - m[2][1], m[1][0] - m[2][0], m[1][1] - m[2][1])
        .sign();
}

/// 1 when d is above the plane through a, b, c, which run counter-clockwise seen from above.
[[nodiscard]] inline int exact_orient3d(const Point3& a, const Point3& b, const Point3& c,
                                        const Point3& d) {
    const auto m = detail::integers<4, 3>({a, b, c, d});
    return detail::det3(detail::minus(m[1], m[0]), detail::minus(m[2], m[0]),
                        detail::minus(m[3], m[0]))
        .sign();
}

/// The side of s on which the common point of p, q, r lies; nothing when they have not exactly one.
[[nodiscard]] inline std::optional<int> exact_side(const PlaneEquation& p, const PlaneEquation& q,
                                                   const PlaneEquation& r, const PlaneEquation& s) {
    const auto m = detail::integers<4, 4>({p, q, r, s});
    const auto minor = [&m](std::size_t i) {
        return detail::det3(detail::without(m[0], i), detail::without(m[1], i),
                            detail::without(m[2], i));
    };
    const Integer w = minor(3);
    if (w.sign() == 0) return std::nullopt;
    const Integer det = m[3][3] * w - m[3][2] * minor(2) + m[3][1] * minor(1) - m[3][0] * minor(0);
    return det.sign() * w.sign();
}

// ---------------------------------------------------------------- families

/// The inputs: every family is a way to come near a zero, or to leave the range of doubles.
class Generator {
public:
    explicit Generator(std::uint64_t seed) : state_(seed) {}

    static constexpr std::array<const char*, 10> orient2d_families{
        "general", "grid",   "line",       "line-ulps", "classroom",
        "twins",   "needle", "line-units", "tiny",      "huge"};
    static constexpr std::array<const char*, 11> orient3d_families{
        "general", "grid",        "plane", "plane-ulps", "classroom", "twins",
        "needle",  "plane-units", "mixed", "tiny",       "huge"};
    static constexpr std::array<const char*, 6> side_families{"general",    "grid",   "point",
                                                              "near-point", "pencil", "parallel"};

    std::array<Point2, 3> orient2d(std::size_t family) {
        std::array<Point2, 3> out{};
        affine<2, 3>(family, out);
        return out;
    }
    std::array<Point3, 4> orient3d(std::size_t family) {
        std::array<Point3, 4> out{};
        // `mixed` stands before `tiny` here and is missing in the plane.
        if (family == 8) {
            for (auto& p : out) {
                for (double& x : p) {
                    const int exponent = between(-150, 100);  // a statement each: one order
                    x = std::ldexp(mantissa(53), exponent);
                }
            }
            if (coin()) out[3] = out[static_cast<std::size_t>(between(0, 2))];
            return out;
        }
        affine<3, 4>(family > 8 ? family - 1 : family, out);
        return out;
    }
    std::array<PlaneEquation, 4> planes(std::size_t family) {
        std::array<PlaneEquation, 4> out{};
        const int bits = family == 1 ? between(1, 3) : between(2, 24);
        for (auto& p : out)
            for (double& x : p) x = mantissa(bits);
        if (family == 2 || family == 3) through_a_point(out, bits, family == 3);
        if (family == 4 || family == 5) combine_last(out, family == 5);
        return out;
    }

private:
    std::uint64_t bits() {  // splitmix64 (Steele, Lea, Flood 2014)
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    }
    int between(int low, int high) {
        return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
    }
    bool coin() { return (bits() >> 63) != 0; }
    // An integer below 2^n.
    double mantissa(int n) {
        const auto m = static_cast<double>(bits() >> (64 - n));
        return coin() ? m : -m;
    }
    double nudged(double x, int steps) {
        for (int k = between(-steps, steps); k != 0; k += k < 0 ? 1 : -1)
            x = std::nextafter(x, k < 0 ? -HUGE_VAL : HUGE_VAL);
        return x;
    }

    // base + i u + j v, all integers: exactly in the line or plane through base, u, v.
    template <std::size_t D, std::size_t N>
    void combinations(std::array<std::array<double, D>, N>& out, int size) {
        std::array<std::array<double, D>, D> span{};
        for (auto& p : span)
            for (double& x : p) x = mantissa(size);
        for (auto& p : out) {
            std::array<double, D> k{};
            for (std::size_t j = 1; j < D; ++j) k[j] = between(-4, 4);
            for (std::size_t i = 0; i < D; ++i) {
                p[i] = span[0][i];
                for (std::size_t j = 1; j < D; ++j) p[i] += k[j] * span[j][i];
            }
        }
    }

    template <std::size_t D, std::size_t N>
    void affine(std::size_t family, std::array<std::array<double, D>, N>& out) {
        const auto fill = [&](int size) {
            for (auto& p : out)
                for (double& x : p) x = mantissa(size);
        };
        const auto each = [&](auto&& change) {
            for (auto& p : out)
                for (double& x : p) x = change(x);
        };
        switch (family) {
            case 0:
                fill(53);
                break;
            case 1:
                fill(between(1, 3));
                break;
            case 2:
                combinations(out, between(2, 48));
                break;
            case 3:
                combinations(out, between(2, 48));
                for (double& x : out[N - 1]) x = nudged(x, 1);
                break;
            case 4:  // one point on a grid of ulps, the others far out on the diagonal
                out[0].fill(0.5);
                for (double& x : out[0]) x += static_cast<double>(between(0, 255)) * 0x1p-53;
                for (std::size_t k = 1; k < N; ++k) {
                    const int far = between(1, 40);
                    for (double& x : out[k]) x = far;
                    if (k > 2) out[k][static_cast<std::size_t>(between(0, D - 1))] += 1;
                }
                break;
            case 5:
                fill(between(2, 53));
                out[N - 1] = out[static_cast<std::size_t>(between(0, N - 2))];
                for (double& x : out[N - 1]) x = nudged(x, 1);
                break;
            case 6:  // all others near the middle of the first two
                combinations(out, between(20, 48));
                for (std::size_t k = 2; k < N; ++k)
                    for (std::size_t i = 0; i < D; ++i)
                        out[k][i] = nudged((out[0][i] + out[1][i]) * 0.5, 3);
                break;
            case 7:  // exact coincidences missed by one unit
                combinations(out, between(2, 48));
                for (double& x : out[N - 1]) x += between(-1, 1);
                break;
            default: {  // products leave the range of doubles, the points do not
                combinations(out, between(2, 30));
                if (coin()) each([&](double x) { return nudged(x, 1); });
                const int far = family == 8 ? between(-460, -370) : between(345, 450);
                each([&](double x) { return std::ldexp(x, far); });
            }
        }
    }

    // Moves the offsets so that all planes contain one integer point, or miss it by one.
    void through_a_point(std::array<PlaneEquation, 4>& out, int size, bool miss) {
        const Point3 x{mantissa(size), mantissa(size), mantissa(size)};
        for (auto& p : out) p[3] = -(p[0] * x[0] + p[1] * x[1] + p[2] * x[2]);
        if (miss) out[static_cast<std::size_t>(between(0, 3))][3] += coin() ? 1 : -1;
    }
    // The last plane passes through the line of the first two, or is nearly parallel to the first.
    void combine_last(std::array<PlaneEquation, 4>& out, bool parallel) {
        const double i = between(1, 4);
        const double j = parallel ? 0 : between(-4, 4);
        for (std::size_t k = 0; k < 4; ++k) out[3][k] = i * out[0][k] + j * out[1][k];
        if (coin()) out[3][static_cast<std::size_t>(between(0, 3))] += between(-1, 1);
    }

    std::uint64_t state_;
};

// ---------------------------------------------------------------- the test

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t cases = 10000;  ///< in each family
};

/// What one family showed.
struct Row {
    const char* family = "";
    std::uint64_t cases = 0;
    std::uint64_t zeros = 0;         ///< of them, cases whose exact sign is 0
    std::uint64_t wrong = 0;         ///< another sign than the exact one
    std::uint64_t inconsistent = 0;  ///< two arguments swapped, and the sign did not turn
    /// The first wrong answer: the arguments as hexadecimal doubles, and both signs.
    std::string first;
};

namespace detail {

template <class Number>
int sign_of(const Number& x) {
    return (x > Number(0) ? 1 : 0) - (x < Number(0) ? 1 : 0);
}

template <class Input>
std::string describe(const Input& input, int answer, int expected) {
    std::string text = "answer " + std::to_string(answer) + ", exactly " + std::to_string(expected);
    char number[40];
    for (const auto& row : input) {
        text += " (";
        for (const double x : row) {
            (void)std::snprintf(number, sizeof number, "%a ", x);
            text += number;
        }
        text.back() = ')';
    }
    return text;
}

inline void book(Row& row, int answer, int swapped, int expected, const auto& input) {
    ++row.cases;
    if (expected == 0) ++row.zeros;
    if (answer != -swapped) ++row.inconsistent;
    if (answer == expected) return;
    if (row.wrong++ == 0) row.first = describe(input, answer, expected);
}

}  // namespace detail

/// f(a, b, c) for points of the plane; its sign, positive for a left turn, or the opposite: which
/// of both is meant is asked once.
template <class F>
std::vector<Row> test_orient2d(F&& f, const Options& options = {}) {
    const int convention =
        detail::sign_of(f(Point2{0, 0}, Point2{1, 0}, Point2{0, 1})) < 0 ? -1 : 1;
    Generator generator(options.seed);
    std::vector<Row> rows;
    for (std::size_t k = 0; k < Generator::orient2d_families.size(); ++k) {
        Row row;
        row.family = Generator::orient2d_families[k];
        for (std::uint64_t n = 0; n < options.cases; ++n) {
            const auto p = generator.orient2d(k);
            detail::book(row, convention * detail::sign_of(f(p[0], p[1], p[2])),
                         convention * detail::sign_of(f(p[1], p[0], p[2])),
                         exact_orient2d(p[0], p[1], p[2]), p);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// f(a, b, c, d) for points of space; its sign, positive when d is above a, b, c, or the opposite.
template <class F>
std::vector<Row> test_orient3d(F&& f, const Options& options = {}) {
    const int convention =
        detail::sign_of(f(Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, 1, 0}, Point3{0, 0, 1})) < 0
            ? -1
            : 1;
    Generator generator(options.seed);
    std::vector<Row> rows;
    for (std::size_t k = 0; k < Generator::orient3d_families.size(); ++k) {
        Row row;
        row.family = Generator::orient3d_families[k];
        for (std::uint64_t n = 0; n < options.cases; ++n) {
            const auto p = generator.orient3d(k);
            detail::book(row, convention * detail::sign_of(f(p[0], p[1], p[2], p[3])),
                         convention * detail::sign_of(f(p[1], p[0], p[2], p[3])),
                         exact_orient3d(p[0], p[1], p[2], p[3]), p);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// f(p, q, r, s): the side of s on which the common point of the planes p, q, r lies. Called only
/// where they meet in one point. "Swapped" is s turned over.
template <class F>
std::vector<Row> test_side(F&& f, const Options& options = {}) {
    Generator generator(options.seed);
    std::vector<Row> rows;
    for (std::size_t k = 0; k < Generator::side_families.size(); ++k) {
        Row row;
        row.family = Generator::side_families[k];
        for (std::uint64_t n = 0; n < options.cases; ++n) {
            const auto p = generator.planes(k);
            const auto expected = exact_side(p[0], p[1], p[2], p[3]);
            const bool is_plane = p[3][0] != 0 || p[3][1] != 0 || p[3][2] != 0;
            if (!expected || !is_plane) continue;
            const PlaneEquation turned{-p[3][0], -p[3][1], -p[3][2], -p[3][3]};
            detail::book(row, detail::sign_of(f(p[0], p[1], p[2], p[3])),
                         detail::sign_of(f(p[0], p[1], p[2], turned)), *expected, p);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace trisect::predicate_suite
