// SPDX-License-Identifier: Apache-2.0
//
// A mesh whose faces are the obstacles' would need points where obstacles have none, and rounding
// with them. It is not needed: lists say which obstacles a tetrahedron meets, and what is tested is
// on the safe side. The tetrahedra that a triangle meets are connected through their faces, since
// those at one point of it are, and neighbouring points share them.
//
// Signs in doubles. A normal n is a product of differences, with N the sums of the magnitudes of
// its terms; a value n·d has an error below 2^-50 N·|d|, and N times what a coordinate of d is off
// by: the error of the points and 2^-51 of the largest coordinate. 2^-45 pays for all.

#include <trisect/bsp/hierarchies/partitions/obstacle_mesh.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

using detail::minus;
using detail::Vector3;

namespace {

/// A plane through three points and how far doubles can be trusted with it.
class ObstaclePlane {
public:
    ObstaclePlane(const Vector3& a, const Vector3& b, const Vector3& c) : origin_(a) {
        const Vector3 u = minus(b, a);
        const Vector3 v = minus(c, a);
        for (std::size_t k = 0; k < 3; ++k) {
            const double p = u[(k + 1) % 3] * v[(k + 2) % 3];
            const double q = u[(k + 2) % 3] * v[(k + 1) % 3];
            normal_[k] = p - q;
            size_[k] = std::abs(p) + std::abs(q);
        }
    }
    /// 1 or -1 when the point is certainly on that side; `error` of the coordinates' difference.
    [[nodiscard]] int side(const Vector3& p, double error) const {
        double value = 0;
        double bound = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double d = p[k] - origin_[k];
            value += normal_[k] * d;
            bound += size_[k] * (0x1p-45 * std::abs(d) + error);
        }
        return value > bound ? 1 : (value < -bound ? -1 : 0);
    }

private:
    Vector3 origin_;
    Vector3 normal_{};
    Vector3 size_{};
};

/// 1 where all coordinates are whole, or may be.
double unit_of(const detail::InterferenceModelData& model) {
    const bool whole = std::ranges::all_of(model.brep.points(), [](const Point& p) {
        return !p.is_lattice() || p.lattice().is_whole();
    });
    if (whole || !(model.largest > 0)) return 1;
    return std::ldexp(1.0, std::ilogb(model.largest) - (coordinate_bits - 1));
}

/// Faces of a positive tetrahedron, its inside on the positive side.
constexpr std::array<std::array<std::size_t, 3>, 4> faces{
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

}  // namespace

IntegerPoint ObstacleMesh::place(const Vector3& p) const {
    return {std::llround(p[0] / unit_), std::llround(p[1] / unit_), std::llround(p[2] / unit_)};
}

std::array<Vector3, 4> ObstacleMesh::corners_of(std::uint32_t tetrahedron) const {
    std::array<Vector3, 4> r{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            r[i][k] = unit_ * static_cast<double>(
                                  mesh_.point(mesh_.tetrahedra()[tetrahedron].corner[i])[k]);
    return r;
}

PointHull::PointHull(std::span<const Vector3> points, double e) : count(points.size()), error(e) {
    std::copy(points.begin(), points.end(), point.begin());
    for (std::size_t k = 0; k < 3; ++k) {
        double lo = HUGE_VAL;
        double hi = -HUGE_VAL;
        for (const Vector3& p : points) {
            lo = std::min(lo, p[k]);
            hi = std::max(hi, p[k]);
        }
        box.lo[k] = std::nextafter(lo - e, -HUGE_VAL);
        box.hi[k] = std::nextafter(hi + e, HUGE_VAL);
    }
}

ObstacleMesh::ObstacleMesh(const detail::InterferenceModelData& model) : unit_(unit_of(model)) {
    std::vector<IntegerPoint> points;
    for (const Vector3& p : model.positions) points.push_back(place(p));
    while (true) {
        mesh_ = DelaunayMesh(points);
        make_boxes();
        if (make_lists(model) || points.empty()) return;
        // Fewer and larger ones.
        for (std::size_t i = 0; 2 * i < points.size(); ++i) points[i] = points[2 * i];
        points.resize(points.size() / 2);
    }
}

void ObstacleMesh::make_boxes() {
    boxes_.clear();
    outermost_.clear();
    for (std::uint32_t t = 0; t < mesh_.tetrahedra().size(); ++t) {
        const auto c = corners_of(t);
        // The points of the cube may have one bit more than a double.
        boxes_.push_back(PointHull(c, 0).box);
        const auto& n = mesh_.tetrahedra()[t].neighbour;
        if (std::count(n.begin(), n.end(), DelaunayMesh::none) != 0) outermost_.push_back(t);
    }
}

bool ObstacleMesh::contains(const IntegerPoint& p) const {
    bool r = true;
    for (std::size_t k = 0; k < 3; ++k) r = r && mesh_.low()[k] <= p[k] && p[k] <= mesh_.high()[k];
    return r;
}

bool ObstacleMesh::may_meet(std::uint32_t tetrahedron, const PointHull& hull) const {
    if (!boxes_[tetrahedron].meets(hull.box)) return false;
    const auto corner = corners_of(tetrahedron);
    double far = 0;
    for (const Vector3& c : corner)
        for (const double v : c) far = std::max(far, std::abs(v));
    const double error = hull.error + 0x1p-50 * far;
    for (const auto& f : faces) {
        const ObstaclePlane plane(corner[f[0]], corner[f[1]], corner[f[2]]);
        bool beyond = true;
        for (std::size_t i = 0; beyond && i < hull.count; ++i)
            beyond = plane.side(hull.point[i], error) < 0;
        if (beyond) return false;
    }
    if (hull.count != 3) return true;
    // The points of a triangle are off as well: its plane is tried for exact ones only.
    if (hull.error != 0) return true;
    const ObstaclePlane plane(hull.point[0], hull.point[1], hull.point[2]);
    int below = 0;
    int above = 0;
    for (const Vector3& c : corner) {
        const int side = plane.side(c, error);
        below += side < 0 ? 1 : 0;
        above += side > 0 ? 1 : 0;
    }
    return below < 4 && above < 4;
}

bool ObstacleMesh::make_lists(const detail::InterferenceModelData& model) {
    // A vertex that is not at a place of the mesh has been moved by rounding; a triangle grown by a
    // unit contains it.
    const bool is_exact =
        model.all_lattice && std::ranges::all_of(model.positions, [&](const auto& p) {
            return std::ranges::all_of(
                p, [&](double c) { return std::nearbyint(c / unit_) == c / unit_; });
        });
    const double error = is_exact ? 0 : model.position_error + unit_;
    const std::size_t most = most_entries * model.triangles.size();
    std::vector<std::vector<std::uint32_t>> lists(mesh_.tetrahedra().size());
    std::vector<std::uint32_t> mark(lists.size(), DelaunayMesh::none);
    std::vector<std::uint32_t> open;
    std::size_t total = 0;
    std::uint64_t steps = 0;
    std::uint32_t start = 0;
    for (std::uint32_t i = 0; i < model.triangles.size(); ++i) {
        const auto& v = model.triangles[i].vertex;
        const std::array<Vector3, 3> corners{model.position(v[0]), model.position(v[1]),
                                             model.position(v[2])};
        const PointHull triangle(corners, error);
        start = mesh_.locate(place(corners[0]), start, steps);
        open.assign(1, start);
        mark[start] = i;
        while (!open.empty()) {
            const std::uint32_t t = open.back();
            open.pop_back();
            lists[t].push_back(i);
            if (++total > most) return false;
            for (const std::uint32_t n : mesh_.tetrahedra()[t].neighbour) {
                if (n == DelaunayMesh::none || mark[n] == i) continue;
                mark[n] = i;
                if (may_meet(n, triangle)) open.push_back(n);
            }
        }
    }
    first_.assign(1, 0);
    entries_.clear();
    for (const auto& list : lists) {
        entries_.insert(entries_.end(), list.begin(), list.end());
        first_.push_back(static_cast<std::uint32_t>(entries_.size()));
    }
    return true;
}

}  // namespace trisect::hierarchies
