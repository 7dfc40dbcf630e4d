// SPDX-License-Identifier: Apache-2.0
//
// A program that was written for Manifold: only its include and its namespace were changed.
// With -D WITH_MANIFOLD it is compiled against Manifold itself, and must end with 0 as well.
#ifdef WITH_MANIFOLD
#include <manifold/manifold.h>
#else
#include <trisect/manifold.h>
namespace manifold = trisect::manifold;
#endif

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace {

using manifold::Manifold;
using manifold::OpType;

bool is_near(double a, double b) { return std::abs(a - b) < 1e-9; }

manifold::MeshGL64 tetrahedron() {
    manifold::MeshGL64 mesh;
    mesh.numProp = 3;
    mesh.vertProperties = {0, 0, 0, 6, 0, 0, 0, 6, 0, 0, 0, 6};
    mesh.triVerts = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    return mesh;
}

int booleans() {
    const Manifold cube = Manifold::Cube({2, 2, 2});
    const Manifold other = Manifold::Cube({2, 2, 2}, true).Translate({2, 2, 2});
    if (!is_near((cube + other).Volume(), 15)) return 1;
    if (!is_near((cube - other).Volume(), 7)) return 2;
    if (!is_near((cube ^ other).Volume(), 1)) return 3;
    const std::vector<Manifold> all{cube, other, Manifold::Cube({1, 1, 1}).Translate({-1, -1, -1})};
    if (!is_near(Manifold::BatchBoolean(all, OpType::Add).Volume(), 16)) return 4;
    if (!is_near(Manifold::BatchBoolean(all, OpType::Subtract).Volume(), 7)) return 5;
    if (!Manifold::BatchBoolean(all, OpType::Intersect).IsEmpty()) return 6;
    const auto [common, rest] = cube.Split(other);
    if (!is_near(common.Volume(), 1) || !is_near(rest.Volume(), 7)) return 7;
    const auto [above, below] = cube.SplitByPlane({0, 0, 2}, 0.5);
    if (!is_near(above.Volume(), 6) || !is_near(below.Volume(), 2)) return 8;
    if (!is_near(cube.TrimByPlane({1, 0, 0}, 1.5).Volume(), 2)) return 9;
    Manifold sum = cube;
    sum += Manifold::Cube({1, 1, 1}).Translate({5, 0, 0});
    if (sum.Decompose().size() != 2 || !is_near(sum.Hull().BoundingBox().max.x, 6)) return 10;
    return 0;
}

int shapes_and_moves() {
    const Manifold solid(tetrahedron());
    if (solid.Status() != Manifold::Error::NoError) return 20;
    if (solid.NumTri() != 4 || solid.NumVert() != 4 || solid.NumEdge() != 6) return 21;
    if (!is_near(solid.Volume(), 36) || !is_near(solid.BoundingBox().Size().z, 6)) return 22;
    if (!is_near(solid.SurfaceArea(), 54 + 18 * std::sqrt(3))) return 23;
    const Manifold turned = solid.Rotate(0, 0, 90);
    if (!is_near(turned.BoundingBox().min.x, -6) || !is_near(turned.Volume(), 36)) return 24;
    const Manifold mapped = solid.Transform({{0, 2, 0}, {-1, 0, 0}, {0, 0, 1}, {9, 0, 0}});
    if (!is_near(mapped.BoundingBox().min.x, 3) || !is_near(mapped.BoundingBox().max.y, 12))
        return 25;
    const Manifold cylinder = Manifold::Cylinder(4, 1, -1, 64, true);
    if (std::abs(cylinder.Volume() - 12.55) > 0.05 || cylinder.BoundingBox().min.z != -2) return 26;
    if (std::abs(Manifold::Cylinder(3, 1, 0, 64).Volume() - 3.14) > 0.02) return 27;
    if (std::abs(Manifold::Sphere(1, 64).Volume() - 4.18) > 0.03) return 28;
    return is_near(solid.Scale({1, 2, 1}).Volume(), 72) ? 0 : 29;
}

int sweeps_and_levels() {
    const manifold::Polygons square{{{1, 0}, {2, 0}, {2, 1}, {1, 1}}};
    const Manifold bar = Manifold::Extrude(square, 3);
    if (!is_near(bar.Volume(), 3)) return 60;
    if (!is_near(bar.Mirror({2, 0, 0}).BoundingBox().min.x, -2)) return 61;
    if (!is_near(bar.Mirror({1, -1, 0}).BoundingBox().min.y, 1)) return 62;
    if (!is_near(Manifold::Extrude(square, 3, 0, 0, {0, 0}).Volume(), 1)) return 63;
    const double twisted = Manifold::Extrude(square, 3, 30, 90).Volume();
    if (std::abs(twisted - 3) > 0.1) return 64;
    if (!is_near(Manifold::Revolve(square, 4).Volume(), 6)) return 65;
    const manifold::Polygons across{{{-1, 0}, {2, 0}, {2, 1}, {-1, 1}}};
    if (!is_near(Manifold::Revolve(across, 4).Volume(), 8)) return 66;
    if (!is_near(Manifold::Revolve(square, 3, 90).BoundingBox().max.y, 2)) return 67;
    const auto ball = [](manifold::vec3 p) { return 1 - std::hypot(p.x, p.y, p.z); };
    const manifold::Box box{{-2, -2, -2}, {2, 2, 2}};
    if (std::abs(Manifold::LevelSet(ball, box, 0.2).Volume() - 4.19) > 0.15) return 68;
    const double smaller = Manifold::LevelSet(ball, box, 0.2, 0.5, 0.01).Volume();
    if (std::abs(smaller - 0.52) > 0.05) return 69;
    return Manifold::Extrude({}, 1).Status() == Manifold::Error::InvalidConstruction ? 0 : 70;
}

int meshes() {
    const Manifold solid(tetrahedron());
    const Manifold part = solid - Manifold::Cube({1, 1, 1});
    const manifold::MeshGL64 mesh = part.GetMeshGL64();
    if (mesh.NumTri() != part.NumTri() || mesh.NumVert() != part.NumVert()) return 40;
    if (mesh.runOriginalID.size() != 2 || mesh.runIndex.size() != 3) return 41;
    if (mesh.runIndex.back() != mesh.triVerts.size() || mesh.faceID.size() != mesh.NumTri())
        return 42;
    if (!is_near(Manifold(mesh).Volume(), 35)) return 43;
    const manifold::MeshGL floats = part.GetMeshGL();
    if (!is_near(Manifold(floats).Volume(), 35)) return 44;

    manifold::MeshGL64 open = tetrahedron();
    open.triVerts.resize(9);
    const Manifold wrong(open);
    if (wrong.Status() != Manifold::Error::NotManifold || !wrong.IsEmpty()) return 45;
    if ((solid + wrong).Status() != Manifold::Error::NotManifold) return 46;
    manifold::MeshGL64 endless = tetrahedron();
    endless.vertProperties[3] = std::numeric_limits<double>::infinity();
    if (Manifold(endless).Status() != Manifold::Error::NonFiniteVertex) return 47;
    manifold::MeshGL64 outside = tetrahedron();
    outside.triVerts[0] = 4;
    if (Manifold(outside).Status() != Manifold::Error::VertexOutOfBounds) return 48;
    if (Manifold::Cube({-1, 1, 1}).Status() != Manifold::Error::InvalidConstruction) return 49;
    manifold::MeshGL64 short_of = tetrahedron();
    short_of.vertProperties.pop_back();
    if (Manifold(short_of).Status() == Manifold::Error::NoError) return 50;
    const Manifold cube = Manifold::Cube();
    if (cube.OriginalID() < 0 || (cube + cube).OriginalID() != -1) return 51;
    const manifold::Box none = Manifold().BoundingBox();
    return Manifold().IsEmpty() && none.min.x > none.max.x ? 0 : 52;
}

}  // namespace

int main() {
    for (const auto test : {booleans, shapes_and_moves, sweeps_and_levels, meshes})
        if (const int failure = test(); failure != 0) return failure;
    return 0;
}
