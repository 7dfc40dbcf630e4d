// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/fill_holes.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/face/loop_triangulator.h>
#include <trisect/brep/mend/open_edges.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

// Walks along open edges, which are joined at vertices where two meet.
class HoleLoops {
public:
    explicit HoleLoops(std::span<const UnmatchedEdge> edges)
        : edges_(edges), ends_(ends_of(edges)), at_(ends_.size()), is_done_(edges.size(), false) {
        for (std::uint32_t i = 0; i < edges.size(); ++i)
            for (const std::uint32_t v : {edges[i].low, edges[i].high}) {
                Vertex& at = at_[index(v)];
                if (at.count < 2) at.edges[at.count] = i;
                ++at.count;
            }
    }

    /// The loop that starts with an edge, against the face of it; empty where it is none, or was
    /// walked before.
    [[nodiscard]] std::vector<std::uint32_t> walk(std::uint32_t first) {
        std::vector<std::uint32_t> loop;
        if (is_done_[first]) return loop;
        const UnmatchedEdge& e = edges_[first];
        const std::uint32_t start = e.net > 0 ? e.high : e.low;
        std::uint32_t vertex = start;
        std::uint32_t edge = first;
        while (true) {
            if (at_[index(vertex)].count != 2) return {};
            is_done_[edge] = true;
            loop.push_back(vertex);
            vertex = edges_[edge].low == vertex ? edges_[edge].high : edges_[edge].low;
            if (vertex == start) return loop;
            const Vertex& at = at_[index(vertex)];
            if (at.count != 2) return {};
            edge = at.edges[0] == edge ? at.edges[1] : at.edges[0];
        }
    }

private:
    struct Vertex {
        std::array<std::uint32_t, 2> edges{};
        std::uint32_t count = 0;
    };
    [[nodiscard]] std::size_t index(std::uint32_t v) const {
        return static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), v) -
                                        ends_.begin());
    }

    std::span<const UnmatchedEdge> edges_;
    std::vector<std::uint32_t> ends_;
    std::vector<Vertex> at_;
    std::vector<bool> is_done_;
};

bool has_triangles_only(const MendingMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.loop(f).size() != 3) return false;
    return true;
}

}  // namespace

void fill_planar_holes(MendingMesh& mesh, MendReport& report) {
    const std::vector<UnmatchedEdge> edges = odd_edges(mesh);
    const bool cuts = has_triangles_only(mesh);
    HoleLoops loops(edges);
    LoopTriangulator triangulator(mesh.points);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        check_stop();
        const std::vector<std::uint32_t> loop = loops.walk(i);
        if (loop.size() < 3 || loop.size() > loop_corner_limit) continue;
        triangles.clear();
        // Before the triangles: those of a loop in no plane take long.
        if (LoopShape shape = triangulator.shape(loop); shape.degenerate || !shape.planar) continue;
        if (!triangulator.triangulate(loop, triangles).simple) continue;
        ++report.filled_holes;
        if (!cuts) {
            mesh.add_face(loop, no_face);
        } else {
            for (const auto& t : triangles) mesh.add_face(t, no_face);
        }
    }
}

}  // namespace trisect::detail
