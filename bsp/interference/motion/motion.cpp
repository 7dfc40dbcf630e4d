// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/motion.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/brep/number/real_root.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::IntegerPolynomial;
using detail::MotionPiece;
using detail::PolynomialVector;

MotionPiece piece_of(const Pose& pose) {
    MotionPiece r;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) r.matrix[i][j] = detail::to_gmp(pose.matrix(i, j));
        r.shift[i] = detail::to_gmp(pose.translation(i));
    }
    r.weight = detail::to_gmp(pose.denominator());
    return r;
}

// The doubles as integers over a common denominator.
std::vector<mpz_class> integers(std::span<const double> values, mpz_class& denominator) {
    std::vector<mpq_class> fractions;
    for (const double v : values) {
        if (!std::isfinite(v)) throw UsageError("a motion needs finite numbers");
        fractions.emplace_back(v);
    }
    return detail::common_numerators(fractions, denominator);
}

// The translation by s · by.
MotionPiece translation_piece(const std::array<double, 3>& by) {
    MotionPiece r = MotionPiece::still();
    mpz_class denominator;
    const std::vector<mpz_class> n = integers(by, denominator);
    for (std::size_t i = 0; i < 3; ++i) {
        r.matrix[i][i] = denominator;
        r.shift[i] = IntegerPolynomial({mpz_class(0), n[i]});
    }
    r.weight = denominator;
    return r;
}

// The rotation by (q0, s q1, s q2, s q3) about the origin.
MotionPiece rotation_piece(const std::array<std::int64_t, 4>& q) {
    std::array<IntegerPolynomial, 4> p{detail::to_gmp(q[0])};
    for (std::size_t i = 1; i < 4; ++i)
        p[i] = IntegerPolynomial({mpz_class(0), detail::to_gmp(q[i])});
    return detail::rotation_by(p);
}

std::array<double, 3> negated(const std::array<double, 3>& v) { return {-v[0], -v[1], -v[2]}; }

// The pose of a piece at one place.
MotionPiece frozen(const MotionPiece& piece, const mpq_class& s) {
    std::vector<mpq_class> values;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) values.push_back(piece.matrix[i][j].value_at(s));
        values.push_back(piece.shift[i].value_at(s));
    }
    values.push_back(piece.weight.value_at(s));
    mpz_class denominator;
    const std::vector<mpz_class> n = detail::common_numerators(values, denominator);
    MotionPiece r;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) r.matrix[i][j] = n[4 * i + j];
        r.shift[i] = n[4 * i + 3];
    }
    r.weight = n[12];
    r.reduce();
    return r;
}

bool same_map(const MotionPiece& a, const MotionPiece& b) {
    return a.weight == b.weight && a.shift == b.shift && a.matrix == b.matrix;
}

bool has_root(const IntegerPolynomial& p) {
    return p.is_zero() || !detail::isolate_roots(p, 0, 1).empty();
}

MotionPiece checked(MotionPiece piece) {
    if (has_root(piece.weight))
        throw UsageError("the denominator of a rational motion has a root between 0 and 1");
    if (has_root(determinant(piece.matrix)))
        throw UnsupportedError("the motion makes the solid flat on the way");
    piece.reduce();
    return piece;
}

Pose::Number pose_number(const IntegerPolynomial& constant) {
    mpz_class v;
    if (!constant.is_zero()) v = constant[0];
    if (mpz_sizeinbase(v.get_mpz_t(), 2) > static_cast<std::size_t>(Pose::bits))
        throw LimitError("the pose needs numbers of more than " + std::to_string(Pose::bits) +
                         " bits");
    std::array<std::uint64_t, 7> limbs{};
    std::size_t count = 0;
    mpz_export(limbs.data(), &count, -1, sizeof limbs[0], 0, 0, v.get_mpz_t());
    Pose::Number n;
    for (int i = 0; i < 7; ++i) n.set_limb(i, limbs[static_cast<std::size_t>(i)]);
    return sgn(v) < 0 ? -n : n;
}

}  // namespace

Motion::Motion() : Motion(Pieces{MotionPiece::still()}) {}
Motion::Motion(const Pose& pose) : Motion(Pieces{piece_of(pose)}) {}
Motion::Motion(Pieces pieces) : pieces_(std::make_shared<const Pieces>(std::move(pieces))) {}

Motion Motion::translation(const Pose& start, const std::array<double, 3>& by) {
    return Motion(Pieces{translation_piece(by) * piece_of(start)});
}

Motion Motion::blend(const Pose& from, const Pose& to) {
    const MotionPiece a = piece_of(from);
    const MotionPiece b = piece_of(to);
    // a + s (b - a) over the common denominator.
    const IntegerPolynomial rest({mpz_class(1), mpz_class(-1)});
    const IntegerPolynomial s({mpz_class(0), mpz_class(1)});
    const IntegerPolynomial of_a = rest * b.weight;
    const IntegerPolynomial of_b = s * a.weight;
    MotionPiece r;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            r.matrix[i][j] = a.matrix[i][j] * of_a + b.matrix[i][j] * of_b;
        r.shift[i] = a.shift[i] * of_a + b.shift[i] * of_b;
    }
    r.weight = a.weight * b.weight;
    return Motion(Pieces{checked(std::move(r))});
}

Motion Motion::screw(const Pose& start, const Screw& screw) {
    constexpr std::int64_t limit = std::int64_t{1} << 53;
    if (screw.turn[0] <= 0)
        throw UsageError("a screw turns by less than 180 degrees: turn[0] must be positive");
    for (const std::int64_t v : screw.turn)
        if (v < -limit || v > limit)
            throw UsageError("components of the turn of a screw must be below 2^53");
    const auto at_one = [](const std::array<double, 3>& by) {
        return frozen(translation_piece(by), 1);
    };
    const MotionPiece turn =
        at_one(screw.center) * rotation_piece(screw.turn) * at_one(negated(screw.center));
    return Motion(Pieces{translation_piece(screw.shift) * turn * piece_of(start)});
}

Motion Motion::rational(const std::array<std::vector<ExactRational>, 12>& entries,
                        const std::vector<ExactRational>& denominator) {
    std::vector<mpq_class> values;
    for (const auto& entry : entries)
        for (const ExactRational& c : entry) values.push_back(detail::to_gmp(c));
    for (const ExactRational& c : denominator) values.push_back(detail::to_gmp(c));
    mpz_class common;
    const std::vector<mpz_class> n = detail::common_numerators(values, common);
    auto next = n.begin();
    const auto take = [&next](std::size_t count) {
        const auto end = next + static_cast<std::ptrdiff_t>(count);
        IntegerPolynomial p(std::vector<mpz_class>(next, end));
        next = end;
        return p;
    };
    MotionPiece r;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) r.matrix[i][j] = take(entries[4 * i + j].size());
        r.shift[i] = take(entries[4 * i + 3].size());
    }
    r.weight = take(denominator.size());
    return Motion(Pieces{checked(std::move(r))});
}

Motion Motion::through(std::span<const Pose> poses) {
    if (poses.size() < 2) throw UsageError("a motion through poses needs two of them");
    Pieces pieces;
    for (std::size_t i = 1; i < poses.size(); ++i)
        pieces.push_back(blend(poses[i - 1], poses[i]).pieces()[0]);
    return Motion(std::move(pieces));
}

Motion Motion::joined(std::span<const Motion> motions) {
    if (motions.empty()) throw UsageError("a motion needs at least one piece");
    Pieces pieces;
    for (const Motion& next : motions) {
        const Pieces& more = next.pieces();
        if (!pieces.empty() && !same_map(frozen(pieces.back(), 1), frozen(more.front(), 0)))
            throw UsageError("a motion must begin where the one before it ends");
        pieces.insert(pieces.end(), more.begin(), more.end());
    }
    return Motion(std::move(pieces));
}

Motion Motion::then(const Motion& next) const { return joined(std::array{*this, next}); }

const Motion::Pieces& Motion::still_pieces() {
    static const auto& still = *new Pieces{MotionPiece::still()};  // never destroyed
    return still;
}

std::size_t Motion::piece_count() const { return pieces().size(); }

bool Motion::is_still() const {
    return std::all_of(pieces().begin(), pieces().end(), [](const MotionPiece& p) {
        MotionPiece reduced = p;
        reduced.reduce();
        return reduced.degree() == 0;
    });
}

Pose Motion::pose_at(const ExactRational& s) const {
    const mpq_class at = detail::to_gmp(s);
    const auto count = static_cast<unsigned long>(piece_count());
    if (sgn(at) < 0 || at > count)
        throw UsageError("the parameter of a motion of " + std::to_string(count) +
                         " pieces is between 0 and " + std::to_string(count));
    const mpz_class floor = at.get_num() / at.get_den();
    const std::size_t i = std::min<std::size_t>(floor.get_ui(), piece_count() - 1);
    const MotionPiece pose = frozen(pieces()[i], at - static_cast<unsigned long>(i));
    std::array<Pose::Number, 9> m;
    std::array<Pose::Number, 3> t;
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) m[3 * r + c] = pose_number(pose.matrix[r][c]);
        t[r] = pose_number(pose.shift[r]);
    }
    return Pose::from_integers(m, t, pose_number(pose.weight));
}

std::array<double, 12> Motion::approximate_pose_at(double s) const {
    const double last = static_cast<double>(piece_count());
    const double clamped = std::clamp(s, 0.0, last);
    const std::size_t i = std::min(static_cast<std::size_t>(clamped), piece_count() - 1);
    const MotionPiece& piece = pieces()[i];
    const mpq_class at(clamped - static_cast<double>(i));
    const mpq_class weight = piece.weight.value_at(at);
    const auto value = [&](const IntegerPolynomial& p) {
        return mpq_class(p.value_at(at) / weight).get_d();
    };
    std::array<double, 12> r{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t c = 0; c < 3; ++c) r[4 * row + c] = value(piece.matrix[row][c]);
        r[4 * row + 3] = value(piece.shift[row]);
    }
    return r;
}

}  // namespace trisect
