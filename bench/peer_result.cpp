// SPDX-License-Identifier: Apache-2.0
//
// Writes what a peer makes of a boolean of two files, for `trisect verify`:
//
//     peer_result_ENGINE union|intersection|difference A B RESULT.off
//
// Linked with one engine (engine.h). Exit code 1 when the engine declines, with its reason.
#include <cstdio>
#include <exception>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>

#include "engine.h"

namespace {

/// The triangles of the file on its lattice: the engine gets the very solid that verify reads.
trisect::PolygonMesh operand(const char* file) {
    const trisect::LatticeMesh mesh = trisect::import_mesh(trisect::read_mesh(file)).mesh;
    trisect::PolygonMesh out;
    for (const trisect::LatticePoint& p : mesh.points)
        out.points.push_back({mesh.lattice.to_double(p.x.to_double()),
                              mesh.lattice.to_double(p.y.to_double()),
                              mesh.lattice.to_double(p.z.to_double())});
    for (const auto& t : mesh.triangles) out.add_triangle(t[0], t[1], t[2]);
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fprintf(stderr, "usage: %s OP A B RESULT.off\n", argv[0]);
        return 2;
    }
    try {
        const auto operation = bench::operation_of(argv[1]);
        if (!operation) return 2;
        const auto engine = bench::make_engine({});
        const std::vector<bench::Engine::Body> a{engine->import(operand(argv[2]))};
        const std::vector<bench::Engine::Body> b{engine->import(operand(argv[3]))};
        trisect::write_mesh(argv[4], engine->to_mesh(engine->evaluate(a, b, *operation)));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
    return 0;
}
