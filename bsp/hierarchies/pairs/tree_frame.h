// SPDX-License-Identifier: Apache-2.0
//
// TreeFrame: units of a tree's numbers, and maps between trees.
#pragma once

#include <array>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

/// Positions p of a model are z = (p - origin) / unit in its tree. There everything is within
/// [-1, 1]^3, where floats are good; and what doubles make of a vertex is within `error` of it.
struct TreeFrame {
    std::array<double, 3> origin{};
    double unit = 1;  ///< a power of two
    double error = 0;

    TreeFrame() = default;
    explicit TreeFrame(const detail::InterferenceModelData& model);

    [[nodiscard]] std::array<double, 3> operator()(const std::array<double, 3>& p) const {
        return {(p[0] - origin[0]) / unit, (p[1] - origin[1]) / unit, (p[2] - origin[2]) / unit};
    }
};

/// From the frame of B's tree to that of A's: y = m z + t. Each exact entry of m is within m_error,
/// each component of t within t_error of what stands here.
struct FrameMap {
    std::array<std::array<double, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<double, 3> t{};
    double m_error = 0;
    double t_error = 0;
    double stretch = 1;  ///< images of unit vectors are at most this long

    FrameMap() = default;
    FrameMap(const TreeFrame& a, const TreeFrame& b, const detail::ApproximateMap& b_to_a);

    [[nodiscard]] std::array<double, 3> operator()(const std::array<double, 3>& z) const {
        std::array<double, 3> y{};
        for (std::size_t i = 0; i < 3; ++i)
            y[i] = ((m[i][0] * z[0] + m[i][1] * z[1]) + m[i][2] * z[2]) + t[i];
        return y;
    }
    /// Bound on the error of a component of the image of a point with |z_i| <= 2, z itself exact.
    [[nodiscard]] double error() const { return error_; }

private:
    double error_ = 0;
};

}  // namespace trisect::hierarchies
