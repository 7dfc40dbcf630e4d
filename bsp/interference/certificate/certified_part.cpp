// SPDX-License-Identifier: Apache-2.0
//
// Triangles are clipped by the plane, and each half is closed by a fan in the plane: a triangle
// from one common point to every edge that the clipped triangles leave open there. Fans may cover
// themselves; but a surface in a plane is known, with signs, by its boundary, so those of both
// halves, and triangles in the plane, cancel each other whatever they look like. For the same
// reason all triangles of a plane may be replaced by a fan over their boundary, and all edges of a
// line in it by those between the points where they begin and end.

#include <trisect/bsp/interference/certificate/certified_part.h>

#include <algorithm>
#include <limits>
#include <map>

namespace trisect::detail::certified {

namespace {

constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

using Triangle = std::array<std::uint32_t, 3>;

// Numbers times a common factor, without it and with one sign; whether that is another one.
template <std::size_t N>
bool make_canonical(std::array<mpz_class, N>& numbers) {
    mpz_class common;
    for (const mpz_class& c : numbers) common = gcd(common, c);
    if (sgn(common) == 0) return false;
    const auto first =
        std::ranges::find_if(numbers, [](const mpz_class& c) { return sgn(c) != 0; });
    const bool turned = sgn(*first) < 0;
    if (turned) common = -common;
    for (mpz_class& c : numbers) c /= common;
    return turned;
}

// Of the line from u to v: direction and moment.
std::array<mpz_class, 6> line_through(const IntegerPoint& u, const IntegerPoint& v) {
    std::array<mpz_class, 6> r;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        r[k] = u.w * v.x[k] - v.w * u.x[k];
        r[k + 3] = u.x[i] * v.x[j] - u.x[j] * v.x[i];
    }
    (void)make_canonical(r);
    return r;
}

// The plane of three points; 0 where they are in a line.
std::array<mpz_class, 4> plane_through(const IntegerPoint& p, const IntegerPoint& q,
                                       const IntegerPoint& r) {
    IntegerVector u;
    IntegerVector v;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = q.x[k] * p.w - p.x[k] * q.w;
        v[k] = r.x[k] * p.w - p.x[k] * r.w;
    }
    std::array<mpz_class, 4> n;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const mpz_class c = u[i] * v[j] - u[j] * v[i];
        n[k] = c * p.w;
        n[3] -= c * p.x[k];
    }
    (void)make_canonical(n);
    return n;
}

// The boundary of triangles in a plane, taken with signs, in as few edges as possible.
class Outline {
public:
    explicit Outline(const std::vector<IntegerPoint>& points) : points_(points) {}

    void add(const Triangle& t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t u = t[i];
            const std::uint32_t v = t[(i + 1) % 3];
            edges_[std::minmax(u, v)] += u < v ? 1 : -1;
        }
    }
    // The fan over it.
    [[nodiscard]] std::vector<Triangle> fan() const {
        // On each line, how often edges end at a point, less how often they begin there.
        std::map<std::array<mpz_class, 6>, std::map<std::uint32_t, int>> lines;
        for (const auto& [edge, count] : edges_) {
            if (count == 0) continue;
            auto& ends = lines[line_through(points_[edge.first], points_[edge.second])];
            ends[edge.first] -= count;
            ends[edge.second] += count;
        }
        std::vector<Triangle> r;
        std::uint32_t apex = no_index;
        for (const auto& [line, ends] : lines) {
            std::uint32_t last = no_index;
            int count = 0;
            for (const std::uint32_t v : along(line, ends)) {
                if (count != 0) {
                    if (apex == no_index) apex = last;
                    add_triangles(apex, last, v, count, r);
                }
                count -= ends.at(v);
                last = v;
            }
        }
        return r;
    }

private:
    [[nodiscard]] std::vector<std::uint32_t> along(const std::array<mpz_class, 6>& line,
                                                   const std::map<std::uint32_t, int>& ends) const {
        std::vector<std::uint32_t> r;
        for (const auto& [v, count] : ends)
            if (count != 0) r.push_back(v);
        const IntegerVector d{line[0], line[1], line[2]};
        std::ranges::sort(r, [&](std::uint32_t u, std::uint32_t v) {
            const IntegerPoint& p = points_[u];
            const IntegerPoint& q = points_[v];
            return form(d, 0, p.x, 0) * q.w < form(d, 0, q.x, 0) * p.w;
        });
        return r;
    }
    void add_triangles(std::uint32_t apex, std::uint32_t u, std::uint32_t v, int count,
                       std::vector<Triangle>& all) const {
        if (count < 0) std::swap(u, v);
        if (u == apex || v == apex) return;
        const auto plane = plane_through(points_[apex], points_[u], points_[v]);
        if (std::ranges::all_of(plane, [](const mpz_class& c) { return sgn(c) == 0; })) return;
        for (int k = 0; k < std::abs(count); ++k) all.push_back({apex, u, v});
    }

    const std::vector<IntegerPoint>& points_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges_;
};

}  // namespace

// One half of a part.
class Part::Divider {
public:
    // `values`: heights of the part's points, above 0 in what is kept.
    Divider(const Part& whole, const std::vector<mpz_class>& values)
        : whole_(whole), values_(values), copy_(whole.points_.size(), no_index) {}

    Part run() {
        for (const auto& t : whole_.triangles_) clip(t);
        close();
        half_.simplify();
        return std::move(half_);
    }

private:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    [[nodiscard]] int side(std::uint32_t v) const { return sgn(values_[v]); }

    std::uint32_t add(IntegerPoint p) {
        half_.points_.push_back(std::move(p));
        return static_cast<std::uint32_t>(half_.points_.size() - 1);
    }
    std::uint32_t copy_of(std::uint32_t v) {
        if (copy_[v] == no_index) copy_[v] = add(whole_.points_[v]);
        return copy_[v];
    }
    // Where an edge crosses the plane: with heights f / u.w and -g / v.w of its ends.
    std::uint32_t crossing(std::uint32_t i, std::uint32_t j) {
        const auto at = crossings_.find(std::minmax(i, j));
        if (at != crossings_.end()) return at->second;
        const IntegerPoint& u = whole_.points_[i];
        const IntegerPoint& v = whole_.points_[j];
        const mpz_class f = abs(values_[i]);
        const mpz_class g = abs(values_[j]);
        const std::uint32_t r =
            add({{f * v.x[0] + g * u.x[0], f * v.x[1] + g * u.x[1], f * v.x[2] + g * u.x[2]},
                 f * v.w + g * u.w});
        crossings_.emplace(std::minmax(i, j), r);
        return r;
    }
    void clip(const std::array<std::uint32_t, 3>& t) {
        if (std::ranges::none_of(t, [this](std::uint32_t v) { return side(v) > 0; })) return;
        // Corners, and whether each is in the plane.
        std::vector<std::pair<std::uint32_t, bool>> polygon;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t u = t[i];
            const std::uint32_t v = t[(i + 1) % 3];
            if (side(u) >= 0) polygon.emplace_back(copy_of(u), side(u) == 0);
            if (side(u) * side(v) < 0) polygon.emplace_back(crossing(u, v), true);
        }
        for (std::size_t i = 2; i < polygon.size(); ++i)
            half_.triangles_.push_back({polygon[0].first, polygon[i - 1].first, polygon[i].first});
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const auto& [u, u_in] = polygon[i];
            const auto& [v, v_in] = polygon[(i + 1) % polygon.size()];
            if (!u_in || !v_in) continue;
            if (u < v)
                ++open_[{u, v}];
            else
                --open_[{v, u}];
        }
    }
    void close() {
        std::uint32_t apex = no_index;
        for (const auto& [edge, count] : open_) {
            if (count != 0 && apex == no_index) apex = edge.first;
            const auto& [u, v] = count > 0 ? Edge(edge.second, edge.first) : edge;
            if (u == apex || v == apex) continue;
            for (int k = 0; k < std::abs(count); ++k) half_.triangles_.push_back({apex, u, v});
        }
    }

    const Part& whole_;
    const std::vector<mpz_class>& values_;
    std::vector<std::uint32_t> copy_;
    std::map<Edge, std::uint32_t> crossings_;
    std::map<Edge, int> open_;  // edges in the plane, with signs
    Part half_;
};

Part::Part(const Boundary& boundary, const std::vector<CertifiedTriangle>& triangles)
    : points_(boundary.points()) {
    for (const CertifiedTriangle& t : triangles)
        triangles_.push_back({t.vertex[0].index, t.vertex[1].index, t.vertex[2].index});
}

// Fans for all triangles of a plane, and only the corners that are left.
void Part::simplify() {
    std::map<IntegerPoint, std::uint32_t> numbers;
    std::vector<IntegerPoint> points;
    std::map<std::array<mpz_class, 4>, std::vector<Triangle>> planes;
    for (Triangle t : triangles_) {
        for (std::uint32_t& v : t) {
            const auto [at, is_new] =
                numbers.try_emplace(points_[v], static_cast<std::uint32_t>(points.size()));
            if (is_new) points.push_back(points_[v]);
            v = at->second;
        }
        auto plane = plane_through(points[t[0]], points[t[1]], points[t[2]]);
        const bool is_flat =
            std::ranges::all_of(plane, [](const mpz_class& c) { return sgn(c) == 0; });
        if (!is_flat) planes[std::move(plane)].push_back(t);
    }
    triangles_.clear();
    for (const auto& [plane, triangles] : planes) {
        Outline outline(points);
        for (const Triangle& t : triangles) outline.add(t);
        const auto fan = triangles.size() == 1 ? triangles : outline.fan();
        triangles_.insert(triangles_.end(), fan.begin(), fan.end());
    }
    points_.clear();
    std::vector<std::uint32_t> left(points.size(), no_index);
    for (Triangle& t : triangles_)
        for (std::uint32_t& v : t) {
            if (left[v] == no_index) {
                left[v] = static_cast<std::uint32_t>(points_.size());
                points_.push_back(points[v]);
            }
            v = left[v];
        }
}

std::pair<Part, Part> Part::divided(const IntegerPlane& plane) const {
    std::vector<mpz_class> values;
    for (const IntegerPoint& p : points_) values.push_back(plane.value_at(p));
    Part above = Divider(*this, values).run();
    for (mpz_class& v : values) v = -v;
    return {Divider(*this, values).run(), std::move(above)};
}

}  // namespace trisect::detail::certified
