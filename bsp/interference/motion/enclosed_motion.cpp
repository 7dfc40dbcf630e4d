// SPDX-License-Identifier: Apache-2.0
//
// Slerp between the rotations of quaternions p and q turns by the rotation of conj(p) q = (w, v) in
// the frame of p: the axis is v / |v| and half of the angle is the angle of (w, |v|), whatever the
// lengths of p and q are. So nothing but one square root, one arctangent and the sines of
// near_piece (bsp/interference/motion/turning_piece.h) is irrational, and all are known to 2^-120.

#include <trisect/bsp/interference/enclosed_motion.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/brep/number/trigonometry.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/motion/turning_piece.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect {

namespace {

using detail::IntegerPolynomial;
using detail::MotionPiece;
using detail::NearPiece;
using detail::Turning;

constexpr double infinite = std::numeric_limits<double>::infinity();

void expect(bool condition, const char* message) {
    if (!condition) throw UsageError(message);
}

void expect_finite(std::span<const double> values) {
    for (const double v : values) expect(std::isfinite(v), "a motion needs finite numbers");
}

void expect_ascending(std::span<const double> breaks) {
    expect_finite(breaks);
    expect(breaks.size() >= 2 && breaks.front() == 0 &&
               std::adjacent_find(breaks.begin(), breaks.end(), std::greater_equal<>()) ==
                   breaks.end(),
           "the times of a motion must ascend from 0");
}

// The part of the motion that holds a range of time beginning at `from`.
std::size_t part_of(std::span<const double> breaks, double from) {
    const auto after = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, from);
    return static_cast<std::size_t>(after - breaks.begin()) - 1;
}

mpq_class fraction_of(double t, double from, double to) {
    return (mpq_class(t) - mpq_class(from)) / (mpq_class(to) - mpq_class(from));
}

std::array<mpq_class, 3> fractions(const std::array<double, 3>& v) {
    return {mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])};
}

class TurningLaw final : public MotionLaw {
public:
    TurningLaw(std::vector<Turning> parts, std::vector<double> breaks)
        : parts_(std::move(parts)), breaks_(std::move(breaks)) {}

    MotionEnclosure enclose(double from, double to) const override {
        const std::size_t i = part_of(breaks_, from);
        NearPiece near = near_piece(parts_[i], fraction_of(from, breaks_[i], breaks_[i + 1]),
                                    fraction_of(to, breaks_[i], breaks_[i + 1]));
        return {detail::motion_of(near.piece), near.by_length, near.constant};
    }

private:
    std::vector<Turning> parts_;
    std::vector<double> breaks_;
};

// The unit vector along v, in fixed point.
std::array<mpz_class, 3> unit_vector(const std::array<mpz_class, 3>& v) {
    constexpr unsigned bits = 2 * detail::fixed_bits;
    const mpz_class square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const mpz_class length = sqrt(mpz_class(square << (2 * bits)));
    std::array<mpz_class, 3> r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = (v[i] << (bits + detail::fixed_bits)) / length;
    return r;
}

// Doubles times one power of two.
template <std::size_t N>
std::array<mpz_class, N> integers(const std::array<double, N>& values) {
    std::vector<mpq_class> fractions;
    for (const double v : values) fractions.emplace_back(v);
    mpz_class denominator;
    const std::vector<mpz_class> n = detail::common_numerators(fractions, denominator);
    std::array<mpz_class, N> r;
    std::copy(n.begin(), n.end(), r.begin());
    return r;
}

Turning turning_between(const KeyFrame& f, const KeyFrame& g) {
    Turning r;
    r.base = integers(f.rotation);
    std::array<mpz_class, 4> q = integers(g.rotation);
    const std::array<mpz_class, 4>& p = r.base;
    mpz_class w = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    if (w < 0) {
        for (mpz_class& c : q) c = -c;
        w = -w;
    }
    const std::array<mpz_class, 3> v{p[0] * q[1] - p[1] * q[0] - p[2] * q[3] + p[3] * q[2],
                                     p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1],
                                     p[0] * q[3] - p[1] * q[2] + p[2] * q[1] - p[3] * q[0]};
    r.from = fractions(f.position);
    r.to = fractions(g.position);
    if (v == std::array<mpz_class, 3>{0, 0, 0}) return r;
    r.axis = unit_vector(v);
    const mpz_class square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const mpz_class length = sqrt(mpz_class(square << (2 * detail::fixed_bits)));
    r.half_angle = detail::angle_of(length, w << detail::fixed_bits);
    return r;
}

class SmoothLaw final : public MotionLaw {
public:
    explicit SmoothLaw(SmoothMotion motion) : motion_(std::move(motion)) {}

    // Between two values a function is within h^2 / 8 times its second derivative of the line.
    MotionEnclosure enclose(double from, double to) const override {
        const std::array<double, 12> begin = motion_.pose(from);
        const std::array<double, 12> end = motion_.pose(to);
        expect_finite(begin);
        expect_finite(end);
        const double h = to - from;
        const double bend = from == to ? 0 : motion_.bend(from, to);
        const double each = (motion_.error + h * h / 8 * bend) * detail::surely_more + 0x1p-1000;
        if (!(each < infinite)) return {Motion(), infinite, infinite};
        MotionPiece piece;
        std::vector<mpq_class> values;
        for (std::size_t i = 0; i < 12; ++i) {
            values.emplace_back(begin[i]);
            values.push_back(mpq_class(end[i]) - mpq_class(begin[i]));
        }
        mpz_class denominator;
        const std::vector<mpz_class> n = detail::common_numerators(values, denominator);
        const auto line = [&n](std::size_t i) {
            return IntegerPolynomial({n[2 * i], n[2 * i + 1]});
        };
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) piece.matrix[i][j] = line(4 * i + j);
            piece.shift[i] = line(4 * i + 3);
        }
        piece.weight = denominator;
        // Nine and three numbers, each off by `each`.
        return {detail::motion_of(piece), 3 * each, 2 * each};
    }

private:
    SmoothMotion motion_;
};

class RationalLaw final : public MotionLaw {
public:
    explicit RationalLaw(Motion motion) : motion_(std::move(motion)) {}

    MotionEnclosure enclose(double from, double to) const override {
        const double last = static_cast<double>(motion_.piece_count());
        const auto i = static_cast<std::size_t>(std::min(from, last - 1));
        const MotionPiece& piece = detail::piece_of(motion_, i);
        const mpq_class f = mpq_class(from) - static_cast<unsigned long>(i);
        const mpq_class t = mpq_class(to) - static_cast<unsigned long>(i);
        return {detail::motion_of(detail::part_of(piece, f, t)), 0, 0};
    }

private:
    Motion motion_;
};

class StillLaw final : public MotionLaw {
public:
    explicit StillLaw(Motion motion) : motion_(std::move(motion)) {}
    MotionEnclosure enclose(double /*from*/, double /*to*/) const override {
        return {motion_, 0, 0};
    }

private:
    Motion motion_;
};

std::vector<double> whole_numbers(std::size_t count) {
    std::vector<double> r;
    for (std::size_t i = 0; i <= count; ++i) r.push_back(static_cast<double>(i));
    return r;
}

}  // namespace

EnclosedMotion::EnclosedMotion() : EnclosedMotion(Motion()) {}

EnclosedMotion::EnclosedMotion(const Motion& motion)
    : breaks_(whole_numbers(motion.piece_count())), is_still_(motion.is_still()) {
    if (is_still_)
        law_ = std::make_shared<StillLaw>(motion);
    else
        law_ = std::make_shared<RationalLaw>(motion);
}

EnclosedMotion::EnclosedMotion(std::shared_ptr<const MotionLaw> law, std::vector<double> breaks)
    : law_(std::move(law)), breaks_(std::move(breaks)) {
    expect(law_ != nullptr, "a motion needs a law");
    expect_ascending(breaks_);
}

EnclosedMotion EnclosedMotion::through(std::span<const KeyFrame> frames) {
    expect(frames.size() >= 2, "a motion through key frames needs two of them");
    std::vector<double> breaks;
    for (const KeyFrame& f : frames) {
        expect_finite(f.rotation);
        expect_finite(f.position);
        expect(f.rotation != std::array<double, 4>{0, 0, 0, 0},
               "the quaternion of a key frame must not be 0");
        breaks.push_back(f.time);
    }
    expect_ascending(breaks);
    std::vector<Turning> parts;
    for (std::size_t i = 1; i < frames.size(); ++i)
        parts.push_back(turning_between(frames[i - 1], frames[i]));
    return {std::make_shared<TurningLaw>(std::move(parts), breaks), breaks};
}

EnclosedMotion EnclosedMotion::turning(const Pose& start, const ConstantTurn& turn,
                                       double duration) {
    expect_finite(turn.axis);
    expect_finite(turn.center);
    expect_finite(turn.shift);
    expect(std::isfinite(duration) && duration > 0, "the duration of a motion must be positive");
    expect(std::abs(turn.angle) <= 0x1p20, "the angle of a turn must be within 2^20 radians");
    expect(turn.axis != std::array<double, 3>{0, 0, 0}, "the axis of a turn must not be 0");
    Turning t;
    t.start = detail::piece_of(Motion(start), 0);
    t.axis = unit_vector(integers(turn.axis));
    t.half_angle = mpq_class(turn.angle) / 2;
    t.center = fractions(turn.center);
    t.to = fractions(turn.shift);
    const std::vector<double> breaks{0, duration};
    return {std::make_shared<TurningLaw>(std::vector{std::move(t)}, breaks), breaks};
}

EnclosedMotion EnclosedMotion::smooth(SmoothMotion motion, std::vector<double> breaks) {
    expect(motion.pose && motion.bend, "a smooth motion needs two functions");
    expect(std::isfinite(motion.error) && motion.error >= 0,
           "the error of a motion must be finite and not negative");
    return {std::make_shared<SmoothLaw>(std::move(motion)), std::move(breaks)};
}

}  // namespace trisect
