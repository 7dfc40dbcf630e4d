// SPDX-License-Identifier: Apache-2.0
#include "view_page.h"

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/kernel/plane.h>

#include <fmt/format.h>

#include <cstdint>

#include "page_data.h"
#include "page_plane.h"
#include "page_style.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr const char* view_body = R"html(</style>
</head>
<body>
<canvas id="view" tabindex="0" aria-label="the solid"></canvas>
<div id="panel">
<h1 id="name"></h1>
<div id="counts"></div>
<ul id="legend"></ul>
<label><input type="checkbox" id="edges" checked> edges</label>
<label><input type="checkbox" id="ghosts"> inputs</label>
<label>section <select id="axis">
<option value="-1">none</option><option value="0">x</option><option value="1">y</option>
<option value="2">z</option></select>
<input type="range" id="level" min="0" max="1000" value="500" disabled
aria-label="where the section is"></label>
<label>apart <input type="range" id="explode" min="0" max="2" step="0.01" value="0"
aria-label="how far parts are moved apart"></label>
<pre id="section"></pre>
<pre id="picked" aria-live="polite"></pre>
<pre id="distance" aria-live="polite"></pre>
<details><summary>keys</summary>
click: what a vertex, an edge or a face is, exactly; two of them: their distance.
Drag: turn; wheel: nearer; right button: move. E edges, G inputs, S section, [ and ] move it,
R from the front, Escape forget.</details>
</div>
<div id="item"></div>
<pre id="answer" hidden></pre>
<script id="facts" type="application/json">)html";

constexpr const char* before_data = "</script>\n<script id=\"data\" type=\"text/plain\">";
constexpr const char* before_program = "</script>\n<script>";
constexpr const char* page_end = "</script>\n</body>\n</html>\n";

/// Three corners that are lattice points and not on a line: their doubles give the plane.
bool has_exact_corners(const Brep& brep, FaceId f) {
    std::vector<LatticePoint> corners;
    for (const HalfedgeId h : brep.halfedges(f)) {
        const Point& p = brep.point(brep.origin(h));
        if (!p.is_lattice()) continue;
        if (corners.size() < 2) {
            if (corners.empty() || corners[0] != p.lattice()) corners.push_back(p.lattice());
        } else if (!are_collinear(corners[0], corners[1], p.lattice())) {
            return true;
        }
    }
    return false;
}

/// Normal and offset of n·x + d = 0 in lattice units, for faces that have no exact corners.
Json planes_of(const Brep& brep) {
    Json out = Json::object();
    for (const FaceId f : brep.faces()) {
        if (has_exact_corners(brep, f)) continue;
        out[std::to_string(f.index)] = plane_json(brep.plane(f));
    }
    return out;
}

/// The triangles of each face, and where those of the next one begin.
void add_triangles(PageData& data, const PolygonMesh& mesh, const MeshMap& map, std::size_t faces) {
    Differences corners;
    std::vector<std::uint32_t> counts(faces);
    for (std::size_t t = 0; t < mesh.face_count(); ++t) {
        for (const std::uint32_t v : mesh.face(t)) corners.add(v);
        ++counts[map.face[t].index];
    }
    Differences first;
    std::int64_t at = 0;
    first.add(at);
    for (const std::uint32_t n : counts) first.add(at += n);
    data.add("triangles", corners.bytes());
    data.add("first", first.bytes());
}

void add_edges(PageData& data, const Brep& brep) {
    Differences ends;
    for (const EdgeId e : brep.edges()) {
        const HalfedgeId h = brep.halfedge(e);
        ends.add(brep.origin(h).index);
        ends.add(brep.target(h).index);
    }
    data.add("edges", ends.bytes());
}

void add_sources(PageData& data, const ViewedSolid& solid) {
    Differences operands;
    Differences faces;
    for (const FaceId f : solid.brep.faces()) {
        const auto& operand = solid.operand_of[f.index];
        operands.add(static_cast<std::int64_t>(operand.value_or(solid.operands.size())));
        faces.add(solid.brep.source(f).face);
    }
    data.add("operand", operands.bytes());
    data.add("source", faces.bytes());
}

void add_inputs(PageData& data, const std::vector<PolygonMesh>& inputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const PolygonMesh& mesh = inputs[i];
        data.add_points(fmt::format("points{}", i), mesh.points);
        Differences corners;
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            const auto c = mesh.face(f);
            for (std::size_t k = 1; k + 1 < c.size(); ++k)
                for (const std::uint32_t v : {c[0], c[k], c[k + 1]}) corners.add(v);
        }
        data.add(fmt::format("triangles{}", i), corners.bytes());
    }
}

}  // namespace

std::string page_text(const ViewedSolid& solid) {
    const Brep& brep = solid.brep;
    MeshMap map;
    const PolygonMesh mesh = to_polygon_mesh(brep, {}, &map);
    PageData data;
    data.add_points("points", mesh.points);
    std::string exact;
    for (const VertexId v : brep.vertices()) exact += brep.point(v).is_lattice() ? '\1' : '\0';
    data.add("exact", exact);
    add_triangles(data, mesh, map, brep.faces().size());
    add_edges(data, brep);
    add_sources(data, solid);
    add_inputs(data, solid.inputs);
    Json facts;
    facts["title"] = solid.title;
    facts["operands"] = solid.operands;
    facts["volume"] = number_text(volume(brep));
    facts["unit"] = brep.lattice().exponent;
    facts["planes"] = planes_of(brep);
    facts["inputs"] = solid.inputs.size();
    facts["places"] = data.places();
    return page_start + std::string(page_style) + view_body + script_text(facts) + before_data +
           data.in_base64() + before_program + viewer_program() + page_end;
}

}  // namespace trisect::app
