// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/divide_edges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/face/loop_triangulator.h>
#include <trisect/brep/mend/near_search.h>
#include <trisect/brep/mend/open_edges.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

// A vertex in an edge, whose ends are in rising order.
struct Division {
    std::uint32_t low, high;
    std::uint32_t vertex;
    FootOnEdge foot;

    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> edge() const { return {low, high}; }
};

// Calls visit(division) for each vertex and edge that come near each other.
template <class Visit>
void for_each_division(const MendingMesh& mesh, std::span<const UnmatchedEdge> edges,
                       const DistanceBound& bound, Visit&& visit) {
    const std::vector<std::uint32_t> vertices = ends_of(edges);
    const FacesAtVertices faces(mesh, vertices);
    std::vector<std::array<std::uint32_t, 2>> ends;
    for (const UnmatchedEdge& e : edges) ends.push_back({e.low, e.high});
    NearSearch search(mesh.points, ends, bound);
    const auto at = [&](std::uint32_t v) {
        const auto it = std::lower_bound(vertices.begin(), vertices.end(), v);
        return faces.of(static_cast<std::size_t>(it - vertices.begin()));
    };
    // Whether a face that has the edge has the vertex too.
    const auto is_in_face_of = [&](std::span<const std::uint32_t> at_vertex, std::uint32_t low,
                                   std::uint32_t high) {
        std::vector<std::uint32_t> both;
        std::ranges::set_intersection(at_vertex, at(low), std::back_inserter(both));
        return have_common(both, at(high));
    };
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t v = vertices[i];
        search.for_each_near(mesh.points[v], [&](std::uint32_t k) {
            const auto [low, high] = ends[k];
            if (low == v || high == v) return;
            const FootOnEdge foot =
                foot_on_edge(mesh.points[low], mesh.points[high], mesh.points[v]);
            if (!foot.is_inside || !bound.covers(foot.distance)) return;
            if (!is_in_face_of(faces.of(i), low, high)) visit(Division{low, high, v, foot});
        });
    }
}

// Divisions of each edge, side by side, from its low end on.
void sort_divisions(std::vector<Division>& divisions) {
    std::ranges::sort(divisions, [](const Division& a, const Division& b) {
        if (a.edge() != b.edge()) return a.edge() < b.edge();
        if (a.foot.place != b.foot.place) return a.foot.place < b.foot.place;
        return a.vertex < b.vertex;
    });
}

class FaceDivider {
public:
    FaceDivider(const MendingMesh& mesh, std::span<const Division> divisions)
        : mesh_(mesh),
          divisions_(divisions),
          is_low_end_(mesh.points.size(), false),
          triangulator_(mesh.points) {
        for (const Division& d : divisions) is_low_end_[d.low] = true;
    }

    [[nodiscard]] MendingMesh divided(MendReport& report) {
        MendingMesh out;
        for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
            check_stop();
            if (divide(mesh_.loop(f))) {
                add_divided(f, out, report);
            } else {
                out.add_face(mesh_.loop(f), mesh_.face_source[f]);
            }
        }
        return out;
    }

private:
    // Leaves the loop with all vertices in loop_. Whether there are any new ones.
    bool divide(std::span<const std::uint32_t> loop) {
        loop_.clear();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i];
            const std::uint32_t b = loop[i + 1 < loop.size() ? i + 1 : 0];
            loop_.push_back(a);
            const std::uint32_t low = std::min(a, b);
            if (a == b || !is_low_end_[low]) continue;
            const std::size_t before = loop_.size();
            const std::pair edge(low, std::max(a, b));
            for (auto d = std::ranges::lower_bound(divisions_, edge, {}, &Division::edge);
                 d != divisions_.end() && d->edge() == edge; ++d)
                loop_.push_back(d->vertex);
            if (a != low)
                std::reverse(loop_.begin() + static_cast<std::ptrdiff_t>(before), loop_.end());
        }
        return loop_.size() > loop.size();
    }
    void add_divided(std::size_t face, MendingMesh& out, MendReport& report) {
        const std::uint32_t source = mesh_.face_source[face];
        if (mesh_.loop(face).size() > 3) {
            const LoopShape shape = triangulator_.shape(loop_);
            if (shape.planar && !shape.degenerate) return out.add_face(loop_, source);
        }
        triangles_.clear();
        triangulator_.triangulate(loop_, triangles_);
        for (const auto& t : triangles_) out.add_face(t, source);
        if (source != no_face) report.cut_faces.push_back(source);
    }

    const MendingMesh& mesh_;
    std::span<const Division> divisions_;
    std::vector<bool> is_low_end_;
    LoopTriangulator triangulator_;
    std::vector<std::uint32_t> loop_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

void divide(MendingMesh& mesh, std::vector<Division>&& divisions, Lattice lattice,
            MendReport& report) {
    if (divisions.empty()) return;
    sort_divisions(divisions);
    for (const Division& d : divisions) {
        const double gap = lattice.to_double(d.foot.distance.root());
        report.divided.push_back({{mesh.source_point[d.low], mesh.source_point[d.high]},
                                  mesh.source_point[d.vertex],
                                  gap});
        report.max_gap = std::max(report.max_gap, gap);
    }
    MendingMesh faces = FaceDivider(mesh, divisions).divided(report);
    mesh.take_faces(std::move(faces));
}

}  // namespace

void divide_exactly(MendingMesh& mesh, const DistanceBound& ends, Lattice lattice,
                    MendReport& report) {
    std::vector<Division> divisions;
    const auto is_near = [&](std::uint32_t a, std::uint32_t b) {
        return ends.covers(squared_distance(mesh.points[a], mesh.points[b]));
    };
    for_each_division(mesh, unmatched_edges(mesh), DistanceBound(0, lattice),
                      [&](const Division& d) {
                          if (!is_near(d.vertex, d.low) && !is_near(d.vertex, d.high))
                              divisions.push_back(d);
                      });
    divide(mesh, std::move(divisions), lattice, report);
}

void divide_near(MendingMesh& mesh, const DistanceBound& bound, Lattice lattice,
                 MendReport& report) {
    std::vector<Division> nearest;  // of each vertex
    for_each_division(mesh, odd_edges(mesh), bound, [&](const Division& d) {
        if (nearest.empty() || nearest.back().vertex != d.vertex) {
            nearest.push_back(d);
            return;
        }
        Division& best = nearest.back();
        if (d.foot.distance < best.foot.distance ||
            (!(best.foot.distance < d.foot.distance) && d.edge() < best.edge()))
            best = d;
    });
    divide(mesh, std::move(nearest), lattice, report);
}

void leave_out_degenerate(MendingMesh& mesh, MendReport& report) {
    LoopTriangulator triangulator(mesh.points);
    std::vector<std::uint32_t> loop;
    MendingMesh out;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        check_stop();
        const auto whole = mesh.loop(f);
        loop.assign(whole.begin(), whole.end());
        loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
        while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
        const bool has_area =
            loop.size() == 3
                ? !are_collinear(mesh.points[loop[0]], mesh.points[loop[1]], mesh.points[loop[2]])
                : loop.size() > 3 && !triangulator.shape(loop).degenerate;
        if (has_area) {
            out.add_face(loop, mesh.face_source[f]);
        } else {
            report.degenerate_faces.push_back(mesh.face_source[f]);
        }
    }
    mesh.take_faces(std::move(out));
}

}  // namespace trisect::detail
