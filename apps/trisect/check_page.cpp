// SPDX-License-Identifier: Apache-2.0
#include "check_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "values.h"

namespace trisect::app {
namespace {

std::string words_of(std::string_view name) {
    std::string out(name);
    std::ranges::replace(out, '_', ' ');
    return out;
}

PageFinding defect_finding(const Defect& defect, std::size_t body, const PolygonMesh& mesh) {
    PageFinding out;
    out.title = words_of(name_of(defect.kind));
    out.text = defect.sentence;
    out.kind = defect.severity() == Severity::Error ? PageFinding::Kind::Error
                                                    : PageFinding::Kind::Warning;
    std::vector<Point3d> corners;
    for (const std::uint32_t v : defect.vertices)
        if (v < mesh.points.size()) corners.push_back(mesh.points[v]);
    if (corners.size() == 2)
        out.segments.push_back({corners[0], corners[1]});
    else
        out.points = corners;
    if (out.points.empty() && out.segments.empty()) out.points.push_back(defect.place);
    for (const std::uint32_t f : defect.faces) out.faces.emplace_back(body, f);
    return out;
}

void add_defects(PageScene& scene, const ValidationReport& report, std::size_t body) {
    const PolygonMesh& mesh = scene.shapes[scene.bodies[body].shape].mesh;
    for (const Defect& defect : report.defects()) {
        if (scene.findings.size() < most_page_findings)
            scene.findings.push_back(defect_finding(defect, body, mesh));
        else
            ++scene.more_findings;
    }
    const std::size_t all = report.count(Severity::Error) + report.count(Severity::Warning);
    scene.more_findings += all - report.defects().size();
}

PageBody body_of(std::string name, std::size_t number, PageBody::Look look) {
    PageBody out;
    out.name = std::move(name);
    out.shape = number;
    out.color = number;
    out.look = look;
    return out;
}

PageFinding witness_point(const Witness& witness, const std::vector<std::string>& names) {
    PageFinding out;
    out.title = "witness";
    out.kind = PageFinding::Kind::Error;
    Point3d point{};
    for (std::size_t k = 0; k < 3; ++k) point[k] = witness.point[k].to_double();
    out.points.push_back(point);
    out.text = fmt::format("about ({}, {}, {}): {} the exact set, {} the result",
                           number_text(point[0]), number_text(point[1]), number_text(point[2]),
                           witness.in_exact ? "in" : "not in", witness.in_result ? "in" : "not in");
    for (std::size_t i = 0; i < names.size(); ++i)
        out.text += fmt::format("; winding number {} of {}", witness.winding[i], names[i]);
    for (const BlamedFace& f : witness.faces) out.faces.emplace_back(f.mesh, f.face);
    return out;
}

}  // namespace

std::string check_page(const std::string& name, PageShape shape, const ValidationReport& report,
                       std::vector<std::string> remarks) {
    PageScene scene;
    scene.title = name;
    scene.shapes.push_back(std::move(shape));
    scene.bodies.push_back(
        body_of(name, 0, report.empty() ? PageBody::Look::Solid : PageBody::Look::Clear));
    scene.summary.push_back(
        fmt::format("{}; {} errors, {} warnings", report.is_solid() ? "a solid" : "not a solid",
                    report.count(Severity::Error), report.count(Severity::Warning)));
    for (std::string& r : remarks) scene.summary.push_back(std::move(r));
    add_defects(scene, report, 0);
    return page_text(scene);
}

std::string verify_page(const std::string& title, const std::vector<std::string>& names,
                        const std::vector<PolygonMesh>& meshes, const VerifyReport& report,
                        std::vector<std::string> summary) {
    PageScene scene;
    scene.title = title;
    scene.summary = std::move(summary);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const bool is_result = i + 1 == meshes.size();
        scene.shapes.push_back(shape_of(meshes[i]));
        scene.bodies.push_back(
            body_of(names[i], i, is_result ? PageBody::Look::Solid : PageBody::Look::Hidden));
    }
    if (report.witness) {
        scene.bodies.back().look = PageBody::Look::Clear;
        scene.findings.push_back(witness_point(*report.witness, names));
    }
    if (report.verdict == Verdict::NotClosed)
        add_defects(scene, report.result_defects, meshes.size() - 1);
    return page_text(scene);
}

}  // namespace trisect::app
