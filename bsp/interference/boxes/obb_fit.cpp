// SPDX-License-Identifier: Apache-2.0
//
// Boxes along the principal axes of the area, not of the vertices: then a finely triangulated
// corner does not turn the box of the large faces beside it (Gottschalk, Lin and Manocha, OBBTree,
// SIGGRAPH 1996, section 4). Nothing here need be exact: any frame gives a box that contains its
// triangles.

#include <trisect/bsp/interference/boxes/obb_fit.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {

namespace {

using SymmetricMatrix = std::array<Vector3, 3>;

// One rotation of Jacobi's method that makes a[p][q] zero.
void rotate(SymmetricMatrix& a, SymmetricMatrix& v, std::size_t p, std::size_t q) {
    if (a[p][q] == 0) return;
    const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    const double t = std::copysign(1 / (std::abs(theta) + std::sqrt(theta * theta + 1)), theta);
    const double c = 1 / std::sqrt(t * t + 1);
    const double s = t * c;
    const std::size_t r = 3 - p - q;
    const double arp = a[r][p];
    const double arq = a[r][q];
    a[p][p] -= t * a[p][q];
    a[q][q] += t * a[p][q];
    a[p][q] = a[q][p] = 0;
    a[r][p] = a[p][r] = c * arp - s * arq;
    a[r][q] = a[q][r] = s * arp + c * arq;
    for (std::size_t k = 0; k < 3; ++k) {
        const double vkp = v[k][p];
        const double vkq = v[k][q];
        v[k][p] = c * vkp - s * vkq;
        v[k][q] = s * vkp + c * vkq;
    }
}

// Exactly orthogonal up to rounding, whatever came in. \pre x != 0
AreaFrame frame_of(const Vector3& x, const Vector3& roughly_y) {
    AreaFrame f;
    f.axis[0] = scaled(x, 1 / std::sqrt(dot(x, x)));
    Vector3 y = minus(roughly_y, scaled(f.axis[0], dot(f.axis[0], roughly_y)));
    double yy = dot(y, y);
    if (!(yy > 1e-12 * dot(roughly_y, roughly_y)) || !(yy > 0)) {
        std::size_t least = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (std::abs(f.axis[0][k]) < std::abs(f.axis[0][least])) least = k;
        Vector3 e{};
        e[least] = 1;
        y = minus(e, scaled(f.axis[0], f.axis[0][least]));
        yy = dot(y, y);
    }
    y = scaled(y, 1 / std::sqrt(yy));
    y = minus(y, scaled(f.axis[0], dot(f.axis[0], y)));  // once more: the first may have cancelled
    f.axis[1] = scaled(y, 1 / std::sqrt(dot(y, y)));
    f.axis[2] = cross(f.axis[0], f.axis[1]);
    return f;
}

}  // namespace

void AreaMoments::add(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 n = cross(minus(b, a), minus(c, a));
    const double w = 0.5 * std::sqrt(dot(n, n));
    const Vector3 sum{a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]};
    area += w;
    for (std::size_t k = 0; k < 3; ++k) first[k] += w / 3 * sum[k];
    constexpr std::array<std::array<std::size_t, 2>, 6> pairs{
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = pairs[k];
        second[k] += w / 12 * (sum[i] * sum[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
    }
}

AreaFrame principal_frame(const AreaMoments& m) {
    if (!(m.area > 0)) return {};
    const Vector3 c{m.first[0] / m.area, m.first[1] / m.area, m.first[2] / m.area};
    SymmetricMatrix a{};
    SymmetricMatrix v{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};
    for (std::size_t i = 0; i < 3; ++i) a[i][i] = m.second[i] / m.area - c[i] * c[i];
    a[0][1] = a[1][0] = m.second[3] / m.area - c[0] * c[1];
    a[0][2] = a[2][0] = m.second[4] / m.area - c[0] * c[2];
    a[1][2] = a[2][1] = m.second[5] / m.area - c[1] * c[2];
    for (int sweep = 0; sweep < 12; ++sweep) {
        const double off = std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]);
        const double on = std::abs(a[0][0]) + std::abs(a[1][1]) + std::abs(a[2][2]);
        if (!(off > 1e-7 * on)) break;
        rotate(a, v, 0, 1);
        rotate(a, v, 0, 2);
        rotate(a, v, 1, 2);
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&a](std::size_t i, std::size_t j) { return a[i][i] > a[j][j]; });
    const auto column = [&v](std::size_t j) { return Vector3{v[0][j], v[1][j], v[2][j]}; };
    return frame_of(column(order[0]), column(order[1]));
}

AreaFrame triangle_frame(const Vector3& a, const Vector3& b, const Vector3& c) {
    const std::array<Vector3, 3> side{minus(b, a), minus(c, b), minus(a, c)};
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (dot(side[i], side[i]) > dot(side[longest], side[longest])) longest = i;
    if (!(dot(side[longest], side[longest]) > 0)) return {};
    return frame_of(side[longest], side[(longest + 1) % 3]);
}

}  // namespace trisect::detail
