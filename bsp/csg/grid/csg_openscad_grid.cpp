// SPDX-License-Identifier: Apache-2.0
//
// What OpenSCAD (version 2021.01) does, found by reading what it says and what it writes: a shape
// stays a list of polygons in doubles as long as matrices and groups with one child stand above it,
// and becomes a set on the grid at the first boolean, or at the end.
#include <trisect/bsp/csg/grid/csg_openscad_grid.h>

#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_transform.h>

#include <trisect/bsp/csg/csg_frame.h>
#include <trisect/bsp/csg/csg_node_progress.h>
#include <trisect/bsp/csg/csg_program.h>
#include <trisect/bsp/csg/csg_shapes.h>
#include <trisect/bsp/csg/grid/csg_grid_points.h>

namespace trisect::detail {
namespace {

constexpr std::size_t most_remarks = 100;

/// Polygons in doubles, or an exact set; neither where nothing is.
struct Geometry {
    enum class Kind { Nothing, Polygons, Set } kind = Kind::Nothing;
    PolygonMesh polygons;
    bool is_convex = false;  ///< by what it is
    std::uint32_t shape = 0;
    Solid set;

    [[nodiscard]] bool is_empty() const {
        return kind == Kind::Nothing ||
               (kind == Kind::Polygons ? polygons.face_count() == 0 : set.is_empty());
    }
};

class GridEvaluator {
public:
    GridEvaluator(const CsgProgram& program, const CsgOptions& options, CsgReport& report)
        : program_(program), options_(options), report_(report), progress_(program, options) {
        for (const std::uint32_t n : program.used_nodes()) {
            check(n);
            ++report_.by_name[program.node(n).name].nodes;
        }
    }

    Solid run() {
        Geometry all = united(geometries_of(program_.roots()));
        progress_.begin_formula();
        return set_of(all);
    }

private:
    void check(std::uint32_t n) const {
        const std::string& name = program_.node(n).name;
        switch (program_.kind(n)) {
            case CsgKind::Group:
            case CsgKind::Difference:
            case CsgKind::Intersection:
            case CsgKind::Matrix:
                return;
            case CsgKind::Solid:
                if (name != "surface") return;
                break;
            default:
                break;
        }
        program_.arguments(n).fail(
            ErrorCode::Unsupported,
            "OpenSCAD's grid is for cubes, spheres, cylinders, polyhedra, matrices and booleans");
    }

    void remark(std::uint32_t n, const std::string& text) {
        if (report_.remarks.size() < most_remarks)
            report_.remarks.push_back(program_.place(n) + ": " + text);
    }

    std::vector<Geometry> geometries_of(const std::vector<std::uint32_t>& children) {
        std::vector<Geometry> out;
        for (const std::uint32_t n : program_.used(children)) out.push_back(geometry_of(n));
        return out;
    }

    Geometry geometry_of(std::uint32_t n) {
        const CsgNodeProgress::Scope scope(progress_, n);
        switch (program_.kind(n)) {
            case CsgKind::Group:
                return united(geometries_of(program_.node(n).children));
            case CsgKind::Difference:
            case CsgKind::Intersection:
                return combined(n);
            case CsgKind::Matrix:
                return moved(n);
            default:
                return shape_of(n);
        }
    }

    Geometry shape_of(std::uint32_t n) {
        const std::string& name = program_.node(n).name;
        const CsgArguments in = program_.arguments(n);
        ++report_.leaves;
        ++report_.meshes;
        Geometry out;
        out.kind = Geometry::Kind::Polygons;
        out.shape = n;
        out.is_convex = name != "polyhedron";
        if (name == "cube")
            out.polygons = csg_cube(in);
        else if (name == "sphere")
            out.polygons = csg_sphere(in);
        else if (name == "cylinder")
            out.polygons = csg_cylinder(in);
        else
            out.polygons = csg_polyhedron(in);
        return out;
    }

    Geometry united(std::vector<Geometry> all) {
        if (all.size() == 1) return std::move(all[0]);
        std::erase_if(all, [](const Geometry& g) { return g.is_empty(); });
        if (all.empty()) return {};
        if (all.size() == 1) return std::move(all[0]);
        std::vector<Solid> sets;
        for (Geometry& g : all) sets.push_back(set_of(g));
        return evaluated(Expression::any_of(sets));
    }

    Geometry combined(std::uint32_t n) {
        std::vector<Geometry> all = geometries_of(program_.node(n).children);
        if (all.empty()) return {};
        if (all.size() == 1) return std::move(all[0]);
        const bool is_difference = program_.kind(n) == CsgKind::Difference;
        Expression out = set_of(all[0]);
        for (std::size_t i = 1; i < all.size(); ++i) {
            const Solid other = set_of(all[i]);
            out = is_difference ? out - other : out & other;
        }
        return evaluated(out);
    }

    Geometry evaluated(const Expression& formula) {
        ++report_.evaluations;
        Geometry out;
        out.kind = Geometry::Kind::Set;
        out.set = evaluate(formula, options_.evaluate);
        return out;
    }

    Geometry moved(std::uint32_t n) {
        const AffineMap map = csg_matrix(program_.arguments(n), false);
        Geometry out = united(geometries_of(program_.node(n).children));
        if (out.is_empty()) return out;
        if (map.orientation() == 0) {
            remark(n, "left out, since the matrix makes it flat");
            return {};
        }
        if (out.kind == Geometry::Kind::Polygons) {
            out.polygons = moved_in_doubles(out.polygons, map);
            return out;
        }
        LatticeReport lattice;
        out.set = transformed(out.set, map, &lattice);
        if (!lattice.lossless)
            remark(n, "corners that a boolean made are rounded here, and not in OpenSCAD");
        return out;
    }

    Solid set_of(Geometry& geometry) {
        if (geometry.is_empty()) return {};
        if (geometry.kind == Geometry::Kind::Set) return geometry.set;
        const std::uint32_t n = geometry.shape;
        const auto polygons = on_openscad_grid(geometry.polygons);
        if (!polygons)
            program_.arguments(n).fail(ErrorCode::Unsupported,
                                       "a corner is beyond the cells of OpenSCAD's grid");
        if (polygons->face_count() == 0) return {};
        return at_place(n, [&] {
            if (geometry.is_convex || is_about_convex(*polygons)) return hull_of(n, *polygons);
            ImportedMesh mesh = import_mesh(*polygons);
            if (mesh.report.nonplanar_faces > 0)
                remark(n, "faces that are not flat have other triangles in OpenSCAD, in floats");
            return Solid::from_import(std::move(mesh), Embedding::Check);
        });
    }

    Solid hull_of(std::uint32_t n, const PolygonMesh& polygons) {
        try {
            return Solid::from_mesh(make_hull(polygons.points));
        } catch (const UsageError&) {
            remark(n, "left out, since all its corners lie in one plane");
            return {};
        }
    }

    /// \throw CsgError with the place of the node
    template <class Work>
    Solid at_place(std::uint32_t n, const Work& work) {
        try {
            return work();
        } catch (const CsgError&) {
            throw;
        } catch (const CancelledError&) {
            throw;
        } catch (const Error& e) {
            program_.arguments(n).fail(e.code(), e.what());
        }
    }

    const CsgProgram& program_;
    const CsgOptions& options_;
    CsgReport& report_;
    CsgNodeProgress progress_;
};

}  // namespace
}  // namespace trisect::detail

namespace trisect {

Solid evaluate_on_openscad_grid(const CsgTree& tree, const CsgOptions& options, CsgReport* report) {
    CsgReport own;
    CsgReport& out = report == nullptr ? own : *report;
    out = CsgReport();
    out.nodes = tree.nodes.size();
    const detail::CsgProgram program(tree);
    return detail::GridEvaluator(program, options, out).run();
}

}  // namespace trisect
