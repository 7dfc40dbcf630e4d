// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/few_facets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <trisect/bsp/two_meshes/two_meshes.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// A facet with its box, for a test that decides nothing but the way that is taken.
class NearFacet {
public:
    NearFacet(const LatticeMesh& mesh, std::size_t facet) {
        const auto& t = mesh.triangles[facet];
        a_ = mesh.points[t[0]].doubles();
        const Vector3 b = mesh.points[t[1]].doubles();
        const Vector3 c = mesh.points[t[2]].doubles();
        normal_ = cross(minus(b, a_), minus(c, a_));
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k] = std::min({a_[k], b[k], c[k]});
            hi_[k] = std::max({a_[k], b[k], c[k]});
        }
    }
    [[nodiscard]] bool may_contain(const Vector3& p) const {
        double value = 0;
        double size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (p[k] < lo_[k] || p[k] > hi_[k]) return false;
            const double term = normal_[k] * (p[k] - a_[k]);
            value += term;
            size += std::fabs(term);
        }
        return std::fabs(value) <= 0x1p-44 * size;
    }

private:
    Vector3 a_{}, normal_{}, lo_{}, hi_{};
};

// Corners beside the box of both are on no facet of the other mesh; a box is one of positions, from
// which coordinates are less than a unit away.
bool has_corner_on(const LatticeMesh& facets, const LatticeMesh& corners, const Box& common) {
    std::vector<Vector3> near;
    for (const LatticePoint& corner : corners.points) {
        const Vector3 p = corner.doubles();
        bool is_within = true;
        for (std::size_t k = 0; k < 3; ++k)
            is_within = is_within && p[k] >= static_cast<double>(common.lo[k] - 1) &&
                        p[k] <= static_cast<double>(common.hi[k] + 1);
        if (is_within) near.push_back(p);
    }
    if (near.empty()) return false;
    for (std::size_t f = 0; f < facets.triangles.size(); ++f) {
        const NearFacet facet(facets, f);
        for (const Vector3& p : near)
            if (facet.may_contain(p)) return true;
    }
    return false;
}

}  // namespace

bool are_apart_or_touch(const SolidStates& solids) {
    const TwoMeshes two(solids);
    return two.common.is_empty() || has_corner_on(*two.meshes[0], *two.meshes[1], two.common) ||
           has_corner_on(*two.meshes[1], *two.meshes[0], two.common);
}

}  // namespace trisect::detail
