// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/grid/csg_grid_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace trisect::detail {
namespace {

constexpr double cell_size = 0x1p-20;
constexpr double most_cells = 0x1p62;
constexpr double valley_degrees = 0.1;

using Cell = std::array<std::int64_t, 3>;
using Vector = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;

/// Cells that are taken, and the points in them.
class Grid {
public:
    std::uint32_t point_of(const Cell& cell, PolygonMesh& mesh) {
        auto at = points_.find(cell);
        if (at == points_.end()) at = nearest_beside(cell);
        if (at == points_.end()) {
            at = points_.emplace(cell, static_cast<std::uint32_t>(mesh.points.size())).first;
            mesh.points.push_back({static_cast<double>(cell[0]) * cell_size,
                                   static_cast<double>(cell[1]) * cell_size,
                                   static_cast<double>(cell[2]) * cell_size});
        }
        return at->second;
    }

private:
    using Points = std::map<Cell, std::uint32_t>;

    Points::iterator nearest_beside(const Cell& cell) {
        auto out = points_.end();
        std::int64_t least = 4;
        for (std::int64_t x = -1; x <= 1; ++x)
            for (std::int64_t y = -1; y <= 1; ++y)
                for (std::int64_t z = -1; z <= 1; ++z) {
                    const std::int64_t distance = x * x + y * y + z * z;
                    if (distance >= least) continue;
                    const auto at = points_.find({cell[0] + x, cell[1] + y, cell[2] + z});
                    if (at == points_.end()) continue;
                    out = at;
                    least = distance;
                }
        return out;
    }

    Points points_;
};

std::optional<Cell> cell_of(const Point3d& p) {
    Cell out{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double cells = p[k] / cell_size;
        if (!(std::fabs(cells) < most_cells)) return std::nullopt;
        out[k] = static_cast<std::int64_t>(cells);  // towards 0
    }
    return out;
}

Vector difference(const Point3d& a, const Point3d& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::vector<Triangle> fans_of(const PolygonMesh& mesh) {
    std::vector<Triangle> out;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
            out.push_back({face[0], face[i], face[i + 1]});
    }
    return out;
}

/// The triangle at each directed edge; nothing where two have one.
std::optional<std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>> edges_of(
    const std::vector<Triangle>& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> out;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            if (!out.emplace(std::pair(triangles[t][k], triangles[t][(k + 1) % 3]), t).second)
                return std::nullopt;
    return out;
}

}  // namespace

PolygonMesh moved_in_doubles(const PolygonMesh& mesh, const AffineMap& map) {
    PolygonMesh out = mesh;
    for (Point3d& p : out.points) {
        const Point3d q = p;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& row = map.rows[k];
            p[k] = ((row[0] * q[0] + row[1] * q[1]) + row[2] * q[2]) + row[3];
        }
    }
    if (map.orientation() < 0)
        for (std::size_t f = 0; f < out.face_count(); ++f)
            std::reverse(out.corners.begin() + out.face_begin[f],
                         out.corners.begin() + out.face_begin[f + 1]);
    return out;
}

std::optional<PolygonMesh> on_openscad_grid(const PolygonMesh& mesh) {
    PolygonMesh out;
    Grid grid;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::vector<std::uint32_t> all;
        for (const std::uint32_t v : mesh.face(f)) {
            const std::optional<Cell> cell = cell_of(mesh.points[v]);
            if (!cell) return std::nullopt;
            all.push_back(grid.point_of(*cell, out));
        }
        std::vector<std::uint32_t> loop;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i] != all[(i + 1) % all.size()]) loop.push_back(all[i]);
        if (loop.size() >= 3) out.add_face(loop);
    }
    return out;
}

bool is_about_convex(const PolygonMesh& mesh) {
    const std::vector<Triangle> triangles = fans_of(mesh);
    const auto edges = edges_of(triangles);
    if (!edges || triangles.empty()) return false;
    const double least = std::cos(valley_degrees * std::numbers::pi / 180);
    std::vector<bool> is_reached(triangles.size(), false);
    std::vector<std::size_t> pending{0};
    is_reached[0] = true;
    std::size_t reached = 0;
    const auto normal = [&](const Triangle& t) {
        return cross(difference(mesh.points[t[1]], mesh.points[t[0]]),
                     difference(mesh.points[t[2]], mesh.points[t[0]]));
    };
    while (!pending.empty()) {
        const Triangle t = triangles[pending.back()];
        pending.pop_back();
        ++reached;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto other = edges->find({t[(k + 1) % 3], t[k]});
            if (other == edges->end()) return false;
            const Triangle& o = triangles[other->second];
            const Vector u = normal(o);
            const Vector v = normal(t);
            const bool is_above =
                dot(u, difference(mesh.points[t[(k + 2) % 3]], mesh.points[o[0]])) > 0;
            if (is_above && dot(u, v) < least * std::sqrt(dot(u, u) * dot(v, v))) return false;
            if (is_reached[other->second]) continue;
            is_reached[other->second] = true;
            pending.push_back(other->second);
        }
    }
    return reached == triangles.size();
}

}  // namespace trisect::detail
