// SPDX-License-Identifier: Apache-2.0
//
// Each corner of each operand's face has numbers of its own, from a generator, so that a wrong face
// or a wrong place shows. The check does not use names: it looks for a face of any operand that has
// the sample point, among all of them.
#include <trisect/bsp/property_mesh.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trisect {
namespace {

using Vec = std::array<double, 3>;

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec crossed(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dotted(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Textured {
    PolygonMesh mesh;
    CornerProperties properties;
    Solid solid;

    [[nodiscard]] PropertyOperand operand() const {
        return {solid.source_id(), &mesh, &properties};
    }
};

/// Triangles only.
PolygonMesh in_triangles(const PolygonMesh& mesh) {
    PolygonMesh out;
    out.points = mesh.points;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            out.add_triangle(loop[0], loop[i], loop[i + 1]);
    }
    return out;
}

Textured textured(const PolygonMesh& polygons, std::mt19937_64& random) {
    Textured out;
    out.mesh = in_triangles(polygons);
    out.properties.width = 5;  // uv and a colour
    std::uniform_real_distribution<double> number(-1, 1);
    for (std::size_t i = 0; i < 5 * out.mesh.corners.size(); ++i)
        out.properties.values.push_back(number(random));
    out.solid = Solid::from_mesh(out.mesh);
    return out;
}

Vec mixed(const std::array<Vec, 3>& p, const Vec& w) {
    Vec out{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i) out[k] += w[i] * p[i][k];
    return out;
}

/// Weights of a point in a triangle; nothing where it is farther than `off` from it.
std::optional<Vec> weights_of(const std::array<Vec, 3>& p, const Vec& q, double off) {
    const Vec n = crossed(minus(p[1], p[0]), minus(p[2], p[0]));
    const double size = dotted(n, n);
    if (size == 0 || std::fabs(dotted(n, minus(q, p[0]))) > off * std::sqrt(size))
        return std::nullopt;
    Vec w{};
    for (std::size_t i = 0; i < 3; ++i)
        w[i] = dotted(n, crossed(minus(p[(i + 1) % 3], q), minus(p[(i + 2) % 3], q))) / size;
    for (const double x : w)
        if (x < -off) return std::nullopt;
    return w;
}

std::array<Vec, 3> corners_of(const PolygonMesh& mesh, std::size_t f) {
    const auto loop = mesh.face(f);
    return {mesh.points[loop[0]], mesh.points[loop[1]], mesh.points[loop[2]]};
}

std::array<double, 5> values_at(const PolygonMesh& mesh, const CornerProperties& properties,
                                std::size_t f, const Vec& w) {
    std::array<double, 5> out{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 5; ++i)
            out[i] += w[k] * properties.at(mesh.face_begin[f] + k)[i];
    return out;
}

/// Whether a face of an operand has the point, and these values there.
bool is_found(const std::vector<Textured>& operands, const Vec& q,
              const std::array<double, 5>& values) {
    constexpr double off = 1e-9;
    for (const Textured& operand : operands)
        for (std::size_t f = 0; f < operand.mesh.face_count(); ++f) {
            const auto w = weights_of(corners_of(operand.mesh, f), q, off);
            if (!w) continue;
            const auto there = values_at(operand.mesh, operand.properties, f, *w);
            double largest = 0;
            for (std::size_t i = 0; i < 5; ++i)
                largest = std::max(largest, std::fabs(there[i] - values[i]));
            if (largest < 1e-6) return true;
        }
    return false;
}

/// Sample points whose values are not those of an operand there.
std::size_t wrong_samples(const std::vector<Textured>& operands, const Expression& formula,
                          std::size_t samples, std::mt19937_64& random) {
    std::vector<PropertyOperand> named;
    for (const Textured& operand : operands) named.push_back(operand.operand());
    const PropertyMesh result = to_property_mesh(evaluate(formula), named);
    EXPECT_EQ(result.properties.values.size(), 5 * result.mesh.corners.size());
    EXPECT_EQ(result.is_turned_over.size(), result.mesh.face_count());
    std::uniform_int_distribution<std::size_t> face(0, result.mesh.face_count() - 1);
    std::uniform_real_distribution<double> number(0, 1);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const std::size_t f = face(random);
        const double a = std::sqrt(number(random));
        const double b = number(random);
        const Vec w{1 - a, a * (1 - b), a * b};
        const auto corners = corners_of(result.mesh, f);
        const Vec n = crossed(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        if (dotted(n, n) < 1e-16) continue;  // no place for a sample between rounded corners
        if (!is_found(operands, mixed(corners, w), values_at(result.mesh, result.properties, f, w)))
            ++wrong;
    }
    return wrong;
}

std::size_t wrong_samples_of_booleans(std::size_t samples) {
    std::mt19937_64 random(20261127);
    std::uniform_real_distribution<double> number(-0.7, 0.7);
    std::size_t wrong = 0;
    for (int i = 0; i < 20; ++i) {
        const auto moved = [&](const PolygonMesh& mesh) {
            const AffineMap turn =
                AffineMap::rotation({number(random), number(random), 1}, 90 * number(random));
            const AffineMap move =
                AffineMap::translation({number(random), number(random), number(random)});
            return textured(transformed(mesh, compose(move, turn)), random);
        };
        const std::vector<Textured> operands{
            moved(make_icosphere(1, 2)), moved(make_cylinder(0.6, 2.5, 16)),
            moved(make_box({1.5, 1.2, 1.8})), moved(make_torus(1.1, 0.3, 16, 8))};
        const auto& [a, b, c, d] =
            std::tie(operands[0].solid, operands[1].solid, operands[2].solid, operands[3].solid);
        const std::array<Expression, 5> formulas{a - b, a | c, (a & c) | d, (a | b) - d, a ^ c};
        wrong +=
            wrong_samples(operands, formulas[static_cast<std::size_t>(i) % 5], samples, random);
    }
    return wrong;
}

TEST(PropertyMesh, SamplesHaveTheValuesOfTheFaceThatHasThem) {
    EXPECT_EQ(wrong_samples_of_booleans(100), 0U);
}

// 10^5 points in all.
TEST(PropertyMesh, ManySamplesHaveTheValuesOfTheFaceThatHasThem) {
    EXPECT_EQ(wrong_samples_of_booleans(5000), 0U);
}

TEST(PropertyMesh, FlushBoxesKeepTheirFaces) {
    std::mt19937_64 random(1);
    const std::vector<Textured> operands{textured(make_box({2, 2, 2}), random),
                                         textured(make_box({1, 0, 0}, {3, 2, 1}), random)};
    EXPECT_EQ(wrong_samples(operands, operands[0].solid | operands[1].solid, 500, random), 0U);
    EXPECT_EQ(wrong_samples(operands, operands[0].solid - operands[1].solid, 500, random), 0U);
}

TEST(PropertyMesh, CornersOfFacesHaveTheirValuesExactly) {
    std::mt19937_64 random(2);
    const Textured box = textured(make_box({2, 2, 2}), random);
    const std::array named{box.operand()};
    const PropertyMesh result = to_property_mesh(box.solid, named);
    ASSERT_EQ(result.mesh.face_count(), 12U);
    for (std::size_t t = 0; t < 12; ++t) {
        EXPECT_FALSE(result.is_turned_over[t]);
        const std::uint32_t f = result.source[t].face;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto p = result.mesh.points[result.mesh.face(t)[k]];
            for (std::size_t j = 0; j < 3; ++j) {
                if (box.mesh.points[box.mesh.face(f)[j]] != p) continue;
                const auto expected = box.properties.at(box.mesh.face_begin[f] + j);
                const auto actual = result.properties.at(3 * t + k);
                EXPECT_TRUE(std::equal(expected.begin(), expected.end(), actual.begin()));
            }
        }
    }
}

TEST(PropertyMesh, WallsOfAHoleAreTurnedOver) {
    std::mt19937_64 random(3);
    const Textured block = textured(make_box({3, 3, 3}), random);
    const Textured drill = textured(make_box({1, 1, -1}, {2, 2, 4}), random);
    const std::array named{block.operand(), drill.operand()};
    const PropertyMesh result = to_property_mesh(evaluate(block.solid - drill.solid), named);
    std::size_t walls = 0;
    for (std::size_t t = 0; t < result.mesh.face_count(); ++t) {
        const bool is_wall = result.source[t].operand == drill.solid.source_id();
        EXPECT_EQ(result.is_turned_over[t], is_wall);
        walls += is_wall ? 1 : 0;
    }
    EXPECT_GE(walls, 8U);  // more where diagonals of the block meet them
}

TEST(PropertyMesh, OperandsWithoutPropertiesHaveZeros) {
    std::mt19937_64 random(4);
    const Textured a = textured(make_box({2, 2, 2}), random);
    const Textured b = textured(make_box({1, 1, 1}, {3, 3, 3}), random);
    const std::array named{a.operand(), PropertyOperand{b.solid.source_id(), &b.mesh, nullptr}};
    const PropertyMesh result = to_property_mesh(evaluate(a.solid | b.solid), named);
    for (std::size_t t = 0; t < result.mesh.face_count(); ++t) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
            for (const double v : result.properties.at(3 * t + k)) sum += std::fabs(v);
        EXPECT_EQ(sum == 0, result.source[t].operand == b.solid.source_id());
    }
}

TEST(PropertyMesh, PropertiesThatDoNotFitAreRefused) {
    std::mt19937_64 random(5);
    Textured a = textured(make_box({2, 2, 2}), random);
    const std::array twice{a.operand(), a.operand()};
    EXPECT_THROW((void)to_property_mesh(a.solid, twice), UsageError);
    a.properties.values.pop_back();
    const std::array short_one{a.operand()};
    EXPECT_THROW((void)to_property_mesh(a.solid, short_one), UsageError);
}

/// A box with one channel, the same number at all corners.
Textured with_channel(const PolygonMesh& mesh, PropertyChannel channel, double number) {
    Textured out;
    out.mesh = in_triangles(mesh);
    out.properties.width = channel.width;
    out.properties.values.assign(channel.width * out.mesh.corners.size(), number);
    out.properties.channels = {std::move(channel)};
    out.solid = Solid::from_mesh(out.mesh);
    return out;
}

TEST(PropertyMesh, WhatAnOperandDoesNotHaveIsAbsent) {
    const Textured a = with_channel(make_box({2, 2, 2}), {"tag", PropertyMeaning::Any, 1}, 7);
    const Textured b = with_channel(make_box({1, 1, 9}), {"heat", PropertyMeaning::Any, 1}, 0.5);
    const std::array operands{a.operand(), b.operand()};
    const PropertyMesh result = to_property_mesh(evaluate(a.solid | b.solid), operands);
    ASSERT_EQ(result.properties.channels.size(), 2U);
    EXPECT_EQ(result.properties.channels[0].name, "tag");
    std::size_t seen = 0;
    for (std::size_t c = 0; c < result.mesh.corners.size(); ++c) {
        const auto row = result.properties.at(c);
        const bool is_a = result.source[c / 3].operand == a.solid.source_id();
        seen |= is_a ? 1U : 2U;
        EXPECT_EQ(is_a ? row[0] : row[1], is_a ? 7 : 0.5);
        EXPECT_TRUE(std::isnan(is_a ? row[1] : row[0]));
    }
    EXPECT_EQ(seen, 3U);
}

TEST(PropertyMesh, NormalsOfWallsOfHolesAreTurned) {
    const PropertyChannel normal{"normal", PropertyMeaning::Normal, 3};
    const Textured a = with_channel(make_box({2, 2, 2}), normal, 1);
    const Textured b = with_channel(make_box({1, 1, 9}), normal, 1);
    const std::array operands{a.operand(), b.operand()};
    const PropertyMesh result = to_property_mesh(evaluate(a.solid - b.solid), operands);
    for (std::size_t c = 0; c < result.mesh.corners.size(); ++c) {
        const bool is_a = result.source[c / 3].operand == a.solid.source_id();
        EXPECT_EQ(result.properties.at(c)[1], is_a ? 1 : -1);
    }
}

TEST(PropertyMesh, ChannelsOfOneNameMustAgree) {
    const Textured a = with_channel(make_box({2, 2, 2}), {"tag", PropertyMeaning::Any, 1}, 7);
    const Textured b = with_channel(make_box({1, 1, 9}), {"tag", PropertyMeaning::Any, 2}, 7);
    const std::array operands{a.operand(), b.operand()};
    EXPECT_THROW((void)to_property_mesh(a.solid, operands), UsageError);
}

}  // namespace
}  // namespace trisect
