// SPDX-License-Identifier: Apache-2.0
//
// The slab of the direction d about the image of a k-DOP: the largest d · (M z + t) over it. With
// M^T d = Σ w_i d_i, w_i >= 0, it is at most Σ w_i h_i + d · t, by linear programming duality, and
// equal to that for the right three i. Which three are right depends on the k-DOP; but for one
// whose slabs all touch the unit ball they are the corners of the face of the directions' convex
// hull through which M^T d passes, and those are taken for all (Zachmann 1998 does the same with
// the corners of a generic DOP). So a placement costs one search for each direction, and then a
// volume three products for each. Klosowski et al. (1998) instead keep the corners of each k-DOP
// and climb to the extreme ones: tighter, and ten times the work.
//
// Errors. Whatever the weights are, M^T d = Σ w_i d_i + r with a residual r, and d·(M z) <= Σ w_i
// h_i + |r|_1 max |z_k|, where |z_k| <= 2. The residual is computed (6 products and sums, 2^-49 of
// magnitudes) and has 3 m_error more. The product with h, |h| <= 8: three products, three sums and
// the rounding to float, at most 2^-23 of the sum of magnitudes.

#include <trisect/bsp/hierarchies/volumes/kdop.h>

#include <map>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/kernel/contract.h>

namespace trisect::hierarchies {

namespace {

using detail::cross;
using detail::dot;
using detail::minus;
using detail::scaled;
using detail::Vector3;

// Three directions that span a face of the hull of all, and the inverse of their matrix.
struct Cone {
    std::array<std::uint8_t, 3> from{};
    std::array<Vector3, 3> inverse{};  // weights are its rows times a vector
};

std::vector<Vector3> signed_directions(std::span<const std::array<int, 3>> directions) {
    std::vector<Vector3> r;
    for (const double sign : {1.0, -1.0})
        for (const auto& d : directions) r.push_back({sign * d[0], sign * d[1], sign * d[2]});
    return r;
}

std::vector<Cone> cones_of(std::span<const std::array<int, 3>> directions) {
    const std::vector<Vector3> all = signed_directions(directions);
    std::vector<Vector3> unit;
    for (const Vector3& d : all) unit.push_back(scaled(d, 1 / std::sqrt(dot(d, d))));
    std::vector<Cone> cones;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j)
            for (std::size_t k = j + 1; k < all.size(); ++k) {
                Vector3 normal = cross(minus(unit[j], unit[i]), minus(unit[k], unit[i]));
                const double height = dot(normal, unit[i]);
                if (std::abs(height) < 1e-9) continue;
                normal = scaled(normal, 1 / height);
                const bool face = std::ranges::none_of(
                    unit, [&normal](const Vector3& u) { return dot(normal, u) > 1 + 1e-9; });
                if (!face) continue;
                const double det = dot(all[i], cross(all[j], all[k]));
                cones.push_back({{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j),
                                  static_cast<std::uint8_t>(k)},
                                 {scaled(cross(all[j], all[k]), 1 / det),
                                  scaled(cross(all[k], all[i]), 1 / det),
                                  scaled(cross(all[i], all[j]), 1 / det)}});
            }
    return cones;
}

const std::vector<Cone>& cones(std::span<const std::array<int, 3>> directions) {
    static const std::map<std::size_t, std::vector<Cone>> known{
        {3, cones_of(KDop<6>::directions)},
        {7, cones_of(KDop<14>::directions)},
        {9, cones_of(KDop<18>::directions)},
        {13, cones_of(KDop<26>::directions)}};
    return known.at(directions.size());
}

KDopTurn::Bound bound(const Vector3& pulled, std::span<const Cone> all,
                      std::span<const Vector3> directions) {
    const Cone* best = nullptr;
    Vector3 best_weight{};
    double best_least = -std::numeric_limits<double>::infinity();
    for (const Cone& c : all) {
        const Vector3 w{dot(c.inverse[0], pulled), dot(c.inverse[1], pulled),
                        dot(c.inverse[2], pulled)};
        const double least = std::min({w[0], w[1], w[2]});
        if (least > best_least) {
            best_least = least;
            best = &c;
            best_weight = w;
        }
        if (least >= 0) break;
    }
    TRISECT_EXPECTS(best != nullptr, "no cone of directions");
    KDopTurn::Bound r;
    r.from = best->from;
    Vector3 residual = pulled;
    double size = std::abs(pulled[0]) + std::abs(pulled[1]) + std::abs(pulled[2]);
    for (std::size_t i = 0; i < 3; ++i) {
        r.weight[i] = std::max(0.0, best_weight[i]);
        residual = minus(residual, scaled(directions[r.from[i]], r.weight[i]));
        size += 3 * r.weight[i];
    }
    const double left = std::abs(residual[0]) + std::abs(residual[1]) + std::abs(residual[2]);
    r.shift =
        2.01 * (left + 0x1p-49 * size) + 0x1p-22 * 3.01 * (r.weight[0] + r.weight[1] + r.weight[2]);
    return r;
}

}  // namespace

KDopTurn::KDopTurn(std::span<const std::array<int, 3>> axes, const FrameMap& map) {
    const std::vector<Vector3> all = signed_directions(axes);
    const std::vector<Cone>& faces = cones(axes);
    bounds.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Vector3& d = all[i];
        Vector3 pulled{};
        double along = 0;
        double size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t j = 0; j < 3; ++j) pulled[k] += map.m[j][k] * d[j];
            along += d[k] * map.t[k];
            size += std::abs(map.t[k]);
        }
        bounds[i] = bound(pulled, faces, all);
        // 2 |z|_1 is at most 6: of pulled, rounded, and of the matrix.
        const double matrix = std::abs(pulled[0]) + std::abs(pulled[1]) + std::abs(pulled[2]);
        const double errors = 0x1p-48 * (matrix + map.stretch) + 18.1 * map.m_error +
                              3.01 * map.t_error + 0x1p-22 * size;
        bounds[i].shift += along + errors;
    }
}

}  // namespace trisect::hierarchies
