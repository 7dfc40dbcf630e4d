// SPDX-License-Identifier: Apache-2.0
//
// Matrices go down to the shapes, so that a program is one formula over meshes. That is right as
// long as a matrix changes axes, moves and scales: what was flush stays flush. Below a matrix that
// turns otherwise rounded corners would come apart, so a group is evaluated first, where it is
// flush, and turned as a whole.
#include <trisect/bsp/csg/csg_evaluator.h>

#include <utility>

#include <trisect/brep/primitives/hull.h>
#include <trisect/bsp/solid_transform.h>

#include <trisect/bsp/csg/csg_extrude.h>
#include <trisect/bsp/csg/csg_import.h>
#include <trisect/bsp/csg/csg_key.h>
#include <trisect/bsp/csg/csg_region.h>
#include <trisect/bsp/csg/csg_shapes.h>

namespace trisect::detail {
namespace {

constexpr std::size_t most_remarks = 100;

Expression joined(const std::vector<Expression>& terms) {
    if (terms.empty()) return Solid();
    return terms.size() == 1 ? terms[0] : Expression::any_of(terms);
}

std::vector<Outline> outlines_of(const CsgNode& node, const CsgArguments& arguments) {
    if (node.name == "square") return csg_square(arguments);
    if (node.name == "circle") return csg_circle(arguments);
    return csg_polygon(arguments);
}

}  // namespace

Expression CsgEvaluator::formula() {
    return any_of(program_.roots(), program_.dimension(), CsgFrame());
}

// What is made of children, as a whole, for the next program.
template <class Make>
Expression CsgEvaluator::kept_formula(std::uint32_t n, const CsgFrame& frame, const Make& make) {
    if (!kept_.is_across_programs()) return make();
    const std::string key = csg_key(program_, n, frame);
    if (const Expression* known = kept_.formula(key)) return *known;
    return kept_.keep_formula(key, make());
}

void CsgEvaluator::remark(std::uint32_t n, const std::string& text) {
    if (report_.remarks.size() < most_remarks)
        report_.remarks.push_back(program_.place(n) + ": " + text);
}

Solid CsgEvaluator::solid_of(const Expression& formula) {
    ++report_.evaluations;
    return evaluate(formula, options_.evaluate);
}

std::vector<Expression> CsgEvaluator::terms_of(const std::vector<std::uint32_t>& children,
                                               int dimension, const CsgFrame& frame) {
    std::vector<Expression> out;
    for (const std::uint32_t n : program_.used(children)) {
        if (program_.dimension(n) != 0 && program_.dimension(n) != dimension) {
            remark(n, "left out, since it is of another dimension than what is before it");
            continue;
        }
        out.push_back(expression_of(n, frame));
    }
    return out;
}

Expression CsgEvaluator::any_of(const std::vector<std::uint32_t>& children, int dimension,
                                const CsgFrame& frame) {
    return joined(terms_of(children, dimension, frame));
}

Expression CsgEvaluator::children_of(std::uint32_t n, const CsgFrame& frame) {
    return any_of(program_.node(n).children, program_.dimension(n), frame);
}

Expression CsgEvaluator::expression_of(std::uint32_t n, const CsgFrame& frame) {
    switch (program_.kind(n)) {
        case CsgKind::Group:
            return children_of(n, frame);
        case CsgKind::Difference:
            return difference(n, frame);
        case CsgKind::Intersection:
            return intersection(n, frame);
        case CsgKind::Matrix:
            return turned(n, csg_matrix(program_.arguments(n), program_.dimension(n) == 2), frame);
        case CsgKind::Hull:
            return kept_formula(n, frame, [&] { return hull(n, frame); });
        case CsgKind::Linear:
            return linear(n, frame);
        case CsgKind::Revolved:
            return kept_formula(n, frame, [&] { return revolved(n, frame); });
        case CsgKind::Minkowski:
        case CsgKind::Offset:
        case CsgKind::Projection:
            return kept_formula(n, frame, [&] { return made(n, frame); });
        case CsgKind::Resize:
            return kept_formula(n, frame, [&] { return resized(n, frame); });
        case CsgKind::Import:
        case CsgKind::Solid:
            return shape(n, frame);
        case CsgKind::Flat:
            return region(n, frame);
        case CsgKind::Unknown:
            break;
    }
    return Solid();
}

Expression CsgEvaluator::difference(std::uint32_t n, const CsgFrame& frame) {
    std::vector<Expression> terms =
        terms_of(program_.node(n).children, program_.dimension(n), frame);
    if (terms.size() < 2) return joined(terms);
    const Expression first = terms.front();
    terms.erase(terms.begin());
    return first - joined(terms);
}

/// Empty where a child is of another dimension.
Expression CsgEvaluator::intersection(std::uint32_t n, const CsgFrame& frame) {
    const auto terms = terms_of(program_.node(n).children, program_.dimension(n), frame);
    if (terms.size() < program_.used_children(n).size()) return Solid();
    return terms.size() < 2 ? joined(terms) : Expression::all_of(terms);
}

/// Whether there is one shape only, so that there is nothing to be flush with.
bool CsgEvaluator::is_single(std::uint32_t n) const {
    const CsgKind kind = program_.kind(n);
    if (csg_is_whole(kind)) return true;
    if (kind == CsgKind::Linear && !is_straight(program_.arguments(n))) return true;
    const std::vector<std::uint32_t> used = program_.used_children(n);
    return used.empty() || (used.size() == 1 && is_single(used[0]));
}

Expression CsgEvaluator::turned(std::uint32_t n, const AffineMap& own, const CsgFrame& frame) {
    const AffineMap map = compose(frame.map, own);
    if (map.orientation() == 0) {
        remark(n, "left out, since the matrix makes it flat");
        return Solid();
    }
    if (changes_axes(map) || is_single(n)) return children_of(n, {map, frame.low, frame.high});
    const CsgFrame straight{AffineMap(), frame.low, frame.high};
    const std::string key = csg_key(program_, n, straight, true);
    return kept_formula(n, frame, [&]() -> Expression {
        const Solid* known = kept_.solid(key);
        const Solid group =
            known != nullptr ? *known : kept_.keep(key, solid_of(children_of(n, straight)));
        return group.is_empty() ? group : transformed(group, map);
    });
}

Solid CsgEvaluator::placed(std::uint32_t n, const PolygonMesh& mesh, const AffineMap& map) {
    if (mesh.face_count() == 0) {
        remark(n, "is empty");
        return {};
    }
    SolidOptions options;
    options.embedding = Embedding::Check;
    return at_node(n, [&] {
        return map == AffineMap() ? Solid::from_mesh(mesh, options)
                                  : Solid::from_mesh(transformed(mesh, map), options);
    });
}

PolygonMesh CsgEvaluator::mesh_of(std::uint32_t n) {
    const std::string& name = program_.node(n).name;
    const CsgArguments in = program_.arguments(n);
    if (name == "cube") return csg_cube(in);
    if (name == "sphere") return csg_sphere(in);
    if (name == "cylinder") return csg_cylinder(in);
    return name == "polyhedron" ? csg_polyhedron(in) : file_of(n);
}

/// Nothing when no file is named, as OpenSCAD has it where a program named none.
PolygonMesh CsgEvaluator::file_of(std::uint32_t n) {
    const CsgArguments in = program_.arguments(n);
    if (!options_.reads_files) in.fail(ErrorCode::Unsupported, "files are not read");
    const std::filesystem::path file = csg_file(in, options_.folder.value_or(program_.folder()));
    if (file.empty()) return {};
    kept_.note_file(file);
    return at_node(n, [&] {
        return program_.kind(n) == CsgKind::Import ? csg_import(in, file) : csg_surface(in, file);
    });
}

Expression CsgEvaluator::shape(std::uint32_t n, const CsgFrame& frame) {
    ++report_.leaves;
    const std::string key = csg_key(program_, n, frame);
    if (const Solid* known = kept_.solid(key)) return *known;
    ++report_.meshes;
    return kept_.keep(key, placed(n, mesh_of(n), frame.map));
}

Expression CsgEvaluator::region(std::uint32_t n, const CsgFrame& frame) {
    ++report_.leaves;
    const std::string key = csg_key(program_, n, frame);
    if (const Expression* known = kept_.formula(key)) return *known;
    ++report_.meshes;
    std::vector<Outline> paths = outlines_of(program_.node(n), program_.arguments(n));
    if (paths.empty()) remark(n, "is empty");
    const Expression prism = at_node(n, [&] { return even_odd_prism(std::move(paths), frame); });
    return kept_.keep_formula(key, prism);
}

Expression CsgEvaluator::linear(std::uint32_t n, const CsgFrame& frame) {
    refuse_drawing(n);
    const CsgArguments in = program_.arguments(n);
    const double height = in.number("height", 100);
    if (!(height > 0)) {
        remark(n, "is empty");
        return Solid();
    }
    const double low = in.truth("center", false) ? -height / 2 : 0;
    if (is_straight(in))
        return any_of(program_.node(n).children, 2, {frame.map, low, low + height});
    return kept_formula(n, frame, [&]() -> Expression {
        const PlaneRegion base = flat_children_of(n);
        return placed(n, csg_twisted(base, in, low, low + height), frame.map);
    });
}

Expression CsgEvaluator::revolved(std::uint32_t n, const CsgFrame& frame) {
    refuse_drawing(n);
    return placed(n, csg_revolved(flat_children_of(n), program_.arguments(n)), frame.map);
}

/// Old programs name a drawing instead of children.
void CsgEvaluator::refuse_drawing(std::uint32_t n) const {
    const CsgArguments in = program_.arguments(n);
    if (!csg_file(in, {}).empty()) in.fail(ErrorCode::Unsupported, "drawings are not read");
}

PlaneRegion CsgEvaluator::flat_children_of(std::uint32_t n) {
    return region_of_faces(solid_of(any_of(program_.node(n).children, 2, CsgFrame())), 1);
}

Expression CsgEvaluator::hull(std::uint32_t n, const CsgFrame& frame) {
    std::vector<Point3d> points;
    for (const std::uint32_t c : program_.used_children(n)) {
        if (program_.dimension(c) != 0 && program_.dimension(c) != program_.dimension(n)) continue;
        const PolygonMesh mesh = solid_of(expression_of(c, frame)).to_mesh();
        points.insert(points.end(), mesh.points.begin(), mesh.points.end());
    }
    if (points.empty()) return Solid();
    return at_node(n, [&] { return placed(n, make_hull(points), AffineMap()); });
}

}  // namespace trisect::detail
