// SPDX-License-Identifier: Apache-2.0
#include "page_scene.h"

#include <fmt/format.h>

#include <filesystem>

#include "page_style.h"
#include "view_page.h"

namespace trisect::app {
namespace {

constexpr const char* scene_body = R"html(</style>
</head>
<body>
<canvas id="view" tabindex="0" role="img" aria-label="the solids; arrow keys turn them"></canvas>
<div id="panel"></div>
<div id="bar"></div>
<div id="item" aria-live="polite"></div>
<pre id="answer" hidden></pre>
<noscript>This page needs JavaScript and WebGL.</noscript>
<script id="facts" type="application/json">)html";

void add_shape(PageData& data, const PageShape& shape, std::size_t number) {
    data.add_points(fmt::format("points{}", number), shape.mesh.points);
    data.add_integers(fmt::format("triangles{}", number), shape.mesh.corners);
    data.add_integers(fmt::format("faces{}", number), shape.face);
    Differences ends;
    for (const auto& e : shape.edges)
        for (const std::uint32_t v : e) ends.add(v);
    data.add(fmt::format("edges{}", number), ends.bytes());
    data.add_integers(fmt::format("source{}", number), shape.source);
}

Json body_json(const PageBody& body) {
    constexpr std::array looks{"solid", "clear", "hidden"};
    Json out;
    out["name"] = body.name;
    out["shape"] = body.shape;
    out["color"] = body.color;
    if (body.pose != identity_pose) out["pose"] = body.pose;
    out["look"] = looks.at(static_cast<std::size_t>(body.look));
    return out;
}

Json finding_json(const PageFinding& finding) {
    constexpr std::array kinds{"error", "warning", "note"};
    Json out;
    out["title"] = finding.title;
    out["text"] = finding.text;
    out["kind"] = kinds.at(static_cast<std::size_t>(finding.kind));
    if (!finding.points.empty()) out["points"] = finding.points;
    if (!finding.segments.empty()) out["segments"] = finding.segments;
    if (!finding.loops.empty()) out["loops"] = finding.loops;
    if (!finding.faces.empty()) out["faces"] = finding.faces;
    if (!finding.bodies.empty()) out["bodies"] = finding.bodies;
    if (finding.frame) out["frame"] = *finding.frame;
    return out;
}

void add_timeline(PageData& data, Json& facts, const PageTimeline& timeline) {
    std::vector<double> all;
    for (const PosePlace& pose : timeline.poses) all.insert(all.end(), pose.begin(), pose.end());
    data.add_doubles("poses", all);
    facts["timeline"] = {{"unit", timeline.unit},
                         {"times", timeline.times},
                         {"bodies", timeline.bodies},
                         {"contact", timeline.contact ? Json(*timeline.contact) : Json()}};
}

}  // namespace

std::string page_text(const PageScene& scene, PageData data, const Json& more) {
    Json facts = more;
    facts["page"] = scene.kind;
    facts["title"] = scene.title;
    facts["summary"] = scene.summary;
    facts["shapes"] = scene.shapes.size();
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) add_shape(data, scene.shapes[i], i);
    facts["bodies"] = Json::array();
    for (const PageBody& body : scene.bodies) facts["bodies"].push_back(body_json(body));
    facts["findings"] = Json::array();
    for (const PageFinding& f : scene.findings) facts["findings"].push_back(finding_json(f));
    facts["more_findings"] = scene.more_findings;
    if (scene.timeline) add_timeline(data, facts, *scene.timeline);
    facts["places"] = data.places();
    return page_start + std::string(page_style) + scene_body + script_text(facts) +
           "</script>\n<script id=\"data\" type=\"text/plain\">" + data.in_base64() +
           "</script>\n<script>" + viewer_program() + "</script>\n</body>\n</html>\n";
}

std::string short_name(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

}  // namespace trisect::app
