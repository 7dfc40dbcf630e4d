// SPDX-License-Identifier: Apache-2.0
//
// Solids: where they come from and where they go.

#include <string>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cone.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/native_file.h>
#include <trisect/bsp/solid.h>

#include "call.h"
#include "handles.h"
#include "mesh_input.h"

using namespace trisect;  // NOLINT(google-build-using-namespace)
using c::make_handle;
using c::point_of;
using c::required;

trisect_status trisect_solid_from_triangles(const double* vertices, size_t vertex_count,
                                            const uint32_t* faces, size_t face_count,
                                            const trisect_solid_options* options,
                                            trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        return Solid::from_triangles(c::view_of(vertices, vertex_count, faces, face_count),
                                     c::options_of(options));
    });
}

trisect_status trisect_solid_from_polygons(const double* vertices, size_t vertex_count,
                                           const uint32_t* corners, const uint32_t* face_begin,
                                           size_t face_count, const trisect_solid_options* options,
                                           trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        return Solid::from_mesh(
            c::polygons_of(vertices, vertex_count, corners, face_begin, face_count),
            c::options_of(options));
    });
}

trisect_status trisect_solid_empty(trisect_solid** solid) {
    return make_handle(solid, "solid", [] { return Solid(); });
}

trisect_status trisect_solid_whole_space(trisect_solid** solid) {
    return make_handle(solid, "solid", [] { return Solid::whole_space(); });
}

trisect_status trisect_solid_half_space(const double plane[4], trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        (void)required(plane, "plane");
        return Solid::half_space({plane[0], plane[1], plane[2], plane[3]});
    });
}

trisect_status trisect_solid_box(const double low[3], const double high[3], trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        return Solid::from_mesh(make_box(point_of(low, "low"), point_of(high, "high")));
    });
}

trisect_status trisect_solid_cylinder(double radius, double height, uint32_t segments,
                                      trisect_solid** solid) {
    return make_handle(solid, "solid",
                       [&] { return Solid::from_mesh(make_cylinder(radius, height, segments)); });
}

trisect_status trisect_solid_cone(double bottom_radius, double top_radius, double height,
                                  uint32_t segments, trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        return Solid::from_mesh(make_cone(bottom_radius, top_radius, height, segments));
    });
}

trisect_status trisect_solid_sphere(double radius, uint32_t subdivisions, trisect_solid** solid) {
    return make_handle(solid, "solid",
                       [&] { return Solid::from_mesh(make_icosphere(radius, subdivisions)); });
}

trisect_status trisect_solid_torus(double major_radius, double minor_radius,
                                   uint32_t major_segments, uint32_t minor_segments,
                                   trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        return Solid::from_mesh(
            make_torus(major_radius, minor_radius, major_segments, minor_segments));
    });
}

namespace {

bool has_native_name(const std::string& name) { return name.ends_with(".trisect"); }

}  // namespace

trisect_status trisect_solid_read(const char* path, const trisect_solid_options* options,
                                  trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        const std::string name = &required(path, "path");
        if (!has_native_name(name))
            return Solid::from_mesh(read_mesh(name), c::options_of(options));
        return read_native(name,
                           {.names = NativeNames::Fresh, .threads = c::limits_of_thread().threads});
    });
}

trisect_status trisect_solid_write(const trisect_solid* solid, const char* path) {
    return c::call([&] {
        const std::string name = &required(path, "path");
        const Solid& written = required(solid, "solid").solid;
        const std::uint32_t threads = c::limits_of_thread().threads;
        if (has_native_name(name))
            write_native(written, name, {.threads = threads});
        else
            write_mesh(name, written.to_mesh(threads));
    });
}

trisect_status trisect_solid_exact_text(const trisect_solid* solid, trisect_text** text) {
    return make_handle(text, "text",
                       [&] { return exact_text(required(solid, "solid").solid.to_brep()); });
}

trisect_status trisect_solid_from_exact_text(const char* text, size_t length,
                                             trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        const auto characters = c::array_of(text, length, "text");
        return Solid::from_brep(
            read_exact(std::string_view(characters.data(), characters.size()), "text"));
    });
}

trisect_status trisect_solid_from_csg(const char* text, size_t length, trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        const auto characters = c::array_of(text, length, "text");
        CsgOptions options;
        options.evaluate.threads = c::limits_of_thread().threads;
        options.reads_files = false;
        return evaluate_csg(
            parse_csg(std::string_view(characters.data(), characters.size()), "text"), options);
    });
}

trisect_status trisect_solid_copy(const trisect_solid* from, trisect_solid** solid) {
    return make_handle(solid, "solid", [&] { return required(from, "from").solid; });
}

void trisect_solid_free(trisect_solid* solid) { delete solid; }

trisect_status trisect_solid_mesh(const trisect_solid* solid, trisect_mesh** mesh) {
    if (mesh != nullptr) *mesh = nullptr;
    return c::call([&] {
        trisect_mesh*& handle = required(mesh, "mesh");
        MeshMap map;
        PolygonMesh made =
            required(solid, "solid").solid.to_mesh(map, c::limits_of_thread().threads);
        handle = new trisect_mesh{std::move(made), std::move(map.source)};
    });
}

size_t trisect_mesh_vertex_count(const trisect_mesh* mesh) {
    return mesh != nullptr ? mesh->mesh.points.size() : 0;
}

size_t trisect_mesh_face_count(const trisect_mesh* mesh) {
    return mesh != nullptr ? mesh->mesh.face_count() : 0;
}

const double* trisect_mesh_vertices(const trisect_mesh* mesh) {
    return mesh != nullptr ? reinterpret_cast<const double*>(mesh->mesh.points.data()) : nullptr;
}

const uint32_t* trisect_mesh_faces(const trisect_mesh* mesh) {
    return mesh != nullptr ? mesh->mesh.corners.data() : nullptr;
}

const uint32_t* trisect_mesh_sources(const trisect_mesh* mesh) {
    static_assert(sizeof(FaceSource) == 2 * sizeof(uint32_t));
    return mesh != nullptr ? reinterpret_cast<const uint32_t*>(mesh->sources.data()) : nullptr;
}

void trisect_mesh_free(trisect_mesh* mesh) { delete mesh; }
