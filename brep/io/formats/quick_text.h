// SPDX-License-Identifier: Apache-2.0
//
// QuickText: fast path for the plain lines of a text file.
// Plain lines (numbers of at most 19 digits, indices, single words, and blanks between them) make
// up nearly all of a file. They are read eight characters at a time. Everything else is refused
// without an error, and TextCursor reads the line again with all checks.
//
// DigitRun: eight bytes minus '0' with a carry test show how many leading ones are digits; shifting
// the others out leaves zeros in front, and three multiplications add the digits up in pairs (D.
// Lemire, Number Parsing at a Gigabyte per Second, 2021, section 4).
//
// Value: w · 10^e with both exact in doubles is one correctly rounded operation (W. Clinger, How to
// Read Floating Point Numbers Accurately, 1990). Longer numbers, such as the shortest digits of a
// double, are divided as integers: 64 bits of quotient and whether anything is left decide the
// rounding. Everything else is refused.
#pragma once

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/polygon_mesh.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace trisect::detail {

/// The digits at the start of eight characters.
struct DigitRun {
    std::uint64_t value = 0;
    unsigned count = 0;
};

inline DigitRun leading_digits(const char* at) noexcept {
    constexpr std::uint64_t ones = 0x0101'0101'0101'0101U;
    std::uint64_t x = 0;
    std::memcpy(&x, at, 8);
    x ^= '0' * ones;
    // The top bit of each byte that is no digit; a carry spoils bytes behind the first of them
    // only.
    const std::uint64_t others = ((x + 0x76 * ones) | x) & (0x80 * ones);
    DigitRun d;
    d.count = static_cast<unsigned>(std::countr_zero(others)) / 8;
    if (d.count == 0) return d;
    x <<= 64 - 8 * d.count;
    x = x * 10 + (x >> 8);
    constexpr std::uint64_t pairs = 0x0000'00FF'0000'00FFU;
    d.value = (((x & pairs) * (100 + (std::uint64_t{1'000'000} << 32))) +
               (((x >> 16) & pairs) * (1 + (std::uint64_t{10'000} << 32)))) >>
              32;
    return d;
}

template <class Number, std::size_t Size>
constexpr std::array<Number, Size> powers_of(unsigned base) {
    std::array<Number, Size> p{1};
    for (std::size_t i = 1; i < Size; ++i) p[i] = p[i - 1] * static_cast<Number>(base);
    return p;
}
inline constexpr auto powers_of_ten = powers_of<std::uint64_t, 20>(10);
inline constexpr auto exact_powers_of_ten = powers_of<double, 23>(10);
inline constexpr auto powers_of_five = powers_of<std::uint64_t, 28>(5);

/// w / 10^k correctly rounded, for w > 0 and k < 28.
inline double quotient_by_power_of_ten(std::uint64_t w, unsigned k) noexcept {
    __extension__ using Wide = unsigned __int128;
    const std::uint64_t power = powers_of_five[k];
    const int w_shift = std::countl_zero(w);
    const int power_shift = std::countl_zero(power);
    const std::uint64_t n = w << w_shift;
    const std::uint64_t d = power << power_shift;
    // n and d have their top bits set; q gets 64 bits in either case.
    const int shift = n >= d ? 63 : 64;
    const Wide numerator = Wide{n} << shift;
    const auto q = static_cast<std::uint64_t>(numerator / d);
    const bool exact = q * d == static_cast<std::uint64_t>(numerator);  // modulo 2^64 suffices
    // The value is q · 2^(power_shift - w_shift - shift - k), with q in [2^63, 2^64).
    std::uint64_t mantissa = q >> 11;
    const std::uint64_t rest = q & 0x7FF;
    if (rest > 0x400 || (rest == 0x400 && (!exact || (mantissa & 1U) != 0))) ++mantissa;
    const int exponent = power_shift - w_shift - shift - static_cast<int>(k) + 11;
    const auto scale = static_cast<std::uint64_t>(exponent + 1023) << 52;
    return static_cast<double>(mantissa) * std::bit_cast<double>(scale);
}

class QuickText {
public:
    /// Lines that begin before end() can be tried.
    explicit QuickText(const InputText& source) {
        const ReadLimits& limits = source.limits();
        const std::string_view bytes = source.bytes();
        end_ = source.begin();
        if (!source.allows_quick() || source.line_end() != '\n') return;
        if (std::endian::native != std::endian::little) return;
        if (limits.line_bytes < longest || limits.literal_characters < 64) return;
        if (bytes.size() < overrun) return;
        // Every scan ends at a line end, and what is loaded beyond is still in the file.
        const std::size_t last = bytes.rfind('\n', bytes.size() - overrun);
        if (last != std::string_view::npos) end_ += last;
    }

    [[nodiscard]] const char* end() const noexcept { return end_; }
    /// Starts to read at `line`, which is before end().
    void begin(const char* line) noexcept { here_ = line_ = line; }
    [[nodiscard]] const char* here() const noexcept { return here_; }

    /// Takes the characters of `word` and at least one blank.
    bool keyword(std::string_view word) noexcept { return take(word) && blanks(); }
    /// The same for the last word of a line.
    bool last_word(std::string_view word) noexcept { return take(word) && blanks_or_line_end(); }
    /// Takes any word of printable characters.
    bool word() noexcept {
        const char* p = here_;
        while (*p > ' ') ++p;
        const bool any = p != here_;
        here_ = p;
        return any && blanks_or_line_end();
    }

    /// Takes a number and the blanks behind it.
    bool number(double& value) noexcept {
        const char* p = here_;
        const bool negative = *p == '-';
        p += negative ? 1 : 0;
        std::uint64_t w = 0;
        unsigned digits = 0;
        unsigned decimals = 0;
        const auto first = static_cast<unsigned char>(*p - '0');
        if (first <= 9 && p[1] == '.') {
            ++p;
            w = first;
            digits = 1;
        } else if (!take_digits(p, w, digits) || digits == 0) {
            return false;
        }
        if (*p == '.') {
            ++p;
            const unsigned before = digits;
            if (!take_digits(p, w, digits)) return false;
            decimals = digits - before;
            if (decimals == 0) return false;
        }
        int exponent = -static_cast<int>(decimals);
        if ((*p == 'e' || *p == 'E') && !take_exponent(p, exponent)) return false;
        here_ = p;
        return blanks_or_line_end() && compose(w, exponent, negative, value);
    }

    /// Takes an integer that is not negative, of at most seven digits; what follows is not looked
    /// at.
    bool integer(std::uint32_t& value) noexcept {
        const DigitRun d = leading_digits(here_);
        here_ += d.count;
        value = static_cast<std::uint32_t>(d.value);
        return d.count - 1 < 7;
    }

    bool take(char c) noexcept {
        if (*here_ != c) return false;
        ++here_;
        return true;
    }

    /// Takes blanks; false when there is something else that is no line end.
    bool blanks_or_line_end() noexcept { return blanks() || *here_ == '\n' || *here_ == '\r'; }

    /// Takes blanks; false when there are none.
    bool blanks() noexcept {
        const char* p = here_;
        while (*p == ' ' || *p == '\t') ++p;
        const bool any = p != here_;
        here_ = p;
        return any;
    }

    /// True at the end of the line.
    [[nodiscard]] bool at_line_end() const noexcept { return *here_ == '\n' || *here_ == '\r'; }

    /// Takes the end of the line; false when something precedes it or the line is long.
    bool line_end() noexcept {
        if (*here_ == '\r') ++here_;
        return take('\n') && here_ - line_ < static_cast<std::ptrdiff_t>(longest);
    }

private:
    bool take(std::string_view word) noexcept {
        if (std::memcmp(here_, word.data(), word.size()) != 0) return false;
        here_ += word.size();
        return true;
    }

    static constexpr std::size_t longest = 4096;
    static constexpr std::size_t overrun = 32;

    /// Appends digits to w; false when it gets more than 19.
    static bool take_digits(const char*& p, std::uint64_t& w, unsigned& digits) noexcept {
        for (;;) {
            const DigitRun d = leading_digits(p);
            if (w >= powers_of_ten[19 - d.count] || digits > 40) return false;
            digits += d.count;
            w = w * powers_of_ten[d.count] + d.value;
            p += d.count;
            if (d.count < 8) return true;
        }
    }

    static bool take_exponent(const char*& p, int& exponent) noexcept {
        ++p;
        const bool negative = *p == '-';
        p += negative || *p == '+' ? 1 : 0;
        const DigitRun d = leading_digits(p);
        if (d.count == 0 || d.count > 3) return false;
        p += d.count;
        const int e = static_cast<int>(d.value);
        exponent += negative ? -e : e;
        return true;
    }

    static bool compose(std::uint64_t w, int exponent, bool negative, double& value) noexcept {
        double v = 0;
        if (w <= std::uint64_t{1} << 53 && exponent >= -22 && exponent <= 22) {
            const double power =
                exact_powers_of_ten[static_cast<std::size_t>(exponent < 0 ? -exponent : exponent)];
            v = exponent < 0 ? static_cast<double>(w) / power : static_cast<double>(w) * power;
        } else if (w > 0 && exponent <= 0 && exponent > -28) {
            v = quotient_by_power_of_ten(w, static_cast<unsigned>(-exponent));
        } else {
            return false;
        }
        const std::uint64_t sign = negative ? std::uint64_t{1} << 63 : 0;
        value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(v) | sign);
        return true;
    }

    const char* end_ = nullptr;
    const char* line_ = nullptr;
    const char* here_ = nullptr;
};

}  // namespace trisect::detail
