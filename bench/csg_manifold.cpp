// SPDX-License-Identifier: Apache-2.0
#include "csg_manifold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <manifold/cross_section.h>
#include <manifold/manifold.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/bsp/csg/csg_drawing.h>
#include <trisect/bsp/csg/csg_extrude.h>
#include <trisect/bsp/csg/csg_frame.h>
#include <trisect/bsp/csg/csg_import.h>
#include <trisect/bsp/csg/csg_key.h>
#include <trisect/bsp/csg/csg_program.h>
#include <trisect/bsp/csg/csg_shapes.h>

namespace bench {
namespace {

using manifold::CrossSection;
using manifold::Manifold;
using manifold::MeshGL64;
using manifold::OpType;
using trisect::AffineMap;
using trisect::CsgOptions;
using trisect::Outline;
using trisect::PlaneRegion;
using trisect::PolygonMesh;
using trisect::detail::CsgArguments;
using trisect::detail::CsgFrame;
using trisect::detail::CsgKind;
using trisect::detail::CsgProgram;
using trisect::detail::Drawing;
using Index = std::uint32_t;

MeshGL64 arrays_of(const PolygonMesh& mesh) {
    MeshGL64 out;
    out.numProp = 3;
    for (const auto& p : mesh.points)
        out.vertProperties.insert(out.vertProperties.end(), p.begin(), p.end());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            out.triVerts.insert(out.triVerts.end(), {loop[0], loop[i], loop[i + 1]});
    }
    return out;
}

/// Faces of files and polyhedra need not be convex, and their points may be there several times:
/// import connects them and makes triangles.
MeshGL64 connected_arrays_of(const PolygonMesh& mesh) {
    const trisect::LatticeMesh lattice = trisect::import_mesh(mesh).mesh;
    MeshGL64 out;
    out.numProp = 3;
    for (const trisect::LatticePoint& p : lattice.points)
        for (std::size_t k = 0; k < 3; ++k)
            out.vertProperties.push_back(lattice.lattice.to_double(p[k].to_double()));
    for (const auto& t : lattice.triangles)
        out.triVerts.insert(out.triVerts.end(), t.begin(), t.end());
    return out;
}

manifold::Polygons polygons_of(const std::vector<Outline>& outlines) {
    manifold::Polygons out;
    for (const Outline& outline : outlines) {
        manifold::SimplePolygon& polygon = out.emplace_back();
        for (const auto& p : outline) polygon.emplace_back(p[0], p[1]);
    }
    return out;
}

CrossSection even_odd(const std::vector<Outline>& outlines) {
    return CrossSection::EvenOdd(polygons_of(outlines));
}

/// Corners alone, for the numbers of slices and steps that extrusions of it have.
PlaneRegion corners_of(const manifold::Polygons& polygons) {
    PlaneRegion out;
    for (const auto& polygon : polygons)
        for (const auto& p : polygon) out.points.push_back({p.x, p.y});
    return out;
}

std::vector<Outline> outlines_of(const std::string& name, const CsgArguments& in) {
    if (name == "square") return trisect::detail::csg_square(in);
    if (name == "circle") return trisect::detail::csg_circle(in);
    return trisect::detail::csg_polygon(in);
}

class Evaluator {
public:
    Evaluator(const CsgProgram& program, const CsgOptions& options)
        : program_(program), options_(options) {}

    [[nodiscard]] Manifold solid() { return any_solid(program_.roots()); }
    [[nodiscard]] CrossSection region() { return any_region(program_.roots()); }
    [[nodiscard]] std::size_t approximate() const { return approximate_; }

private:
    [[noreturn]] void refuse(Index n, const std::string& why) const {
        throw std::runtime_error(program_.node(n).name + ": " + why);
    }
    Manifold checked(Index n, Manifold m) const {
        if (m.Status() != Manifold::Error::NoError)
            refuse(n, "status " + std::to_string(static_cast<int>(m.Status())));
        return m;
    }
    /// What is made once for equal content at the origin.
    template <class T, class Make>
    T kept(std::map<std::string, T>& known, Index n, bool children_only, const Make& make) {
        const std::string key = trisect::detail::csg_key(program_, n, CsgFrame(), children_only) +
                                (children_only ? "children" : "");
        const auto it = known.find(key);
        return it != known.end() ? it->second : known.emplace(key, make()).first->second;
    }

    // Groups.
    std::vector<Index> of_dimension(const std::vector<Index>& nodes, int dimension) const {
        std::vector<Index> out;
        for (const Index n : program_.used(nodes))
            if (program_.dimension(n) == 0 || program_.dimension(n) == dimension) out.push_back(n);
        return out;
    }
    std::vector<Manifold> solids(const std::vector<Index>& nodes) {
        std::vector<Manifold> out;
        for (const Index n : of_dimension(nodes, 3)) out.push_back(solid_of(n));
        return out;
    }
    std::vector<CrossSection> regions(const std::vector<Index>& nodes) {
        std::vector<CrossSection> out;
        for (const Index n : of_dimension(nodes, 2)) out.push_back(region_of(n));
        return out;
    }
    template <class T>
    static T combined(const std::vector<T>& all, OpType type) {
        if (all.empty()) return {};
        return all.size() == 1 ? all[0] : T::BatchBoolean(all, type);
    }
    Manifold any_solid(const std::vector<Index>& nodes) {
        return combined(solids(nodes), OpType::Add);
    }
    CrossSection any_region(const std::vector<Index>& nodes) {
        return combined(regions(nodes), OpType::Add);
    }
    const std::vector<Index>& children(Index n) const { return program_.node(n).children; }
    bool lacks_operands(Index n, std::size_t count) const {
        return count < program_.used_children(n).size();
    }

    // Solids.
    Manifold solid_of(Index n) {
        switch (program_.kind(n)) {
            case CsgKind::Group:
                return any_solid(children(n));
            case CsgKind::Difference:
                return combined(solids(children(n)), OpType::Subtract);
            case CsgKind::Intersection: {
                const auto all = solids(children(n));
                return lacks_operands(n, all.size()) ? Manifold()
                                                     : combined(all, OpType::Intersect);
            }
            case CsgKind::Matrix:
                return kept(groups_, n, true, [&] { return any_solid(children(n)); })
                    .Transform(matrix(n));
            case CsgKind::Hull:
                return kept(solids_, n, false, [&] { return Manifold::Hull(solids(children(n))); });
            case CsgKind::Minkowski:
                return kept(solids_, n, false, [&] { return minkowski(n); });
            case CsgKind::Linear:
                return kept(solids_, n, false, [&] { return linear(n); });
            case CsgKind::Revolved:
                return kept(solids_, n, false, [&] { return revolved(n); });
            case CsgKind::Resize:
                return resized(n);
            default:
                return kept(solids_, n, false, [&] { return checked(n, shape(n)); });
        }
    }

    manifold::mat3x4 matrix(Index n) const {
        const AffineMap map = trisect::detail::csg_matrix(program_.arguments(n), false);
        manifold::mat3x4 out;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                out[column][row] =
                    map.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        return out;
    }

    Manifold shape(Index n) {
        const std::string& name = program_.node(n).name;
        const CsgArguments in = program_.arguments(n);
        if (name == "cube") {
            const auto size = in.numbers("size", 3, 1);
            if (!(size[0] > 0 && size[1] > 0 && size[2] > 0)) return {};
            return Manifold::Cube({size[0], size[1], size[2]}, in.truth("center", false));
        }
        if (name == "cylinder") return cylinder(in);
        if (name == "sphere") return from_mesh(trisect::detail::csg_sphere(in), false);
        if (name == "polyhedron") return from_mesh(trisect::detail::csg_polyhedron(in), true);
        const std::filesystem::path file = file_of(in);
        if (file.empty()) return {};
        return from_mesh(program_.kind(n) == CsgKind::Import
                             ? trisect::detail::csg_import(in, file)
                             : trisect::detail::csg_surface(in, file),
                         true);
    }

    static Manifold from_mesh(const PolygonMesh& mesh, bool connect) {
        if (mesh.face_count() == 0) return {};
        return Manifold(connect ? connected_arrays_of(mesh) : arrays_of(mesh));
    }

    static Manifold cylinder(const CsgArguments& in) {
        const double height = in.number("h", 1);
        const double r1 = in.number("r1", in.number("r", 1));
        const double r2 = in.number("r2", in.number("r", 1));
        if (!(height > 0) || r1 < 0 || r2 < 0 || !(std::max(r1, r2) > 0)) return {};
        const auto n = trisect::detail::csg_fragments(in, std::max(r1, r2));
        return Manifold::Cylinder(height, r1, r2, static_cast<int>(n), in.truth("center", false));
    }

    std::filesystem::path file_of(const CsgArguments& in) const {
        std::filesystem::path file =
            trisect::detail::csg_file(in, options_.folder.value_or(program_.folder()));
        std::error_code none;
        return std::filesystem::exists(file, none) ? file : std::filesystem::path();
    }

    Manifold minkowski(Index n) {
        Manifold out;
        bool first = true;
        for (const Manifold& operand : solids(children(n))) {
            if (operand.IsEmpty()) continue;
            out = first ? operand : out.MinkowskiSum(operand);
            first = false;
        }
        return checked(n, out);
    }

    manifold::Polygons base_of(Index n) {
        const CsgArguments in = program_.arguments(n);
        if (!trisect::detail::csg_file(in, {}).empty()) return drawing_file(in, 1).ToPolygons();
        return any_region(children(n)).ToPolygons();
    }

    Manifold linear(Index n) {
        const CsgArguments in = program_.arguments(n);
        const double height = in.number("height", 100);
        const manifold::Polygons base = base_of(n);
        if (!(height > 0) || base.empty()) return {};
        const auto scale = in.numbers("scale", 2, 1);
        int slices = 1;
        if (!trisect::detail::is_straight(in)) {
            ++approximate_;
            const PlaneRegion corners = corners_of(base);
            const auto mesh = trisect::detail::csg_twisted(corners, in, 0, height);
            slices = static_cast<int>(mesh.points.size() / corners.points.size()) - 1;
        }
        Manifold out = Manifold::Extrude(base, height, slices - 1, -in.number("twist", 0),
                                         {scale[0], scale[1]});
        if (in.truth("center", false)) out = out.Translate({0, 0, -height / 2});
        return checked(n, out);
    }

    /// OpenSCAD's full turns begin on the other side. Both sides of the axis are equal to it.
    Manifold revolved(Index n) {
        const CsgArguments in = program_.arguments(n);
        manifold::Polygons base = base_of(n);
        const double given = in.number("angle", 360);
        if (base.empty() || given == 0) return {};
        const PlaneRegion corners = corners_of(base);
        const auto mesh = trisect::detail::csg_revolved(corners, in);
        const bool is_full = std::fabs(given) >= 360;
        const int steps =
            static_cast<int>(mesh.points.size() / corners.points.size()) - (is_full ? 0 : 1);
        const bool is_left = std::any_of(corners.points.begin(), corners.points.end(),
                                         [](const auto& p) { return p[0] < 0; });
        if (is_left)
            for (auto& polygon : base) {
                for (auto& p : polygon) p.x = -p.x;
                std::reverse(polygon.begin(), polygon.end());
            }
        ++approximate_;
        Manifold out = Manifold::Revolve(base, steps, std::min(std::fabs(given), 360.0));
        const double begin = (is_full ? 180 : std::min(given, 0.0)) + (is_left ? 180 : 0);
        return checked(n, begin == 0 ? out : out.Rotate(0, 0, begin));
    }

    /// Of resize(): a size that is not positive leaves its axis as it is, or follows the largest.
    static std::array<double, 3> factors(const CsgArguments& in, const std::array<double, 3>& size,
                                         std::size_t axes) {
        const auto sizes = in.numbers("newsize", 3, 0);
        const auto follows = in.truths("auto", 3);
        std::array<double, 3> out{1, 1, 1};
        std::size_t largest = 0;
        for (std::size_t k = 0; k < axes; ++k) {
            if (sizes[k] > 0) out[k] = sizes[k] / size[k];
            if (sizes[k] > sizes[largest]) largest = k;
        }
        for (std::size_t k = 0; k < axes; ++k)
            if (!(sizes[k] > 0) && follows[k]) out[k] = out[largest];
        return out;
    }
    Manifold resized(Index n) {
        const Manifold all = any_solid(children(n));
        if (all.IsEmpty()) return {};
        const auto size = all.BoundingBox().Size();
        const auto f = factors(program_.arguments(n), {size.x, size.y, size.z}, 3);
        return all.Scale({f[0], f[1], f[2]});
    }

    // Regions of the plane.
    CrossSection region_of(Index n) {
        switch (program_.kind(n)) {
            case CsgKind::Group:
                return any_region(children(n));
            case CsgKind::Difference:
                return combined(regions(children(n)), OpType::Subtract);
            case CsgKind::Intersection: {
                const auto all = regions(children(n));
                return lacks_operands(n, all.size()) ? CrossSection()
                                                     : combined(all, OpType::Intersect);
            }
            case CsgKind::Matrix:
                return any_region(children(n)).Transform(flat_matrix(n));
            case CsgKind::Hull:
                return CrossSection::Hull(regions(children(n)));
            case CsgKind::Minkowski:
                refuse(n, "no call for regions of the plane");
            case CsgKind::Offset:
                return kept(regions_, n, false, [&] { return offset(n); });
            case CsgKind::Projection:
                return kept(regions_, n, false, [&] { return projection(n); });
            case CsgKind::Resize:
                return resized_region(n);
            default:
                return kept(regions_, n, false, [&] { return flat_shape(n); });
        }
    }

    manifold::mat2x3 flat_matrix(Index n) const {
        const AffineMap map = trisect::detail::csg_matrix(program_.arguments(n), true);
        return {{map.rows[0][0], map.rows[1][0]},
                {map.rows[0][1], map.rows[1][1]},
                {map.rows[0][3], map.rows[1][3]}};
    }

    CrossSection drawn(const Drawing& drawing) const {
        std::vector<CrossSection> shapes;
        for (const auto& shape : drawing.shapes) {
            CrossSection all = even_odd(shape.outlines);
            for (const auto& stroke : shape.strokes) {
                std::vector<CrossSection> pieces;
                for (const Outline& piece : stroke) pieces.push_back(even_odd({piece}));
                const CrossSection one = combined(pieces, OpType::Add);
                all = (all - one) + (one - all);
            }
            shapes.push_back(all);
        }
        return combined(shapes, OpType::Add);
    }
    CrossSection drawing_file(const CsgArguments& in, double scale) const {
        const std::filesystem::path file = file_of(in);
        if (file.empty()) return {};
        return drawn(trisect::detail::csg_drawing_file(in, file, scale));
    }
    CrossSection flat_shape(Index n) const {
        const CsgArguments in = program_.arguments(n);
        if (program_.kind(n) == CsgKind::Import) return drawing_file(in, in.number("scale", 1));
        if (program_.node(n).name == "text") return drawn(trisect::detail::csg_text(in));
        return even_odd(outlines_of(program_.node(n).name, in));
    }

    CrossSection offset(Index n) {
        ++approximate_;
        const CsgArguments in = program_.arguments(n);
        const CrossSection all = any_region(children(n));
        if (in.find("r") == nullptr && in.find("delta") != nullptr)
            return all.Offset(in.number("delta", 1),
                              in.truth("chamfer", false) ? CrossSection::JoinType::Square
                                                         : CrossSection::JoinType::Miter,
                              1e6);
        const double r = in.number("r", 1);
        return all.Offset(r, CrossSection::JoinType::Round, 2,
                          static_cast<int>(trisect::detail::csg_fragments(in, std::fabs(r))));
    }
    CrossSection projection(Index n) {
        const Manifold all = any_solid(children(n));
        const bool cut = program_.arguments(n).truth("cut", false);
        return CrossSection(cut ? all.Slice(0) : all.Project());
    }
    CrossSection resized_region(Index n) {
        const CrossSection all = any_region(children(n));
        if (all.IsEmpty()) return {};
        const auto size = all.Bounds().Size();
        const auto f = factors(program_.arguments(n), {size.x, size.y, 1}, 2);
        return all.Scale({f[0], f[1]});
    }

    const CsgProgram& program_;
    const CsgOptions& options_;
    std::size_t approximate_ = 0;
    std::map<std::string, Manifold> solids_;
    std::map<std::string, Manifold> groups_;
    std::map<std::string, CrossSection> regions_;
};

}  // namespace

ManifoldOutcome evaluate_by_manifold(const trisect::CsgTree& tree, const CsgOptions& options) {
    const CsgProgram program(tree);
    Evaluator evaluator(program, options);
    ManifoldOutcome out;
    if (program.dimension() == 2) {
        const CrossSection region = evaluator.region();
        const manifold::Polygons polygons = region.ToPolygons();
        out.volume = polygons.empty() ? 0 : region.Area();
    } else {
        const Manifold solid = evaluator.solid();
        if (solid.Status() != Manifold::Error::NoError)
            throw std::runtime_error("status " + std::to_string(static_cast<int>(solid.Status())));
        out.triangles = solid.GetMeshGL64().NumTri();
        out.volume = solid.Volume();
    }
    out.approximate = evaluator.approximate();
    return out;
}

}  // namespace bench
