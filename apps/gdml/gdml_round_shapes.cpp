// SPDX-License-Identifier: Apache-2.0
//
// Corners lie on the surfaces that are meant, so facets of convex ones are inside, and those of
// holes outside, by the deviation at most.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "gdml_shape.h"

namespace trisect::app {
namespace {

/// How far the middle of a chord is from its arc.
double sagitta(double radius, double degrees) {
    return radius * (1 - std::cos(radians(degrees) / 2));
}

GdmlTurn turn_of(const GdmlSource& in, const GdmlElement& e) {
    GdmlTurn out;
    out.start = in.values.angle(e, "startphi", 0);
    out.extent = in.values.angle(e, "deltaphi", 360);
    if (!(out.extent > 0))
        in.document.fail(e, "<" + e.name + "> with an angle that is not positive");
    if (out.extent >= 360) out = {.start = 0, .extent = 360};
    return out;
}

void check_profile(const GdmlSource& in, const GdmlElement& e, const Outline& profile) {
    double area = 0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const Point2d& p = profile[i];
        const Point2d& q = profile[(i + 1) % profile.size()];
        if (p[0] < 0) in.document.fail(e, "<" + e.name + "> with a negative radius");
        area += p[0] * q[1] - p[1] * q[0];
    }
    if (area == 0) in.document.fail(e, "<" + e.name + "> without an inside");
}

GdmlShape turned(const GdmlSource& in, const GdmlElement& e, const Outline& profile,
                 const GdmlTurn& turn) {
    check_profile(in, e, profile);
    GdmlShape out;
    out.mesh = turned_profile(in, profile, turn);
    double radius = 0;
    for (const Point2d& p : profile) radius = std::max(radius, p[0]);
    radius *= std::max(turn.scale_x, turn.scale_y);
    out.deviation = rounding_of_corners;
    out.is_round = turn.sides == 0;
    if (out.is_round) out.deviation += sagitta(radius, 360.0 / in.facets);
    return out;
}

GdmlShape tube(const GdmlSource& in, const GdmlElement& e) {
    const double inner = in.values.length(e, "rmin", 0);
    const double outer = in.values.length(e, "rmax");
    const double z = in.values.length(e, "z") / 2;
    return turned(in, e, {{inner, -z}, {outer, -z}, {outer, z}, {inner, z}}, turn_of(in, e));
}

GdmlShape cone(const GdmlSource& in, const GdmlElement& e) {
    const auto length = [&](const char* name) { return in.values.length(e, name, 0); };
    const double z = in.values.length(e, "z") / 2;
    return turned(
        in, e,
        {{length("rmin1"), -z}, {length("rmax1"), -z}, {length("rmax2"), z}, {length("rmin2"), z}},
        turn_of(in, e));
}

/// Up along the outer radii, and down along the inner ones.
Outline profile_of_planes(const GdmlSource& in, const GdmlElement& e, double times) {
    Outline out;
    Outline inner;
    for (const GdmlElement& c : e.children) {
        if (c.name != "zplane") continue;
        const double z = in.values.length(c, "z", e);
        const auto radius = [&](const char* name) {
            return c.find(name) != nullptr ? std::nearbyint(in.values.length(c, name, e) * times)
                                           : 0.0;
        };
        out.push_back({radius("rmax"), z});
        inner.push_back({radius("rmin"), z});
    }
    if (out.size() < 2) in.document.fail(e, "<" + e.name + "> with fewer than two planes");
    std::ranges::reverse(inner);
    out.insert(out.end(), inner.begin(), inner.end());
    return out;
}

Outline profile_of_points(const GdmlSource& in, const GdmlElement& e) {
    Outline out;
    for (const GdmlElement& c : e.children)
        if (c.name == "rzpoint")
            out.push_back({in.values.length(c, "r", e), in.values.length(c, "z", e)});
    if (out.size() < 3) in.document.fail(e, "<" + e.name + "> with fewer than three points");
    return out;
}

GdmlShape polycone(const GdmlSource& in, const GdmlElement& e) {
    return turned(in, e, profile_of_planes(in, e, 1), turn_of(in, e));
}

GdmlShape generic_polycone(const GdmlSource& in, const GdmlElement& e) {
    return turned(in, e, profile_of_points(in, e), turn_of(in, e));
}

GdmlTurn sided_turn(const GdmlSource& in, const GdmlElement& e) {
    GdmlTurn out = turn_of(in, e);
    out.start = in.values.angle(e, "startphi", 0);
    out.sides = in.values.count(e, "numsides", out.extent >= 360 ? 3 : 1, 1U << 16);
    return out;
}

/// Radii are distances of sides from the axis.
GdmlShape polyhedra(const GdmlSource& in, const GdmlElement& e) {
    const GdmlTurn turn = sided_turn(in, e);
    const double half_side = radians(turn.extent / turn.sides) / 2;
    if (half_side > 1.5) in.document.fail(e, "<polyhedra> with a side of half a turn");
    return turned(in, e, profile_of_planes(in, e, 1 / std::cos(half_side)), turn);
}

/// Radii are those of the corners.
GdmlShape generic_polyhedra(const GdmlSource& in, const GdmlElement& e) {
    return turned(in, e, profile_of_points(in, e), sided_turn(in, e));
}

/// Points of an arc about the origin, from one angle from the z axis to another.
void add_arc(Outline& out, const GdmlSource& in, double radius, double from, double to) {
    const double step = 360.0 / in.facets;
    const auto steps =
        static_cast<std::uint32_t>(std::max(std::ceil(std::fabs(to - from) / step - 1e-9), 1.0));
    for (std::uint32_t i = 0; i <= steps; ++i) {
        const double t = i == steps ? to : from + (to - from) * i / steps;
        const bool is_pole = t == 0 || t == 180;
        out.push_back({is_pole ? 0 : std::nearbyint(radius * std::sin(radians(t))),
                       std::nearbyint(radius * std::cos(radians(t)))});
    }
}

GdmlShape with_arcs(const GdmlSource& in, GdmlShape shape, double radius) {
    shape.deviation += sagitta(radius, 360.0 / in.facets) + rounding_of_corners;
    return shape;
}

GdmlShape sphere(const GdmlSource& in, const GdmlElement& e) {
    const double inner = in.values.length(e, "rmin", 0);
    const double outer = in.values.length(e, "rmax");
    const double from = in.values.angle(e, "starttheta", 0);
    const double to = std::min(from + in.values.angle(e, "deltatheta", 180), 180.0);
    if (from < 0 || !(to > from)) in.document.fail(e, "<sphere> with angles that make no sense");
    Outline profile;
    add_arc(profile, in, outer, from, to);
    if (inner > 0)
        add_arc(profile, in, inner, to, from);
    else if (from > 0 || to < 180)
        profile.push_back({0, 0});
    return with_arcs(in, turned(in, e, profile, turn_of(in, e)), outer);
}

GdmlShape orb(const GdmlSource& in, const GdmlElement& e) {
    const double radius = in.values.length(e, "r");
    Outline profile;
    add_arc(profile, in, radius, 0, 180);
    return with_arcs(in, turned(in, e, profile, {}), radius);
}

Outline circle_at(const GdmlSource& in, double radius, double middle) {
    Outline out;
    add_arc(out, in, radius, 0, 360);
    out.pop_back();
    for (Point2d& p : out) p[0] += middle;
    return out;
}

GdmlShape torus(const GdmlSource& in, const GdmlElement& e) {
    const double inner = in.values.length(e, "rmin", 0);
    const double outer = in.values.length(e, "rmax");
    const double middle = in.values.length(e, "rtor");
    const GdmlTurn turn = turn_of(in, e);
    GdmlShape out = with_arcs(in, turned(in, e, circle_at(in, outer, middle), turn), outer);
    if (inner > 0) out.hole = turned_profile(in, circle_at(in, inner, middle), turn);
    return out;
}

GdmlShape elliptical_tube(const GdmlSource& in, const GdmlElement& e) {
    const double z = in.values.length(e, "dz");
    GdmlTurn turn;
    // The profile's radius is a step; the two half axes are its factors.
    turn.scale_x = in.values.length(e, "dx");
    turn.scale_y = in.values.length(e, "dy");
    return turned(in, e, {{0, -z}, {1, -z}, {1, z}, {0, z}}, turn);
}

GdmlShape ellipsoid(const GdmlSource& in, const GdmlElement& e) {
    const double height = in.values.length(e, "cz");
    GdmlTurn turn;
    turn.scale_x = in.values.length(e, "ax");
    turn.scale_y = in.values.length(e, "by");
    const double low = e.find("zcut1") ? in.values.length(e, "zcut1") : 0;
    const double high = e.find("zcut2") ? in.values.length(e, "zcut2") : 0;
    const double bottom = low == 0 && high == 0 ? -height : std::max(low, -height);
    const double top = low == 0 && high == 0 ? height : std::min(high, height);
    if (!(height > 0) || !(top > bottom)) in.document.fail(e, "<ellipsoid> without an inside");
    const double from = std::acos(bottom / height);
    const double to = std::acos(top / height);
    const auto steps = static_cast<std::uint32_t>(in.facets / 2);
    Outline profile;
    if (bottom > -height) profile.push_back({0, bottom});
    for (std::uint32_t i = 0; i <= steps; ++i) {
        const double t = from + (to - from) * i / steps;
        const bool is_end = i == 0 || i == steps;
        const double z = is_end ? (i == 0 ? bottom : top) : std::nearbyint(height * std::cos(t));
        profile.push_back({std::fabs(z) == height ? 0 : std::sin(t), z});
    }
    if (top < height) profile.push_back({0, top});
    const double largest = std::max({turn.scale_x, turn.scale_y, height});
    return with_arcs(in, turned(in, e, profile, turn), largest);
}

/// A tube between two planes through the ends of its axis.
GdmlShape cut_tube(const GdmlSource& in, const GdmlElement& e) {
    const double inner = in.values.length(e, "rmin", 0);
    const double outer = in.values.length(e, "rmax");
    const double z = in.values.length(e, "z") / 2;
    GdmlShape out;
    double reach = z;
    for (const auto& [name, at] : {std::pair{"low", -z}, std::pair{"high", z}}) {
        Point3d n{};
        for (std::size_t k = 0; k < 3; ++k)
            n[k] = in.values.number(e, std::string(name) + std::array{"X", "Y", "Z"}.at(k));
        if (!((at > 0) == (n[2] > 0)) || n[2] == 0)
            in.document.fail(e, "<cutTube> with a plane that looks inwards");
        reach = std::max(reach, z + outer * std::hypot(n[0], n[1]) / std::fabs(n[2]) + 1);
        out.cuts.push_back({n[0], n[1], n[2], -n[2] * at});
    }
    reach = std::ceil(reach);
    const auto cuts = std::move(out.cuts);
    out = turned(in, e, {{inner, -reach}, {outer, -reach}, {outer, reach}, {inner, reach}},
                 turn_of(in, e));
    out.cuts = cuts;
    return out;
}

}  // namespace

std::optional<GdmlShape> round_gdml_shape(const GdmlSource& source, const GdmlElement& element) {
    using Make = GdmlShape (*)(const GdmlSource&, const GdmlElement&);
    constexpr std::array<std::pair<std::string_view, Make>, 12> kinds{
        {{"tube", tube},
         {"cone", cone},
         {"polycone", polycone},
         {"genericPolycone", generic_polycone},
         {"polyhedra", polyhedra},
         {"genericPolyhedra", generic_polyhedra},
         {"sphere", sphere},
         {"orb", orb},
         {"torus", torus},
         {"eltube", elliptical_tube},
         {"ellipsoid", ellipsoid},
         {"cutTube", cut_tube}}};
    for (const auto& [name, make] : kinds)
        if (name == element.name) return make(source, element);
    return std::nullopt;
}

}  // namespace trisect::app
