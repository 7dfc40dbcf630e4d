// SPDX-License-Identifier: Apache-2.0
//
// Writing STEP: AP214, one product, a B-rep of advanced faces for each closed shell of each part
// with its voids, a surface model for each open one. Edges and vertices are shared. The vertices
// are the mesh's own doubles; planes and lines are given through them with normals rounded to
// doubles, so faces fit by the uncertainty that the file states.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/models/step/bodies.h>
#include <trisect/brep/io/models/step/face_normal.h>
#include <trisect/brep/io/models/step/string.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>

namespace trisect::detail {
namespace {

/// The shortest digits that read back, with the point and the exponent as the format wants them.
std::string step_real(double value) {
    std::array<char, 40> digits{};
    char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    std::string text(digits.data(), end);
    const std::size_t e = text.find('e');
    const std::size_t mantissa = std::min(e, text.size());
    if (e != std::string::npos) text[e] = 'E';
    if (text.find('.') == std::string::npos) text.insert(mantissa, ".");
    return text;
}

std::string reference(std::uint64_t id) { return "#" + std::to_string(id); }

std::string triple_text(const Point3d& p) {
    return "(" + step_real(p[0]) + "," + step_real(p[1]) + "," + step_real(p[2]) + ")";
}

/// Some direction perpendicular to a unit vector, of length 1.
Point3d perpendicular_to(const Point3d& n) {
    std::size_t least = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(n[k]) < std::fabs(n[least])) least = k;
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = (k == least ? 1 : 0) - n[least] * n[k];
    const double length = std::hypot(out[0], out[1], out[2]);
    for (double& c : out) c /= length;
    return out;
}

/// From a to b, of length 1; also where the difference is near the ends of the range of doubles.
Point3d direction_between(const Point3d& a, const Point3d& b) {
    Point3d d{};
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        d[k] = b[k] / 2 - a[k] / 2;
        largest = std::max(largest, std::fabs(d[k]));
    }
    if (largest == 0)
        for (std::size_t k = 0; k < 3; ++k) d[k] = b[k] - a[k];
    for (const double c : d) largest = std::max(largest, std::fabs(c));
    for (double& c : d) c /= largest;
    const double length = std::hypot(d[0], d[1], d[2]);
    for (double& c : d) c /= length;
    return d;
}

/// The power of ten that is a trillionth of the largest coordinate, or a little more.
double uncertainty_of(const Model& model) {
    double most = 0;
    for (const ModelPart& part : model.parts)
        for (const Point3d& p : part.mesh.points)
            for (const double c : p) most = std::max(most, std::fabs(c));
    const int exponent = most > 0 ? static_cast<int>(std::ceil(std::log10(most))) - 12 : -12;
    // Read from text, so that it is the double nearest to the power.
    const std::string text = "1e" + std::to_string(std::clamp(exponent, -300, 300));
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> faces_off_planes_of(const Model& model) {
    const double uncertainty = uncertainty_of(model);
    std::vector<std::vector<std::uint32_t>> out;
    for (const ModelPart& part : model.parts) {
        auto& faces = out.emplace_back();
        for (std::uint32_t f = 0; f < part.mesh.face_count(); ++f) {
            const auto face = part.mesh.face(f);
            if (face.size() == 3) continue;
            const auto normal = face_normal(part.mesh.points, face);
            if (normal && distance_from_plane(part.mesh.points, face, *normal) > uncertainty)
                faces.push_back(f);
        }
    }
    return out;
}

namespace {

class StepWriter {
public:
    StepWriter(const Model& model, const std::string& name) : model_(model), name_(name) {}

    std::string write() {
        out_ =
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('solids of planar faces'),'2;1');\n"
            "FILE_NAME('','1970-01-01T00:00:00',(''),(''),'Trisect','Trisect','');\n"
            "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n";
        const double uncertainty = uncertainty_of(model_);
        const std::uint64_t shape = add_product();
        const std::uint64_t context = add_context(uncertainty);
        for (const ModelPart& part : model_.parts)
            if (part.mesh.face_count() != 0) add_part(part, uncertainty);
        add_representation("ADVANCED_BREP_SHAPE_REPRESENTATION", solids_, shape, context);
        add_representation("MANIFOLD_SURFACE_SHAPE_REPRESENTATION", surfaces_, shape, context);
        add_looks(context);
        out_ += "ENDSEC;\nEND-ISO-10303-21;\n";
        return std::move(out_);
    }

private:
    std::uint64_t add(std::string_view text) {
        out_ += '#';
        out_ += std::to_string(++last_);
        out_ += '=';
        out_ += text;
        out_ += ";\n";
        return last_;
    }

    static std::string list(const std::vector<std::uint64_t>& ids) {
        std::string out = "(";
        for (std::size_t i = 0; i < ids.size(); ++i) {
            // Lines of files stay short.
            if (i != 0) out += i % 16 == 0 ? ",\n" : ",";
            out += reference(ids[i]);
        }
        return out + ")";
    }

    /// Returns the PRODUCT_DEFINITION_SHAPE.
    std::uint64_t add_product() {
        const std::uint64_t application = add("APPLICATION_CONTEXT('automotive design')");
        add("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000," +
            reference(application) + ")");
        const std::uint64_t context =
            add("PRODUCT_CONTEXT(''," + reference(application) + ",'mechanical')");
        const std::string title =
            step_quoted(model_.parts.size() == 1 ? model_.parts[0].name : std::string());
        const std::uint64_t product =
            add("PRODUCT(" + title + "," + title + ",''," + list({context}) + ")");
        add("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$," + list({product}) + ")");
        const std::uint64_t formation =
            add("PRODUCT_DEFINITION_FORMATION('',''," + reference(product) + ")");
        const std::uint64_t definition_context =
            add("PRODUCT_DEFINITION_CONTEXT('part definition'," + reference(application) +
                ",'design')");
        const std::uint64_t definition =
            add("PRODUCT_DEFINITION('design',''," + reference(formation) + "," +
                reference(definition_context) + ")");
        return add("PRODUCT_DEFINITION_SHAPE('',''," + reference(definition) + ")");
    }

    std::uint64_t add_metric(const char* prefix) {
        return add(std::string("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(") + prefix + ",.METRE.))");
    }

    std::uint64_t add_conversion(const char* name, double millimetres) {
        const std::uint64_t exponents = add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
        const std::uint64_t base = add_metric(".MILLI.");
        const std::uint64_t factor = add("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(" +
                                         step_real(millimetres) + ")," + reference(base) + ")");
        return add("(CONVERSION_BASED_UNIT('" + std::string(name) + "'," + reference(factor) +
                   ") LENGTH_UNIT() NAMED_UNIT(" + reference(exponents) + "))");
    }

    /// Millimetres where the model has no unit, as in 3MF.
    std::uint64_t add_length_unit() {
        const std::string& unit = model_.unit;
        if (unit.empty() || unit == "millimeter") return add_metric(".MILLI.");
        constexpr std::array<std::array<const char*, 2>, 7> metric{{{"meter", "$"},
                                                                    {"centimeter", ".CENTI."},
                                                                    {"micron", ".MICRO."},
                                                                    {"decimeter", ".DECI."},
                                                                    {"nanometer", ".NANO."},
                                                                    {"kilometer", ".KILO."},
                                                                    {"decameter", ".DECA."}}};
        for (const auto& [known, prefix] : metric)
            if (unit == known) return add_metric(prefix);
        if (unit == "inch") return add_conversion("INCH", 25.4);
        if (unit == "foot" || unit == "feet") return add_conversion("FOOT", 304.8);
        throw UnsupportedError(name_ + ": cannot write: STEP has no unit " + unit);
    }

    std::uint64_t add_context(double uncertainty) {
        const std::uint64_t length = add_length_unit();
        const std::uint64_t angle = add("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.))");
        const std::uint64_t solid_angle =
            add("(NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT())");
        const std::uint64_t measure =
            add("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(" + step_real(uncertainty) + ")," +
                reference(length) + ",'distance_accuracy_value','')");
        return add("(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(" +
                   list({measure}) + ") GLOBAL_UNIT_ASSIGNED_CONTEXT(" +
                   list({length, angle, solid_angle}) + ") REPRESENTATION_CONTEXT('',''))");
    }

    void add_representation(const char* keyword, const std::vector<std::uint64_t>& items,
                            std::uint64_t shape, std::uint64_t context) {
        if (items.empty() && !(solids_.empty() && surfaces_.empty() && keyword[0] == 'A')) return;
        const std::uint64_t representation =
            add(std::string(keyword) + "(''," + list(items) + "," + reference(context) + ")");
        add("SHAPE_DEFINITION_REPRESENTATION(" + reference(shape) + "," +
            reference(representation) + ")");
    }

    std::uint64_t add_direction(const Point3d& d) {
        return add("DIRECTION(''," + triple_text(d) + ")");
    }

    void add_part(const ModelPart& part, double uncertainty) {
        const StepBodies bodies = step_bodies(part.mesh, uncertainty, name_);
        points_.assign(bodies.points.size(), 0);
        vertices_.assign(bodies.points.size(), 0);
        edges_.assign(bodies.edges.size(), 0);
        face_ids_.assign(bodies.faces.size(), 0);
        const std::string title = step_quoted(part.name);
        for (const StepBody& body : bodies.bodies) {
            const StepShell& outer = bodies.shells[body.shell];
            const std::uint64_t shell = add_shell(bodies, outer, false);
            if (!outer.is_closed) {
                surfaces_.push_back(
                    add("SHELL_BASED_SURFACE_MODEL(" + title + "," + list({shell}) + ")"));
                continue;
            }
            if (body.voids.empty()) {
                solids_.push_back(
                    add("MANIFOLD_SOLID_BREP(" + title + "," + reference(shell) + ")"));
                continue;
            }
            std::vector<std::uint64_t> voids;
            for (const std::uint32_t v : body.voids) {
                const std::uint64_t turned = add_shell(bodies, bodies.shells[v], true);
                voids.push_back(add("ORIENTED_CLOSED_SHELL('',*," + reference(turned) + ",.F.)"));
            }
            solids_.push_back(
                add("BREP_WITH_VOIDS(" + title + "," + reference(shell) + "," + list(voids) + ")"));
        }
        for (std::size_t f = 0; f < part.materials.size(); ++f)
            if (part.materials[f] != no_material)
                colored_.emplace_back(face_ids_[f], part.materials[f]);
    }

    /// A void is written as the boundary of what is in it, and referred to the other way round.
    std::uint64_t add_shell(const StepBodies& bodies, const StepShell& shell, bool is_turned) {
        std::vector<std::uint64_t> faces;
        for (const std::uint32_t f : shell.faces) {
            face_ids_[f] = add_face(bodies, bodies.faces[f], is_turned);
            faces.push_back(face_ids_[f]);
        }
        return add(std::string(shell.is_closed ? "CLOSED" : "OPEN") + "_SHELL(''," + list(faces) +
                   ")");
    }

    std::uint64_t add_face(const StepBodies& bodies, const StepFace& face, bool is_turned) {
        std::vector<std::uint64_t> bounds;
        for (std::size_t l = 0; l < face.loops.size(); ++l) {
            std::vector<std::uint64_t> sides;
            for (const StepEdgeUse& use : face.edges[l]) {
                const std::uint64_t edge = add_edge(bodies, use.edge);
                sides.push_back(add("ORIENTED_EDGE('',*,*," + reference(edge) +
                                    (use.is_forward != is_turned ? ",.T.)" : ",.F.)")));
            }
            if (is_turned) std::reverse(sides.begin(), sides.end());
            const std::uint64_t loop = add("EDGE_LOOP(''," + list(sides) + ")");
            bounds.push_back(add((l == 0 ? "FACE_OUTER_BOUND(''," : "FACE_BOUND('',") +
                                 reference(loop) + ",.T.)"));
        }
        Point3d normal = face.normal;
        if (is_turned)
            for (double& c : normal) c = 0 - c;
        const std::uint64_t axis = add_direction(normal);
        const std::uint64_t side = add_direction(perpendicular_to(normal));
        const std::uint64_t place =
            add("AXIS2_PLACEMENT_3D(''," + reference(add_point(bodies, face.loops[0][0])) + "," +
                reference(axis) + "," + reference(side) + ")");
        const std::uint64_t plane = add("PLANE(''," + reference(place) + ")");
        return add("ADVANCED_FACE(''," + list(bounds) + "," + reference(plane) + ",.T.)");
    }

    std::uint64_t add_edge(const StepBodies& bodies, std::uint32_t number) {
        std::uint64_t& id = edges_[number];
        if (id != 0) return id;
        const auto [a, b] = bodies.edges[number];
        const std::uint64_t first = add_vertex(bodies, a);
        const std::uint64_t last = add_vertex(bodies, b);
        const std::uint64_t direction =
            add_direction(direction_between(bodies.points[a], bodies.points[b]));
        const std::uint64_t vector = add("VECTOR(''," + reference(direction) + ",1.)");
        const std::uint64_t line =
            add("LINE(''," + reference(points_[a]) + "," + reference(vector) + ")");
        id = add("EDGE_CURVE(''," + reference(first) + "," + reference(last) + "," +
                 reference(line) + ",.T.)");
        return id;
    }

    std::uint64_t add_vertex(const StepBodies& bodies, std::uint32_t number) {
        if (vertices_[number] == 0)
            vertices_[number] =
                add("VERTEX_POINT(''," + reference(add_point(bodies, number)) + ")");
        return vertices_[number];
    }

    std::uint64_t add_point(const StepBodies& bodies, std::uint32_t number) {
        if (points_[number] == 0)
            points_[number] = add("CARTESIAN_POINT(''," + triple_text(bodies.points[number]) + ")");
        return points_[number];
    }

    /// Colours of faces, as other programs show them.
    void add_looks(std::uint64_t context) {
        std::map<std::uint32_t, std::uint64_t> styles;
        std::vector<std::uint64_t> items;
        for (const auto& [face, material] : colored_) {
            const ModelMaterial& m = model_.materials[material];
            if (!m.color || face == 0) continue;
            std::uint64_t& style = styles[material];
            if (style == 0) style = add_style(m);
            items.push_back(add("STYLED_ITEM(''," + list({style}) + "," + reference(face) + ")"));
        }
        if (items.empty()) return;
        add("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION(''," + list(items) + "," +
            reference(context) + ")");
    }

    std::uint64_t add_style(const ModelMaterial& m) {
        const ModelColor& c = *m.color;
        const std::uint64_t color =
            add("COLOUR_RGB(" + step_quoted(m.name) + "," + step_real(c[0] / 255.0) + "," +
                step_real(c[1] / 255.0) + "," + step_real(c[2] / 255.0) + ")");
        const std::uint64_t fill_color = add("FILL_AREA_STYLE_COLOUR(''," + reference(color) + ")");
        const std::uint64_t fill = add("FILL_AREA_STYLE(''," + list({fill_color}) + ")");
        const std::uint64_t area = add("SURFACE_STYLE_FILL_AREA(" + reference(fill) + ")");
        const std::uint64_t side = add("SURFACE_SIDE_STYLE(''," + list({area}) + ")");
        const std::uint64_t usage = add("SURFACE_STYLE_USAGE(.BOTH.," + reference(side) + ")");
        return add("PRESENTATION_STYLE_ASSIGNMENT(" + list({usage}) + ")");
    }

    const Model& model_;
    const std::string& name_;
    std::string out_;
    std::uint64_t last_ = 0;
    std::vector<std::uint64_t> solids_;
    std::vector<std::uint64_t> surfaces_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> colored_;  ///< face and material
    // Of the part at hand, by number: the entity, or 0.
    std::vector<std::uint64_t> points_;
    std::vector<std::uint64_t> vertices_;
    std::vector<std::uint64_t> edges_;
    std::vector<std::uint64_t> face_ids_;
};

}  // namespace

FormattedMesh write_step(const Model& model, const std::string& name) {
    FormattedMesh out;
    out.bytes = StepWriter(model, name).write();
    return out;
}

}  // namespace trisect::detail
