// SPDX-License-Identifier: Apache-2.0
#include "interfere_page.h"

#include <fmt/format.h>

#include <utility>

#include "page_entities.h"
#include "values.h"

namespace trisect::app {
namespace {

const char* region_title(const ContactRegion& region) {
    if (region.dimension == 0) return "point";
    if (region.dimension == 1) return "segment";
    return region.opposite ? "area, face to face" : "area, on one side";
}

PageFinding region_finding(const ContactRegion& region, const std::array<PlacedBody, 2>& bodies) {
    PageFinding out;
    out.title = region_title(region);
    out.kind = region.dimension == 2 ? PageFinding::Kind::Note : PageFinding::Kind::Error;
    const std::array entities{region.a, region.b};
    for (std::size_t i = 0; i < 2; ++i) {
        const Brep& brep = bodies.at(i).model.brep();
        if (i != 0) out.text += ", ";
        out.text += entity_words(entities.at(i), brep, bodies.at(i).name);
        if (entities.at(i).is_face()) out.faces.emplace_back(i, entities.at(i).index());
    }
    for (const auto& loop : region.loops) {
        std::vector<Point3d> points;
        for (const ContactPoint& p : loop) points.push_back(p.nearest);
        if (region.dimension == 0)
            out.points.push_back(points.at(0));
        else if (region.dimension == 1)
            out.segments.push_back({points.at(0), points.at(1)});
        else
            out.loops.push_back(std::move(points));
    }
    return out;
}

std::string counts_of(const InterferenceResult& result) {
    std::array<std::size_t, 3> regions{};
    for (const ContactRegion& r : result.regions) ++regions.at(r.dimension);
    return fmt::format("{} contacts; {} areas, {} segments, {} points", result.contacts.size(),
                       regions[2], regions[1], regions[0]);
}

PageFinding distance_finding(const BoundaryDistance& distance,
                             const std::array<PlacedBody, 2>& bodies) {
    PageFinding out;
    out.title = fmt::format("distance {:.9g}", distance.upper);
    out.text = fmt::format("from {} to {}: {}, {}", number_text(distance.lower),
                           number_text(distance.upper),
                           entity_words(distance.a, bodies[0].model.brep(), bodies[0].name),
                           entity_words(distance.b, bodies[1].model.brep(), bodies[1].name));
    out.points = {distance.on_a, distance.on_b};
    out.segments = {{distance.on_a, distance.on_b}};
    if (distance.a.is_face()) out.faces.emplace_back(0, distance.a.index());
    if (distance.b.is_face()) out.faces.emplace_back(1, distance.b.index());
    return out;
}

}  // namespace

PageScene scene_of(const std::array<PlacedBody, 2>& bodies) {
    PageScene out;
    for (std::size_t i = 0; i < 2; ++i) {
        out.shapes.push_back(shape_of(bodies.at(i).model.brep()));
        PageBody body;
        body.name = bodies.at(i).name;
        body.shape = i;
        body.color = i;
        body.pose = bodies.at(i).pose;
        out.bodies.push_back(std::move(body));
    }
    return out;
}

std::string interfere_page(const std::array<PlacedBody, 2>& bodies,
                           const InterferenceResult& result,
                           const std::optional<BoundaryDistance>& distance) {
    PageScene scene = scene_of(bodies);
    scene.title = fmt::format("{} and {}", bodies[0].name, bodies[1].name);
    scene.summary = {to_string(result.relation), counts_of(result)};
    // What meets is within, or between: it is seen through both.
    if (result.relation != Relation::Disjoint)
        for (PageBody& body : scene.bodies) body.look = PageBody::Look::Clear;
    if (distance) scene.findings.push_back(distance_finding(*distance, bodies));
    for (const ContactRegion& region : result.regions) {
        if (scene.findings.size() < most_page_findings)
            scene.findings.push_back(region_finding(region, bodies));
        else
            ++scene.more_findings;
    }
    return page_text(scene);
}

}  // namespace trisect::app
