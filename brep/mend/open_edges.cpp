// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/open_edges.h>

#include <algorithm>
#include <cmath>

#include <trisect/brep/import/edge_table.h>
#include <trisect/brep/import/line_balance.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/disjoint_sets.h>

namespace trisect::detail {

std::vector<UnmatchedEdge> unmatched_edges(const MendingMesh& mesh) {
    std::vector<UnmatchedEdge> out;
    const EdgeTable edges(mesh.points.size(), mesh.loop_begin, mesh.corners);
    edges.for_each_edge([&](std::uint32_t low, std::uint32_t high, std::span<const EdgeUse> uses) {
        std::int64_t net = 0;
        for (const EdgeUse& u : uses) net += u.is_forward() ? 1 : -1;
        if (net != 0)
            out.push_back(
                {low, high, net, static_cast<std::uint32_t>(uses.size()), uses[0].face()});
    });
    return out;
}

// An odd number of uses never cancels.
std::vector<UnmatchedEdge> odd_edges(const MendingMesh& mesh) {
    std::vector<UnmatchedEdge> out = unmatched_edges(mesh);
    std::erase_if(out, [](const UnmatchedEdge& e) { return !e.is_odd(); });
    return out;
}

std::vector<std::uint32_t> ends_of(std::span<const UnmatchedEdge> edges) {
    std::vector<std::uint32_t> out;
    out.reserve(2 * edges.size());
    for (const UnmatchedEdge& e : edges) {
        out.push_back(e.low);
        out.push_back(e.high);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

FacesAtVertices::FacesAtVertices(const MendingMesh& mesh, std::span<const std::uint32_t> vertices) {
    std::vector<std::uint32_t> place(mesh.points.size(), no_face);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        place[vertices[i]] = static_cast<std::uint32_t>(i);
    std::vector<std::array<std::uint32_t, 2>> uses;  // vertex, face
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (const std::uint32_t c : mesh.loop(f))
            if (place[c] != no_face) uses.push_back({place[c], f});
    std::sort(uses.begin(), uses.end());
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    begin_.assign(vertices.size() + 1, 0);
    for (const auto& [v, f] : uses) {
        ++begin_[std::size_t{v} + 1];
        faces_.push_back(f);
    }
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

bool have_common(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
        if (a[i] == b[k]) return true;
        ++(a[i] < b[k] ? i : k);
    }
    return false;
}

namespace {

double length_in_user_units(const MendingMesh& mesh, const UnmatchedEdge& e, Lattice lattice) {
    return lattice.to_double(
        length(minus(mesh.points[e.high].doubles(), mesh.points[e.low].doubles())));
}

std::vector<OpenBoundary> boundaries(const MendingMesh& mesh, Lattice lattice,
                                     std::span<const UnmatchedEdge> edges) {
    const std::vector<std::uint32_t> ends = ends_of(edges);
    const auto index = [&](std::uint32_t v) {
        return static_cast<std::uint32_t>(std::lower_bound(ends.begin(), ends.end(), v) -
                                          ends.begin());
    };
    DisjointSets sets;
    sets.start(ends.size());
    std::vector<std::uint32_t> degree(ends.size(), 0);
    for (const UnmatchedEdge& e : edges) {
        sets.join(index(e.low), index(e.high));
        ++degree[index(e.low)];
        ++degree[index(e.high)];
    }
    std::vector<std::uint32_t> number(ends.size(), no_face);
    std::vector<OpenBoundary> out;
    for (const UnmatchedEdge& e : edges) {
        const std::uint32_t root = sets.root(index(e.low));
        if (number[root] == no_face) {
            number[root] = static_cast<std::uint32_t>(out.size());
            out.push_back({0, 0, mesh.source_point[e.low], mesh.face_source[e.face],
                           to_user(mesh.points[e.low], lattice), true});
        }
        OpenBoundary& b = out[number[root]];
        ++b.edges;
        b.length += length_in_user_units(mesh, e, lattice);
    }
    for (std::uint32_t i = 0; i < ends.size(); ++i)
        if (degree[i] != 2) out[number[sets.root(i)]].is_loop = false;
    std::stable_sort(out.begin(), out.end(), [](const OpenBoundary& a, const OpenBoundary& b) {
        return a.length > b.length;
    });
    return out;
}

}  // namespace

void report_open(const MendingMesh& mesh, Lattice lattice, MendReport& report) {
    const std::vector<UnmatchedEdge> edges = unmatched_edges(mesh);
    std::vector<NetEdge> nets;
    nets.reserve(edges.size());
    for (const UnmatchedEdge& e : edges)
        nets.push_back(e.net > 0 ? NetEdge{e.low, e.high, e.net} : NetEdge{e.high, e.low, -e.net});
    const std::vector<bool> is_left = find_uncancelled(mesh.points, nets);
    std::vector<UnmatchedEdge> open;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (!is_left[i]) continue;
        if (edges[i].is_odd()) {
            open.push_back(edges[i]);
        } else {
            ++report.misoriented_edges;
        }
    }
    report.open = boundaries(mesh, lattice, open);
}

}  // namespace trisect::detail
