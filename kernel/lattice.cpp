// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/lattice.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include <trisect/kernel/error.h>
#include <trisect/kernel/number/power_of_two.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/ready_memory.h>
#include <trisect/kernel/support/wide_clones.h>

namespace trisect {

using detail::is_normal_exponent;
using detail::power_of_two;

namespace {

constexpr std::uint64_t mantissa_bits = (std::uint64_t{1} << 52) - 1;
constexpr std::uint64_t magnitude_bits = ~std::uint64_t{0} >> 1;
constexpr std::uint64_t infinity_bits = std::uint64_t{0x7ff} << 52;

// Magnitudes of finite doubles compare as their bits do.
std::uint64_t magnitude(double v) { return std::bit_cast<std::uint64_t>(v) & magnitude_bits; }

// Exponent of the lowest set bit of a finite non-zero double.
int lowest_bit(double v) {
    const std::uint64_t bits = magnitude(v);
    const auto field = static_cast<int>(bits >> 52);  // 0: subnormal, exponent as if it were 1
    const std::uint64_t leading = field == 0 ? 0 : mantissa_bits + 1;
    return std::max(field, 1) - 1075 + std::countr_zero((bits & mantissa_bits) | leading);
}

double scaled(double v, int e) {
    return is_normal_exponent(e) ? v * power_of_two(e) : std::ldexp(v, e);
}

int floor_to_multiple_of_8(int e) { return (e >= 0 ? e / 8 : -((-e + 7) / 8)) * 8; }
int ceil_to_multiple_of_8(int e) { return -floor_to_multiple_of_8(-e); }

using Coordinates = std::span<const std::array<double, 3>>;

// Fewer points are not worth a part of their own.
constexpr std::size_t least_part = 16384;

// Infinity where some coordinate is infinite.
double largest_magnitude(Coordinates points) {
    // Comparisons with what is not a number are false, and infinity shows at the end.
    double x = 0;
    double y = 0;
    double z = 0;
    for (const auto& p : points) {
        x = std::max(x, std::fabs(p[0]));
        y = std::max(y, std::fabs(p[1]));
        z = std::max(z, std::fabs(p[2]));
    }
    return std::max({x, y, z});
}

double largest_finite(Coordinates points, std::uint32_t threads) {
    const detail::ParallelParts parts(points.size(), threads, least_part);
    std::vector<double> largest_of(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        largest_of[part] = largest_magnitude(points.subspan(begin, end - begin));
    });
    const double most = *std::ranges::max_element(largest_of);
    if (std::isfinite(most)) return most;
    std::uint64_t largest = 0;
    for (const auto& p : points)
        for (const double c : p) {
            const std::uint64_t m = magnitude(c);
            largest = std::max(largest, m < infinity_bits ? m : 0);
        }
    return std::bit_cast<double>(largest);
}

// Rounding to integers by addition: the sum of this and a double below 2^51 lies between 2^52 and
// 2^53, where doubles are the integers, and its bits count them.
constexpr double rounder = 0x1.8p52;

// Many points are rounded at once, as long as that changes nothing.
constexpr std::size_t block_size = 256;

struct RoundedBlock {
    bool is_exact = false;   ///< all are integers below 2^51 already
    std::uint64_t bits = 0;  ///< of all integers
};

// Rounds a multiple of four points, four coordinates at a time: a point is three, without gaps.
TRISECT_WIDE_CLONES RoundedBlock round_fours(const std::array<double, 3>* points, std::size_t n,
                                             double factor, LatticePoint* out) {
    using Reals = double __attribute__((vector_size(32)));
    using Integers = std::int64_t __attribute__((vector_size(32)));
    static_assert(sizeof(LatticePoint) == sizeof(std::array<double, 3>));
    const auto* from = reinterpret_cast<const std::byte*>(points);
    auto* to = reinterpret_cast<std::byte*>(out);
    Integers off{};  // bits of differences: 0 when there are none
    Integers all{};
    Integers in_range = ~Integers{};
    for (const auto* const end = from + n * sizeof(LatticePoint); from != end;
         from += sizeof(Reals), to += sizeof(Reals)) {
        Reals v;
        std::memcpy(&v, from, sizeof(v));
        const Reals units = v * factor;
        const Reals sum = units + rounder;
        const Reals rounded = sum - rounder;
        off |= reinterpret_cast<Integers>(rounded - units);
        all |= reinterpret_cast<Integers>(sum) - std::bit_cast<std::int64_t>(rounder);
        in_range &= (units < 0x1p51) & (units > -0x1p51);
        std::memcpy(to, &rounded, sizeof(rounded));
    }
    RoundedBlock block;
    std::int64_t any_off = 0;
    std::int64_t bits = 0;
    std::int64_t all_in_range = -1;
    for (std::size_t i = 0; i < 4; ++i) {
        any_off |= off[i];
        bits |= all[i];
        all_in_range &= in_range[i];
    }
    block.is_exact = any_off == 0 && all_in_range != 0;
    block.bits = static_cast<std::uint64_t>(bits);
    return block;
}

// The same for up to block_size points.
RoundedBlock round_block(Coordinates points, double factor, LatticePoint* out) {
    if (points.size() % 4 == 0) return round_fours(points.data(), points.size(), factor, out);
    std::array<std::array<double, 3>, block_size> padded{};
    std::array<LatticePoint, block_size> rounded;
    std::ranges::copy(points, padded.begin());
    const RoundedBlock block =
        round_fours(padded.data(), (points.size() + 3) / 4 * 4, factor, rounded.data());
    std::copy_n(rounded.begin(), points.size(), out);
    return block;
}

// Doubles below this are multiples of 2^-fraction_limit when adding and subtracting it changes
// nothing; all others are.
constexpr double fraction_rounder = 0x1p-21;
static_assert(fraction_limit == 21 + 52);

// The nearest multiple of 2^-fraction_limit, ties to even.
double rounded_fraction(double units) {
    const double size = std::fabs(units);
    if (!(size < fraction_rounder)) return units;
    return std::copysign(size + fraction_rounder - fraction_rounder, units);
}

// Scales a multiple of four points. False when some coordinate is out of range, not a multiple of
// 2^-fraction_limit, or underflows.
TRISECT_WIDE_CLONES bool scale_fours(const std::array<double, 3>* points, std::size_t n,
                                     double factor, LatticePoint* out) {
    using Reals = double __attribute__((vector_size(32)));
    using Integers = std::int64_t __attribute__((vector_size(32)));
    const auto* from = reinterpret_cast<const std::byte*>(points);
    auto* to = reinterpret_cast<std::byte*>(out);
    Integers all_good = ~Integers{};
    for (const auto* const end = from + n * sizeof(LatticePoint); from != end;
         from += sizeof(Reals), to += sizeof(Reals)) {
        Reals v;
        std::memcpy(&v, from, sizeof(v));
        const Reals units = v * factor + 0.0;  // no minus zero
        const auto size = reinterpret_cast<Reals>(reinterpret_cast<Integers>(units) &
                                                  static_cast<std::int64_t>(magnitude_bits));
        const Reals rounded = size + fraction_rounder - fraction_rounder;
        const Integers is_multiple = (size >= fraction_rounder) | (rounded == size);
        const Integers has_underflowed = (size == 0.0) & (v != 0.0);
        all_good &= (size < 0x1p53) & is_multiple & ~has_underflowed;
        std::memcpy(to, &units, sizeof(units));
    }
    return (all_good[0] & all_good[1] & all_good[2] & all_good[3]) != 0;
}

// The same for up to block_size points.
bool scale_block(Coordinates points, double factor, LatticePoint* out) {
    if (points.size() % 4 == 0) return scale_fours(points.data(), points.size(), factor, out);
    std::array<std::array<double, 3>, block_size> padded{};
    std::array<LatticePoint, block_size> scaled;
    std::ranges::copy(points, padded.begin());
    const bool good =
        scale_fours(padded.data(), (points.size() + 3) / 4 * 4, factor, scaled.data());
    std::copy_n(scaled.begin(), points.size(), out);
    return good;
}

// Whether all of n finite numbers, a multiple of four, are multiples of 2^-52 times this power of
// two: those that are no smaller are.
TRISECT_WIDE_CLONES bool are_multiples(const double* numbers, std::size_t n, double power) {
    using Reals = double __attribute__((vector_size(32)));
    using Integers = std::int64_t __attribute__((vector_size(32)));
    Integers all_good = ~Integers{};
    for (const double* const end = numbers + n; numbers != end; numbers += 4) {
        Reals v;
        std::memcpy(&v, numbers, sizeof(v));
        const auto size = reinterpret_cast<Reals>(reinterpret_cast<Integers>(v) &
                                                  static_cast<std::int64_t>(magnitude_bits));
        all_good &= (size >= power) | (size + power - power == size);
    }
    return (all_good[0] & all_good[1] & all_good[2] & all_good[3]) != 0;
}

// Whether all coordinates are multiples of 2^limit.
bool are_multiples(Coordinates points, int limit, std::uint32_t threads) {
    if (limit <= -1074) return true;
    const double power = power_of_two(limit + 52);
    const detail::ParallelParts parts(points.size(), threads, least_part);
    std::vector<char> good(parts.count(), 1);
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        const Coordinates some = points.subspan(begin, end - begin);
        const std::size_t fours = some.size() / 4 * 4;
        std::array<std::array<double, 3>, 4> rest{};
        std::ranges::copy(some.subspan(fours), rest.begin());
        good[part] = are_multiples(some.data()->data(), 3 * fours, power) &&
                     are_multiples(rest.data()->data(), 12, power);
    });
    return std::ranges::all_of(good, [](char g) { return g != 0; });
}

// All bits of all coordinates in units of 2^limit, when these surely are integers below 2^51. Block
// by block, since in meshes of measured coordinates the first one ends it.
std::optional<std::uint64_t> common_bits(Coordinates points, int limit) {
    const double factor = power_of_two(-limit);
    std::uint64_t bits = 0;
    std::array<LatticePoint, block_size> rounded;
    while (!points.empty()) {
        const auto some = points.first(std::min(points.size(), block_size));
        points = points.subspan(some.size());
        const RoundedBlock block = round_block(some, factor, rounded.data());
        if (!block.is_exact) return std::nullopt;
        bits |= block.bits;
    }
    return bits;
}

// The lowest bit of all coordinates, when they have common bits that are not all zero: then it is
// the lowest one of all integers together.
std::optional<int> common_lowest_bit(Coordinates points, int limit, std::uint32_t threads) {
    if (limit > 0 || !is_normal_exponent(-limit)) return std::nullopt;  // products are exact
    const detail::ParallelParts parts(points.size(), threads, least_part);
    std::vector<std::optional<std::uint64_t>> bits_of(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        bits_of[part] = common_bits(points.subspan(begin, end - begin), limit);
    });
    std::uint64_t bits = 0;
    for (const auto& b : bits_of) {
        if (!b) return std::nullopt;
        bits |= *b;
    }
    if (bits == 0) return std::nullopt;
    return limit + std::countr_zero(bits);
}

// Whether some coordinate has a bit of value below 2^limit; and the lowest bit, if there is none.
bool reaches_below(Coordinates points, int limit, std::uint32_t threads, int& lowest) {
    if (const auto common = common_lowest_bit(points, limit, threads)) {
        lowest = *common;
        return false;
    }
    for (const auto& p : points)
        for (const double c : p) {
            if (c == 0 || !std::isfinite(c)) continue;
            lowest = std::min(lowest, lowest_bit(c));
            if (lowest < limit) return true;
        }
    return false;
}

// The shortest digits that read back as the same double: others take up to 310 characters.
std::string shortest_text(double value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

template <Fractions Kind>
class Rounding {
public:
    explicit Rounding(Lattice lattice)
        : lattice_(lattice),
          factor_(is_normal_exponent(-lattice.exponent) ? power_of_two(-lattice.exponent) : 0) {}

    void report_to(LatticeReport& report) const {
        report.moved += moved_;
        report.max_move =
            std::max({report.max_move, vanished_, std::ldexp(largest_move_, lattice_.exponent)});
        report.lossless = report.lossless && report.moved == 0;
    }

    /// Rounds up to block_size points, of which the first one has this index.
    void round(Coordinates points, std::size_t index, LatticePoint* out) {
        if (is_done_at_once(points, out)) return;
        for (const auto& p : points) *out++ = (*this)(p, index++);
    }

private:
    // Where nothing moves.
    bool is_done_at_once(Coordinates points, LatticePoint* out) const {
        if constexpr (Kind == Fractions::Kept)
            return factor_ != 0 && scale_block(points, factor_, out);
        // Products with less may underflow, to an unnoticed zero.
        const bool is_product_exact = factor_ >= 1;
        return is_product_exact && round_block(points, factor_, out).is_exact;
    }

    LatticePoint operator()(const std::array<double, 3>& p, std::size_t index) {
        const std::array<double, 3> units{p[0] * factor_, p[1] * factor_, p[2] * factor_};
        const bool in_range = std::fabs(units[0]) < 0x1p51 && std::fabs(units[1]) < 0x1p51 &&
                              std::fabs(units[2]) < 0x1p51 && factor_ != 0;
        if (!in_range) [[unlikely]]
            return round_large(p, index);
        std::array<double, 3> c{};
        double changed = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            c[k] =
                Kind == Fractions::Kept ? rounded_fraction(units[k]) : units[k] + rounder - rounder;
            changed += note_move(p[k], units[k], c[k]);
        }
        moved_ += changed != 0 ? 1 : 0;
        return {Coordinate(c[0]), Coordinate(c[1]), Coordinate(c[2])};
    }

    // Keeps the largest moves; not zero when the coordinate moved. What is rounded to zero moves by
    // its own size: scaling a tiny coordinate may underflow.
    double note_move(double coordinate, double units, double rounded) {
        const bool zero = rounded == 0;
        const double vanished = zero ? std::fabs(coordinate) : 0;
        const double move = zero ? 0 : std::fabs(rounded - units);
        vanished_ = std::max(vanished_, vanished);
        largest_move_ = std::max(largest_move_, move);
        return vanished + move;
    }

    // Out of line, so that the loop stays small.
    [[gnu::noinline]] LatticePoint round_large(const std::array<double, 3>& p, std::size_t index) {
        std::array<double, 3> c{};
        double changed = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double units = scaled(p[k], -lattice_.exponent);
            if (!(std::fabs(units) < static_cast<double>(coordinate_limit)))
                throw LimitError("vertex " + std::to_string(index) + ": coordinate " +
                                 shortest_text(p[k]) +
                                 " is not finite or outside the lattice of unit 2^" +
                                 std::to_string(lattice_.exponent));
            c[k] = Kind == Fractions::Kept ? rounded_fraction(units) : std::nearbyint(units);
            changed += note_move(p[k], units, c[k]);
        }
        moved_ += changed != 0 ? 1 : 0;
        return {Coordinate(c[0]), Coordinate(c[1]), Coordinate(c[2])};
    }

    Lattice lattice_;
    double factor_;  ///< 0: not a normal double
    std::size_t moved_ = 0;
    double largest_move_ = 0;  ///< lattice units
    double vanished_ = 0;      ///< user's units
};

// Rounding takes a coordinate near the largest double up to 2^1024, which every later use of it
// would find infinite.
void refuse_beyond_doubles(Coordinates points, std::span<const LatticePoint> rounded,
                           Lattice lattice) {
    if (lattice.exponent + coordinate_bits < std::numeric_limits<double>::max_exponent) return;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto units = rounded[i].doubles()[k];
            if (std::isfinite(lattice.to_double(units))) continue;
            throw Error(ErrorCode::InvalidSolid,
                        "vertex " + std::to_string(i) + ": coordinate " +
                            shortest_text(points[i][k]) +
                            " is so near the largest double that rounding to the lattice of unit "
                            "2^" +
                            std::to_string(lattice.exponent) + " goes beyond it");
        }
}

template <Fractions Kind>
std::vector<LatticePoint> rounded_points(Coordinates points, Lattice lattice, LatticeReport& report,
                                         std::uint32_t threads) {
    report.lattice = lattice;
    std::vector<LatticePoint> out;
    detail::resize_ready(out, points.size());
    const detail::ParallelParts parts(points.size(), threads, least_part);
    std::vector<Rounding<Kind>> roundings(parts.count(), Rounding<Kind>(lattice));
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        Rounding<Kind> round(lattice);
        for (std::size_t i = begin; i < end; i += block_size)
            round.round(points.subspan(i, std::min(block_size, end - i)), i, &out[i]);
        roundings[part] = round;
    });
    for (const auto& round : roundings) round.report_to(report);
    return out;
}

// For coordinates below 2^top, not all zero.
int exponent_without_room(Coordinates points, int top) {
    const int finest = top - coordinate_bits;
    int lowest = std::numeric_limits<int>::max();
    for (const auto& p : points)
        for (const double c : p)
            if (c != 0 && std::isfinite(c)) lowest = std::min(lowest, lowest_bit(c));
    const int coarsest = lowest + fraction_limit;
    if (coarsest < finest) return finest;  // more than 126 bits
    const int eights = floor_to_multiple_of_8(coarsest);
    return eights >= finest ? eights : coarsest;
}

}  // namespace

double Lattice::to_double(double lattice_units) const { return scaled(lattice_units, exponent); }

// Files of measured or computed coordinates have bits far below any lattice with room. The first
// such coordinate decides, so the second pass mostly ends at once.
int span_bits(std::span<const Point3d> points) {
    int lowest = std::numeric_limits<int>::max();
    double largest = 0;
    for (const Point3d& p : points)
        for (const double c : p) {
            if (c == 0 || !std::isfinite(c)) continue;
            lowest = std::min(lowest, lowest_bit(c));
            largest = std::max(largest, std::fabs(c));
        }
    return largest == 0 ? 0 : std::ilogb(largest) + 1 - lowest;
}

Lattice choose_lattice(std::span<const std::array<double, 3>> points, std::uint32_t threads,
                       Fractions fractions) {
    const double largest = largest_finite(points, threads);
    if (largest == 0) return {0};
    int top = 0;
    std::frexp(largest, &top);  // largest < 2^top
    const int finest_with_room = ceil_to_multiple_of_8(top - (coordinate_bits - growth_bits));
    int lowest = std::numeric_limits<int>::max();
    if (!reaches_below(points, finest_with_room, threads, lowest))
        return {std::max(floor_to_multiple_of_8(lowest), finest_with_room)};
    if (fractions == Fractions::Rounded ||
        are_multiples(points, finest_with_room - fraction_limit, threads))
        return {finest_with_room};
    return {exponent_without_room(points, top)};
}

std::vector<LatticePoint> to_lattice(std::span<const std::array<double, 3>> points, Lattice lattice,
                                     LatticeReport& report, std::uint32_t threads,
                                     Fractions fractions) {
    if (fractions == Fractions::Kept)
        return rounded_points<Fractions::Kept>(points, lattice, report, threads);
    auto out = rounded_points<Fractions::Rounded>(points, lattice, report, threads);
    refuse_beyond_doubles(points, out, lattice);
    return out;
}

}  // namespace trisect
