// SPDX-License-Identifier: Apache-2.0
//
// Where an edge has more than two triangles nothing is flipped, nor where the other diagonal is an
// edge already.

#include <trisect/brep/import/thin_triangles.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

Point3d between(const Point3d& a, const Point3d& b) {
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}

double square_of(const Point3d& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

class ThinTriangles {
public:
    ThinTriangles(std::span<const Point3d> points, std::span<const Triangle> triangles,
                  double width)
        : points_(points), width_(width), square_width_(width * width), depth_{0} {
        out_.point.resize(points.size());
        std::iota(out_.point.begin(), out_.point.end(), 0U);
        merge_points(triangles);
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            Triangle corners = triangles[t];
            for (std::uint32_t& p : corners) p = out_.point[p];
            if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
                add(corners, static_cast<std::uint32_t>(t));
        }
        cancel_opposites();
        for (std::uint32_t t = 0; t < out_.triangles.size(); ++t) connect(t);
    }

    TrianglesWithoutThin result() && {
        flip_all();
        TrianglesWithoutThin kept;
        for (std::size_t t = 0; t < out_.triangles.size(); ++t) {
            if (is_gone_[t]) continue;
            kept.triangles.push_back(out_.triangles[t]);
            kept.origin.push_back(out_.origin[t]);
        }
        kept.point = std::move(out_.point);
        kept.reach = static_cast<double>(*std::max_element(depth_.begin(), depth_.end())) * width_;
        return kept;
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// Triangles to the left of a directed edge: how many, and the exclusive or of their numbers.
    struct Left {
        int count = 0;
        std::uint32_t triangles = 0;
    };

    std::uint32_t root_of(std::uint32_t p) {
        while (out_.point[p] != p) {
            out_.point[p] = out_.point[out_.point[p]];
            p = out_.point[p];
        }
        return p;
    }

    void merge_points(std::span<const Triangle> triangles) {
        for (const Triangle& t : triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = t[i];
                const std::uint32_t b = t[(i + 1) % 3];
                if (square_of(between(points_[a], points_[b])) > square_width_) continue;
                const auto [low, high] = std::minmax({root_of(a), root_of(b)});
                out_.point[high] = low;
            }
        for (std::uint32_t p = 0; p < out_.point.size(); ++p) out_.point[p] = root_of(p);
    }

    std::uint32_t add(const Triangle& corners, std::uint32_t origin) {
        out_.triangles.push_back(corners);
        out_.origin.push_back(origin);
        is_gone_.push_back(false);
        depth_.push_back(0);
        return static_cast<std::uint32_t>(out_.triangles.size() - 1);
    }

    // Fronts and backs, which merged points may leave of what was thin.
    void cancel_opposites() {
        FlatMap numbers;
        std::vector<std::uint32_t> open;                          // the last one, by corners
        std::vector<std::uint32_t> below(out_.triangles.size());  // the one before of the same
        for (std::uint32_t t = 0; t < out_.triangles.size(); ++t) {
            const auto [key, opposite] = keys_of(out_.triangles[t]);
            const std::int32_t other = numbers.find(key_of(opposite));
            if (other >= 0 && open[as_index(other)] != none) {
                std::uint32_t& last = open[as_index(other)];
                is_gone_[t] = is_gone_[last] = true;
                last = below[last];
                continue;
            }
            const auto [own, is_new] =
                numbers.insert(key_of(key), static_cast<std::int32_t>(open.size()));
            if (is_new) open.push_back(none);
            below[t] = open[as_index(own)];
            open[as_index(own)] = t;
        }
    }

    static Key128 key_of(const Triangle& t) { return {key_of(t[0], t[1]), t[2]}; }

    // The corners from the smallest one on, and those of the other side.
    static std::pair<Triangle, Triangle> keys_of(Triangle t) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        return {t, {t[0], t[2], t[1]}};
    }

    static std::uint64_t key_of(std::uint32_t from, std::uint32_t to) {
        return std::uint64_t{from} << 32 | to;
    }

    void connect(std::uint32_t t) {
        if (is_gone_[t]) return;
        count_edges(t, 1);
    }

    void disconnect(std::uint32_t t) {
        is_gone_[t] = true;
        count_edges(t, -1);
    }

    void count_edges(std::uint32_t t, int by) {
        const Triangle& c = out_.triangles[t];
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [number, is_new] = edges_.insert({key_of(c[i], c[(i + 1) % 3]), 0},
                                                        static_cast<std::int32_t>(left_.size()));
            if (is_new) left_.emplace_back();
            Left& left = left_[as_index(number)];
            left.count += by;
            left.triangles ^= t;
        }
    }

    [[nodiscard]] Left left_of_edge(std::uint32_t from, std::uint32_t to) const {
        const std::int32_t number = edges_.find({key_of(from, to), 0});
        return number < 0 ? Left() : left_[as_index(number)];
    }

    [[nodiscard]] bool is_edge(std::uint32_t from, std::uint32_t to) const {
        return left_of_edge(from, to).count > 0;
    }

    // The only triangle to the left of an edge, or `none`.
    [[nodiscard]] std::uint32_t left_of(std::uint32_t from, std::uint32_t to) const {
        const Left left = left_of_edge(from, to);
        return left.count == 1 ? left.triangles : none;
    }

    // Number of the corner that a thin triangle's longest edge starts at.
    [[nodiscard]] std::optional<std::size_t> longest_edge_if_thin(const Triangle& c) const {
        std::array<double, 3> squares{};
        for (std::size_t i = 0; i < 3; ++i)
            squares[i] = square_of(between(points_[c[i]], points_[c[(i + 1) % 3]]));
        const auto longest = static_cast<std::size_t>(
            std::max_element(squares.begin(), squares.end()) - squares.begin());
        const Point3d u = between(points_[c[0]], points_[c[1]]);
        const Point3d v = between(points_[c[0]], points_[c[2]]);
        const Point3d normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                             u[0] * v[1] - u[1] * v[0]};
        if (square_of(normal) > square_width_ * squares[longest]) return std::nullopt;
        return longest;
    }

    // One that cannot be flipped may be once its neighbours were.
    void flip_all() {
        std::vector<std::uint32_t> thin(out_.triangles.size());
        std::iota(thin.begin(), thin.end(), 0U);
        for (int round = 0; round < 64 && !thin.empty(); ++round) {
            const std::size_t before = out_.triangles.size();
            std::erase_if(thin, [&](std::uint32_t t) { return is_gone_[t] || !is_thin(t); });
            bool was_flipped = false;
            for (const std::uint32_t t : thin) was_flipped |= !is_gone_[t] && flip(t);
            if (!was_flipped) return;
            for (std::size_t t = before; t < out_.triangles.size(); ++t)
                thin.push_back(static_cast<std::uint32_t>(t));
        }
    }

    [[nodiscard]] bool is_thin(std::uint32_t t) const {
        return longest_edge_if_thin(out_.triangles[t]).has_value();
    }

    // Of two thin ones only to a shorter diagonal: else both flips would be made again and again.
    bool flip(std::uint32_t t) {
        const Triangle& c = out_.triangles[t];
        const std::size_t longest = *longest_edge_if_thin(c);
        const std::uint32_t a = c[longest];
        const std::uint32_t b = c[(longest + 1) % 3];
        const std::uint32_t top = c[(longest + 2) % 3];
        const std::uint32_t other = left_of(b, a);
        if (other == none || left_of(a, b) != t) return false;
        std::uint32_t bottom = 0;
        for (const std::uint32_t p : out_.triangles[other])
            if (p != a && p != b) bottom = p;
        if (is_edge(top, bottom) || is_edge(bottom, top)) return false;
        if (top != bottom && is_thin(other) && length(top, bottom) >= length(a, b)) return false;
        const std::uint32_t origin = out_.origin[other];
        disconnect(t);
        disconnect(other);
        if (top == bottom) return true;  // a front and its back
        const int depth = std::max(depth_[t + 1], depth_[other + 1]) + 1;
        for (const Triangle& made : {Triangle{a, bottom, top}, Triangle{bottom, b, top}}) {
            connect(add(made, origin));
            depth_.back() = depth;
        }
        return true;
    }

    [[nodiscard]] double length(std::uint32_t a, std::uint32_t b) const {
        return std::sqrt(square_of(between(points_[a], points_[b])));
    }

    std::span<const Point3d> points_;
    double width_;
    double square_width_;
    /// By triangle, after the first entry: a flip adds a tetrahedron around a thin triangle, which
    /// is within the width of the other one; this many of them at most lie on each other.
    std::vector<int> depth_;
    TrianglesWithoutThin out_;
    std::vector<bool> is_gone_;
    FlatMap edges_;  ///< numbers of directed edges
    std::vector<Left> left_;
};

}  // namespace

TrianglesWithoutThin without_thin_triangles(std::span<const Point3d> points,
                                            std::span<const std::array<std::uint32_t, 3>> triangles,
                                            double width) {
    return ThinTriangles(points, triangles, width).result();
}

ThickMesh thick_mesh(const PolygonMesh& mesh, double relative_width) {
    double largest = 0;
    for (const Point3d& p : mesh.points)
        for (const double c : p) largest = std::max(largest, std::fabs(c));
    std::vector<Triangle> triangles(mesh.face_count());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        std::ranges::copy(mesh.face(t), triangles[t].begin());
    TrianglesWithoutThin thick =
        without_thin_triangles(mesh.points, triangles, relative_width * largest);
    ThickMesh out;
    out.mesh.points = mesh.points;
    for (const Triangle& t : thick.triangles) out.mesh.add_triangle(t[0], t[1], t[2]);
    out.origin = std::move(thick.origin);
    out.reach = thick.reach;
    for (std::size_t p = 0; p < mesh.points.size(); ++p)
        for (std::size_t i = 0; i < 3; ++i)
            out.move =
                std::max(out.move, std::fabs(mesh.points[p][i] - mesh.points[thick.point[p]][i]));
    return out;
}

}  // namespace trisect::detail
