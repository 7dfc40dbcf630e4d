// SPDX-License-Identifier: Apache-2.0
//
// The normals of the polygons that contain it decide the kind of boundary point: in one plane a
// face, planes through one line an edge, else a vertex. Near the point the boundary is a cone over
// these polygons, so this is a property of the set.

#include <algorithm>
#include <cmath>

#include <trisect/bsp/query/index/index_core.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

bool have_parallel_normals(const Plane& a, const Plane& b) {
    for (int k = 0; k < 3; ++k)
        if (sign_of_cross(a, b, k) != 0) return false;
    return true;
}

// A triangle's normal, its largest component 1, in doubles: within 2^-40, or not known.
bool find_normal(const PolygonId& id, Vector3& n) {
    if (!id.is_triangle()) return false;
    std::array<Vector3, 3> c{};
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& p = id.corner(i);
        c[static_cast<std::size_t>(i)] = p.doubles();
    }
    const Vector3 u{c[1][0] - c[0][0], c[1][1] - c[0][1], c[1][2] - c[0][2]};
    const Vector3 v{c[2][0] - c[0][0], c[2][1] - c[0][1], c[2][2] - c[0][2]};
    n = cross(u, v);
    // Each component is within 2^-50 of the product of the largest ones of u and v.
    const double size = largest_component(n);
    if (!(0x1p-50 * largest_component(u) * largest_component(v) < 0x1p-42 * size)) return false;
    for (double& x : n) x /= size;
    return true;
}

// Polygons whose normals are linearly independent, up to three: each one that is not a combination
// of those before. Doubles mostly decide.
class Independent {
public:
    [[nodiscard]] std::size_t rank() const { return rank_; }
    void add(const PolygonId& id) {
        Vector3 n{};
        const bool known = find_normal(id, n);
        if (!is_independent(id, known, n)) return;
        if (rank_ == 1) both_ = cross(first_, n);
        if (rank_ == 0) first_ = n;
        sure_ = sure_ && known;
        id_[rank_++] = id;
    }

private:
    [[nodiscard]] bool is_independent(const PolygonId& id, bool known, const Vector3& n) const {
        if (rank_ == 0) return true;
        // Components of a cross product are within 2^-38, a determinant within 2^-35.
        const double turn = rank_ == 1
                                ? largest_component(cross(first_, n))
                                : std::fabs(both_[0] * n[0] + both_[1] * n[1] + both_[2] * n[2]);
        if (known && sure_ && turn > 0x1p-30) return true;
        const Plane p = id.support();
        const Plane first = id_[0].support();
        if (rank_ == 1) return !have_parallel_normals(first, p);
        return sign_of_det(first, id_[1].support(), p) != 0;
    }

    std::array<PolygonId, 3> id_{};
    std::size_t rank_ = 0;
    bool sure_ = true;  // the normals below are good
    Vector3 first_{};
    Vector3 both_{};
};

// Whether a point is a corner, which it can be under a name of planes, too.
bool is_at(const IndexPoint& point, const LatticePoint& corner) {
    if (point.approximate() != corner.doubles()) return false;
    if (point.is_doubles()) return true;
    for (std::size_t k = 0; k < 3; ++k)
        if (point.rational()[k] != ExactRational::from_double(point[k])) return false;
    return true;
}

}  // namespace

Location location_on(const std::vector<PolygonId>& on) {
    Independent chosen;
    for (const PolygonId& id : on) {
        chosen.add(id);
        if (chosen.rank() == 3) return Location::OnVertex;
    }
    return chosen.rank() == 1 ? Location::OnFace : Location::OnEdge;
}

Place place_on(std::vector<PolygonId>& on) {
    if (on.size() > 1)
        std::sort(on.begin(), on.end(),
                  [](const PolygonId& a, const PolygonId& b) { return a.name() < b.name(); });
    Place place;
    Independent chosen;
    for (const PolygonId& id : on) {
        if (chosen.rank() == 3) break;
        const std::size_t before = chosen.rank();
        chosen.add(id);
        if (chosen.rank() != before) place.faces[before] = id.face_source();
    }
    const std::size_t rank = chosen.rank();
    place.face_count = static_cast<std::uint8_t>(rank);
    place.location = rank == 1   ? Location::OnFace
                     : rank == 2 ? Location::OnEdge
                                 : Location::OnVertex;
    return place;
}

Place place_on(std::vector<PolygonId>& on, const IndexPoint& point) {
    Place place = place_on(on);
    if (place.location != Location::OnVertex) return place;
    for (const PolygonId& id : on) {
        const Source& s = id.source();
        if (s.is_half_space()) continue;
        for (int i = 0; i < 3; ++i) {
            const LatticePoint& c = s.corner(id.facet(), i);
            if (!is_at(point, c)) continue;
            const CornerSource name{s.operand(), s.corner_index(id.facet(), i)};
            if (!place.corner.is_valid() || name < place.corner) place.corner = name;
        }
    }
    return place;
}

}  // namespace trisect::detail
