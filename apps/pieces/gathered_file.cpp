// SPDX-License-Identifier: Apache-2.0
#include "gathered_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/bsp/native_file.h>
#include <trisect/kernel/error.h>

#include "piecewise_file.h"
#include "piecewise_import.h"
#include "triangle_stream.h"

namespace trisect::app {

namespace {

bool is_native_file(const std::string& name) {
    const InputFile file(name);
    std::string first(std::min<std::uint64_t>(file.size(), 64), '\0');
    file.read(0, first);
    return is_native(first);
}

struct DoubleMesh {
    std::vector<Point3d> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

Point3d doubles_of(const LatticePoint& p, Lattice lattice) {
    Point3d out{};
    for (int k = 0; k < 3; ++k)
        out[static_cast<std::size_t>(k)] = lattice.to_double(p[k].to_double()) + 0.0;
    return out;
}

DoubleMesh native_mesh(const std::string& name) {
    ExactMesh mesh = read_native(name).to_exact_mesh();
    DoubleMesh out{{}, std::move(mesh.triangles)};
    for (const Point& p : mesh.points) {
        if (!p.is_lattice())
            throw UnsupportedError(name +
                                   ": not all of its corners are doubles; write it as PLY, which "
                                   "rounds them");
        out.points.push_back(doubles_of(p.lattice(), mesh.lattice));
    }
    return out;
}

DoubleMesh imported_mesh(const std::string& name) {
    const ImportedMesh imported = import_mesh(read_mesh(name));
    if (!imported.report.closed) throw InvalidSolid(imported.report.defects);
    if (!imported.report.lattice.lossless)
        throw LimitError(name + ": coordinates span more than 126 bits");
    DoubleMesh out{{}, imported.mesh.triangles};
    for (const LatticePoint& p : imported.mesh.points)
        out.points.push_back(doubles_of(p, imported.mesh.lattice));
    return out;
}

}  // namespace

void gather_triangles(const std::string& name, const std::string& output) {
    const bool is_native = is_native_file(name);
    if (!is_native && is_imported_in_pieces(name)) return import_in_pieces(name, output);
    const DoubleMesh mesh = is_native ? native_mesh(name) : imported_mesh(name);
    OutputStream out(output);
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t corner : t) out.write(mesh.points[corner]);
    out.finish();
}

}  // namespace trisect::app
