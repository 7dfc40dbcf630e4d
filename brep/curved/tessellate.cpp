// SPDX-License-Identifier: Apache-2.0
//
// The bound. Let L be linear on a triangle of the parameter plane that lies in a rectangle l1 × l2,
// equal to the surface S at the corners p_k. At x = Σ λ_k p_k, by Taylor's theorem around x,
//
//     |S(x) - L(x)| <= Σ λ_k (du_k² M_uu + 2 |du_k dv_k| M_uv + dv_k² M_vv) / 2
//
// with (du_k, dv_k) = p_k - x and bounds M of the second derivatives. Numbers with mean 0 in a
// range of l1 have Σ λ_k du_k² <= l1² / 4, so
//
//     |S - L| <= (l1² M_uu + 2 l1 l2 M_uv + l2² M_vv) / 8
//
// whatever the triangle. S(x) and L(x) belong to each other, so this bounds the distance both ways.
// To it add what evaluation and rounding do to the corners.

#include <trisect/brep/curved/tessellate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <trisect/brep/curved/control_net.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::ControlNet;
using detail::SecondDerivatives;
using detail::SideCurve;

constexpr std::uint32_t max_level = 20;
constexpr std::uint64_t max_cells = std::uint64_t{1} << 26;

// Bounds over the whole square from those of its quarters, which are much tighter.
SecondDerivatives bounds_by_quarters(const ControlNet& net, int depth) {
    if (depth == 0) return net.second_derivatives();
    SecondDerivatives worst;
    const auto [low, high] = net.halves_in_u();
    for (const ControlNet* half : {&low, &high}) {
        const auto [first, second] = half->halves_in_v();
        for (const ControlNet* quarter : {&first, &second}) {
            const SecondDerivatives b = bounds_by_quarters(*quarter, depth - 1);
            worst.uu = std::max(worst.uu, 4 * b.uu);
            worst.uv = std::max(worst.uv, 4 * b.uv);
            worst.vv = std::max(worst.vv, 4 * b.vv);
        }
    }
    return worst;
}

// How often a patch is halved each way.
struct Levels {
    std::uint32_t u = 0;
    std::uint32_t v = 0;
    double deviation = 0;
};

double deviation_of(const SecondDerivatives& m, std::uint32_t u, std::uint32_t v) {
    const double a = std::ldexp(1, -static_cast<int>(u));
    const double b = std::ldexp(1, -static_cast<int>(v));
    return (1 + 0x1p-40) * (a * a * m.uu + 2 * a * b * m.uv + b * b * m.vv) / 8;
}

// The fewest cells within the deviation.
Levels choose_levels(const SecondDerivatives& m, double deviation) {
    Levels best{max_level + 1, max_level + 1, 0};
    std::uint32_t v = max_level;
    for (std::uint32_t u = 0; u <= max_level; ++u) {
        while (v > 0 && deviation_of(m, u, v - 1) <= deviation) --v;
        const double reached = deviation_of(m, u, v);
        if (reached <= deviation && u + v < best.u + best.v) best = {u, v, reached};
    }
    if (best.u > max_level)
        throw LimitError("a patch would have to be divided more than 2^20 times one way");
    return best;
}

class Tessellator {
public:
    Tessellator(const CurvedBoundary& boundary, double deviation)
        : boundary_(boundary), deviation_(deviation) {
        double largest = 0;
        for (const BezierPatch& p : boundary.patches()) {
            nets_.emplace_back(p);
            for (const Point3d& c : p.points())
                for (const double x : c) largest = std::max(largest, std::abs(x));
        }
        int exponent = 0;
        (void)std::frexp(largest, &exponent);
        grid_ = std::ldexp(1, exponent - 44);
    }

    Tessellation run() {
        choose();
        side_vertices_.resize(nets_.size());
        for (std::uint32_t p = 0; p < nets_.size(); ++p)
            for (std::uint32_t k = 0; k < 4; ++k) make_side({p, k});
        for (std::uint32_t p = 0; p < nets_.size(); ++p) make_cells(p);
        double reached = 0;
        for (const Levels& l : levels_) reached = std::max(reached, l.deviation);
        out_.deviation = reached + vertex_error_;
        if (!(out_.deviation <= deviation_)) throw_too_fine();
        return std::move(out_);
    }

private:
    using Side = CurvedBoundary::Side;

    [[noreturn]] static void throw_too_fine() {
        throw UsageError("the deviation is finer than doubles can tell on this boundary");
    }

    void choose() {
        // Vertices are off by less than a thousandth of the deviation, or it is too fine.
        const double left = deviation_ * (1 - 0x1p-10);
        if (!(left > 0x1p10 * grid_)) throw_too_fine();
        std::uint64_t cells = 0;
        for (const ControlNet& net : nets_) {
            levels_.push_back(choose_levels(bounds_by_quarters(net, 2), left));
            cells += std::uint64_t{1} << (levels_.back().u + levels_.back().v);
            if (cells > max_cells) throw LimitError("a tessellation of more than 2^26 cells");
        }
    }

    std::uint32_t add_vertex(const CertifiedPoint& p) {
        Point3d rounded{};
        double moved = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            rounded[k] = std::nearbyint(p.position[k] / grid_) * grid_ + 0.0;
            moved = std::max(moved, std::abs(rounded[k] - p.position[k]));
        }
        vertex_error_ = std::max(vertex_error_, 1.8 * (moved + p.error));
        out_.mesh.points.push_back(rounded);
        return static_cast<std::uint32_t>(out_.mesh.points.size() - 1);
    }
    // A corner of a patch is a control point, whatever curve leads there.
    std::uint32_t corner_vertex(const Point3d& p) {
        const auto [it, is_new] = corners_.try_emplace(p, 0);
        if (is_new) it->second = add_vertex({p, 0});
        return it->second;
    }

    [[nodiscard]] std::uint32_t own_level(Side s) const {
        return s.number % 2 == 0 ? levels_[s.patch].u : levels_[s.patch].v;
    }
    void make_side(Side side) {
        std::vector<std::uint32_t>& vertices = side_vertices_[side.patch][side.number];
        if (!vertices.empty()) return;
        const SideCurve curve = detail::side_curve(boundary_.patches()[side.patch], side.number);
        if (boundary_.is_point(side)) {
            vertices.assign((std::size_t{1} << own_level(side)) + 1,
                            corner_vertex(curve.points.front()));
            return;
        }
        const Side partner = boundary_.partner(side);
        const std::size_t n = std::size_t{1} << std::max(own_level(side), own_level(partner));
        const ControlNet net(curve.points.size() - 1, curve.points, curve.weights);
        vertices.push_back(corner_vertex(curve.points.front()));
        for (std::size_t k = 1; k < n; ++k)
            vertices.push_back(
                add_vertex(net.at(static_cast<double>(k) / static_cast<double>(n), 0)));
        vertices.push_back(corner_vertex(curve.points.back()));
        std::vector<std::uint32_t>& others = side_vertices_[partner.patch][partner.number];
        others.assign(vertices.rbegin(), vertices.rend());
    }

    // The vertices of one side of a cell: of those on the patch's side, a range.
    void append_side(std::uint32_t patch, std::uint32_t number, std::size_t cell,
                     std::vector<std::uint32_t>& loop) const {
        const auto& vertices = side_vertices_[patch][number];
        const std::size_t cells = std::size_t{1} << own_level({patch, number});
        const std::size_t steps = (vertices.size() - 1) / cells;
        for (std::size_t k = 0; k < steps; ++k) loop.push_back(vertices[cell * steps + k]);
    }

    void make_cells(std::uint32_t patch) {
        const std::size_t nu = std::size_t{1} << levels_[patch].u;
        const std::size_t nv = std::size_t{1} << levels_[patch].v;
        const auto at = [&](double i, double j) {
            return nets_[patch].at(i / static_cast<double>(nu), j / static_cast<double>(nv));
        };
        const auto first = static_cast<std::uint32_t>(out_.mesh.points.size());
        for (std::size_t i = 1; i < nu; ++i)
            for (std::size_t j = 1; j < nv; ++j)
                add_vertex(at(static_cast<double>(i), static_cast<double>(j)));
        const auto inner = [&](std::size_t i, std::size_t j) {
            return first + static_cast<std::uint32_t>((i - 1) * (nv - 1) + j - 1);
        };
        const auto& sides = side_vertices_[patch];
        const auto vertex = [&](std::size_t i, std::size_t j) {
            const auto on = [&](std::uint32_t number, std::size_t cell, std::size_t cells) {
                return sides[number][cell * ((sides[number].size() - 1) / cells)];
            };
            if (j == 0) return on(0, i, nu);
            if (i == nu) return on(1, j, nv);
            if (j == nv) return on(2, nu - i, nu);
            if (i == 0) return on(3, nv - j, nv);
            return inner(i, j);
        };
        std::vector<std::uint32_t> loop;
        for (std::size_t i = 0; i < nu; ++i)
            for (std::size_t j = 0; j < nv; ++j) {
                loop.clear();
                j == 0 ? append_side(patch, 0, i, loop) : loop.push_back(vertex(i, j));
                i + 1 == nu ? append_side(patch, 1, j, loop) : loop.push_back(vertex(i + 1, j));
                j + 1 == nv ? append_side(patch, 2, nu - 1 - i, loop)
                            : loop.push_back(vertex(i + 1, j + 1));
                i == 0 ? append_side(patch, 3, nv - 1 - j, loop) : loop.push_back(vertex(i, j + 1));
                if (loop.size() == 4) {
                    add_quadrangle(patch, loop);
                    continue;
                }
                const std::uint32_t middle =
                    add_vertex(at(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5));
                for (std::size_t k = 0; k < loop.size(); ++k)
                    add_triangle(patch, middle, loop[k], loop[(k + 1) % loop.size()]);
            }
    }

    // Along the shorter diagonal.
    void add_quadrangle(std::uint32_t patch, const std::vector<std::uint32_t>& q) {
        const auto square = [&](std::uint32_t a, std::uint32_t b) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double d = out_.mesh.points[a][k] - out_.mesh.points[b][k];
                sum += d * d;
            }
            return sum;
        };
        const std::size_t s = square(q[0], q[2]) <= square(q[1], q[3]) ? 0 : 1;
        add_triangle(patch, q[s], q[s + 1], q[s + 2]);
        add_triangle(patch, q[s], q[s + 2], q[(s + 3) % 4]);
    }
    void add_triangle(std::uint32_t patch, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a == b || b == c || c == a) return;  // at a point
        out_.mesh.add_triangle(a, b, c);
        out_.patch_of_face.push_back(patch);
    }

    const CurvedBoundary& boundary_;
    double deviation_;
    double grid_ = 0;
    std::vector<ControlNet> nets_;
    std::vector<Levels> levels_;
    std::vector<std::array<std::vector<std::uint32_t>, 4>> side_vertices_;
    std::map<Point3d, std::uint32_t> corners_;
    double vertex_error_ = 0;
    Tessellation out_;
};

}  // namespace

Tessellation tessellate(const CurvedBoundary& boundary, double deviation) {
    if (!(deviation > 0 && std::isfinite(deviation)))
        throw UsageError("the deviation of a tessellation must be a positive number");
    return Tessellator(boundary, deviation).run();
}

}  // namespace trisect
