// SPDX-License-Identifier: Apache-2.0
#include "view_page.h"

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/kernel/plane.h>

#include <fmt/format.h>

#include <cstdint>

#include "page_data.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr const char* head = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Solid</title>
<style>
:root { color-scheme: light dark; --back: #eef1f5; --panel: #fffffff0; --ink: #1d2733; --line: #cfd6df; }
@media (prefers-color-scheme: dark) {
  :root { --back: #20262e; --panel: #2b333df0; --ink: #e8edf3; --line: #46505c; }
}
html, body { margin: 0; height: 100%; overflow: hidden; background: var(--back); color: var(--ink);
  font: 14px/1.45 system-ui, sans-serif; }
#view { position: absolute; inset: 0; width: 100%; height: 100%; display: block; cursor: grab;
  touch-action: none; }
#panel { position: absolute; top: 10px; left: 10px; width: min(320px, 80vw); max-height: 94%;
  overflow: auto; background: var(--panel); border: 1px solid var(--line); border-radius: 6px;
  padding: 10px 14px; box-sizing: border-box; }
#panel h1 { font-size: 16px; margin: 0 0 2px; overflow-wrap: anywhere; }
#panel ul { list-style: none; padding: 0; margin: 8px 0; }
#panel li { overflow-wrap: anywhere; }
#panel li i { display: inline-block; width: 12px; height: 12px; margin-right: 7px;
  border-radius: 3px; border: 1px solid #0005; vertical-align: -1px; }
#panel label { display: flex; gap: 8px; align-items: center; margin: 3px 0; }
#panel input[type=range] { flex: 1; min-width: 0; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; margin: 8px 0 0; font: 12px/1.4 ui-monospace,
  monospace; }
#item { position: absolute; bottom: 10px; left: 10px; background: var(--panel); padding: 2px 8px;
  border-radius: 4px; }
#item:empty, pre:empty { display: none; }
details { margin-top: 8px; }
</style>
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
constexpr const char* end = "</script>\n</body>\n</html>\n";

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

std::string hexadecimal(const Plane::Coefficient& value) {
    const Plane::Coefficient size = value.abs();
    std::string digits;
    for (int i = 5; i >= 0; --i) digits += fmt::format("{:016x}", size.limb(i));
    return (value.is_negative() ? "-" : "") + digits;
}

/// Normal and offset of n·x + d = 0 in lattice units, for faces that have no exact corners.
Json planes_of(const Brep& brep) {
    Json out = Json::object();
    for (const FaceId f : brep.faces()) {
        if (has_exact_corners(brep, f)) continue;
        const Plane& p = brep.plane(f);
        out[std::to_string(f.index)] = {hexadecimal(p.normal(0)), hexadecimal(p.normal(1)),
                                        hexadecimal(p.normal(2)), hexadecimal(p.offset())};
    }
    return out;
}

void add_points(PageData& data, const std::string& name, const std::vector<Point3d>& points) {
    std::vector<double> all;
    all.reserve(3 * points.size());
    for (const Point3d& p : points) all.insert(all.end(), p.begin(), p.end());
    data.add_doubles(name, all);
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
        add_points(data, fmt::format("points{}", i), mesh.points);
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
    add_points(data, "points", mesh.points);
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
    return head + script_text(facts) + before_data + data.in_base64() + before_program +
           viewer_program() + end;
}

}  // namespace trisect::app
