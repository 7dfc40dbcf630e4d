// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/flat_prism.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include <trisect/bsp/evaluate/flat_formula.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/flat/flat_mesh.h>
#include <trisect/bsp/flat/flat_state.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::FlatCorner;
using detail::FlatPrism;
using detail::FlatRegion;

/// Corners in the directions u, v and that of the prism.
struct Placed {
    std::vector<Point3d> corners;  ///< at the lower end
    std::vector<std::array<std::uint32_t, 2>> sides;
    double low = 0;
    double high = 0;
    int axis = 2;
    bool reverses = false;
};

// Repeated corners do not count.
void add_outline(Placed& out, const FlatOutline& outline) {
    const std::size_t first = out.corners.size();
    for (const auto& p : outline) {
        const Point3d at{p[0], p[1], out.low};
        if (out.corners.size() == first || out.corners.back() != at) out.corners.push_back(at);
    }
    while (out.corners.size() > first + 1 && out.corners.back() == out.corners[first])
        out.corners.pop_back();
    if (out.corners.size() < first + 3) out.corners.resize(first);
    const auto end = static_cast<std::uint32_t>(out.corners.size());
    for (auto i = static_cast<std::uint32_t>(first); i < end; ++i)
        out.sides.push_back({i, i + 1 < end ? i + 1 : static_cast<std::uint32_t>(first)});
}

FlatRegion region_of(const Placed& placed, OutlineRule rule, Coordinate& low, Coordinate& high) {
    std::vector<Point3d> corners = placed.corners;
    corners.push_back({0, 0, placed.high});
    LatticeReport report;
    const Lattice lattice = choose_lattice(corners, 1, Fractions::Kept);
    const auto at = to_lattice(corners, lattice, report, 1, Fractions::Kept);
    FlatRegion out;
    out.lattice = lattice;
    out.rule = rule == OutlineRule::Odd ? FlatRegion::Rule::Odd : FlatRegion::Rule::Positive;
    const auto n = static_cast<std::uint32_t>(placed.corners.size());
    out.vertices.reserve(n);
    out.lines.reserve(placed.sides.size());
    out.segments.reserve(placed.sides.size());
    const auto serial = static_cast<std::uint32_t>(detail::Source::take_serials(1));
    for (std::uint32_t i = 0; i < n; ++i) {
        out.vertices.push_back({at[i].x.to_double(), at[i].y.to_double(), 0});
        out.largest =
            std::max({out.largest, std::fabs(at[i].x.to_double()), std::fabs(at[i].y.to_double())});
    }
    for (auto [from, to] : placed.sides) {
        if (placed.reverses) std::swap(from, to);
        const FlatCorner a = out.vertices[from].corner();
        const FlatCorner b = out.vertices[to].corner();
        const auto line = static_cast<std::uint32_t>(out.lines.size());
        if (a == b) continue;
        out.lines.push_back({a, b, {serial, line}});
        out.segments.push_back({from, to, line, true});
    }
    const auto walls = static_cast<std::uint32_t>(out.lines.size());
    out.cap_names = {FaceSource{serial, walls}, FaceSource{serial, walls + 1}};
    low = at[0].z;
    high = at[n].z;
    return out;
}

Solid solid_of(const Placed& placed, OutlineRule rule) {
    if (placed.sides.empty()) return {};
    if (!(placed.low < placed.high)) throw UsageError("a prism must have a positive height");
    Coordinate low;
    Coordinate high;
    FlatRegion region = region_of(placed, rule, low, high);
    if (!(low < high)) throw LimitError("a prism too low beside its extent");
    return detail::solid_of(detail::flat_state(std::move(region), placed.axis, low, high));
}

// The axis that the prism has under the map, and nothing else of.
std::optional<std::size_t> axis_under(const AffineMap& map) {
    for (std::size_t k = 0; k < 3; ++k) {
        const bool is_only = map.rows[k][0] == 0 && map.rows[k][1] == 0 && map.rows[k][2] != 0 &&
                             map.rows[(k + 1) % 3][2] == 0 && map.rows[(k + 2) % 3][2] == 0;
        if (is_only) return k;
    }
    return std::nullopt;
}

const FlatPrism* flat_form(const Solid& solid) {
    return std::get_if<FlatPrism>(&detail::state_of(solid)->form);
}

}  // namespace

Solid flat_prism(std::span<const FlatOutline> outlines, OutlineRule rule, double low, double high) {
    Placed placed;
    placed.low = low;
    placed.high = high;
    for (const FlatOutline& outline : outlines) add_outline(placed, outline);
    return solid_of(placed, rule);
}

Solid flat_prism(std::span<const std::array<double, 2>> corners,
                 std::span<const std::array<std::uint32_t, 2>> sides, double low, double high) {
    Placed placed;
    placed.low = low;
    placed.high = high;
    for (const auto& p : corners) placed.corners.push_back({p[0], p[1], low});
    placed.sides.assign(sides.begin(), sides.end());
    return solid_of(placed, OutlineRule::Positive);
}

std::optional<Solid> flat_prism(std::span<const FlatOutline> outlines, OutlineRule rule, double low,
                                double high, const AffineMap& map) {
    if (map == AffineMap()) return flat_prism(outlines, rule, low, high);
    const auto axis = axis_under(map);
    const int orientation = map.orientation();
    if (!axis || orientation == 0) return std::nullopt;
    Placed placed;
    placed.low = low;
    for (const FlatOutline& outline : outlines) add_outline(placed, outline);
    const std::size_t u = (*axis + 1) % 3;
    const std::size_t v = (*axis + 2) % 3;
    placed.axis = static_cast<int>(*axis);
    placed.low = map.apply({0, 0, low})[*axis];
    placed.high = map.apply({0, 0, high})[*axis];
    const bool turns_over = placed.low > placed.high;
    if (turns_over) std::swap(placed.low, placed.high);
    placed.reverses = (orientation < 0) != turns_over;
    for (Point3d& p : placed.corners) {
        const Point3d q = map.apply(p);
        p = {q[u], q[v], placed.low};
    }
    return solid_of(placed, rule);
}

std::vector<FlatOutline> FlatOutlines::outlines() const {
    std::vector<FlatOutline> out;
    for (const auto& loop : loops) {
        FlatOutline& outline = out.emplace_back();
        for (const std::uint32_t v : loop) outline.push_back(points[v]);
    }
    return out;
}

std::optional<FlatOutlines> flat_outlines(const Solid& solid) {
    const FlatPrism* const prism = flat_form(solid);
    if (prism == nullptr || prism->axis != 2) return std::nullopt;
    const FlatRegion& region = prism->operand->resolved();
    FlatOutlines out;
    for (const auto& [u, v] : detail::flat_coordinates(region)) out.points.push_back({u, v});
    out.loops = detail::flat_loops(region);
    out.low = region.lattice.to_double(prism->low.to_double());
    out.high = region.lattice.to_double(prism->high.to_double());
    out.is_exact = region.has_corners_only();
    return out;
}

std::vector<std::array<std::uint32_t, 3>> flat_triangles(const Solid& solid) {
    const FlatPrism* const prism = flat_form(solid);
    if (prism == nullptr) throw UsageError("triangles of a solid that is no flat prism");
    return detail::flat_triangles(prism->operand->resolved());
}

std::optional<Solid> evaluate_flat_prisms(const Expression& expression,
                                          const EvaluateOptions& options) {
    auto state = detail::evaluate_flat(detail::translate(expression), options);
    if (state == nullptr) return std::nullopt;
    return detail::solid_of(std::move(state));
}

std::optional<Solid> flat_prism_between(const Solid& solid, double low, double high) {
    const FlatPrism* const prism = flat_form(solid);
    if (prism == nullptr || prism->axis != 2) return std::nullopt;
    if (!(low < high)) throw UsageError("a prism must have a positive height");
    const FlatRegion& region = prism->operand->resolved();
    if (region.is_empty()) return Solid();
    // Heights that take a finer lattice move the region to it.
    const int exponent = region.lattice.exponent;
    const auto in_units = [&](double z) { return std::ldexp(z, -exponent); };
    const auto fits = [](double z) {
        return std::fabs(z) < 0x1p52 &&
               std::ldexp(z, fraction_limit) == std::trunc(std::ldexp(z, fraction_limit));
    };
    if (!fits(in_units(low)) || !fits(in_units(high))) return std::nullopt;
    return detail::solid_of(detail::flat_state(region, prism->axis, Coordinate(in_units(low)),
                                               Coordinate(in_units(high))));
}

}  // namespace trisect
