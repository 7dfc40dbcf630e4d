// SPDX-License-Identifier: Apache-2.0
//
// Nodes whose solids are made of the solids of their children: Minkowski sums, offsets, projections
// and resized ones. They are made at the origin, once for equal content, and put into place.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/bsp/modelling/offset.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/modelling/projection.h>
#include <trisect/bsp/modelling/resized.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>

#include <trisect/bsp/csg/csg_evaluator.h>
#include <trisect/bsp/csg/csg_key.h>
#include <trisect/bsp/csg/csg_shapes.h>

namespace trisect::detail {
namespace {

bool is_at_origin(const CsgFrame& frame) {
    return frame.map == AffineMap() && frame.low == 0 && frame.high == 1;
}

Point3d factors_of(const CsgArguments& in, const Bounds& box, int dimension) {
    std::vector<double> sizes = in.numbers("newsize", 3, 0);
    const std::vector<bool> follows = in.truths("auto", 3);
    if (dimension == 2) sizes[2] = 0;
    return resize_factors(box, {sizes[0], sizes[1], sizes[2]},
                          {follows[0], follows[1], dimension == 3 && follows[2]});
}

/// Whether axes change places and directions, and nothing else. What is rounded before that is
/// rounded alike after it.
bool permutes_axes(const AffineMap& map) {
    return changes_axes(map) && std::ranges::all_of(map.rows, [](const auto& row) {
               return row[3] == 0 && std::fabs(row[0] + row[1] + row[2]) == 1;
           });
}

/// The triangles of a mesh under a map that reach the plane z = 0: all that its section there
/// depends on. Convex faces are fans.
class GroundTriangles {
public:
    GroundTriangles(const PolygonMesh& mesh, const AffineMap& map)
        : mesh_(mesh), map_(map), number_(mesh.points.size(), none) {
        side_.reserve(mesh.points.size());
        for (const Point3d& p : mesh.points) {
            const double z = map.apply(p)[2];
            side_.push_back(static_cast<std::int8_t>(z > 0 ? 1 : z < 0 ? -1 : 0));
        }
    }
    [[nodiscard]] PolygonMesh run() && {
        const bool turns_over = map_.orientation() < 0;
        for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
            const auto face = mesh_.face(f);
            for (std::size_t k = 2; k < face.size(); ++k)
                add(face[0], face[turns_over ? k : k - 1], face[turns_over ? k - 1 : k]);
        }
        return std::move(out_);
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (side_[a] != 0 && side_[a] == side_[b] && side_[a] == side_[c]) return;
        const std::uint32_t first = numbered(a);
        const std::uint32_t second = numbered(b);
        out_.add_triangle(first, second, numbered(c));
    }
    std::uint32_t numbered(std::uint32_t p) {
        if (number_[p] == none) {
            number_[p] = static_cast<std::uint32_t>(out_.points.size());
            out_.points.push_back(map_.apply(mesh_.points[p]));
        }
        return number_[p];
    }

    const PolygonMesh& mesh_;
    const AffineMap& map_;
    std::vector<std::int8_t> side_;
    std::vector<std::uint32_t> number_;
    PolygonMesh out_;
};

}  // namespace

Expression CsgEvaluator::made(std::uint32_t n, const CsgFrame& frame) {
    const std::string key = csg_key(program_, n, CsgFrame());
    if (frame.color >= 0) {
        const CsgFrame plain{frame.map, frame.low, frame.high};
        return tinted(solid_of(made(n, plain)), frame);
    }
    const Solid* known = kept_.solid(key);
    if (known != nullptr) note_found(n);
    const Solid solid =
        known != nullptr ? *known : kept_.keep(key, at_node(n, [&] { return made_at_origin(n); }));
    if (solid.is_empty() || is_at_origin(frame)) return solid;
    if (program_.dimension(n) == 3) return transformed(solid, frame.map);
    if (const auto flat = flat_outlines(solid)) {
        if (frame.map == AffineMap())
            if (auto moved = flat_prism_between(solid, frame.low, frame.high))
                return *std::move(moved);
        if (auto moved = flat_prism(flat->outlines(), OutlineRule::Positive, frame.low, frame.high,
                                    frame.map))
            return *std::move(moved);
    }
    const PlaneRegion region = region_of_faces(solid, 1);
    return placed(n, prism_of_region(region, frame.low, frame.high), frame);
}

Solid CsgEvaluator::made_at_origin(std::uint32_t n) {
    switch (program_.kind(n)) {
        case CsgKind::Offset:
            return offset(n);
        case CsgKind::Projection:
            return projection(n);
        default:
            return minkowski(n);
    }
}

/// Children of the node's dimension. As OpenSCAD has it, solids that are empty are left out, while
/// an empty region makes the sum empty.
std::vector<Solid> CsgEvaluator::operands_of(std::uint32_t n) {
    std::vector<Solid> out;
    for (const std::uint32_t c : program_.used_children(n)) {
        if (program_.dimension(c) != program_.dimension(n)) continue;
        Solid solid = solid_of(expression_of(c, CsgFrame()));
        if (!solid.is_empty() || program_.dimension(n) == 2) out.push_back(std::move(solid));
    }
    if (out.size() < program_.used_children(n).size())
        remark(n, "operands that are empty or of another dimension are left out");
    return out;
}

Solid CsgEvaluator::minkowski(std::uint32_t n) {
    MinkowskiOptions options;
    options.evaluate = options_.evaluate;
    options.convex = MinkowskiOptions::Convex::WithinRounding;
    std::optional<Solid> out;
    for (const Solid& operand : operands_of(n)) {
        if (!out)
            out = operand;
        else
            out = program_.dimension(n) == 2 ? minkowski_sum_of_regions(*out, operand, options)
                                             : minkowski_sum(*out, operand, options);
    }
    return out.value_or(Solid());
}

Solid CsgEvaluator::offset(std::uint32_t n) {
    const CsgArguments in = program_.arguments(n);
    OffsetOptions options;
    options.evaluate = options_.evaluate;
    double distance = in.number("r", 1);
    if (in.find("r") == nullptr && in.find("delta") != nullptr) {
        distance = in.number("delta", 1);
        options.corners = in.truth("chamfer", false) ? OffsetOptions::Corners::Chamfer
                                                     : OffsetOptions::Corners::Miter;
    }
    options.segments = csg_fragments(in, std::fabs(distance));
    return offset_of_region(solid_of(any_of(program_.node(n).children, 2, CsgFrame())), distance,
                            options);
}

/// Of one group that is turned the mesh will do: sections and shadows need no solid, which would be
/// made free of what rounding made meet itself.
std::optional<PolygonMesh> CsgEvaluator::turned_mesh(std::uint32_t n) {
    AffineMap map;
    while (true) {
        const std::vector<std::uint32_t> used = program_.used_children(n);
        if (used.size() != 1 || program_.dimension(used[0]) != 3) return std::nullopt;
        n = used[0];
        if (program_.kind(n) == CsgKind::Group) continue;
        if (program_.kind(n) != CsgKind::Matrix || is_single(n)) return std::nullopt;
        map = compose(map, csg_matrix(program_.arguments(n), false));
        if (map.orientation() == 0) return std::nullopt;
        if (!changes_axes(map)) break;
    }
    const Solid group = turned_group(n, CsgFrame());
    if (group.is_empty()) return std::nullopt;
    std::string key = csg_key(program_, n, CsgFrame(), true);
    if (last_turned_.key != key) last_turned_ = {std::move(key), group.to_exact_mesh(1)};
    return transformed_mesh(last_turned_.mesh, map);
}

/// Shadows from several sides may be of one group. Where only axes change places, it is evaluated
/// once, before that.
std::optional<PolygonMesh> CsgEvaluator::upright_mesh(std::uint32_t n) {
    AffineMap map;
    std::vector<std::uint32_t> used = program_.used_children(n);
    while (used.size() == 1 && program_.dimension(used[0]) == 3) {
        n = used[0];
        const CsgKind kind = program_.kind(n);
        if (kind == CsgKind::Matrix)
            map = compose(map, csg_matrix(program_.arguments(n), false));
        else if (kind != CsgKind::Group)
            break;
        used = program_.used_children(n);
    }
    const CsgKind kind = program_.kind(n);
    if ((kind != CsgKind::Intersection && kind != CsgKind::Difference) || !permutes_axes(map))
        return std::nullopt;
    std::string key = csg_key(program_, n, CsgFrame());
    if (last_mesh_.key == key) {
        note_found(n);
    } else {
        const Solid solid = solid_of(any_of({n}, 3, CsgFrame()));
        last_mesh_ = {std::move(key), solid.to_mesh(options_.evaluate.threads)};
    }
    if (last_mesh_.mesh.face_count() == 0) return std::nullopt;
    return map == AffineMap() ? last_mesh_.mesh : transformed(last_mesh_.mesh, map);
}

/// Of one height field its triangles at z = 0 will do: it never meets itself. Nothing where axes do
/// not stay axes, so that its bottom, a polygon, stays plane.
std::optional<PolygonMesh> CsgEvaluator::surface_at_ground(std::uint32_t n) {
    AffineMap map;
    while (program_.node(n).name != "surface") {
        const std::vector<std::uint32_t> used = program_.used_children(n);
        const CsgKind kind = program_.kind(n);
        if (used.size() != 1 || program_.dimension(used[0]) != 3) return std::nullopt;
        if (kind == CsgKind::Matrix)
            map = compose(map, csg_matrix(program_.arguments(n), false));
        else if (kind != CsgKind::Group && kind != CsgKind::Projection)
            return std::nullopt;
        n = used[0];
    }
    if (map.orientation() == 0 || !changes_axes(map)) return std::nullopt;
    ++report_.leaves;
    std::string key = csg_key(program_, n, CsgFrame());
    if (last_mesh_.key != key) {
        ++report_.meshes;
        last_mesh_ = {std::move(key), mesh_of(n)};
    }
    if (last_mesh_.mesh.face_count() == 0) return std::nullopt;
    return GroundTriangles(last_mesh_.mesh, map).run();
}

Solid CsgEvaluator::projection(std::uint32_t n) {
    const bool cut = program_.arguments(n).truth("cut", false);
    if (cut)
        if (const auto mesh = surface_at_ground(n))
            return section_of_mesh(*mesh, 0, options_.evaluate);
    if (const auto mesh = turned_mesh(n))
        return cut ? section_of_mesh(*mesh, 0, options_.evaluate)
                   : shadow_of_mesh(*mesh, options_.evaluate);
    if (!cut)
        if (const auto mesh = upright_mesh(n)) return shadow_of_mesh(*mesh, options_.evaluate);
    const Solid solid = solid_of(any_of(program_.node(n).children, 3, CsgFrame()));
    return cut ? solid_of_region(section(solid, 0, options_.evaluate))
               : shadow(solid, options_.evaluate);
}

Expression CsgEvaluator::resized(std::uint32_t n, const CsgFrame& frame) {
    const int dimension = program_.dimension(n);
    const std::optional<Bounds> box = bounds(solid_of(children_of(n, CsgFrame())));
    if (!box) return Solid();
    return turned(n, AffineMap::scaling(factors_of(program_.arguments(n), *box, dimension)), frame);
}

}  // namespace trisect::detail
