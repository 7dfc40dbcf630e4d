// SPDX-License-Identifier: Apache-2.0
//
// ExactRational: a fraction of integers of any size, for measures.
// Predicates never use it.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <trisect/kernel/wide_int.h>

namespace trisect {

namespace detail {
struct ExactRationalAccess;
}

/// p/q in lowest terms with q > 0.
///
/// Regular value type; copying allocates. Every operation is exact; `to_double` rounds once.
class ExactRational {
public:
    /// Zero.
    ExactRational() noexcept;
    ExactRational(std::int64_t v);  // NOLINT(google-explicit-constructor): a number is a number
    template <int N>
    explicit ExactRational(const WideInt<N>& v);
    ExactRational(const ExactRational& o);
    ExactRational(ExactRational&& o) noexcept;
    ExactRational& operator=(const ExactRational& o);
    ExactRational& operator=(ExactRational&& o) noexcept;
    ~ExactRational();

    /// "p" or "p/q" in decimal. \throw UsageError for anything else, q = 0 included.
    [[nodiscard]] static ExactRational from_string(const std::string& text);
    /// The double's exact value. \throw UsageError when it is not finite.
    [[nodiscard]] static ExactRational from_double(double v);
    /// ± numerator / denominator from limbs of 64 bits, least significant first.
    /// \throw UsageError when the denominator is 0.
    [[nodiscard]] static ExactRational from_limbs(bool negative,
                                                  std::span<const std::uint64_t> numerator,
                                                  std::span<const std::uint64_t> denominator);

    ExactRational& operator+=(const ExactRational& o);
    ExactRational& operator-=(const ExactRational& o);
    ExactRational& operator*=(const ExactRational& o);
    /// \throw UsageError for division by 0.
    ExactRational& operator/=(const ExactRational& o);
    friend ExactRational operator+(ExactRational a, const ExactRational& b) { return a += b; }
    friend ExactRational operator-(ExactRational a, const ExactRational& b) { return a -= b; }
    friend ExactRational operator*(ExactRational a, const ExactRational& b) { return a *= b; }
    friend ExactRational operator/(ExactRational a, const ExactRational& b) { return a /= b; }
    ExactRational operator-() const { return ExactRational() - *this; }
    /// This times 2^exponent.
    [[nodiscard]] ExactRational scaled(int exponent) const;

    friend bool operator==(const ExactRational& a, const ExactRational& b);
    friend std::strong_ordering operator<=>(const ExactRational& a, const ExactRational& b);

    /// -1, 0 or 1.
    [[nodiscard]] int sign() const;
    [[nodiscard]] bool is_integer() const;
    /// "p" for integers, "p/q" otherwise.
    [[nodiscard]] std::string to_string() const;
    /// The nearest double, ties to even, subnormals included; infinite beyond the largest one.
    [[nodiscard]] double to_double() const;

private:
    friend struct detail::ExactRationalAccess;
    struct Value;
    [[nodiscard]] const Value& value() const;
    [[nodiscard]] Value& mutable_value();

    std::unique_ptr<Value> value_;  // null stands for zero
};

template <int N>
ExactRational::ExactRational(const WideInt<N>& v) : ExactRational() {
    std::array<std::uint64_t, static_cast<std::size_t>(N)> limbs{};
    const WideInt<N> magnitude = v.abs();
    for (int i = 0; i < N; ++i) limbs[static_cast<std::size_t>(i)] = magnitude.limb(i);
    const std::array<std::uint64_t, 1> one{1};
    *this = from_limbs(v.is_negative(), limbs, one);
}

}  // namespace trisect
