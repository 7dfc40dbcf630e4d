// SPDX-License-Identifier: Apache-2.0
//
// A triangle with corners on both sides of the plane has one edge that goes down through it and one
// that goes up, and its side leads from the first to the second. A corner of the section is thus an
// edge of the mesh, or a corner of it that lies in the plane, and is found by that name. Its
// coordinates are quotients of sums of products: in pairs of doubles where these show the nearest
// double, in fractions else.

#include <trisect/bsp/modelling/mesh_section.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_map>

#include <trisect/brep/measure/double_pair.h>
#include <trisect/brep/measure/exact_values.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

mpq_class in_users_units(mpq_class v, Lattice lattice) {
    if (lattice.exponent < 0)
        v >>= static_cast<unsigned long>(-lattice.exponent);
    else
        v <<= static_cast<unsigned long>(lattice.exponent);
    return v;
}

std::array<mpq_class, 3> exact_point(const ExactMesh& mesh, std::uint32_t v) {
    const Corner c = corner_at(mesh.points[v]);
    std::array<mpq_class, 3> out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = in_users_units(fraction(c.x[k], c.w), mesh.lattice);
    return out;
}

std::int8_t sign_between(double value, double height) {
    return static_cast<std::int8_t>(value > height ? 1 : value < height ? -1 : 0);
}

double nearest(const mpq_class& v) {
    return to_rational(v.get_num(), v.get_den()).to_double() + 0.0;
}

/// The nearest double of a number that is at most `error` away from the pair.
std::optional<double> nearest(const DoublePair& v, double error) {
    const double slack = error + 0x1p-50 * std::fabs(v.low);
    if (v.high + (v.low + slack) != v.high || v.high + (v.low - slack) != v.high)
        return std::nullopt;
    return v.high + 0.0;
}

}  // namespace

MeshSection::MeshSection(const PolygonMesh& mesh, double height)
    : height_(height), near_(mesh.points), is_double_(mesh.points.size(), 1) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto t = mesh.face(f);
        triangles_.push_back({t[0], t[1], t[2]});
    }
    for (const Point3d& p : near_) side_.push_back(sign_between(p[2], height));
}

MeshSection::MeshSection(const ExactMesh& mesh, double height)
    : height_(height),
      triangles_(mesh.triangles),
      near_(to_polygon_mesh(mesh).points),
      exact_(&mesh) {
    for (std::uint32_t v = 0; v < near_.size(); ++v) {
        is_double_.push_back(mesh.points[v].is_lattice() ? 1 : 0);
        // The nearest double is on the same side, or in the plane.
        std::int8_t side = sign_between(near_[v][2], height);
        if (side == 0 && is_double_[v] == 0)
            side = static_cast<std::int8_t>(
                sgn(mpq_class(exact_point(mesh, v)[2] - mpq_class(height))));
        side_.push_back(side);
    }
}

bool MeshSection::has_face_in_plane() const {
    return std::ranges::any_of(triangles_, [&](const Triangle& t) {
        return side_[t[0]] == 0 && side_[t[1]] == 0 && side_[t[2]] == 0;
    });
}

/// The corners of one section, by name.
class SectionCorners {
public:
    SectionCorners(const MeshSection& mesh, MeshSection::Place place)
        : mesh_(mesh), in_plane_(place == MeshSection::Place::Below ? 1 : -1) {}

    void add(const MeshSection::Triangle& t) {
        std::uint32_t down = none;
        std::uint32_t up = none;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            if (side(a) > 0 && side(b) < 0) down = number(b, a);
            if (side(a) < 0 && side(b) > 0) up = number(a, b);
        }
        if (down != up) sides_.push_back({down, up});
    }

    [[nodiscard]] SectionSides finish() {
        leave_out_straight();
        SectionSides out;
        std::vector<std::uint32_t> place(ends_.size(), none);
        const auto placed = [&](std::uint32_t n) {
            if (place[n] == none) {
                place[n] = static_cast<std::uint32_t>(out.corners.size());
                out.corners.push_back(near_[n]);
            }
            return place[n];
        };
        for (const auto& [from, to] : sides_)
            if (from != none) {
                const std::uint32_t first = placed(from);
                out.sides.push_back({first, placed(to)});
            }
        return out;
    }

private:
    using Ends = std::array<std::uint32_t, 2>;  // below and above; twice one that is in the plane
    using Numbers = std::array<mpq_class, 2>;
    struct Pairs {
        std::array<DoublePair, 2> at;
        double error = 0;  // of a coordinate
    };

    [[nodiscard]] int side(std::uint32_t v) const {
        return mesh_.side_[v] == 0 ? in_plane_ : mesh_.side_[v];
    }

    std::uint32_t number(std::uint32_t below, std::uint32_t above) {
        if (mesh_.side_[below] == 0) above = below;
        if (mesh_.side_[above] == 0) below = above;
        const auto [at, is_new] = numbers_.try_emplace(std::uint64_t{below} << 32U | above,
                                                       static_cast<std::uint32_t>(ends_.size()));
        if (is_new) {
            ends_.push_back({below, above});
            near_.push_back(rounded(at->second));
        }
        return at->second;
    }

    [[nodiscard]] std::array<mpq_class, 3> exact_end(std::uint32_t v) const {
        if (mesh_.is_double_[v] == 0) return exact_point(*mesh_.exact_, v);
        const Point3d& p = mesh_.near_[v];
        return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])};
    }
    [[nodiscard]] Numbers exact(std::uint32_t n) const {
        const auto [below, above] = ends_[n];
        const std::array<mpq_class, 3> a = exact_end(below);
        if (below == above) return {a[0], a[1]};
        const std::array<mpq_class, 3> b = exact_end(above);
        const mpq_class part = (mesh_.height_ - a[2]) / (b[2] - a[2]);
        return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
    }

    // Weights of both ends are between 0 and 1, and each step is off by less than 2^-99 of what it
    // computes. Nothing where an end is no double, or near underflow.
    [[nodiscard]] std::optional<Pairs> in_pairs(const Ends& ends) const {
        const auto [below, above] = ends;
        if (mesh_.is_double_[below] == 0 || mesh_.is_double_[above] == 0) return std::nullopt;
        const Point3d& a = mesh_.near_[below];
        const Point3d& b = mesh_.near_[above];
        if (below == above) return Pairs{{{{a[0], 0}, {a[1], 0}}}, 0};
        const DoublePair of_a = two_sum(b[2], -mesh_.height_);
        const DoublePair of_b = two_sum(mesh_.height_, -a[2]);
        const DoublePair both = two_sum(b[2], -a[2]);
        if (both.high < 0x1p-100) return std::nullopt;
        Pairs out;
        for (std::size_t k = 0; k < 2; ++k) {
            const DoublePair sum =
                detail::add(multiply({a[k], 0}, of_a), multiply({b[k], 0}, of_b));
            out.at[k] = divide(sum, both);
            out.error = std::max(out.error, 0x1p-94 * (std::fabs(a[k]) + std::fabs(b[k])));
        }
        out.error += 0x1p-900;
        return out;
    }
    [[nodiscard]] Point2d rounded(std::uint32_t n) const {
        const auto [below, above] = ends_[n];
        if (below == above) return {mesh_.near_[below][0] + 0.0, mesh_.near_[below][1] + 0.0};
        if (const auto p = in_pairs(ends_[n])) {
            const auto x = nearest(p->at[0], p->error);
            const auto y = nearest(p->at[1], p->error);
            if (x && y) return {*x, *y};
        }
        const Numbers p = exact(n);
        return {nearest(p[0]), nearest(p[1])};
    }

    // Whether corners surely turn at b. Rounded ones are off by 2^-53 of their size; the bound has
    // room for all of that.
    [[nodiscard]] bool turns(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const Point2d u{near_[b][0] - near_[a][0], near_[b][1] - near_[a][1]};
        const Point2d v{near_[c][0] - near_[b][0], near_[c][1] - near_[b][1]};
        double size = 0;
        for (const std::uint32_t n : {a, b, c})
            size = std::max({size, std::fabs(near_[n][0]), std::fabs(near_[n][1])});
        const double lengths =
            std::fabs(u[0]) + std::fabs(u[1]) + std::fabs(v[0]) + std::fabs(v[1]);
        return std::fabs(u[0] * v[1] - u[1] * v[0]) > 0x1p-48 * size * lengths;
    }
    // The same by pairs: differences are off by 2 e and 2^-100 of the size, products by 2^-99.
    [[nodiscard]] bool turns_by_pairs(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const auto p = in_pairs(ends_[a]);
        const auto q = in_pairs(ends_[b]);
        const auto r = in_pairs(ends_[c]);
        if (!p || !q || !r) return false;
        double size = 0;
        for (const Pairs& at : {*p, *q, *r})
            size = std::max({size, std::fabs(at.at[0].high), std::fabs(at.at[1].high)});
        std::array<DoublePair, 2> u;
        std::array<DoublePair, 2> v;
        double lengths = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            u[k] = subtract(q->at[k], p->at[k]);
            v[k] = subtract(r->at[k], q->at[k]);
            lengths += std::fabs(u[k].high) + std::fabs(v[k].high);
        }
        const double e = p->error + q->error + r->error + 0x1p-98 * size;
        const DoublePair turn = subtract(multiply(u[0], v[1]), multiply(u[1], v[0]));
        return std::fabs(turn.high) > 16 * e * (lengths + 16 * e) + 0x1p-96 * lengths * lengths;
    }
    [[nodiscard]] bool goes_straight(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        if (turns(a, b, c) || turns_by_pairs(a, b, c)) return false;
        const Numbers p = exact(a);
        const Numbers q = exact(b);
        const Numbers r = exact(c);
        const Numbers s{q[0] - p[0], q[1] - p[1]};
        const Numbers t{r[0] - q[0], r[1] - q[1]};
        return s[0] * t[1] == s[1] * t[0] && s[0] * t[0] + s[1] * t[1] > 0;
    }

    // Where one side comes and one goes on in its direction, both become one.
    void leave_out_straight() {
        std::vector<std::uint32_t> in(ends_.size(), none);
        std::vector<std::uint32_t> out(ends_.size(), none);
        std::vector<std::uint8_t> is_simple(ends_.size(), 1);
        for (std::uint32_t s = 0; s < sides_.size(); ++s) {
            const auto [from, to] = sides_[s];
            if (out[from] != none) is_simple[from] = 0;
            if (in[to] != none) is_simple[to] = 0;
            out[from] = s;
            in[to] = s;
        }
        for (std::uint32_t n = 0; n < ends_.size(); ++n) {
            if (is_simple[n] == 0 || in[n] == none || out[n] == none || in[n] == out[n]) continue;
            const std::uint32_t before = sides_[in[n]][0];
            const std::uint32_t after = sides_[out[n]][1];
            if (before == after || !goes_straight(before, n, after)) continue;
            sides_[in[n]][1] = after;
            if (in[after] == out[n]) in[after] = in[n];
            sides_[out[n]] = {none, none};
        }
    }

    const MeshSection& mesh_;
    int in_plane_;  // the side of what is in the plane
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
    std::vector<Ends> ends_;
    std::vector<Point2d> near_;
    std::vector<std::array<std::uint32_t, 2>> sides_;
};

SectionSides MeshSection::right(Place place) const {
    check_stop(triangles_.size());
    SectionCorners corners(*this, place);
    for (const Triangle& t : triangles_) corners.add(t);
    return corners.finish();
}

}  // namespace trisect::detail
