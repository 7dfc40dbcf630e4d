// SPDX-License-Identifier: Apache-2.0
//
// Indices and coordinates are differences to the one before: neighbours in a mesh are neighbours in
// its lists.
#include "mill_page.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "page_data.h"

namespace trisect::app {
namespace {

Bounds box_of(const std::vector<Point3d>& points) {
    if (points.empty()) return {};
    Bounds box{points.front(), points.front()};
    for (const Point3d& p : points)
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = std::min(box.lo[k], p[k]);
            box.hi[k] = std::max(box.hi[k], p[k]);
        }
    return box;
}

void add_film(PageData& data, Json& facts, const MillFilm& film) {
    const Bounds box = box_of(film.points());
    for (std::size_t k = 0; k < 3; ++k) {
        const double extent = std::max(box.hi[k] - box.lo[k], 1e-300);
        Differences coordinates;
        for (const Point3d& p : film.points())
            coordinates.add(std::lround((p[k] - box.lo[k]) / extent * 65535));
        constexpr std::array names{"x", "y", "z"};
        data.add(names.at(k), coordinates.bytes());
    }
    Differences corners;
    std::string births;
    std::string deaths;
    std::string cuts;
    for (const MillFilm::Triangle& t : film.triangles()) {
        for (const std::uint32_t c : t.corners) corners.add(c);
        births += static_cast<char>(t.birth);
        deaths += static_cast<char>(t.death);
        cuts += static_cast<char>(t.is_cut ? 1 : 0);
    }
    data.add("corners", corners.bytes());
    data.add("births", births);
    data.add("deaths", deaths);
    data.add("cuts", cuts);
    facts["box"] = {box.lo, box.hi};
    facts["points"] = film.points().size();
    facts["triangles"] = film.triangles().size();
    facts["frames"] = film.frames();
}

/// Corners of triangles, nine numbers each.
std::vector<float> soup_of(const PolygonMesh& mesh) {
    std::vector<float> out;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto c = mesh.face(f);
        for (std::size_t i = 1; i + 1 < c.size(); ++i)
            for (const std::uint32_t v : {c[0], c[i], c[i + 1]})
                for (const double x : mesh.points[v]) out.push_back(static_cast<float>(x));
    }
    return out;
}

PolygonMesh tool_mesh(const MillJob& job) {
    PolygonMesh out;
    for (const LatticeMesh& part : job.tool->hulls()) {
        PolygonMesh mesh;
        for (const LatticePoint& p : part.points)
            mesh.points.push_back(job.grid.to_user(p.doubles()));
        for (const auto& t : part.triangles) mesh.add_triangle(t[0], t[1], t[2]);
        append(out, mesh);
    }
    return out;
}

void add_bodies(PageData& data, const MillJob& job) {
    data.add_floats("tool", soup_of(tool_mesh(job)));
    data.add_floats("holder", soup_of(job.holder.solid.to_mesh()));
    PolygonMesh fixtures;
    for (const MillBody& f : job.fixtures) append(fixtures, f.solid.to_mesh());
    data.add_floats("fixtures", soup_of(fixtures));
}

/// Eight numbers a step: position, time, line, removed volume, orientation, whether it is rapid.
void add_steps(PageData& data, const MillJob& job, const MillRun& run) {
    std::vector<float> values;
    for (std::size_t i = 0; i < run.done(); ++i) {
        const MillStep& s = job.steps[i];
        for (const double c : job.grid.to_user(s.to)) values.push_back(static_cast<float>(c));
        values.push_back(static_cast<float>(s.end_time));
        values.push_back(static_cast<float>(s.line));
        values.push_back(static_cast<float>(run.records()[i].removed));
        values.push_back(static_cast<float>(s.orientation));
        values.push_back(s.is_rapid ? 1.0F : 0.0F);
    }
    data.add_floats("steps", values);
}

}  // namespace

std::string page_text(const MillJob& job, const MillRun& run, const MillFilm& film) {
    PageData data;
    Json facts;
    add_film(data, facts, film);
    add_bodies(data, job);
    add_steps(data, job, run);
    facts["path"] = job.path.file;
    facts["step_count"] = job.steps.size();
    facts["orientations"] = job.path.orientations;
    facts["collisions"] = run.collisions();
    facts["stock_volume"] = job.stock_volume;
    facts["places"] = data.places();
    return mill_page_before_facts + script_text(facts) + mill_page_before_data + data.in_base64() +
           mill_page_end;
}

}  // namespace trisect::app
