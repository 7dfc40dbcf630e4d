// SPDX-License-Identifier: Apache-2.0
//
// PairCorners: points of a boundary to some 100 bits.
//
// A coordinate X / W is off by less than 2^-97 of itself: 2^-100 for either number and for the
// quotient. Let M bound all coordinates, so that each is off by at most e = 2^-97 M.
//
// Differences of corners are off by 2 e, and 2^-102 M for the subtraction: by less than 4 e. With
// |u| and |v| the sums of the magnitudes of two such vectors' components, a component of their
// product is off by
//     4 e (|u| + |v|) + 16 e² + 2^-101 |u| |v| + 2^-102 |u| |v|,
// and 8 e (|u| + |v| + 8 e) + 2^-98 |u| |v| is taken, which has room for the rounding of the bound.
// The length of the product is off by at most twice that (the root of 3 for three components), and
// by 2^-98 of itself for the squares and their root.
//
// The determinant det(o, p, q) = o · ((p - o) × (q - o)) is off by 3 M times a component's bound,
// by 3 e times the component, and by 2^-100 of the sum of magnitudes for the products and sums:
// 4 M times the bound and 2^-94 M |u| |v| are taken.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/number/double_pair.h>
#include <trisect/kernel/point.h>

namespace trisect::detail {

/// A sum in pairs of doubles, and what it is off by at most.
class PairSum {
public:
    void add(const DoublePair& term, double error) {
        sum_ = detail::add(sum_, term);
        size_ += std::fabs(term.high);
        error_ += error;
        ++count_;
    }
    /// Every addition is off by 2^-102 of what has come together; doubles of the bound by 2^-40.
    [[nodiscard]] double error() const {
        const double additions = 0x1p-102 * static_cast<double>(count_ + 1) * size_;
        return 1.001 * (error_ + additions);
    }
    [[nodiscard]] ExactRational middle() const {
        return ExactRational::from_double(sum_.high) + ExactRational::from_double(sum_.low);
    }

private:
    DoublePair sum_;
    double size_ = 0;
    double error_ = 0;
    std::size_t count_ = 0;
};

class PairCorners {
public:
    explicit PairCorners(std::size_t vertices) : points_(vertices), is_made_(vertices, 0) {}

    /// A corner that sums need.
    void make(std::uint32_t vertex, const Point& point) {
        if (is_made_[vertex] != 0) return;
        is_made_[vertex] = 1;
        points_[vertex] = coordinates_of(point);
    }

    /// Adds the determinant of the triangle's corners.
    void add_determinant(std::uint32_t o, std::uint32_t p, std::uint32_t q, PairSum& sum) const {
        const Product c = product(o, p, q);
        DoublePair det;
        for (std::size_t k = 0; k < 3; ++k) det = add(det, multiply(points_[o][k], c.at[k]));
        sum.add(det, 4 * reach_ * c.error + 0x1p-94 * reach_ * c.size);
    }
    /// Adds twice the triangle's area.
    void add_area(std::uint32_t o, std::uint32_t p, std::uint32_t q, PairSum& sum) const {
        const Product c = product(o, p, q);
        DoublePair square;
        for (std::size_t k = 0; k < 3; ++k) square = add(square, multiply(c.at[k], c.at[k]));
        const DoublePair length = root(square);
        sum.add(length, 2 * c.error + 0x1p-97 * length.high);
    }

private:
    using Coordinates = std::array<DoublePair, 3>;
    struct Product {
        Coordinates at;
        double size = 0;   // the product of the vectors' sizes
        double error = 0;  // of a component
    };

    Coordinates coordinates_of(const Point& point) {
        Coordinates out;
        if (point.is_lattice()) {
            const std::array<double, 3> c = point.lattice().doubles();
            for (std::size_t k = 0; k < 3; ++k) out[k].high = c[k];
        } else {
            const HomogeneousPoint& h = point.plane_point()->exact;
            const ScaledPair w = to_scaled_pair(h.w);
            for (std::size_t k = 0; k < 3; ++k) {
                const ScaledPair x = to_scaled_pair(h.xyz[k]);
                const double factor = std::ldexp(1, 64 * (x.shift - w.shift));
                const DoublePair quotient = divide(x.value, w.value);
                out[k] = {quotient.high * factor, quotient.low * factor};
            }
        }
        for (const DoublePair& c : out) reach_ = std::max(reach_, std::fabs(c.high));
        return out;
    }

    // Of the sides from o to p and to q.
    [[nodiscard]] Product product(std::uint32_t o, std::uint32_t p, std::uint32_t q) const {
        Coordinates u;
        Coordinates v;
        double size_u = 0;
        double size_v = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = subtract(points_[p][k], points_[o][k]);
            v[k] = subtract(points_[q][k], points_[o][k]);
            size_u += std::fabs(u[k].high);
            size_v += std::fabs(v[k].high);
        }
        Product out;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            out.at[k] = subtract(multiply(u[i], v[j]), multiply(u[j], v[i]));
        }
        const double e = 0x1p-97 * reach_;
        out.size = size_u * size_v;
        out.error = 8 * e * (size_u + size_v + 8 * e) + 0x1p-98 * out.size;
        return out;
    }

    std::vector<Coordinates> points_;  // by vertex
    std::vector<std::uint8_t> is_made_;
    double reach_ = 0;  // largest magnitude of a coordinate
};

/// The corners of some faces; `boundary` as in face_sets.h.
template <class Boundary>
[[nodiscard]] PairCorners pair_corners(const Boundary& boundary,
                                       std::span<const std::uint32_t> faces) {
    PairCorners out(boundary.vertex_count());
    for (const std::uint32_t f : faces)
        boundary.for_each_corner(f, [&](std::uint32_t v) { out.make(v, boundary.point(v)); });
    return out;
}

}  // namespace trisect::detail
