// SPDX-License-Identifier: Apache-2.0
//
// Matrices go down to the shapes, so that a program is one formula over meshes. That is right as
// long as a matrix changes axes, moves and scales: what was flush stays flush. Below a matrix that
// turns otherwise rounded corners would come apart, so a group is evaluated first, where it is
// flush, and turned as a whole.
#include <trisect/bsp/csg/csg_evaluator.h>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/plane_hull.h>
#include <trisect/bsp/solid_transform.h>

#include <trisect/bsp/csg/csg_drawing.h>
#include <trisect/bsp/csg/csg_extrude.h>
#include <trisect/bsp/csg/csg_import.h>
#include <trisect/bsp/csg/csg_key.h>
#include <trisect/bsp/csg/csg_region.h>
#include <trisect/bsp/csg/csg_shapes.h>

namespace trisect::detail {
namespace {

constexpr std::size_t most_remarks = 100;

/// A region under a map, its corners rounded; nothing where the map tilts it, and for other solids.
std::optional<Solid> mapped_region(const Solid& solid, const AffineMap& map) {
    const auto flat = flat_outlines(solid);
    if (!flat) return std::nullopt;
    return flat_prism(flat->outlines(), OutlineRule::Positive, flat->low, flat->high, map);
}

/// As regions of the plane have, and extrusions may.
bool have_equal_heights(const std::vector<FlatOutlines>& flats) {
    return std::ranges::all_of(
        flats, [&](const auto& f) { return f.low == flats[0].low && f.high == flats[0].high; });
}

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
    for (const std::uint32_t n : program_.used_nodes())
        ++report_.by_name[program_.node(n).name].nodes;
    CsgFrame frame;
    if (options_.keeps_colors) frame.color = CsgFrame::no_color;
    Expression out = any_of(program_.roots(), program_.dimension(), frame);
    progress_.begin_formula();
    return out;
}

Solid CsgEvaluator::run() { return solid_of(formula()); }

// What is made of children, as a whole, once for equal content; also for the next program.
template <class Make>
Expression CsgEvaluator::kept_formula(std::uint32_t n, const CsgFrame& frame, const Make& make) {
    const std::string key = csg_key(program_, n, frame);
    if (const Expression* known = kept_.formula(key)) {
        note_found(n);
        return *known;
    }
    return kept_.keep_formula(key, make());
}

void CsgEvaluator::remark(std::uint32_t n, const std::string& text) {
    remark(program_.place(n) + ": " + text);
}

void CsgEvaluator::remark(std::string text) {
    if (report_.remarks.size() < most_remarks) report_.remarks.push_back(std::move(text));
}

void CsgEvaluator::note_found(std::uint32_t n) {
    ++report_.found_again;
    ++report_.by_name[program_.node(n).name].found_again;
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
        out.push_back(expression_or_empty(n, frame));
    }
    return out;
}

Expression CsgEvaluator::expression_or_empty(std::uint32_t n, const CsgFrame& frame) {
    if (!options_.leaves_out_refused) return expression_of(n, frame);
    try {
        return expression_of(n, frame);
    } catch (const CsgError& e) {
        if (e.code() != ErrorCode::Input && e.code() != ErrorCode::InvalidSolid &&
            e.code() != ErrorCode::Unsupported)
            throw;
        remark(std::string("left out: ") + e.what());
        return Solid();
    }
}

Expression CsgEvaluator::any_of(const std::vector<std::uint32_t>& children, int dimension,
                                const CsgFrame& frame) {
    return joined(terms_of(children, dimension, frame));
}

Expression CsgEvaluator::children_of(std::uint32_t n, const CsgFrame& frame) {
    return any_of(program_.node(n).children, program_.dimension(n), frame);
}

Expression CsgEvaluator::expression_of(std::uint32_t n, const CsgFrame& frame) {
    const CsgNodeProgress::Scope scope(progress_, n);
    return expression_of_kind(n, frame);
}

Expression CsgEvaluator::expression_of_kind(std::uint32_t n, const CsgFrame& frame) {
    switch (program_.kind(n)) {
        case CsgKind::Group:
            return group(n, frame);
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
            return program_.dimension(n) == 2 ? region(n, frame) : shape(n, frame);
        case CsgKind::Solid:
            return shape(n, frame);
        case CsgKind::Flat:
            return region(n, frame);
        case CsgKind::Unknown:
            break;
    }
    return Solid();
}

/// The outermost colour counts. Regions of it are one solid, which has a name.
Expression CsgEvaluator::group(std::uint32_t n, const CsgFrame& frame) {
    if (frame.color != CsgFrame::no_color || program_.node(n).name != "color")
        return children_of(n, frame);
    const CsgArguments in = program_.arguments(n);
    const CsgValue* const value = in.find("c");
    if (value == nullptr || value->list() == nullptr || value->list()->size() < 4)
        return children_of(n, frame);
    const std::vector<double> numbers = in.numbers(*value, 4);
    if (std::ranges::any_of(numbers, [](double x) { return x < 0; })) return children_of(n, frame);
    CsgFrame inner = frame;
    inner.color = kept_.number_of({numbers[0], numbers[1], numbers[2], numbers[3]});
    if (program_.dimension(n) != 2) return children_of(n, inner);
    return kept_formula(
        n, inner, [&]() -> Expression { return tinted(solid_of(children_of(n, inner)), inner); });
}

/// The same set with the colour, as a source of its own: for what has faces of many sources, and
/// for prisms over regions, which have none before they are cut. Those whose corners are doubles
/// stay meshes.
Solid CsgEvaluator::tinted(const Solid& solid, const CsgFrame& frame) {
    if (frame.color < 0 || solid.is_empty()) return solid;
    Solid out;
    if (const auto flat = flat_outlines(solid); flat && flat->is_exact) {
        ImportedMesh mesh = import_mesh(solid.to_mesh());
        if (is_embedded(mesh.mesh)) out = Solid::from_import(std::move(mesh));
    }
    if (out.is_empty()) out = Solid::from_brep(solid.to_brep());
    kept_.note_color(out.source_id(), frame.color);
    return out;
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

/// What is below a matrix that turns, before that.
Solid CsgEvaluator::turned_group(std::uint32_t n, const CsgFrame& frame) {
    const CsgFrame straight{AffineMap(), frame.low, frame.high, frame.color};
    const std::string key = csg_key(program_, n, straight, true);
    if (const Solid* known = kept_.solid(key)) {
        note_found(n);
        return *known;
    }
    return kept_.keep(key, solid_of(children_of(n, straight)));
}

Expression CsgEvaluator::turned(std::uint32_t n, const AffineMap& own, const CsgFrame& frame) {
    const AffineMap map = compose(frame.map, own);
    if (map.orientation() == 0) {
        remark(n, "left out, since the matrix makes it flat");
        return Solid();
    }
    if (changes_axes(map) || is_single(n))
        return children_of(n, {map, frame.low, frame.high, frame.color});
    return kept_formula(n, frame, [&]() -> Expression {
        const Solid group = turned_group(n, frame);
        if (group.is_empty()) return group;
        if (auto flat = mapped_region(group, map)) return *std::move(flat);
        return transformed(group, map);
    });
}

Solid CsgEvaluator::placed(std::uint32_t n, PolygonMesh mesh, const CsgFrame& frame) {
    if (mesh.face_count() == 0) {
        remark(n, "is empty");
        return {};
    }
    SolidOptions options;
    options.embedding = Embedding::Check;
    return at_node(n, [&] {
        if (frame.map != AffineMap()) mesh = transformed(std::move(mesh), frame.map);
        Solid out = Solid::from_mesh(mesh, options);
        kept_.note_color(out.source_id(), frame.color);
        return out;
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

/// Empty when no file is named, as OpenSCAD has it where a program named none.
std::filesystem::path CsgEvaluator::file_named(std::uint32_t n) {
    const CsgArguments in = program_.arguments(n);
    if (!options_.reads_files) in.fail(ErrorCode::Unsupported, "files are not read");
    const std::filesystem::path file = csg_file(in, options_.folder.value_or(program_.folder()));
    if (!file.empty()) kept_.note_file(file);
    std::error_code none;
    if (options_.missing_files_are_empty && !file.empty() && !std::filesystem::exists(file, none)) {
        remark(n, "there is no file " + file.string());
        return {};
    }
    return file;
}

PolygonMesh CsgEvaluator::file_of(std::uint32_t n) {
    const std::filesystem::path file = file_named(n);
    if (file.empty()) return {};
    const CsgArguments in = program_.arguments(n);
    return at_node(n, [&] {
        return program_.kind(n) == CsgKind::Import ? csg_import(in, file) : csg_surface(in, file);
    });
}

Expression CsgEvaluator::shape(std::uint32_t n, const CsgFrame& frame) {
    ++report_.leaves;
    const std::string key = csg_key(program_, n, frame);
    if (const Solid* known = kept_.solid(key)) {
        note_found(n);
        return *known;
    }
    ++report_.meshes;
    return kept_.keep(key, placed(n, mesh_of(n), frame));
}

Drawing CsgEvaluator::drawing_of(std::uint32_t n) {
    if (program_.kind(n) == CsgKind::Import) return drawing_file(n);
    const CsgArguments in = program_.arguments(n);
    if (program_.node(n).name == "text") return at_node(n, [&] { return csg_text(in); });
    return {{{outlines_of(program_.node(n), in), {}}}, {}};
}

/// Scaled by the argument `scale`, but for linear_extrude(), whose scale is that of its end.
Drawing CsgEvaluator::drawing_file(std::uint32_t n) {
    const std::filesystem::path file = file_named(n);
    if (file.empty()) return {};
    const CsgArguments in = program_.arguments(n);
    const double scale = program_.kind(n) == CsgKind::Linear ? 1 : in.number("scale", 1);
    return at_node(n, [&] { return csg_drawing_file(in, file, scale); });
}

Expression CsgEvaluator::prism_of_drawing(std::uint32_t n, Drawing drawing, const CsgFrame& frame) {
    ++report_.meshes;
    for (const std::string& text : drawing.remarks) remark(n, text);
    const bool has_outlines = std::any_of(
        drawing.shapes.begin(), drawing.shapes.end(),
        [](const DrawingShape& s) { return !s.outlines.empty() || !s.strokes.empty(); });
    if (!has_outlines) remark(n, "is empty");
    return at_node(n, [&] { return drawing_prism(std::move(drawing), frame); });
}

Expression CsgEvaluator::region(std::uint32_t n, const CsgFrame& frame) {
    ++report_.leaves;
    const std::string key = csg_key(program_, n, frame);
    if (const Expression* known = kept_.formula(key)) {
        note_found(n);
        return *known;
    }
    return kept_.keep_formula(key, prism_of_drawing(n, drawing_of(n), frame));
}

/// Old programs name a drawing instead of children.
bool CsgEvaluator::names_drawing(std::uint32_t n) const {
    return !csg_file(program_.arguments(n), {}).empty();
}

/// Another key than that of the extrusion itself.
Expression CsgEvaluator::named_drawing(std::uint32_t n, const CsgFrame& frame) {
    ++report_.leaves;
    const std::string key = csg_key(program_, n, frame) + "drawing";
    if (const Expression* known = kept_.formula(key)) {
        note_found(n);
        return *known;
    }
    return kept_.keep_formula(key, prism_of_drawing(n, drawing_file(n), frame));
}

Expression CsgEvaluator::flat_content(std::uint32_t n, const CsgFrame& frame) {
    return names_drawing(n) ? named_drawing(n, frame) : any_of(program_.node(n).children, 2, frame);
}

Expression CsgEvaluator::linear(std::uint32_t n, const CsgFrame& frame) {
    const CsgArguments in = program_.arguments(n);
    const double height = in.number("height", 100);
    if (!(height > 0)) {
        remark(n, "is empty");
        return Solid();
    }
    const double low = in.truth("center", false) ? -height / 2 : 0;
    if (is_straight(in)) {
        const CsgFrame slab{frame.map, low, low + height};
        if (frame.color < 0) return resolved(flat_content(n, slab));
        return kept_formula(n, frame, [&]() -> Expression {
            return tinted(solid_of(flat_content(n, slab)), frame);
        });
    }
    return kept_formula(n, frame, [&]() -> Expression {
        const PlaneRegion base = base_of(n);
        return placed(n, at_node(n, [&] { return csg_twisted(base, in, low, low + height); }),
                      frame);
    });
}

Expression CsgEvaluator::revolved(std::uint32_t n, const CsgFrame& frame) {
    const PlaneRegion base = base_of(n);
    return placed(n, at_node(n, [&] { return csg_revolved(base, program_.arguments(n)); }), frame);
}

/// Of regions that lie in one plane one solid is left, so that what is flat in a program of solids
/// costs what it would cost by itself.
Expression CsgEvaluator::resolved(const Expression& formula) {
    const auto flat = evaluate_flat_prisms(formula, options_.evaluate);
    return flat ? Expression(*flat) : formula;
}

PlaneRegion CsgEvaluator::base_of(std::uint32_t n) {
    return region_of_faces(solid_of(flat_content(n, CsgFrame())), 1);
}

Expression CsgEvaluator::hull(std::uint32_t n, const CsgFrame& frame) {
    std::vector<Point3d> points;
    std::vector<FlatOutlines> flats;
    for (const std::uint32_t c : program_.used_children(n)) {
        if (program_.dimension(c) != 0 && program_.dimension(c) != program_.dimension(n)) continue;
        const Solid solid = solid_of(expression_of(c, {frame.map, frame.low, frame.high}));
        if (auto flat = flat_outlines(solid)) {
            flats.push_back(*std::move(flat));
            continue;
        }
        const PolygonMesh mesh = solid.to_mesh();
        points.insert(points.end(), mesh.points.begin(), mesh.points.end());
    }
    if (points.empty() && flats.empty()) return Solid();
    if (points.empty() && have_equal_heights(flats)) {
        std::vector<Point2d> corners;
        for (const FlatOutlines& f : flats)
            corners.insert(corners.end(), f.points.begin(), f.points.end());
        return tinted(flat_prism(std::array{hull_of_points(corners)}, OutlineRule::Positive,
                                 flats[0].low, flats[0].high),
                      frame);
    }
    for (const FlatOutlines& f : flats)
        for (const auto& [x, y] : f.points)
            for (const double z : {f.low, f.high}) points.push_back({x, y, z});
    return at_node(n, [&] {
        return placed(n, make_hull(points), {AffineMap(), frame.low, frame.high, frame.color});
    });
}

}  // namespace trisect::detail
