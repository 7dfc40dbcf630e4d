// SPDX-License-Identifier: Apache-2.0

#include "shapes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <trisect/brep/validate/defect.h>
#include <trisect/kernel/lattice.h>

namespace shapes {

namespace {

using trisect::Point3d;
using trisect::PolygonMesh;

struct Box {
    Point3d low{1e300, 1e300, 1e300};
    Point3d high{-1e300, -1e300, -1e300};
};

Box box_of(const PolygonMesh& mesh) {
    Box box;
    for (const Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], p[k]);
            box.high[k] = std::max(box.high[k], p[k]);
        }
    return box;
}

Point3d times(const Matrix& m, const Point3d& p) {
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = m[k][0] * p[0] + m[k][1] * p[1] + m[k][2] * p[2];
    return out;
}

Point3d on_sphere(const Point3d& p) {
    const double scale = 1 / std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return {scale * p[0], scale * p[1], scale * p[2]};
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

class Midpoints {
public:
    explicit Midpoints(std::vector<Point3d>& points) : points_(points) {}
    std::uint32_t between(std::uint32_t a, std::uint32_t b) {
        const auto [at, inserted] =
            index_.insert({std::minmax(a, b), static_cast<std::uint32_t>(points_.size())});
        if (inserted) {
            const Point3d p = points_[a];
            const Point3d q = points_[b];
            points_.push_back(on_sphere({p[0] + q[0], p[1] + q[1], p[2] + q[2]}));
        }
        return at->second;
    }

private:
    std::vector<Point3d>& points_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> index_;
};

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
}

}  // namespace

Matrix rotation(const Point3d& axis, double degrees) {
    const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double c = std::cos(degrees * std::numbers::pi / 180);
    const double s = std::sin(degrees * std::numbers::pi / 180);
    const double q = 1 - c;
    const double x = axis[0] / length;
    const double y = axis[1] / length;
    const double z = axis[2] / length;
    return {{{c + x * x * q, x * y * q - z * s, x * z * q + y * s},
             {y * x * q + z * s, c + y * y * q, y * z * q - x * s},
             {z * x * q - y * s, z * y * q + x * s, c + z * z * q}}};
}

PolygonMesh turned(const PolygonMesh& mesh) {
    const Box box = box_of(mesh);
    const Matrix m = rotation({1, 2, 3}, 37);
    Point3d centre{};
    for (std::size_t k = 0; k < 3; ++k) centre[k] = 0.5 * (box.low[k] + box.high[k]);
    const Point3d turned_centre = times(m, centre);
    Point3d shift{};
    for (std::size_t k = 0; k < 3; ++k)
        shift[k] = centre[k] - turned_centre[k] + 0.1 * (box.high[k] - box.low[k]);
    return moved(mesh, m, shift);
}

PolygonMesh icosphere(int level) {
    const double p = (1 + std::sqrt(5.0)) / 2;
    PolygonMesh mesh;
    mesh.points = {{-1, p, 0},  {1, p, 0},  {-1, -p, 0}, {1, -p, 0}, {0, -1, p},  {0, 1, p},
                   {0, -1, -p}, {0, 1, -p}, {p, 0, -1},  {p, 0, 1},  {-p, 0, -1}, {-p, 0, 1}};
    for (Point3d& q : mesh.points) q = on_sphere(q);
    Triangles triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int i = 0; i < level; ++i) {
        Midpoints midpoints(mesh.points);
        Triangles finer;
        for (const auto& [a, b, c] : triangles) {
            const std::uint32_t ab = midpoints.between(a, b);
            const std::uint32_t bc = midpoints.between(b, c);
            const std::uint32_t ca = midpoints.between(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        triangles = std::move(finer);
    }
    for (const auto& [a, b, c] : triangles) mesh.add_triangle(a, b, c);
    return mesh;
}

PolygonMesh globe(std::uint32_t around, std::uint32_t rings, double bumps) {
    PolygonMesh out;
    out.points.push_back({0, 0, 1});
    for (std::uint32_t i = 0; i < rings; ++i)
        for (std::uint32_t j = 0; j < around; ++j) {
            const double polar = std::numbers::pi * (i + 1) / (rings + 1);
            const double angle = 2 * std::numbers::pi * j / around;
            const double r = 1 + bumps * std::sin(3 * polar) * std::sin(4 * angle + polar);
            out.points.push_back({r * std::sin(polar) * std::cos(angle),
                                  r * std::sin(polar) * std::sin(angle), r * std::cos(polar)});
        }
    out.points.push_back({0, 0, -1});
    const std::uint32_t last = around * rings + 1;
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return 1 + around * i + j % around; };
    for (std::uint32_t j = 0; j < around; ++j) {
        out.add_triangle(0, at(0, j), at(0, j + 1));
        out.add_triangle(last, at(rings - 1, j + 1), at(rings - 1, j));
        for (std::uint32_t i = 0; i + 1 < rings; ++i) {
            out.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            out.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return out;
}

PolygonMesh moved(PolygonMesh mesh, const Point3d& by) {
    for (Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += by[k];
    return mesh;
}

PolygonMesh moved(PolygonMesh mesh, const Matrix& m, const Point3d& by) {
    for (Point3d& p : mesh.points) {
        p = times(m, p);
        for (std::size_t k = 0; k < 3; ++k) p[k] += by[k];
    }
    return mesh;
}

PolygonMesh block(const Point3d& low, const Point3d& high, int n) {
    PolygonMesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> known;
    const auto corner = [&](const std::array<int, 3>& at) {
        const auto [found, inserted] =
            known.insert({at, static_cast<std::uint32_t>(mesh.points.size())});
        if (inserted) {
            Point3d p{};
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = at[k] == 0   ? low[k]
                       : at[k] == n ? high[k]
                                    : low[k] + (high[k] - low[k]) * at[k] / n;
            mesh.points.push_back(p);
        }
        return found->second;
    };
    // Seen from outside the axes u and v of the upper side of axis k turn counterclockwise.
    const auto square = [&](std::size_t k, int side, int i, int j) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        std::array<std::uint32_t, 4> c{};
        for (std::size_t q = 0; q < 4; ++q) {
            std::array<int, 3> at{};
            at[k] = side;
            at[u] = i + (q == 1 || q == 2 ? 1 : 0);
            at[v] = j + (q >= 2 ? 1 : 0);
            c[q] = corner(at);
        }
        if (side == 0) std::swap(c[1], c[3]);
        mesh.add_triangle(c[0], c[1], c[2]);
        mesh.add_triangle(c[0], c[2], c[3]);
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (std::size_t k = 0; k < 3; ++k) {
                square(k, 0, i, j);
                square(k, n, i, j);
            }
    return mesh;
}

PolygonMesh menger_bars(int level, std::size_t axis) {
    PolygonMesh mesh;
    int side = 1;
    for (int i = 0; i < level; ++i) side *= 3;
    const auto carve = [&](const auto& self, int x, int y, int size) -> void {
        if (size < 3) return;
        const int third = size / 3;
        Point3d low{};
        Point3d high{};
        low[axis] = -1;
        high[axis] = side + 1;
        low[(axis + 1) % 3] = x + third;
        high[(axis + 1) % 3] = x + 2 * third;
        low[(axis + 2) % 3] = y + third;
        high[(axis + 2) % 3] = y + 2 * third;
        append(mesh, block(low, high));
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (i != 1 || j != 1) self(self, x + i * third, y + j * third, third);
    };
    carve(carve, 0, 0, side);
    return mesh;
}

double Random::uniform() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1.0p-53;
}

Matrix Random::rotation() {
    const double a = uniform();
    const double b = 2 * std::numbers::pi * uniform();
    const double c = 2 * std::numbers::pi * uniform();
    const double w = std::sqrt(1 - a) * std::sin(b);
    const double x = std::sqrt(1 - a) * std::cos(b);
    const double y = std::sqrt(a) * std::sin(c);
    const double z = std::sqrt(a) * std::cos(c);
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
             {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
             {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

Point3d Random::in_unit_box() {
    Point3d p{};
    for (double& x : p) x = uniform();
    return p;
}

void put_on_one_lattice(std::vector<PolygonMesh>& meshes) {
    std::vector<Point3d> points;
    for (const PolygonMesh& m : meshes)
        points.insert(points.end(), m.points.begin(), m.points.end());
    const trisect::Lattice lattice = trisect::choose_lattice(points);
    for (PolygonMesh& m : meshes) {
        trisect::LatticeReport report;
        const auto rounded = trisect::to_lattice(m.points, lattice, report);
        for (std::size_t i = 0; i < rounded.size(); ++i)
            m.points[i] = trisect::to_user(rounded[i], lattice);
    }
}

Point3d along_1_2_3(double length) {
    const double unit = length / std::sqrt(14.0);
    return {unit, 2 * unit, 3 * unit};
}

Size size_of(const PolygonMesh& mesh) {
    using Real = long double;
    using Vector = std::array<Real, 3>;
    const Box box = box_of(mesh);
    const auto at = [&](std::uint32_t v) {
        Vector out{};
        for (std::size_t k = 0; k < 3; ++k)
            out[k] = Real{mesh.points[v][k]} - Real{0.5} * (Real{box.low[k]} + Real{box.high[k]});
        return out;
    };
    const auto cross = [](const Vector& a, const Vector& b) {
        return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const Vector& a, const Vector& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    Real volume = 0;
    Real area = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 2; i < loop.size(); ++i) {
            const Vector a = at(loop[0]);
            Vector u = at(loop[i - 1]);
            Vector v = at(loop[i]);
            for (std::size_t k = 0; k < 3; ++k) u[k] -= a[k], v[k] -= a[k];
            const Vector normal = cross(u, v);
            volume += dot(a, normal);
            area += std::sqrt(dot(normal, normal));
        }
    }
    return {static_cast<double>(volume / 6), static_cast<double>(area / 2)};
}

std::size_t open_edges(const PolygonMesh& mesh) {
    std::vector<std::pair<std::uint64_t, int>> uses;
    uses.reserve(mesh.corners.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i];
            const std::uint32_t b = loop[(i + 1) % loop.size()];
            if (a != b) uses.emplace_back(edge_key(a, b), a < b ? 1 : -1);
        }
    }
    std::ranges::sort(uses);
    std::size_t open = 0;
    for (std::size_t i = 0; i < uses.size();) {
        int balance = 0;
        const std::uint64_t edge = uses[i].first;
        for (; i < uses.size() && uses[i].first == edge; ++i) balance += uses[i].second;
        open += balance != 0 ? 1U : 0U;
    }
    return open;
}

std::uint64_t hash_of(const PolygonMesh& mesh) {
    std::uint64_t hash = 0xCBF29CE484222325U;
    const auto add = [&](std::uint64_t word) { hash = (hash ^ word) * 0x100000001B3U; };
    for (const Point3d& p : mesh.points)
        for (const double x : p) add(std::bit_cast<std::uint64_t>(x));
    for (const std::uint32_t begin : mesh.face_begin) add(begin);
    for (const std::uint32_t corner : mesh.corners) add(corner);
    return hash;
}

}  // namespace shapes
