// SPDX-License-Identifier: Apache-2.0
#include "corpus_slanted.h"

#include <trisect/brep/primitives/box.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace trisect::app {
namespace {

using enum BooleanOperation;
using SlantedScenes = std::vector<SlantedScene>;

/// splitmix64 (Steele, Lea, Flood 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::int64_t below(std::int64_t n) {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return static_cast<std::int64_t>((z ^ (z >> 31)) % static_cast<std::uint64_t>(n));
    }

private:
    std::uint64_t state_;
};

ExactRational half(std::int64_t v) { return ExactRational(v).scaled(-1); }

/// area += factor · √radicand; squares become rational.
void add_root(CountedResult& out, const ExactRational& factor, std::int64_t radicand) {
    const auto root = static_cast<std::int64_t>(std::llround(std::sqrt(double(radicand))));
    if (root * root == radicand) {
        out.area += factor * ExactRational(root);
    } else {
        out.area_roots[radicand] += factor;
    }
}

void add_square(PolygonMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                std::uint32_t d) {
    mesh.add_triangle(a, b, c);
    mesh.add_triangle(a, c, d);
}

// ---------------------------------------------------------------- terrain

/// Integer heights over a grid of n × n unit squares, each cut from (i, j) to (i + 1, j + 1).
class Terrain {
public:
    Terrain(int n, int top, std::uint64_t seed) : n_(n), top_(top) {
        Random random(seed);
        for (int k = 0; k < (n + 1) * (n + 1); ++k) heights_.push_back(1 + random.below(top - 1));
    }

    /// What lies under the surface and over z = 0.
    [[nodiscard]] PolygonMesh solid() const {
        PolygonMesh mesh;
        for (const bool low : {true, false})
            for (int i = 0; i <= n_; ++i)
                for (int j = 0; j <= n_; ++j)
                    mesh.points.push_back({double(i), double(j), low ? 0. : double(height(i, j))});
        const auto at = [this](int i, int j, bool up) {
            return static_cast<std::uint32_t>((up ? (n_ + 1) * (n_ + 1) : 0) + i * (n_ + 1) + j);
        };
        for (int i = 0; i < n_; ++i) {
            for (int j = 0; j < n_; ++j) {
                add_square(mesh, at(i, j, false), at(i, j + 1, false), at(i + 1, j + 1, false),
                           at(i + 1, j, false));
                add_square(mesh, at(i, j, true), at(i + 1, j, true), at(i + 1, j + 1, true),
                           at(i, j + 1, true));
            }
            const auto wall = [&](int i0, int j0, int i1, int j1) {
                add_square(mesh, at(i0, j0, false), at(i1, j1, false), at(i1, j1, true),
                           at(i0, j0, true));
            };
            wall(i, 0, i + 1, 0);
            wall(i + 1, n_, i, n_);
            wall(0, i + 1, 0, i);
            wall(n_, i, n_, i + 1);
        }
        return mesh;
    }

    /// Of what is under the surface (`below`), or between it and the top of the block.
    [[nodiscard]] CountedResult count(bool below, std::size_t points, std::uint64_t seed) const {
        std::int64_t sixths = 0;  // of the volume under the surface
        std::int64_t halves = 0;  // of the area of its walls
        CountedResult out;
        for (int i = 0; i < n_; ++i) {
            for (int j = 0; j < n_; ++j) {
                const std::int64_t a = height(i, j);
                const std::int64_t b = height(i + 1, j);
                const std::int64_t c = height(i + 1, j + 1);
                const std::int64_t d = height(i, j + 1);
                sixths += (a + b + c) + (a + c + d);
                // Twice a triangle's area is √(1 + its slopes squared).
                add_root(out, half(1), 1 + (b - a) * (b - a) + (c - b) * (c - b));
                add_root(out, half(1), 1 + (d - a) * (d - a) + (c - d) * (c - d));
            }
            for (const auto& [p, q] : {std::pair{height(i, 0), height(i + 1, 0)},
                                       std::pair{height(i, n_), height(i + 1, n_)},
                                       std::pair{height(0, i), height(0, i + 1)},
                                       std::pair{height(n_, i), height(n_, i + 1)}})
                halves += p + q;
        }
        const ExactRational under = ExactRational(sixths) / ExactRational(6);
        const ExactRational walls = half(halves);
        const std::int64_t floor = std::int64_t{n_} * n_;
        out.volume = below ? under : ExactRational(floor * top_) - under;
        out.area += ExactRational(floor) +
                    (below ? walls : ExactRational(std::int64_t{4} * n_ * top_) - walls);
        out.euler = 1;
        add_points(below, points, seed, out);
        return out;
    }

private:
    [[nodiscard]] std::int64_t height(int i, int j) const {
        return heights_[static_cast<std::size_t>(i * (n_ + 1) + j)];
    }

    // At thirds and sixths of the squares, on neither diagonals nor the surface.
    void add_points(bool below, std::size_t points, std::uint64_t seed, CountedResult& out) const {
        Random random(seed);
        while (out.points.size() < points) {
            const auto i = static_cast<int>(random.below(n_));
            const auto j = static_cast<int>(random.below(n_));
            const bool first = random.below(2) == 0;  // the triangle with the larger x
            const std::int64_t x = first ? 2 : 1;     // thirds
            const std::int64_t y = first ? 1 : 2;
            const std::int64_t a = height(i, j);
            const std::int64_t c = height(i + 1, j + 1);
            const std::int64_t b = first ? height(i + 1, j) : height(i, j + 1);
            const std::int64_t surface = a + b + c;  // thirds of the height at the centre
            const std::int64_t z = 1 + random.below(3 * top_ - 1);
            if (z == surface) continue;
            const ExactRational three(3);
            out.points.push_back({{ExactRational(3 * i + x) / three,
                                   ExactRational(3 * j + y) / three, ExactRational(z) / three},
                                  (z < surface) == below});
        }
    }

    int n_;
    int top_;
    std::vector<std::int64_t> heights_;
};

SlantedScenes slanted_terrain(std::size_t points, std::uint64_t seed) {
    constexpr int n = 16;
    constexpr int top = 8;
    const Terrain terrain(n, top, seed);
    const PolygonMesh block = make_box({0, 0, 0}, {n, n, top});
    SlantedScenes scenes;
    for (const BooleanOperation op : {Difference, Intersection, SymmetricDifference})
        scenes.push_back({fmt::format("slanted-terrain-{}-{}", seed, to_string(op)),
                          op,
                          {block, terrain.solid()},
                          terrain.count(op == Intersection, points, seed)});
    return scenes;
}

// ---------------------------------------------------------------- polygons

using Corner = std::array<std::int64_t, 2>;

/// A convex polygon of `size` corners or a few more: the shortest integer vectors without a common
/// factor, each once, in the order of their directions.
std::vector<Corner> convex_polygon(std::size_t size) {
    std::vector<Corner> sides;
    for (std::int64_t reach = 1; sides.size() < size; ++reach)  // rings of equal maximum norm
        for (std::int64_t a = -reach; a <= reach; ++a)
            for (std::int64_t b = -reach; b <= reach; ++b)
                if (std::max(std::abs(a), std::abs(b)) == reach && std::gcd(a, b) == 1)
                    sides.push_back({a, b});
    const auto is_upper = [](const Corner& v) { return v[1] > 0 || (v[1] == 0 && v[0] > 0); };
    std::ranges::sort(sides, [&](const Corner& v, const Corner& w) {
        if (is_upper(v) != is_upper(w)) return is_upper(v);
        return v[0] * w[1] - v[1] * w[0] > 0;
    });
    std::vector<Corner> out;
    Corner at{0, 0};
    for (const Corner& v : sides) {
        out.push_back(at);
        at = {at[0] + v[0], at[1] + v[1]};
    }
    return out;
}

PolygonMesh prism(const std::vector<Corner>& base, double low, double high) {
    PolygonMesh mesh;
    for (const double z : {low, high})
        for (const Corner& c : base) mesh.points.push_back({double(c[0]), double(c[1]), z});
    const auto n = static_cast<std::uint32_t>(base.size());
    std::vector<std::uint32_t> loop(n);
    std::iota(loop.rbegin(), loop.rend(), 0U);
    mesh.add_face(loop);
    std::iota(loop.begin(), loop.end(), n);
    mesh.add_face(loop);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = i + 1 < n ? i + 1 : 0;
        const std::array<std::uint32_t, 4> side{i, next, n + next, n + i};
        mesh.add_face(side);
    }
    return mesh;
}

/// Of the prism over the polygon between two heights.
CountedResult count_prism(const std::vector<Corner>& base, std::int64_t low, std::int64_t high,
                          std::size_t points, std::uint64_t seed) {
    CountedResult out;
    std::int64_t doubled = 0;
    Corner least = base[0];
    Corner most = base[0];
    for (std::size_t i = 0; i < base.size(); ++i) {
        const Corner& p = base[i];
        const Corner& q = base[(i + 1) % base.size()];
        doubled += p[0] * q[1] - p[1] * q[0];
        const std::int64_t dx = q[0] - p[0];
        const std::int64_t dy = q[1] - p[1];
        add_root(out, ExactRational(high - low), dx * dx + dy * dy);
        for (std::size_t k = 0; k < 2; ++k) {
            least[k] = std::min(least[k], p[k]);
            most[k] = std::max(most[k], p[k]);
        }
    }
    out.area += ExactRational(doubled);
    out.volume = half(doubled) * ExactRational(high - low);
    out.euler = 1;
    Random random(seed);
    while (out.points.size() < points) {
        // Doubled coordinates; a point with an odd one is no corner, and the rest is looked at.
        const std::int64_t x = 2 * (least[0] + random.below(most[0] - least[0])) + 1;
        const std::int64_t y = 2 * (least[1] + random.below(most[1] - least[1])) + 1;
        const std::int64_t z = 2 * random.below(4) + 1;
        bool inside = z > 2 * low && z < 2 * high;
        bool on = false;
        for (std::size_t i = 0; i < base.size(); ++i) {
            const Corner& p = base[i];
            const Corner& q = base[(i + 1) % base.size()];
            const std::int64_t side =
                (q[0] - p[0]) * (y - 2 * p[1]) - (q[1] - p[1]) * (x - 2 * p[0]);
            inside = inside && side > 0;
            on = on || side == 0;
        }
        if (!on) out.points.push_back({{half(x), half(y), half(z)}, inside});
    }
    return out;
}

/// A prism of height 2 and the same one higher by 1: all sides coincide in part.
SlantedScenes polygons(std::size_t size, std::size_t points, std::uint64_t seed) {
    const std::vector<Corner> base = convex_polygon(size);
    SlantedScenes scenes;
    for (const auto& [op, low, high] :
         {std::tuple{Union, 0, 3}, std::tuple{Intersection, 1, 2}, std::tuple{Difference, 0, 1}})
        scenes.push_back({fmt::format("polygon-{}-{}", base.size(), to_string(op)),
                          op,
                          {prism(base, 0, 2), prism(base, 1, 3)},
                          count_prism(base, low, high, points, seed)});
    return scenes;
}

}  // namespace

std::vector<std::string> slanted_family_names() {
    return {"slanted-terrain", "polygon-1000", "polygon-100000"};
}

std::vector<SlantedScene> slanted_family(const std::string& name, std::size_t points,
                                         std::uint64_t seed) {
    if (name == "slanted-terrain") return slanted_terrain(points, seed);
    return polygons(name == "polygon-1000" ? 1000 : 100'000, points, seed);
}

}  // namespace trisect::app
