// SPDX-License-Identifier: Apache-2.0
//
// Entities are read once: points and edges have numbers by their places in the file. Faces are read
// as often as shells have them; an unshared corner takes at least three bytes of the file, so a
// file whose faces have more corners than it has bytes shares them without end, and is refused.
#include <trisect/brep/io/models/step/shapes.h>

#include <trisect/brep/io/models/step/loops.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace trisect::detail {
namespace {

constexpr std::array<std::string_view, 5> shape_keywords{
    "MANIFOLD_SOLID_BREP", "FACETED_BREP", "BREP_WITH_VOIDS", "SHELL_BASED_SURFACE_MODEL",
    "FACE_BASED_SURFACE_MODEL"};

bool has_keyword(const StepEntity& entity, std::initializer_list<std::string_view> keywords) {
    return std::any_of(keywords.begin(), keywords.end(),
                       [&](std::string_view k) { return entity.is(k); });
}

double scalar_product(const Point3d& a, const Point3d& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Ends of a mesh's faces, as numbers of the whole file; references that occur twice are refused.
void require_different(const StepText& text, const StepEntity& entity,
                       const std::vector<StepValue>& references) {
    std::vector<std::uint64_t> ids;
    for (const StepValue& v : references) {
        if (v.kind != StepKind::Reference) text.fail(entity, "a list of references expected");
        ids.push_back(v.id);
    }
    std::sort(ids.begin(), ids.end());
    const auto twice = std::adjacent_find(ids.begin(), ids.end());
    if (twice != ids.end()) text.fail(entity, "has #" + std::to_string(*twice) + " twice");
}

}  // namespace

StepShapes::StepShapes(const StepText& text, ModelReport& report)
    : text_(text),
      report_(report),
      corners_left_(text.source().bytes().size()),
      known_(text.entity_count(), 0) {}

bool StepShapes::is_shape(std::string_view keyword) {
    return std::find(shape_keywords.begin(), shape_keywords.end(), keyword) != shape_keywords.end();
}

StepShapes::Shells StepShapes::shells(const StepEntity& shape) const {
    // A complex entity has the values of each keyword apart; a simple one all, the name first.
    const bool is_complex = shape.parts.size() > 1;
    const std::size_t first = is_complex ? 0 : 1;
    Shells out;
    const auto add_list = [&](const StepPart& part, std::size_t index) {
        const auto& list = text_.value(shape, part, index, StepKind::List).items;
        require_different(text_, shape, list);
        for (const StepValue& v : list) out.ids.push_back(text_.entity(v.id, v.at).id);
    };
    const StepPart* solid = nullptr;
    for (const char* keyword : {"FACETED_BREP", "BREP_WITH_VOIDS", "MANIFOLD_SOLID_BREP"})
        if (const StepPart* p = shape.part(keyword)) solid = p;
    out.is_solid = solid != nullptr;
    if (out.is_solid) {
        out.ids.push_back(text_.referred(shape, *solid, first).id);
        if (const StepPart* voids = shape.part("BREP_WITH_VOIDS"))
            add_list(*voids, is_complex ? 0 : 2);
        return out;
    }
    for (const char* keyword : {"SHELL_BASED_SURFACE_MODEL", "FACE_BASED_SURFACE_MODEL"})
        if (const StepPart* model = shape.part(keyword)) add_list(*model, first);
    return out;
}

PolygonMesh StepShapes::read(const StepEntity& shape, double uncertainty) {
    uncertainty_ = uncertainty;
    mesh_ = PolygonMesh();
    for (const std::uint64_t id : shells(shape).ids) add_shell(text_.entity(id, shape.at), true);
    for (const std::uint32_t p : touched_) local_[p] = 0;
    touched_.clear();
    return std::move(mesh_);
}

void StepShapes::add_shell(const StepEntity& shell, bool forward) {
    if (has_keyword(shell, {"ORIENTED_CLOSED_SHELL", "ORIENTED_OPEN_SHELL"})) {
        const StepPart& part = shell.parts.front();
        const StepEntity inner = text_.referred(shell, part, 2);
        if (has_keyword(inner, {"ORIENTED_CLOSED_SHELL", "ORIENTED_OPEN_SHELL"}))
            text_.fail(shell, "refers to " + shown_entity(inner) + ", which is oriented, too");
        return add_shell(inner, forward == text_.flag(shell, part, 3));
    }
    if (!has_keyword(shell, {"CLOSED_SHELL", "OPEN_SHELL", "CONNECTED_FACE_SET"}))
        text_.refuse(shell, "is not read as a shell");
    const auto& faces = text_.value(shell, shell.parts.front(), 1, StepKind::List).items;
    require_different(text_, shell, faces);
    for (const StepValue& v : faces) {
        check_stop();
        add_face(text_.entity(v.id, v.at), forward);
    }
}

void StepShapes::add_face(const StepEntity& face, bool forward) {
    const StepPart& part = face.parts.front();
    if (face.is("ORIENTED_FACE")) {
        const StepEntity inner = text_.referred(face, part, 2);
        if (inner.is("ORIENTED_FACE"))
            text_.fail(face, "refers to " + shown_entity(inner) + ", which is oriented, too");
        return add_face(inner, forward == text_.flag(face, part, 3));
    }
    const bool has_surface = has_keyword(face, {"ADVANCED_FACE", "FACE_SURFACE"});
    if (!has_surface && !face.is("FACE")) text_.refuse(face, "is not read as a face");
    StatedPlane plane;
    if (has_surface) plane = plane_of(face, forward);
    const auto& bounds = text_.value(face, part, 1, StepKind::List).items;
    if (bounds.empty()) text_.fail(face, "has no bounds");
    require_different(text_, face, bounds);
    std::vector<IndexLoop> loops;
    for (const StepValue& v : bounds)
        loops.push_back(bound_loop(text_.entity(v.id, v.at), forward));
    if (has_surface) check_plane(face, plane, loops);
    add_polygons(face, loops);
}

StepShapes::StatedPlane StepShapes::plane_of(const StepEntity& face, bool forward) const {
    const StepPart& part = face.parts.front();
    const StepEntity surface = text_.referred(face, part, 2);
    if (!surface.is("PLANE"))
        text_.refuse(surface, "faces are read where they are planar; this is the surface of " +
                                  shown_entity(face));
    const StepEntity placement = text_.referred(surface, surface.parts.front(), 1);
    if (!placement.is("AXIS2_PLACEMENT_3D"))
        text_.refuse(placement, "is not read as the place of a plane");
    const StepPart& frame = placement.parts.front();
    StatedPlane out;
    out.location = triple(text_.referred(placement, frame, 1), "CARTESIAN_POINT");
    out.normal = {0, 0, 1};
    if (frame.values.size() > 2 && frame.values[2].kind != StepKind::Omitted)
        out.normal = triple(text_.referred(placement, frame, 2), "DIRECTION");
    const double length = std::hypot(out.normal[0], out.normal[1], out.normal[2]);
    if (!(length > 0) || !std::isfinite(length))
        text_.fail(placement, "has an axis without a direction");
    const double sign = forward == text_.flag(face, part, 3) ? 1 : -1;
    for (double& c : out.normal) c *= sign / length;
    return out;
}

void StepShapes::check_plane(const StepEntity& face, const StatedPlane& plane,
                             const std::vector<IndexLoop>& loops) {
    Point3d area{};
    double size = 0;
    for (const IndexLoop& loop : loops) {
        const Point3d a = area_vector(points_, loop);
        for (std::size_t k = 0; k < 3; ++k) area[k] += a[k];
        size += std::hypot(a[0], a[1], a[2]);
        for (const std::uint32_t c : loop) {
            Point3d d = points_[c];
            for (std::size_t k = 0; k < 3; ++k) d[k] -= plane.location[k];
            const double distance = std::fabs(scalar_product(d, plane.normal));
            report_.largest_plane_distance = std::max(report_.largest_plane_distance, distance);
            if (distance > uncertainty_) ++report_.off_plane_corners;
        }
    }
    // Faces with next to no area have no side; what is left is a contradiction of the file.
    if (scalar_product(area, plane.normal) < -1e-9 * size)
        text_.fail(face, "its loops run against the normal of its plane");
}

IndexLoop StepShapes::bound_loop(const StepEntity& bound, bool forward) {
    if (!has_keyword(bound, {"FACE_BOUND", "FACE_OUTER_BOUND"}))
        text_.refuse(bound, "is not read as the bound of a face");
    const StepPart& part = bound.parts.front();
    const StepEntity loop = text_.referred(bound, part, 1);
    IndexLoop out;
    if (loop.is("POLY_LOOP"))
        out = poly_loop(loop);
    else if (loop.is("EDGE_LOOP"))
        out = edge_loop(loop);
    else
        text_.refuse(loop, "is not read as a loop of a planar face");
    if (out.size() < 3)
        text_.fail(loop, "has " + std::to_string(out.size()) +
                             " corners; a loop of straight edges needs at least three");
    if (out.size() > text_.source().limits().loop_corners)
        text_.fail_limit(loop, "has more than " +
                                   std::to_string(text_.source().limits().loop_corners) +
                                   " corners, the limit for a face");
    if (out.size() > corners_left_)
        text_.fail_limit(loop,
                         "the faces of this file have more corners than it has bytes: "
                         "shells share them again and again");
    corners_left_ -= out.size();
    if (forward != text_.flag(bound, part, 2)) std::reverse(out.begin() + 1, out.end());
    return out;
}

IndexLoop StepShapes::poly_loop(const StepEntity& loop) {
    IndexLoop out;
    for (const StepValue& v : text_.value(loop, loop.parts.front(), 1, StepKind::List).items) {
        if (v.kind != StepKind::Reference) text_.fail(loop, "a list of references expected");
        out.push_back(point_number(v.id, v.at));
    }
    return out;
}

IndexLoop StepShapes::edge_loop(const StepEntity& loop) {
    const auto& list = text_.value(loop, loop.parts.front(), 1, StepKind::List).items;
    IndexLoop out;
    IndexLoop ends;
    for (const StepValue& v : list) {
        if (v.kind != StepKind::Reference) text_.fail(loop, "a list of references expected");
        const Edge edge = oriented_edge(text_.entity(v.id, v.at));
        out.push_back(edge.first);
        ends.push_back(edge.last);
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::uint32_t next = out[(i + 1) % out.size()];
        if (ends[i] == next || points_[ends[i]] == points_[next]) continue;
        text_.fail(loop, "edge " + std::to_string(i + 1) + " of " + std::to_string(out.size()) +
                             " does not end where the next one begins");
    }
    return out;
}

StepShapes::Edge StepShapes::oriented_edge(const StepEntity& oriented) {
    if (!oriented.is("ORIENTED_EDGE")) text_.refuse(oriented, "is not read as an edge of a loop");
    const StepPart& part = oriented.parts.front();
    const StepValue& v = text_.value(oriented, part, 3, StepKind::Reference);
    const Edge edge = edges_[edge_number(v.id, v.at)];
    return text_.flag(oriented, part, 4) ? edge : Edge{edge.last, edge.first};
}

std::uint32_t StepShapes::edge_number(std::uint64_t id, const char* from) {
    const std::size_t place = text_.place_of(id, from);
    // An entity is a point or an edge, never both, so one table of numbers will do.
    if (known_[place] != 0 && text_.keyword(place) == "EDGE_CURVE") return known_[place] - 1;
    const StepEntity edge = text_.entity(id, from);
    if (!edge.is("EDGE_CURVE")) text_.refuse(edge, "is not read as an edge");
    const StepPart& part = edge.parts.front();
    Edge made;
    for (const std::size_t end : {1U, 2U}) {
        const StepEntity vertex = text_.referred(edge, part, end);
        if (!vertex.is("VERTEX_POINT")) text_.refuse(vertex, "is not read as a vertex");
        const StepValue& p = text_.value(vertex, vertex.parts.front(), 1, StepKind::Reference);
        (end == 1 ? made.first : made.last) = point_number(p.id, p.at);
    }
    require_line(text_.referred(edge, part, 3), edge);
    edges_.push_back(made);
    known_[place] = static_cast<std::uint32_t>(edges_.size());
    return known_[place] - 1;
}

void StepShapes::require_line(StepEntity curve, const StepEntity& edge) const {
    for (int depth = 0; depth < 4; ++depth) {
        const StepPart& part = curve.parts.front();
        if (curve.is("LINE")) return;
        if (curve.is("POLYLINE") && text_.value(curve, part, 1, StepKind::List).items.size() == 2)
            return;
        if (curve.is("B_SPLINE_CURVE_WITH_KNOTS") && curve.parts.size() == 1 &&
            text_.value(curve, part, 1, StepKind::Number).number == 1 &&
            text_.value(curve, part, 2, StepKind::List).items.size() == 2)
            return;
        if (!has_keyword(curve, {"SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE",
                                 "BOUNDED_SURFACE_CURVE", "TRIMMED_CURVE"}))
            break;
        curve = text_.referred(curve, part, 1);
    }
    text_.refuse(curve, "edges are read where they are straight; this is the curve of " +
                            shown_entity(edge));
}

std::uint32_t StepShapes::point_number(std::uint64_t id, const char* from) {
    const std::size_t place = text_.place_of(id, from);
    if (known_[place] != 0 && text_.keyword(place) == "CARTESIAN_POINT") return known_[place] - 1;
    const StepEntity entity = text_.entity(id, from);
    if (!entity.is("CARTESIAN_POINT")) text_.refuse(entity, "is not read as a point");
    const Point3d point = triple(entity, "CARTESIAN_POINT");
    points_.push_back(point);
    local_.push_back(0);
    known_[place] = static_cast<std::uint32_t>(points_.size());
    return known_[place] - 1;
}

Point3d StepShapes::triple(const StepEntity& entity, std::string_view keyword) const {
    const StepPart* part = entity.part(keyword);
    if (part == nullptr) text_.fail(entity, "is no " + std::string(keyword));
    const auto& list = text_.value(entity, *part, 1, StepKind::List).items;
    if (list.size() != 3) text_.fail(entity, "has not three numbers");
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) {
        if (list[k].kind != StepKind::Number) text_.fail(entity, "has not three numbers");
        out[k] = list[k].number;
    }
    return out;
}

void StepShapes::add_polygons(const StepEntity& face, const std::vector<IndexLoop>& loops) {
    if (loops.size() == 1) return add_polygon(face, loops.front());
    const auto polygons = polygons_of_loops(points_, loops);
    if (!polygons) text_.fail(face, "its loops bound no region");
    for (const IndexLoop& polygon : *polygons) add_polygon(face, polygon);
}

void StepShapes::add_polygon(const StepEntity& face, const IndexLoop& polygon) {
    const ReadLimits& limits = text_.source().limits();
    if (mesh_.face_count() >= limits.faces)
        text_.fail_limit(face, "more than " + std::to_string(limits.faces) + " faces, the limit");
    IndexLoop corners;
    for (const std::uint32_t c : polygon) corners.push_back(local_number(c));
    if (mesh_.points.size() > limits.vertices)
        text_.fail_limit(face,
                         "more than " + std::to_string(limits.vertices) + " vertices, the limit");
    mesh_.add_face(corners);
}

std::uint32_t StepShapes::local_number(std::uint32_t point) {
    if (local_[point] == 0) {
        mesh_.points.push_back(points_[point]);
        local_[point] = static_cast<std::uint32_t>(mesh_.points.size());
        touched_.push_back(point);
    }
    return local_[point] - 1;
}

}  // namespace trisect::detail
