// SPDX-License-Identifier: Apache-2.0
#include "page_entities.h"

#include <fmt/format.h>

#include "output_name.h"

namespace trisect::app {
namespace {

Point3d place_of(const Brep& brep, VertexId v, const PosePlace& pose) {
    const std::array<double, 3> p = brep.point(v).nearest();
    Point3d user{};
    for (std::size_t k = 0; k < 3; ++k) user[k] = brep.lattice().to_double(p[k]);
    return placed_point(pose, user);
}

}  // namespace

void add_page_option(CLI::App& command, std::string& page) {
    command.add_option("--page", page, "a page (HTML) that shows it in a browser")
        ->type_name("FILE");
}

void check_page_name(const Session& session, const std::string& page) {
    if (page == "-") throw UsageError("--page: the answer goes to the standard output");
    check_output_name(session, page, ".html");
}

Point3d placed_point(const PosePlace& pose, const Point3d& point) {
    Point3d out{};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = pose[4 * i] * point[0] + pose[4 * i + 1] * point[1] + pose[4 * i + 2] * point[2] +
                 pose[4 * i + 3];
    return out;
}

std::string entity_words(const BoundaryEntity& entity, const Brep& brep, const std::string& body) {
    if (entity.is_vertex()) return fmt::format("vertex {} of {}", entity.index(), body);
    if (entity.is_edge()) return fmt::format("edge {} of {}", entity.index(), body);
    return fmt::format("face {} of {} (face {} of its file)", entity.index(), body,
                       brep.source(entity.face()).face);
}

void mark_entity(PageFinding& finding, std::size_t body, const BoundaryEntity& entity,
                 const Brep& brep, const PosePlace& pose) {
    if (entity.is_vertex()) {
        finding.points.push_back(place_of(brep, entity.vertex(), pose));
    } else if (entity.is_edge()) {
        const HalfedgeId h = brep.halfedge(entity.edge());
        finding.segments.push_back(
            {place_of(brep, brep.origin(h), pose), place_of(brep, brep.target(h), pose)});
    } else {
        finding.faces.emplace_back(body, entity.index());
    }
}

}  // namespace trisect::app
