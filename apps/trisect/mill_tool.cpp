// SPDX-License-Identifier: Apache-2.0
#include "mill_tool.h"

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/convex_sweep.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <span>

namespace trisect::app {
namespace {

constexpr double most_added_volume = 1e-5;

/// Sets of faces, joined along edges.
class FaceSets {
public:
    explicit FaceSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t find(std::uint32_t v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<std::uint32_t> parent_;
};

/// For every point the first one of the same value.
std::vector<std::uint32_t> first_of_value(const std::vector<Point3d>& points) {
    std::map<Point3d, std::uint32_t> first;
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < points.size(); ++i)
        out.push_back(first.emplace(points[i], i).first->second);
    return out;
}

double signed_volume(const PolygonMesh& mesh) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const std::span<const std::uint32_t> c = mesh.face(f);
        for (std::size_t i = 1; i + 1 < c.size(); ++i) {
            const Point3d& p = mesh.points[c[0]];
            const Point3d& q = mesh.points[c[i]];
            const Point3d& r = mesh.points[c[i + 1]];
            sum += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                   p[2] * (q[0] * r[1] - q[1] * r[0]);
        }
    }
    return sum / 6;
}

Point3d turned(const std::array<double, 9>& m, const Point3d& p) {
    return {m[0] * p[0] + m[1] * p[1] + m[2] * p[2], m[3] * p[0] + m[4] * p[1] + m[5] * p[2],
            m[6] * p[0] + m[7] * p[1] + m[8] * p[2]};
}

LatticeMesh hull_of_shell(const PolygonMesh& shell, const std::array<double, 9>& orientation,
                          MillGrid& grid) {
    std::vector<LatticePoint> corners;
    for (const std::uint32_t c : shell.corners) {
        const Point3d p = grid.rounded(turned(orientation, shell.points[c]));
        corners.push_back({Coordinate(p[0]), Coordinate(p[1]), Coordinate(p[2])});
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return hull_mesh(corners, grid.lattice());
}

}  // namespace

std::vector<PolygonMesh> shells_of(const PolygonMesh& mesh) {
    const std::vector<std::uint32_t> first = first_of_value(mesh.points);
    // Faces by directed edge. Where shells touch in an edge it has several faces on each side, and
    // joins none.
    std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> faces;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const auto c = mesh.face(f);
        for (std::size_t i = 0; i < c.size(); ++i)
            faces[{first[c[i]], first[c[(i + 1) % c.size()]]}].push_back(f);
    }
    FaceSets sets(mesh.face_count());
    for (const auto& [edge, here] : faces) {
        const auto there = faces.find({edge[1], edge[0]});
        if (here.size() == 1 && there != faces.end() && there->second.size() == 1)
            sets.join(here[0], there->second[0]);
    }
    std::map<std::uint32_t, PolygonMesh> shells;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        PolygonMesh& shell = shells[sets.find(f)];
        if (shell.points.empty()) shell.points = mesh.points;
        shell.add_face(mesh.face(f));
    }
    std::vector<PolygonMesh> out;
    for (auto& [root, shell] : shells) out.push_back(std::move(shell));
    return out;
}

MillTool::MillTool(const PolygonMesh& mesh, const std::string& name, MillGrid& grid,
                   const std::vector<std::array<double, 9>>& orientations) {
    const std::vector<PolygonMesh> shells = shells_of(mesh);
    for (const std::array<double, 9>& orientation : orientations) {
        std::vector<Part>& parts = parts_.emplace_back();
        for (const PolygonMesh& shell : shells) {
            parts.push_back({hull_of_shell(shell, orientation, grid), {}});
            const double whole = volume(parts.back().mesh);
            const double added = 1 - signed_volume(shell) / whole;
            if (!(added <= most_added_volume))
                throw UnsupportedError(
                    fmt::format("{}: a shell is not convex (its hull has {:.3g} % more volume); "
                                "what is swept is "
                                "made of convex shells, which may touch or overlap",
                                name, 100 * added / std::max(1 - added, 1e-9)));
            added_volume_ = std::max(added_volume_, added);
        }
    }
}

std::vector<LatticeMesh> MillTool::hulls() const {
    std::vector<LatticeMesh> out;
    for (const Part& part : parts_.front()) out.push_back(part.mesh);
    return out;
}

const LatticeMesh& MillTool::leading(Part& part, const std::array<double, 3>& by) {
    constexpr std::size_t most_kept = 4096;
    if (part.leading.size() == most_kept) part.leading.clear();
    const std::vector<bool> key = leading_triangles(part.mesh, by);
    auto known = part.leading.find(key);
    if (known == part.leading.end())
        known = part.leading.emplace(key, leading_part(part.mesh, by)).first;
    return known->second;
}

std::vector<Solid> MillTool::swept_shells(std::uint32_t orientation, const Point3d& from,
                                          const Point3d& to, bool is_clear) {
    const std::array<double, 3> by{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const bool moves = by != std::array<double, 3>{};
    std::vector<Solid> out;
    for (Part& part : parts_.at(orientation)) {
        const LatticeMesh& body = is_clear && moves ? leading(part, by) : part.mesh;
        out.push_back(Solid::from_lattice_mesh(trisect::swept(moved(body, from), by)));
    }
    return out;
}

SweptTool MillTool::swept(std::uint32_t orientation, const Point3d& from, const Point3d& to,
                          bool is_clear) {
    SweptTool out;
    const std::vector<Solid> solids = swept_shells(orientation, from, to, is_clear);
    for (const Solid& solid : solids) out.sources.push_back(solid.source_id());
    out.solid = solids.size() == 1 ? solids.front() : evaluate(Expression::any_of(solids));
    return out;
}

}  // namespace trisect::app
