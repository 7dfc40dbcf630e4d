// SPDX-License-Identifier: Apache-2.0
//
// Vertices that became one are a cluster, which lies at the place of one of them. Two clusters join
// if all vertices of one are within the distance of the place of the other, so chains of near
// vertices do not move far.

#include <trisect/brep/mend/join_vertices.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/mend/near_search.h>
#include <trisect/brep/mend/open_edges.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

// By their places in the list of vertices.
struct NearPair {
    double square;  // of the distance in lattice units, rounded
    std::uint32_t a, b;
};

// Of differences, squares and sums, each rounded by 2^-53 of its size.
constexpr double square_error = 0x1p-49;

class Clusters {
public:
    Clusters(const MendingMesh& mesh, std::span<const std::uint32_t> vertices,
             const DistanceBound& bound)
        : mesh_(mesh),
          vertices_(vertices),
          bound_(bound),
          place_(vertices.size()),
          members_(vertices.size()),
          faces_(vertices.size()) {
        const FacesAtVertices at(mesh, vertices);
        for (std::uint32_t i = 0; i < vertices.size(); ++i) {
            place_[i] = i;
            members_[i] = {i};
            faces_[i].assign(at.of(i).begin(), at.of(i).end());
        }
    }

    [[nodiscard]] bool share_face(std::uint32_t a, std::uint32_t b) const {
        return have_common(faces_[a], faces_[b]);
    }
    [[nodiscard]] const LatticePoint& point(std::uint32_t i) const {
        return mesh_.points[vertices_[i]];
    }

    void try_join(std::uint32_t a, std::uint32_t b) {
        a = place_[a];
        b = place_[b];
        if (a == b || share_face(a, b)) return;
        if (b < a) std::swap(a, b);
        if (!reach(b, a)) {
            if (!reach(a, b)) return;
            std::swap(a, b);
        }
        for (const std::uint32_t m : members_[b]) place_[m] = a;
        const auto add = [](std::vector<std::uint32_t>& to, std::vector<std::uint32_t>& from) {
            const auto middle = static_cast<std::ptrdiff_t>(to.size());
            to.insert(to.end(), from.begin(), from.end());
            std::inplace_merge(to.begin(), to.begin() + middle, to.end());
            from = {};
        };
        add(members_[a], members_[b]);
        add(faces_[a], faces_[b]);
    }
    /// Where a vertex is at last.
    [[nodiscard]] std::uint32_t place_of(std::uint32_t i) const { return place_[i]; }

private:
    // Whether all of cluster a may move to the place of b.
    [[nodiscard]] bool reach(std::uint32_t a, std::uint32_t b) const {
        return std::ranges::all_of(members_[a], [&](std::uint32_t m) {
            return bound_.covers(squared_distance(point(m), point(b)));
        });
    }

    const MendingMesh& mesh_;
    std::span<const std::uint32_t> vertices_;
    const DistanceBound& bound_;
    std::vector<std::uint32_t> place_;
    std::vector<std::vector<std::uint32_t>> members_;
    std::vector<std::vector<std::uint32_t>> faces_;
};

std::vector<NearPair> near_pairs(const MendingMesh& mesh, std::span<const std::uint32_t> vertices,
                                 const DistanceBound& bound, const Clusters& clusters) {
    std::vector<std::array<std::uint32_t, 2>> ends;
    for (const std::uint32_t v : vertices) ends.push_back({v, v});
    NearSearch search(mesh.points, ends, bound);
    std::vector<NearPair> out;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        search.for_each_near(clusters.point(i), [&](std::uint32_t k) {
            if (k <= i) return;
            const SquaredDistance d = squared_distance(clusters.point(i), clusters.point(k));
            if (!bound.covers(d) || clusters.share_face(i, k)) return;
            const double root = d.root();
            out.push_back({root * root, i, k});
        });
    }
    return out;
}

}  // namespace

void join_near_vertices(MendingMesh& mesh, const DistanceBound& bound, Lattice lattice,
                        MendReport& report) {
    const std::vector<std::uint32_t> vertices = ends_of(odd_edges(mesh));
    if (vertices.empty()) return;
    Clusters clusters(mesh, vertices, bound);
    std::vector<NearPair> pairs = near_pairs(mesh, vertices, bound, clusters);
    end_step();
    std::ranges::sort(pairs, [&](const NearPair& p, const NearPair& q) {
        if (std::abs(p.square - q.square) > square_error * (p.square + q.square))
            return p.square < q.square;
        const SquaredDistance d = squared_distance(clusters.point(p.a), clusters.point(p.b));
        const SquaredDistance e = squared_distance(clusters.point(q.a), clusters.point(q.b));
        if (d.numerator != e.numerator) return d.numerator < e.numerator;
        return std::pair(p.a, p.b) < std::pair(q.a, q.b);
    });
    for (const NearPair& p : pairs) clusters.try_join(p.a, p.b);
    std::vector<std::uint32_t> name(mesh.points.size());
    std::iota(name.begin(), name.end(), 0U);
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t k = clusters.place_of(i);
        if (k == i) continue;
        name[vertices[i]] = vertices[k];
        const double move =
            lattice.to_double(squared_distance(clusters.point(i), clusters.point(k)).root());
        report.joined.push_back(
            {mesh.source_point[vertices[i]], mesh.source_point[vertices[k]], move});
        report.max_move = std::max(report.max_move, move);
    }
    for (std::uint32_t& c : mesh.corners) c = name[c];
}

}  // namespace trisect::detail
