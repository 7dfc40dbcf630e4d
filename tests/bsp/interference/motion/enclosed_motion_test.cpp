// SPDX-License-Identifier: Apache-2.0
//
// Enclosures contain the motion that they stand for: sampled against rotations by the exponential
// formula in long doubles, and for rational motions against the motion itself.

#include <trisect/bsp/interference/enclosed_motion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <trisect/kernel/error.h>

#include "reference/random_solids.h"
#include "support/enclosed_motions.h"

namespace {

using moving::whole;
using trisect::ConstantTurn;
using trisect::EnclosedMotion;
using trisect::ExactRational;
using trisect::KeyFrame;
using trisect::Motion;
using trisect::MotionEnclosure;
using trisect::Pose;
using trisect::Screw;
using trisect::UsageError;

using Real = long double;
using RealVector = std::array<Real, 3>;
using RealQuaternion = std::array<Real, 4>;

RealQuaternion product(const RealQuaternion& p, const RealQuaternion& q) {
    return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

RealQuaternion normalized(RealQuaternion q) {
    const Real n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (Real& v : q) v /= n;
    return q;
}

RealVector rotated(const RealQuaternion& q, const RealVector& x) {
    const RealQuaternion r =
        product(product(q, {0, x[0], x[1], x[2]}), {q[0], -q[1], -q[2], -q[3]});
    return {r[1], r[2], r[3]};
}

RealVector under(const Pose& pose, const RealVector& x) {
    const auto& m = pose.approximate();
    RealVector r{};
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = Real(m[4 * i]) * x[0] + Real(m[4 * i + 1]) * x[1] + Real(m[4 * i + 2]) * x[2] +
               Real(m[4 * i + 3]);
    return r;
}

Real distance(const RealVector& a, const RealVector& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

RealVector slerp(const KeyFrame& f, const KeyFrame& g, double time, const RealVector& x) {
    const Real t = (Real(time) - f.time) / (Real(g.time) - f.time);
    const auto real = [](const std::array<double, 4>& q) {
        return normalized({q[0], q[1], q[2], q[3]});
    };
    const RealQuaternion p = real(f.rotation);
    RealQuaternion q = real(g.rotation);
    Real dot = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    if (dot < 0) {
        for (Real& v : q) v = -v;
        dot = -dot;
    }
    const Real angle = std::acos(std::min(dot, Real(1)));
    RealQuaternion r = p;
    if (angle > 1e-9L)
        for (std::size_t i = 0; i < 4; ++i)
            r[i] =
                (std::sin((1 - t) * angle) * p[i] + std::sin(t * angle) * q[i]) / std::sin(angle);
    RealVector y = rotated(normalized(r), x);
    for (std::size_t i = 0; i < 3; ++i) y[i] += (1 - t) * f.position[i] + t * g.position[i];
    return y;
}

RealVector turned(const Pose& start, const ConstantTurn& turn, Real t, const RealVector& x) {
    RealVector y = under(start, x);
    for (std::size_t i = 0; i < 3; ++i) y[i] -= turn.center[i];
    const Real half = t * turn.angle / 2;
    const Real length = std::hypot(Real(turn.axis[0]), Real(turn.axis[1]), Real(turn.axis[2]));
    RealQuaternion q{std::cos(half)};
    for (std::size_t i = 0; i < 3; ++i) q[i + 1] = std::sin(half) * turn.axis[i] / length;
    y = rotated(q, y);
    for (std::size_t i = 0; i < 3; ++i) y[i] += turn.center[i] + t * turn.shift[i];
    return y;
}

RealVector random_point(reference::Random& random) {
    return {whole(random, -10, 10), whole(random, -10, 10), whole(random, -10, 10)};
}

double random_real(reference::Random& random) { return whole(random, -4096, 4096) / 1021; }

// Samples of a range, the ends among them, are within the bounds of the enclosure. Poses of an
// enclosure in doubles are rounded.
template <class Truth>
void expect_enclosed(const EnclosedMotion& motion, double from, double to,
                     reference::Random& random, Truth&& truth) {
    const MotionEnclosure e = motion.enclose(from, to);
    if (!(e.by_length < HUGE_VAL)) return;
    for (int i = 0; i <= 8; ++i) {
        const RealVector x = random_point(random);
        const double time = i == 8 ? to : from + (to - from) * (i / 8.);
        const ExactRational s =
            from == to ? ExactRational(0)
                       : (ExactRational::from_double(time) - ExactRational::from_double(from)) /
                             (ExactRational::from_double(to) - ExactRational::from_double(from));
        const auto m = e.motion.approximate_pose_at(s.to_double());
        RealVector y{};
        for (std::size_t k = 0; k < 3; ++k)
            y[k] = m[4 * k] * x[0] + m[4 * k + 1] * x[1] + m[4 * k + 2] * x[2] + m[4 * k + 3];
        const Real bound = e.by_length * distance(x, {}) + e.constant;
        EXPECT_LE(distance(y, truth(time, x)), bound + 1e-13L) << from << " to " << to;
    }
}

TEST(EnclosedMotion, ScrewsContainTurnsOfConstantSpeed) {
    reference::Random random(1);
    for (int round = 0; round < 200; ++round) {
        ConstantTurn turn;
        turn.axis = {random_real(random), random_real(random), random_real(random)};
        turn.angle = random_real(random) * 4;
        turn.center = {random_real(random), random_real(random), random_real(random)};
        turn.shift = {random_real(random), random_real(random), random_real(random)};
        if (turn.axis == std::array<double, 3>{0, 0, 0}) continue;
        const Pose start = Pose::from_quaternion({random.between(1, 4), random.between(-4, 4),
                                                  random.between(-4, 4), random.between(-4, 4)},
                                                 {random_real(random), 0, 1});
        const double duration = whole(random, 1, 5);
        const EnclosedMotion motion = EnclosedMotion::turning(start, turn, duration);
        for (int part = 0; part < 8; ++part) {
            const double from = duration * whole(random, 0, 1000) / 1001;
            const double to = std::min(
                duration,
                from + duration * std::ldexp(1., -static_cast<int>(random.between(1, 12))));
            expect_enclosed(motion, from, to, random, [&](double t, const RealVector& x) {
                return turned(start, turn, Real(t) / duration, x);
            });
        }
    }
}

TEST(EnclosedMotion, ScrewsContainSlerps) {
    reference::Random random(2);
    const auto frame = [&random](double time) {
        KeyFrame f{time, {}, {random_real(random), random_real(random), random_real(random)}};
        do {
            for (double& v : f.rotation)
                v = random.chance(1, 2) ? whole(random, -3, 3) : random_real(random);
        } while (f.rotation == std::array<double, 4>{0, 0, 0, 0});
        return f;
    };
    for (int round = 0; round < 200; ++round) {
        const std::vector<KeyFrame> frames{frame(0), frame(0.75), frame(3)};
        const EnclosedMotion motion = EnclosedMotion::through(frames);
        EXPECT_EQ(motion.duration(), 3);
        for (std::size_t i = 0; i < 2; ++i)
            for (int part = 0; part < 5; ++part) {
                const double begin = frames[i].time;
                const double end = frames[i + 1].time;
                const double from = begin + (end - begin) * whole(random, 0, 1000) / 1000;
                const double to = std::min(
                    end, from + (end - begin) *
                                    std::ldexp(1., -static_cast<int>(random.between(0, 12))));
                expect_enclosed(motion, from, to, random, [&](double t, const RealVector& x) {
                    return slerp(frames[i], frames[i + 1], t, x);
                });
            }
    }
}

TEST(EnclosedMotion, DeviationsFallWithTheThirdPower) {
    ConstantTurn turn;
    turn.angle = 1;
    const EnclosedMotion motion = EnclosedMotion::turning(Pose(), turn);
    const double whole = motion.enclose(0, 1).by_length;
    const double part = motion.enclose(0.25, 0.25 + 1. / 16).by_length;
    EXPECT_LT(whole, 0.01);
    EXPECT_LT(part * 3900, whole);
    EXPECT_LT(motion.enclose(0.5, 0.5).by_length, 0x1p-56);
    turn.angle = 100;  // sixteen turns: no single screw is near them
    EXPECT_EQ(EnclosedMotion::turning(Pose(), turn).enclose(0, 1).by_length, HUGE_VAL);
}

TEST(EnclosedMotion, PartsOfARationalMotionAreExact) {
    const Motion screw =
        Motion::screw(Pose::from_quaternion({2, 1, 0, 1}, {1, 2, 3}),
                      {{3, 1, 2, 0}, {1, 0, 0}, {0, 0.5, 2}})
            .then(Motion::translation(Motion::screw(Pose::from_quaternion({2, 1, 0, 1}, {1, 2, 3}),
                                                    {{3, 1, 2, 0}, {1, 0, 0}, {0, 0.5, 2}})
                                          .pose_at(1),
                                      {1, 0, 0}));
    const EnclosedMotion motion(screw);
    EXPECT_EQ(motion.duration(), 2);
    for (const auto& [from, to] : std::vector<std::array<double, 2>>{
             {0, 1}, {0.25, 0.75}, {0.375, 0.375}, {1, 2}, {1.5, 1.625}, {2, 2}}) {
        const MotionEnclosure e = motion.enclose(from, to);
        EXPECT_EQ(e.by_length, 0);
        EXPECT_EQ(e.constant, 0);
        for (int i = 0; i <= 4; ++i) {
            const ExactRational part = ExactRational(i) / ExactRational(4);
            const ExactRational time =
                ExactRational::from_double(from) +
                part * (ExactRational::from_double(to) - ExactRational::from_double(from));
            EXPECT_EQ(e.motion.pose_at(part), screw.pose_at(time)) << from << " " << i;
        }
    }
}

TEST(EnclosedMotion, StraightLinesContainASmoothMotion) {
    // On a circle of radius 2, without turning.
    trisect::SmoothMotion circle;
    circle.pose = [](double t) {
        return std::array<double, 12>{1, 0, 0, 2 * std::cos(t), 0, 1, 0, 2 * std::sin(t), 0,
                                      0, 1, 0};
    };
    circle.error = 1e-15;
    circle.bend = [](double, double) { return 2.; };
    const EnclosedMotion motion = EnclosedMotion::smooth(circle, {0, 1, 4});
    reference::Random random(3);
    for (int i = 0; i < 100; ++i) {
        const double from = 1 + 3 * whole(random, 0, 1000) / 1001;
        const double to =
            std::min(4., from + std::ldexp(1., -static_cast<int>(random.between(0, 10))));
        expect_enclosed(motion, from, to, random, [](double t, const RealVector& x) {
            return RealVector{x[0] + 2 * std::cos(Real(t)), x[1] + 2 * std::sin(Real(t)), x[2]};
        });
    }
}

TEST(EnclosedMotion, WhatMakesNoSenseIsRefused) {
    const std::vector<KeyFrame> one{{}};
    EXPECT_THROW((void)EnclosedMotion::through(one), UsageError);
    const std::vector<KeyFrame> late{{1, {1, 0, 0, 0}, {}}, {2, {1, 0, 0, 0}, {}}};
    EXPECT_THROW((void)EnclosedMotion::through(late), UsageError);
    const std::vector<KeyFrame> equal{{0, {1, 0, 0, 0}, {}}, {0, {1, 0, 0, 0}, {}}};
    EXPECT_THROW((void)EnclosedMotion::through(equal), UsageError);
    const std::vector<KeyFrame> zero{{0, {1, 0, 0, 0}, {}}, {1, {0, 0, 0, 0}, {}}};
    EXPECT_THROW((void)EnclosedMotion::through(zero), UsageError);
    const std::vector<KeyFrame> infinite{{0, {1, 0, 0, 0}, {}},
                                         {1, {1, 0, 0, 0}, {HUGE_VAL, 0, 0}}};
    EXPECT_THROW((void)EnclosedMotion::through(infinite), UsageError);
    ConstantTurn turn;
    EXPECT_THROW((void)EnclosedMotion::turning(Pose(), turn, 0), UsageError);
    turn.axis = {};
    EXPECT_THROW((void)EnclosedMotion::turning(Pose(), turn), UsageError);
    turn = {};
    turn.angle = 0x1p21;
    EXPECT_THROW((void)EnclosedMotion::turning(Pose(), turn), UsageError);
    EXPECT_THROW((void)EnclosedMotion::smooth({}, {0, 1}), UsageError);
    EXPECT_THROW(EnclosedMotion(nullptr, {0, 1}), UsageError);
}

}  // namespace
