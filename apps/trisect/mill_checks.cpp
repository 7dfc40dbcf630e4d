// SPDX-License-Identifier: Apache-2.0
//
// The relation is found without contacts first, since nearly all answers are "disjoint". Only for a
// collision the contacts are listed, the common part is evaluated for a place, and its volume says
// how bad it is.
#include "mill_checks.h"

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "values.h"

namespace trisect::app {
namespace {

constexpr std::size_t listed_contacts = 8;

const char* const tool_name = "tool";
const char* const holder_name = "holder";

bool is_overlap(Relation relation) {
    return relation != Relation::Disjoint && relation != Relation::Touching;
}

/// What a solid has in the other one's box, or a little more; on the first one's lattice.
Solid part_near(const Solid& of, const Solid& other) {
    const auto box = bounds(other.to_mesh());
    if (!box) return Solid();
    const double unit = std::ldexp(1.0, of.lattice().exponent);
    Point3d low = box->lo;
    Point3d high = box->hi;
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = unit * (std::floor(low[k] / unit) - 1);
        high[k] = unit * (std::ceil(high[k] / unit) + 1);
    }
    ImportOptions options;
    options.lattice = of.lattice();
    return evaluate(of & Solid::from_lattice_mesh(import_mesh(make_box(low, high), options).mesh));
}

/// The centroid in doubles: the exact one of many corners takes seconds.
Point3d middle_of(const PolygonMesh& mesh) {
    const Point3d& origin = mesh.points.front();
    Point3d sum{};
    double six_volumes = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::array<Point3d, 3> c{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                c[i][k] = mesh.points[mesh.face(f)[i]][k] - origin[k];
        const auto& [p, q, r] = c;
        const double v = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                         p[2] * (q[0] * r[1] - q[1] * r[0]);
        six_volumes += v;
        for (std::size_t k = 0; k < 3; ++k) sum[k] += v * (p[k] + q[k] + r[k]) / 4;
    }
    Point3d out = origin;
    if (six_volumes > 0)
        for (std::size_t k = 0; k < 3; ++k) out[k] += sum[k] / six_volumes;
    return out;
}

const char* kind_word(EntityName::Kind kind) {
    switch (kind) {
        case EntityName::Kind::Vertex:
            return "vertex";
        case EntityName::Kind::Edge:
            return "edge";
        case EntityName::Kind::Face:
            break;
    }
    return "face";
}

}  // namespace

MillChecks::MillChecks(const MillJob& job, const MillOptions& options)
    : job_(job), holder_parts_(job.holder_parts), touch_(options.touch) {
    bodies_[job.stock_source] = stock_name_;
    bodies_[job.holder.source] = job.holder.name;
    for (const MillBody& fixture : job.fixtures) bodies_[fixture.source] = fixture.name;
}

void MillChecks::name_cut(const SweptTool& tool, std::size_t index) {
    for (const std::uint32_t source : tool.sources) cuts_[source] = index;
}

std::string MillChecks::face_name(const FaceSource& face) const {
    if (const auto body = bodies_.find(face.operand); body != bodies_.end())
        return fmt::format("{} face {}", body->second, face.face);
    if (const auto cut = cuts_.find(face.operand); cut != cuts_.end())
        return fmt::format("a face cut at step {}", cut->second + 1);
    return "a swept face";  // of the tool on a rapid move, or of the holder
}

Json MillChecks::entity_json(const EntityName& entity) const {
    Json out;
    out["kind"] = kind_word(entity.kind);
    out["faces"] = Json::array();
    std::string name;
    for (std::size_t i = 0; i < entity.face_count; ++i) {
        const std::string face = face_name(entity.faces.at(i));
        name += (i == 0 ? "" : " and ") + face;
        out["faces"].push_back(face);
    }
    if (entity.face_count > 1) name = fmt::format("{} of {}", kind_word(entity.kind), name);
    out["name"] = name;
    return out;
}

void MillChecks::add_place(const Pair& pair, Json& out) const {
    const Solid placed = transformed(pair.a, pair.pose_a);
    // The two may have different lattices, and a whole stock takes seconds to move to another one.
    const Solid common = evaluate(placed & part_near(pair.b, placed));
    const PolygonMesh mesh = common.to_mesh();
    if (const auto box = bounds(mesh)) {
        out["common_volume"] = volume(common);
        out["place"] = middle_of(mesh);
        out["bounds"] = {box->lo, box->hi};
    } else if (const auto distance = boundary_distance(pair.a, pair.pose_a, pair.b, Pose())) {
        out["place"] = distance->on_b;
    }
}

Json MillChecks::collision(const Pair& pair, std::size_t index, Relation relation) const {
    const MillStep& step = job_.steps[index];
    Json out;
    out["kind"] = pair.kind;
    out["step"] = index + 1;
    out["line"] = step.line;
    out["time"] = step.end_time;
    out["position"] = job_.grid.to_user(step.to);
    out["a"] = pair.name_a;
    out["b"] = pair.name_b;
    out["relation"] = to_string(relation);
    add_place(pair, out);
    const SolidInterference all =
        interfere(pair.a, pair.pose_a, pair.b, Pose(), {.contacts = true});
    out["contact_count"] = all.contacts.size();
    out["contacts"] = Json::array();
    for (std::size_t i = 0; i < std::min(all.contacts.size(), listed_contacts); ++i) {
        const NamedContact& c = all.contacts[i];
        out["contacts"].push_back(
            {{"a", entity_json(c.a)}, {"b", entity_json(c.b)}, {"dimension", c.dimension}});
    }
    return out;
}

void MillChecks::check(const Pair& pair, std::size_t index, bool touch_counts,
                       std::vector<Json>& out) const {
    const Relation relation = interfere(pair.a, pair.pose_a, pair.b, Pose()).relation;
    if (is_overlap(relation) || (touch_counts && relation == Relation::Touching))
        out.push_back(collision(pair, index, relation));
}

std::vector<Json> MillChecks::of_tool(std::size_t index, const SweptTool& tool,
                                      const Solid& stock) const {
    std::vector<Json> out;
    const MillStep& step = job_.steps[index];
    const Pose here;
    for (const MillBody& fixture : job_.fixtures)
        check({"tool in fixture", tool_name, tool.solid, here, fixture.name, fixture.solid}, index,
              touch_, out);
    // Rapid moves slide along what was cut before, flush with it, and contact is no collision.
    // Whether there is a common part takes a hundredth of finding out how such faces touch.
    if (step.is_rapid && !evaluate(stock & tool.solid).is_empty())
        check({"rapid through stock", tool_name, tool.solid, here, stock_name_, stock}, index,
              false, out);
    return out;
}

std::vector<Json> MillChecks::of_holder(std::size_t index, const Solid& stock) {
    std::vector<Json> out;
    const MillStep& step = job_.steps[index];
    const Pose pose = job_.pose_after(step);
    check({"holder in stock", holder_name, job_.holder.solid, pose, stock_name_, stock}, index,
          touch_, out);
    for (const MillBody& fixture : job_.fixtures)
        check({"holder in fixture", holder_name, job_.holder.solid, pose, fixture.name,
               fixture.solid},
              index, touch_, out);
    if (out.empty() && holder_parts_ && !step.is_placement) check_way(index, stock, out);
    return out;
}

void MillChecks::check_way(std::size_t index, const Solid& stock, std::vector<Json>& out) {
    const MillStep& step = job_.steps[index];
    const Pose here;
    // Clear or not at its beginning, that was found by the step before.
    for (const Solid& way :
         holder_parts_->swept_shells(step.orientation, step.from, step.to, index > 0)) {
        check({"holder through stock", holder_name, way, here, stock_name_, stock}, index, false,
              out);
        for (const MillBody& fixture : job_.fixtures)
            check({"holder through fixture", holder_name, way, here, fixture.name, fixture.solid},
                  index, false, out);
        if (!out.empty()) return;
    }
}

std::string collision_text(const Json& c, std::size_t step_count) {
    std::string out =
        fmt::format("collision at step {} of {}, line {}, {:.2f} s: the {} meets the {} ({}, {})",
                    c["step"].get<std::size_t>(), step_count, c["line"].get<std::uint64_t>(),
                    c["time"].get<double>(), c["a"].get<std::string>(), c["b"].get<std::string>(),
                    c["kind"].get<std::string>(), c["relation"].get<std::string>());
    const auto point = [](const Json& p) {
        return fmt::format("({}, {}, {})", number_text(p[0].get<double>()),
                           number_text(p[1].get<double>()), number_text(p[2].get<double>()));
    };
    out += "\n  tool at " + point(c["position"]);
    if (c.contains("place")) out += ", they meet around " + point(c["place"]);
    if (c.contains("common_volume"))
        out += ", common volume " + number_text(c["common_volume"].get<double>());
    for (const Json& contact : c["contacts"])
        out += fmt::format("\n  {} meets {}", contact["a"]["name"].get<std::string>(),
                           contact["b"]["name"].get<std::string>());
    const auto more = c["contact_count"].get<std::size_t>() - c["contacts"].size();
    if (more > 0) out += fmt::format("\n  and {} more contacts", more);
    return out + "\n";
}

}  // namespace trisect::app
