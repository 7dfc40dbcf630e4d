// SPDX-License-Identifier: Apache-2.0

#include "tri_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "disjoint_sets.h"

namespace manifold {

Box box_of(const TriMesh& mesh) {
    Box box;
    for (const vec3& p : mesh.points) box.Union(p);
    return box;
}

double volume_of(const TriMesh& mesh) {
    long double sum = 0;
    const vec3 base = mesh.points.empty() ? vec3() : mesh.points.front();
    for (std::size_t t = 0; t < mesh.corners.size(); ++t)
        sum += static_cast<long double>(la::dot(mesh.corner(t, 0) - base, mesh.normal(t)));
    return static_cast<double>(sum / 6);
}

double area_of(const TriMesh& mesh) {
    long double sum = 0;
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) sum += la::length(mesh.normal(t));
    return static_cast<double>(sum / 2);
}

mat3x4 compose(const mat3x4& second, const mat3x4& first) {
    const mat3 linear(second);
    return {linear * mat3(first), linear * first[3] + second[3]};
}

mat3 normal_map(const mat3x4& map) { return la::inverse(la::transpose(mat3(map))); }

namespace {

// Of the runs that have some. A row that other runs have as well moves with them.
void move_normals(TriMesh& mesh, const mat3& map) {
    std::vector<bool> done(mesh.properties.size() / std::max<std::size_t>(mesh.width, 1));
    for (std::size_t t = 0; t < mesh.rows.size(); ++t) {
        if (!mesh.runs[mesh.run[t]].normals) continue;
        for (const std::uint32_t r : mesh.rows[t]) {
            if (done[r]) continue;
            done[r] = true;
            double* n = mesh.properties.data() + r * mesh.width;
            const vec3 turned = la::normalize(map * vec3(n));
            for (int i = 0; i < 3; ++i) n[i] = turned[i];
        }
    }
}

}  // namespace

TriMesh moved(TriMesh mesh, const mat3x4& map) {
    for (vec3& p : mesh.points) p = map * vec4(p, 1.0);
    for (Run& run : mesh.runs) run.transform = compose(map, run.transform);
    if (mesh.width >= 3) move_normals(mesh, normal_map(map));
    if (la::determinant(mat3(map)) < 0) {
        for (Triple& t : mesh.corners) std::swap(t[1], t[2]);
        for (Triple& t : mesh.rows) std::swap(t[1], t[2]);
    }
    return mesh;
}

TriMesh part_of(const TriMesh& mesh, const std::vector<std::uint32_t>& triangles) {
    TriMesh part;
    part.width = mesh.width;
    part.runs = mesh.runs;
    std::vector<std::uint32_t> point(mesh.points.size(), no_side);
    std::vector<std::uint32_t> row(mesh.properties.size() / std::max<std::size_t>(mesh.width, 1),
                                   no_side);
    for (const std::uint32_t t : triangles) {
        Triple corners{};
        Triple rows{};
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& p = point[mesh.corners[t][k]];
            if (p == no_side) {
                p = static_cast<std::uint32_t>(part.points.size());
                part.points.push_back(mesh.corner(t, k));
            }
            corners[k] = p;
            if (mesh.width == 0) continue;
            std::uint32_t& r = row[mesh.rows[t][k]];
            if (r == no_side) {
                r = static_cast<std::uint32_t>(part.properties.size() / mesh.width);
                part.properties.insert(part.properties.end(), mesh.row(t, k),
                                       mesh.row(t, k) + mesh.width);
            }
            rows[k] = r;
        }
        part.corners.push_back(corners);
        if (mesh.width != 0) part.rows.push_back(rows);
        part.run.push_back(mesh.run[t]);
        part.face.push_back(mesh.face[t]);
    }
    return part;
}

std::vector<std::vector<std::uint32_t>> parts_of(const TriMesh& mesh) {
    DisjointSets sets(mesh.points.size());
    for (const Triple& t : mesh.corners) {
        sets.join(t[0], t[1]);
        sets.join(t[0], t[2]);
    }
    std::vector<std::uint32_t> number(mesh.points.size(), no_side);
    std::vector<std::vector<std::uint32_t>> parts;
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
        std::uint32_t& n = number[sets.root(mesh.corners[t][0])];
        if (n == no_side) {
            n = static_cast<std::uint32_t>(parts.size());
            parts.emplace_back();
        }
        parts[n].push_back(static_cast<std::uint32_t>(t));
    }
    return parts;
}

std::vector<std::uint32_t> opposite_sides(const TriMesh& mesh) {
    struct Side {
        std::uint32_t low;
        std::uint32_t high;
        std::uint32_t number;
    };
    std::vector<Side> sides;
    sides.reserve(3 * mesh.corners.size());
    for (std::uint32_t t = 0; t < mesh.corners.size(); ++t)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.corners[t][k];
            const std::uint32_t b = mesh.corners[t][(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), 3 * t + k});
        }
    std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.number); });
    std::vector<std::uint32_t> opposite(sides.size(), no_side);
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high)
            ++end;
        const auto from = [&](std::size_t s) {
            return mesh.corners[sides[s].number / 3][sides[s].number % 3];
        };
        if (end - i == 2 && from(i) != from(i + 1)) {
            opposite[sides[i].number] = sides[i + 1].number;
            opposite[sides[i + 1].number] = sides[i].number;
        }
        i = end;
    }
    return opposite;
}

std::vector<std::uint64_t> flat_faces(const TriMesh& mesh) {
    const double tolerance = relative_epsilon * box_of(mesh).Scale();
    const std::vector<std::uint32_t> opposite = opposite_sides(mesh);
    constexpr std::uint64_t none = ~std::uint64_t{0};
    std::vector<std::uint64_t> face(mesh.corners.size(), none);
    // Large triangles have the better planes.
    std::vector<std::uint32_t> order(mesh.corners.size());
    std::iota(order.begin(), order.end(), 0U);
    std::vector<double> size;
    for (std::size_t t = 0; t < order.size(); ++t) size.push_back(la::length2(mesh.normal(t)));
    std::ranges::stable_sort(order, std::greater<>(), [&](std::uint32_t t) { return size[t]; });
    std::vector<std::uint32_t> members;
    for (const std::uint32_t seed : order) {
        if (face[seed] != none) continue;
        const double length = std::sqrt(size[seed]);
        const vec3 up = length > 0 ? mesh.normal(seed) / length : vec3();
        members.assign(1, seed);
        face[seed] = seed;
        for (std::size_t i = 0; i < members.size() && length > 0; ++i)
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t other = opposite[3 * members[i] + k];
                if (other == no_side) continue;
                const std::uint32_t t = other / 3;
                if (face[t] != none || mesh.run[t] != mesh.run[seed]) continue;
                const vec3 far = mesh.corner(t, (other % 3 + 2) % 3);
                if (std::abs(la::dot(up, far - mesh.corner(seed, 0))) > tolerance) continue;
                if (la::dot(up, mesh.normal(t)) < 0) continue;
                face[t] = seed;
                members.push_back(t);
            }
        const std::uint32_t least = *std::ranges::min_element(members);
        for (const std::uint32_t t : members) face[t] = least;
    }
    return face;
}

}  // namespace manifold
