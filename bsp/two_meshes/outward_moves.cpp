// SPDX-License-Identifier: Apache-2.0
//
// The sum of a corner's normals mostly has a positive product with each of them. Where it has not,
// the middle of the smallest cap that has all of them on the unit sphere has one if any vector has.
// That cap is found as the smallest circle around points of a plane is (Welzl, "Smallest enclosing
// disks", 1991), in loops.

#include <trisect/bsp/two_meshes/outward_moves.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

Vector3 unit(const Vector3& v) {
    const double size = length(v);
    return size > 0 ? scaled(v, 1 / size) : Vector3{};
}

// A cap of the unit sphere, less than a half of it.
struct Cap {
    Vector3 middle{};
    double least = 1;  // product with the middle that a point of it has

    [[nodiscard]] bool has(const Vector3& n) const {
        constexpr double rounding = 0x1p-40;
        return dot(middle, n) >= least - rounding;
    }
    static Cap of(const Vector3& a) { return {a, 1}; }
    static Cap of(const Vector3& a, const Vector3& b) {
        const Vector3 m = unit(plus(a, b));
        return {m, dot(m, a)};
    }
    static Cap of(const Vector3& a, const Vector3& b, const Vector3& c) {
        Vector3 m = unit(cross(minus(b, a), minus(c, a)));
        if (dot(m, a) < 0) m = scaled(m, -1.0);
        return {m, dot(m, a)};
    }
};

Cap smallest_cap(std::span<const Vector3> n) {
    Cap cap = Cap::of(n[0]);
    for (std::size_t i = 1; i < n.size(); ++i) {
        if (cap.has(n[i])) continue;
        cap = Cap::of(n[i]);
        for (std::size_t j = 0; j < i; ++j) {
            if (cap.has(n[j])) continue;
            cap = Cap::of(n[i], n[j]);
            for (std::size_t k = 0; k < j; ++k)
                if (!cap.has(n[k])) cap = Cap::of(n[i], n[j], n[k]);
        }
    }
    return cap;
}

double least_product(const Vector3& v, std::span<const Vector3> normals) {
    double least = 1;
    for (const Vector3& n : normals) least = std::min(least, dot(v, n));
    return least;
}

Vector3 outward(std::span<const Vector3> normals) {
    Vector3 sum{};
    for (const Vector3& n : normals) sum = plus(sum, n);
    sum = unit(sum);
    constexpr double clear = 0.125;
    if (least_product(sum, normals) > clear) return sum;
    const Vector3 middle = smallest_cap(normals).middle;
    return least_product(middle, normals) > least_product(sum, normals) ? middle : sum;
}

CornerMoves::Vector rounded(const Vector3& v, double size) {
    CornerMoves::Vector out{};
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = static_cast<std::int32_t>(std::lround(size * v[k]));
    return out;
}

Vector3 normal_of(const LatticeMesh& mesh, std::uint32_t facet) {
    const auto& t = mesh.triangles[facet];
    const Vector3 a = mesh.points[t[0]].doubles();
    return unit(
        cross(minus(mesh.points[t[1]].doubles(), a), minus(mesh.points[t[2]].doubles(), a)));
}

}  // namespace

std::shared_ptr<const CornerMoves> outward_moves(const LatticeMesh& mesh,
                                                 std::span<const std::uint32_t> facets,
                                                 bool inwards) {
    auto out = std::make_shared<CornerMoves>();
    out->points = mesh.points.data();
    out->vectors.resize(mesh.points.size());
    // Normals by corner.
    std::vector<std::uint32_t> end(mesh.points.size() + 1);
    for (const std::uint32_t f : facets)
        for (const std::uint32_t v : mesh.triangles[f]) ++end[v];
    std::exclusive_scan(end.begin(), end.end(), end.begin(), 0U);
    std::vector<Vector3> normals(end.back());
    for (const std::uint32_t f : facets) {
        const Vector3 n = normal_of(mesh, f);
        for (const std::uint32_t v : mesh.triangles[f]) normals[end[v]++] = n;
    }
    const double size = inwards ? -0x1p30 : 0x1p30;
    std::uint32_t begin = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if (end[v] == begin) continue;
        out->vectors[v] = rounded(outward(std::span(normals).subspan(begin, end[v] - begin)), size);
        begin = end[v];
    }
    return out;
}

}  // namespace trisect::detail
