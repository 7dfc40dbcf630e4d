// SPDX-License-Identifier: Apache-2.0
//
// An imported mesh is all triangles; what the user counts are polygons. A polygon of n corners is
// n-2 triangles and n-3 diagonals, so each triangle beyond one per polygon stands for one edge that
// is not there: edges = (edges of the triangles) - (triangles - polygons).
#include "description.h"

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/validate/manifold_counts.h>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "report_json.h"
#include "values.h"

namespace trisect::app {
namespace {

std::ptrdiff_t total_genus(const Brep& brep) {
    std::ptrdiff_t genus = 0;
    for (const ShellId shell : brep.shells()) genus += brep.genus(shell);
    return genus;
}

std::size_t polygon_count(const LatticeMesh& mesh) {
    if (mesh.face_of_triangle.empty()) return mesh.triangles.size();
    std::vector<std::uint32_t> faces = mesh.face_of_triangle;
    std::sort(faces.begin(), faces.end());
    return static_cast<std::size_t>(std::unique(faces.begin(), faces.end()) - faces.begin());
}

/// Vertices, edges and connected parts of triangles that need not be closed.
class OpenCounter {
public:
    explicit OpenCounter(const LatticeMesh& mesh) : mesh_(mesh) { collect_edges(); }

    void count(Description& out) {
        out.vertices = mesh_.points.size();
        std::vector<std::uint32_t> parent(mesh_.triangles.size());
        std::iota(parent.begin(), parent.end(), 0U);
        std::size_t parts = parent.size();
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            if (i == 0 || sides_[i].ends != sides_[i - 1].ends) {
                ++out.edges;
                continue;
            }
            const std::uint32_t a = root(parent, sides_[i].triangle);
            const std::uint32_t b = root(parent, sides_[i - 1].triangle);
            if (a == b) continue;
            parent[a] = b;
            --parts;
        }
        out.shells = parts;
    }

private:
    struct Side {
        std::pair<std::uint32_t, std::uint32_t> ends;
        std::uint32_t triangle;
        auto operator<=>(const Side&) const = default;
    };

    void collect_edges() {
        sides_.reserve(3 * mesh_.triangles.size());
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto& c = mesh_.triangles[t];
            for (std::size_t i = 0; i < 3; ++i) {
                sides_.push_back({std::minmax({c[i], c[(i + 1) % 3]}), t});
            }
        }
        std::sort(sides_.begin(), sides_.end());
    }

    static std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t t) {
        while (parent[t] != t) t = parent[t] = parent[parent[t]];
        return t;
    }

    const LatticeMesh& mesh_;
    std::vector<Side> sides_;
};

void count_closed(const Brep& brep, Description& out) {
    const BrepCounts counts = brep.counts();
    out.vertices = counts.vertices;
    out.edges = counts.edges;
    out.shells = counts.shells;
    out.genus = total_genus(brep);
}

/// False where the boundary closes only as a set: T-vertices.
bool count_as_brep(const ImportedMesh& imported, Description& out) {
    if (!imported.report.closed || imported.report.t_edges != 0) return false;
    try {
        count_closed(brep_from_lattice_mesh(imported.mesh), out);
        return true;
    } catch (const Error& e) {
        if (e.code() != ErrorCode::InvalidSolid) throw;
        return false;
    }
}

/// Of triangles that touch each other, with the vertices and edges there as often as in the B-rep
/// of the same set: each edge has two triangles, and Euler's formula gives the vertices.
ManifoldCounts counts_of_copies(std::size_t triangles, const Brep& brep) {
    ManifoldCounts out;
    out.shells = brep.counts().shells;
    out.genus = total_genus(brep);
    out.edges = 3 * triangles / 2;
    const std::ptrdiff_t euler = 2 * (static_cast<std::ptrdiff_t>(out.shells) - out.genus);
    out.vertices = static_cast<std::size_t>(euler + static_cast<std::ptrdiff_t>(triangles / 2));
    return out;
}

template <class Boundary>
void measure(const Boundary& boundary, DescriptionOptions options, Description& out) {
    if (options.measures) {
        out.area = area(boundary).value;
        out.bounds = bounds(boundary);
    }
    if (!out.closed) return;
    out.volume = volume(boundary);
    if (options.exact) out.volume_exact = exact_volume(boundary);
}

Json bounds_json(const std::optional<Bounds>& bounds) {
    if (!bounds) return {};
    Json out;
    out["lower"] = bounds->lo;
    out["upper"] = bounds->hi;
    return out;
}

template <class Value>
Json optional_json(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}

template <class Value>
std::string line(std::string_view name, const Value& value) {
    return fmt::format("{:<11}{}\n", name, value);
}

std::string lattice_text(const LatticeReport& lattice) {
    if (lattice.lossless) return fmt::format("unit 2^{}, lossless", lattice.lattice.exponent);
    return fmt::format("unit 2^{}, {} vertices moved by at most {}", lattice.lattice.exponent,
                       lattice.moved, number_text(lattice.max_move));
}

}  // namespace

Description describe(const ImportedMesh& imported, DescriptionOptions options) {
    Description out;
    out.closed = imported.report.closed;
    out.lattice = imported.report.lattice;
    out.triangles = imported.mesh.triangles.size();
    out.faces = polygon_count(imported.mesh);
    if (!count_as_brep(imported, out)) OpenCounter(imported.mesh).count(out);
    out.edges -= std::min(out.edges, out.triangles - out.faces);
    measure(imported.mesh, options, out);
    return out;
}

Description describe(const Brep& brep, DescriptionOptions options) {
    Description out;
    count_closed(brep, out);
    const BrepCounts counts = brep.counts();
    out.faces = counts.faces;
    // A face of n corners and h holes fills with n + 2h - 2 triangles.
    out.triangles = counts.halfedges + 2 * (counts.loops - counts.faces) - 2 * counts.faces;
    out.closed = true;
    out.lattice.lattice = brep.lattice();
    measure(brep, options, out);
    return out;
}

Description describe(const ExactMesh& mesh, const std::function<Brep()>& boundary,
                     DescriptionOptions options) {
    auto counts = manifold_counts(mesh.points.size(), mesh.triangles);
    if (!counts) counts = counts_of_copies(mesh.triangles.size(), boundary());
    Description out;
    out.vertices = counts->vertices;
    out.edges = counts->edges;
    out.shells = counts->shells;
    out.genus = counts->genus;
    out.triangles = mesh.triangles.size();
    out.faces = mesh.triangles.size();
    out.closed = true;
    out.lattice.lattice = mesh.lattice;
    measure(mesh, options, out);
    return out;
}

Json to_json(const Description& d) {
    Json out;
    out["vertices"] = d.vertices;
    out["edges"] = d.edges;
    out["faces"] = d.faces;
    out["triangles"] = d.triangles;
    out["shells"] = d.shells;
    out["genus"] = optional_json(d.genus);
    out["closed"] = d.closed;
    out["volume"] = optional_json(d.volume);
    if (d.volume_exact) out["volume_exact"] = d.volume_exact->to_string();
    out["area"] = d.area;
    out["bounds"] = bounds_json(d.bounds);
    out["lattice"] = lattice_json(d.lattice);
    return out;
}

std::string to_text(const Description& d) {
    std::string out;
    out += line("vertices", d.vertices);
    out += line("edges", d.edges);
    out += line("faces", d.faces);
    out += line("triangles", d.triangles);
    out += line("shells", d.shells);
    out += line("genus", d.genus ? fmt::format("{}", *d.genus) : "-");
    out += line("closed", d.closed ? "yes" : "no");
    out += line("volume", d.volume ? number_text(*d.volume) : "-");
    if (d.volume_exact) out += line("", d.volume_exact->to_string());
    out += line("area", number_text(d.area));
    if (d.bounds) {
        out += line("bounds", place_text(d.bounds->lo) + " to " + place_text(d.bounds->hi));
    }
    out += line("lattice", lattice_text(d.lattice));
    return out;
}

}  // namespace trisect::app
