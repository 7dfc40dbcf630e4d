// SPDX-License-Identifier: Apache-2.0
//
// All that happens to a net are convex combinations of its points (de Casteljau), so an error in
// the points stays what it is and each combination adds a rounding of numbers that are no larger
// than the largest one at the start: u = 2^-53 of it for a mean, 3 u for (1 - t) a + t b.
//
// Derivatives. Let N(u, v) and W(u, v) be numerator and denominator of the surface as seen from a
// centre c, N = Σ w (P - c) B B. They are polynomials, and a derivative of one is a mean of the
// differences of its control numbers, times the degree: a range of each number, not a bound on
// magnitudes alone, so that derivatives that cancel each other do so. With S = N / W,
//
//     S_u  = (N_u - S W_u) / W
//     S_uu = (N_uu - 2 S_u W_u - S W_uu) / W
//     S_uv = (N_uv - S_u W_v - S_v W_u - S W_uv) / W
//
// are computed in interval arithmetic. The ranges shrink when the patch is halved, and converge to
// the derivatives.

#include <trisect/brep/curved/control_net.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

Homogeneous mean(const Homogeneous& a, const Homogeneous& b) {
    Homogeneous m;
    for (std::size_t k = 0; k < 4; ++k) m[k] = 0.5 * a[k] + 0.5 * b[k];
    return m;
}

Homogeneous between(const Homogeneous& a, const Homogeneous& b, double t) {
    Homogeneous m;
    for (std::size_t k = 0; k < 4; ++k) m[k] = (1 - t) * a[k] + t * b[k];
    return m;
}

double length(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

// Every operation on ranges rounds outwards.
Range around(double lo, double hi) {
    const double slack = 0x1p-51 * std::max(std::abs(lo), std::abs(hi));
    return {lo - slack, hi + slack};
}
Range operator-(Range a, Range b) { return around(a.lo - b.hi, a.hi - b.lo); }
Range operator*(Range a, Range b) {
    const auto [lo, hi] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
    return around(lo, hi);
}
// \pre b.lo > 0
Range operator/(Range a, Range b) {
    const auto [lo, hi] = std::minmax({a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi});
    return around(lo, hi);
}
constexpr Range no_number{HUGE_VAL, -HUGE_VAL};

// Of each homogeneous coordinate of some points.
struct HomogeneousRange {
    std::array<Range, 4> of{no_number, no_number, no_number, no_number};
    void include(const Homogeneous& h) {
        for (std::size_t k = 0; k < 4; ++k)
            of[k] = {std::min(of[k].lo, h[k]), std::max(of[k].hi, h[k])};
    }
    // Of a derivative: differences, each off by an error, times a factor. Nothing was included
    // where the degree is too low for one: 0.
    [[nodiscard]] HomogeneousRange times(double factor, double error) const {
        HomogeneousRange r;
        for (std::size_t k = 0; k < 4; ++k)
            r.of[k] = of[k].lo > of[k].hi
                          ? Range{}
                          : around(factor * (of[k].lo - error), factor * (of[k].hi + error));
        return r;
    }
};

}  // namespace

void ControlNet::add(const Point3d& p, double w) {
    const Homogeneous h{w * p[0], w * p[1], w * p[2], w};
    for (const double c : h) largest_ = std::max(largest_, std::abs(c));
    // A product with 1 is exact.
    if (w != 1) error_ = std::max(error_, 2 * unit_roundoff * largest_);
    net_.push_back(h);
}

ControlNet::ControlNet(const BezierPatch& patch)
    : degree_u_(patch.degree_u()), degree_v_(patch.degree_v()) {
    net_.reserve(patch.points().size());
    for (std::size_t i = 0; i < patch.points().size(); ++i)
        add(patch.points()[i], patch.weights()[i]);
}

ControlNet::ControlNet(std::size_t degree, const std::vector<Point3d>& points,
                       const std::vector<double>& weights)
    : degree_u_(degree) {
    for (std::size_t i = 0; i < points.size(); ++i) add(points[i], weights[i]);
}

std::pair<ControlNet, ControlNet> ControlNet::halves_in_u() const {
    std::pair<ControlNet, ControlNet> r{*this, *this};
    for (ControlNet* half : {&r.first, &r.second})
        half->error_ += static_cast<double>(degree_u_) * 2 * unit_roundoff * largest_;
    std::vector<Homogeneous> row(degree_u_ + 1);
    for (std::size_t j = 0; j <= degree_v_; ++j) {
        for (std::size_t i = 0; i <= degree_u_; ++i) row[i] = net(i, j);
        for (std::size_t level = 0; level <= degree_u_; ++level) {
            r.first.net_[level * (degree_v_ + 1) + j] = row[0];
            r.second.net_[(degree_u_ - level) * (degree_v_ + 1) + j] = row[degree_u_ - level];
            for (std::size_t i = 0; i < degree_u_ - level; ++i) row[i] = mean(row[i], row[i + 1]);
        }
    }
    return r;
}

std::pair<ControlNet, ControlNet> ControlNet::halves_in_v() const {
    std::pair<ControlNet, ControlNet> r{*this, *this};
    for (ControlNet* half : {&r.first, &r.second})
        half->error_ += static_cast<double>(degree_v_) * 2 * unit_roundoff * largest_;
    std::vector<Homogeneous> row(degree_v_ + 1);
    for (std::size_t i = 0; i <= degree_u_; ++i) {
        for (std::size_t j = 0; j <= degree_v_; ++j) row[j] = net(i, j);
        for (std::size_t level = 0; level <= degree_v_; ++level) {
            r.first.net_[i * (degree_v_ + 1) + level] = row[0];
            r.second.net_[i * (degree_v_ + 1) + degree_v_ - level] = row[degree_v_ - level];
            for (std::size_t j = 0; j < degree_v_ - level; ++j) row[j] = mean(row[j], row[j + 1]);
        }
    }
    return r;
}

CertifiedPoint ControlNet::projected(const Homogeneous& h, double error) const {
    CertifiedPoint p;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        p.position[k] = h[3] == 1 ? h[k] : h[k] / h[3];
        largest = std::max(largest, std::abs(p.position[k]));
    }
    // |x/w - x'/w'| <= (|x - x'| + |x'/w'| |w - w'|) / w, and the quotient is rounded once.
    const double least = h[3] - error;
    p.error = least > 0 ? surely_more * (error * (1 + largest) / least) : INFINITY;
    if (h[3] != 1) p.error += 2 * unit_roundoff * largest;
    return p;
}

CertifiedPoint ControlNet::at(double u, double v) const {
    std::vector<Homogeneous> column(degree_u_ + 1);
    std::vector<Homogeneous> row(degree_v_ + 1);
    for (std::size_t i = 0; i <= degree_u_; ++i) {
        for (std::size_t j = 0; j <= degree_v_; ++j) row[j] = net(i, j);
        for (std::size_t level = degree_v_; level > 0; --level)
            for (std::size_t j = 0; j < level; ++j) row[j] = between(row[j], row[j + 1], v);
        column[i] = row[0];
    }
    for (std::size_t level = degree_u_; level > 0; --level)
        for (std::size_t i = 0; i < level; ++i) column[i] = between(column[i], column[i + 1], u);
    const auto steps = static_cast<double>(degree_u_ + degree_v_);
    return projected(column[0], error_ + steps * 4 * unit_roundoff * largest_);
}

CertifiedPoint ControlNet::corner(std::size_t u, std::size_t v) const {
    return projected(net(u * degree_u_, v * degree_v_), error_);
}

ControlNet::Hull ControlNet::hull() const {
    Hull r;
    r.points.reserve(net_.size());
    for (const Homogeneous& h : net_) {
        const CertifiedPoint p = projected(h, error_);
        r.points.push_back(p.position);
        r.radius = std::max(r.radius, 1.8 * p.error);
    }
    return r;
}

SecondDerivatives ControlNet::second_derivatives() const {
    // Seen from the middle of the corners.
    Point3d c{};
    for (const std::size_t u : {0U, 1U})
        for (const std::size_t v : {0U, 1U})
            for (std::size_t k = 0; k < 3; ++k) c[k] += 0.25 * corner(u, v).position[k];
    double size = 0;
    for (const double x : c) size = std::max(size, std::abs(x));
    std::vector<Homogeneous> seen = net_;
    for (Homogeneous& h : seen)
        for (std::size_t k = 0; k < 3; ++k) h[k] -= c[k] * h[3];
    const double error =
        surely_more * (error_ * (1 + size) + 4 * unit_roundoff * largest_ * (1 + size));

    // Of the surface: its points are means of these.
    VectorRange surface{no_number, no_number, no_number};
    HomogeneousRange whole;
    for (const Homogeneous& h : seen) {
        const Range w = around(h[3] - error, h[3] + error);
        if (!(w.lo > 0)) {
            constexpr Range any{-HUGE_VAL, HUGE_VAL};
            constexpr VectorRange unknown{any, any, any};
            return {unknown, unknown, unknown};
        }
        whole.include(h);
        for (std::size_t k = 0; k < 3; ++k) {
            const Range x = around(h[k] - error, h[k] + error) / w;
            surface[k] = {std::min(surface[k].lo, x.lo), std::max(surface[k].hi, x.hi)};
        }
    }
    const Range weight = whole.times(1, error).of[3];

    const auto p = static_cast<double>(degree_u_);
    const auto q = static_cast<double>(degree_v_);
    const auto at = [&](std::size_t i, std::size_t j) { return seen[i * (degree_v_ + 1) + j]; };
    const auto minus = [](Homogeneous a, const Homogeneous& b) {
        for (std::size_t k = 0; k < 4; ++k) a[k] -= b[k];
        return a;
    };
    HomogeneousRange u;
    HomogeneousRange v;
    HomogeneousRange uu;
    HomogeneousRange uv;
    HomogeneousRange vv;
    for (std::size_t i = 0; i <= degree_u_; ++i)
        for (std::size_t j = 0; j <= degree_v_; ++j) {
            if (i < degree_u_) u.include(minus(at(i + 1, j), at(i, j)));
            if (j < degree_v_) v.include(minus(at(i, j + 1), at(i, j)));
            if (i + 1 < degree_u_)
                uu.include(minus(minus(at(i + 2, j), at(i + 1, j)), minus(at(i + 1, j), at(i, j))));
            if (j + 1 < degree_v_)
                vv.include(minus(minus(at(i, j + 2), at(i, j + 1)), minus(at(i, j + 1), at(i, j))));
            if (i < degree_u_ && j < degree_v_)
                uv.include(
                    minus(minus(at(i + 1, j + 1), at(i + 1, j)), minus(at(i, j + 1), at(i, j))));
        }
    // Rounding of the differences is less than what the factors of `error` leave.
    const double e = 2 * error + 4 * unit_roundoff * largest_ * (1 + size);
    u = u.times(p, e);
    v = v.times(q, e);
    uu = uu.times(p * (p - 1), 2 * e);
    vv = vv.times(q * (q - 1), 2 * e);
    uv = uv.times(p * q, 2 * e);

    const Range two{2, 2};
    SecondDerivatives r;
    for (std::size_t k = 0; k < 3; ++k) {
        const Range s = surface[k];
        const Range s_u = (u.of[k] - s * u.of[3]) / weight;
        const Range s_v = (v.of[k] - s * v.of[3]) / weight;
        r.uu[k] = (uu.of[k] - two * s_u * u.of[3] - s * uu.of[3]) / weight;
        r.uv[k] = (uv.of[k] - s_u * v.of[3] - s_v * u.of[3] - s * uv.of[3]) / weight;
        r.vv[k] = (vv.of[k] - two * s_v * v.of[3] - s * vv.of[3]) / weight;
    }
    return r;
}

double ControlNet::length_in_u() const {
    const Hull h = hull();
    double longest = 0;
    for (std::size_t j = 0; j <= degree_v_; ++j) {
        double sum = 0;
        for (std::size_t i = 0; i < degree_u_; ++i) {
            const Point3d& a = h.points[i * (degree_v_ + 1) + j];
            const Point3d& b = h.points[(i + 1) * (degree_v_ + 1) + j];
            sum += length(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        }
        longest = std::max(longest, sum);
    }
    return longest;
}

double ControlNet::length_in_v() const {
    const Hull h = hull();
    double longest = 0;
    for (std::size_t i = 0; i <= degree_u_; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < degree_v_; ++j) {
            const Point3d& a = h.points[i * (degree_v_ + 1) + j];
            const Point3d& b = h.points[i * (degree_v_ + 1) + j + 1];
            sum += length(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        }
        longest = std::max(longest, sum);
    }
    return longest;
}

ControlNet ControlNet::moved(const std::array<double, 12>& map) const {
    ControlNet r = *this;
    double rows = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        for (std::size_t k = 0; k < 4; ++k) row += std::abs(map[4 * i + k]);
        rows = std::max(rows, row);
    }
    for (Homogeneous& h : r.net_) {
        const Homogeneous x = h;
        for (std::size_t i = 0; i < 3; ++i)
            h[i] = map[4 * i] * x[0] + map[4 * i + 1] * x[1] + map[4 * i + 2] * x[2] +
                   map[4 * i + 3] * x[3];
    }
    r.largest_ = surely_more * rows * largest_;
    // 2^-50 of each product for the map, at most 5·2^-53 for products and sums.
    r.error_ = surely_more * (rows * error_ + 0x1p-49 * rows * largest_);
    return r;
}

}  // namespace trisect::detail
