/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Test of the C interface, in C99: each group of functions once for what it does and once for what
 * it refuses.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <trisect-c/trisect.h>

static int failures = 0;

#define EXPECT(condition)                                                             \
    do {                                                                              \
        if (!(condition)) {                                                           \
            printf("%s:%d: %s\n    last error: %s\n", __FILE__, __LINE__, #condition, \
                   trisect_error_message());                                          \
            ++failures;                                                               \
        }                                                                             \
    } while (0)
#define EXPECT_OK(call) EXPECT((call) == TRISECT_OK)

static const double tetrahedron_points[12] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
static const uint32_t tetrahedron_faces[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};

static trisect_solid* box(double x0, double y0, double z0, double x1, double y1, double z1) {
    const double low[3] = {x0, y0, z0};
    const double high[3] = {x1, y1, z1};
    trisect_solid* solid = NULL;
    EXPECT_OK(trisect_solid_box(low, high, &solid));
    return solid;
}

static double volume_of(const trisect_solid* solid) {
    double volume = -1;
    EXPECT_OK(trisect_volume(solid, &volume));
    return volume;
}

static void test_version(void) {
    char version[32];
    (void)snprintf(version, sizeof(version), "%d.%d.%d", TRISECT_C_VERSION_MAJOR,
                   TRISECT_C_VERSION_MINOR, TRISECT_C_VERSION_PATCH);
    EXPECT(strcmp(trisect_version(), version) == 0);
    EXPECT(trisect_is_compatible(TRISECT_C_VERSION_MAJOR, TRISECT_C_VERSION_MINOR));
    EXPECT(!trisect_is_compatible(99, 0));
}

static void test_solids_of_arrays(void) {
    trisect_solid* solid = NULL;
    EXPECT_OK(
        trisect_solid_from_triangles(tetrahedron_points, 4, tetrahedron_faces, 4, NULL, &solid));
    trisect_text* text = NULL;
    EXPECT_OK(trisect_exact_volume(solid, &text));
    size_t length = 0;
    EXPECT(strcmp(trisect_text_data(text, &length), "4/3") == 0);
    EXPECT(length == 3);
    trisect_text_free(text);
    trisect_solid_free(solid);

    const uint32_t begin[5] = {0, 3, 6, 9, 12};
    const trisect_solid_options options = {sizeof(options), TRISECT_EMBEDDING_CHECK, 0};
    EXPECT_OK(trisect_solid_from_polygons(tetrahedron_points, 4, tetrahedron_faces, begin, 4,
                                          &options, &solid));
    trisect_solid_free(solid);
    trisect_solid_free(NULL);
}

static void test_refused_arrays(void) {
    trisect_solid* solid = NULL;
    EXPECT(trisect_solid_from_triangles(tetrahedron_points, 4, tetrahedron_faces, 3, NULL,
                                        &solid) == TRISECT_INVALID_SOLID);
    EXPECT(strstr(trisect_error_message(), "open_edge") != NULL);
    EXPECT(solid == NULL);
    EXPECT(trisect_solid_from_triangles(tetrahedron_points, 3, tetrahedron_faces, 4, NULL,
                                        &solid) == TRISECT_USAGE);
    EXPECT(trisect_solid_from_triangles(NULL, 4, tetrahedron_faces, 4, NULL, &solid) ==
           TRISECT_USAGE);
    EXPECT(strcmp(trisect_error_message(), "vertices is NULL") == 0);
    EXPECT(trisect_solid_from_triangles(tetrahedron_points, 4, tetrahedron_faces, 4, NULL, NULL) ==
           TRISECT_USAGE);
    EXPECT(trisect_solid_from_triangles(tetrahedron_points, 4, tetrahedron_faces, (size_t)1 << 32,
                                        NULL, &solid) == TRISECT_LIMIT);
    trisect_solid_options options = {0};
    EXPECT(trisect_solid_from_triangles(tetrahedron_points, 4, tetrahedron_faces, 4, &options,
                                        &solid) == TRISECT_USAGE);
    double points[12];
    memcpy(points, tetrahedron_points, sizeof(points));
    points[4] = NAN;
    EXPECT(trisect_solid_from_triangles(points, 4, tetrahedron_faces, 4, NULL, &solid) ==
           TRISECT_LIMIT);
    const uint32_t wrong_begin[5] = {0, 3, 2, 9, 12};
    EXPECT(trisect_solid_from_polygons(tetrahedron_points, 4, tetrahedron_faces, wrong_begin, 4,
                                       NULL, &solid) == TRISECT_USAGE);
}

static void test_booleans(void) {
    trisect_solid* a = box(0, 0, 0, 2, 2, 2);
    trisect_solid* b = box(1, 1, 1, 3, 3, 3);
    const trisect_solid* operands[2];
    operands[0] = a;
    operands[1] = b;
    const double expected[4] = {15, 1, 7, 14};
    for (int operation = TRISECT_UNION; operation <= TRISECT_XOR; ++operation) {
        trisect_solid* result = NULL;
        EXPECT_OK(trisect_boolean((trisect_operation)operation, operands, 2, &result));
        EXPECT(volume_of(result) == expected[operation]);
        trisect_solid_free(result);
    }
    trisect_solid* result = NULL;
    EXPECT(trisect_boolean((trisect_operation)7, operands, 2, &result) == TRISECT_USAGE);
    EXPECT(trisect_boolean(TRISECT_UNION, operands, 0, &result) == TRISECT_USAGE);
    operands[1] = NULL;
    EXPECT(trisect_boolean(TRISECT_UNION, operands, 2, &result) == TRISECT_USAGE);

    trisect_solid* complement = NULL;
    trisect_mesh* mesh = NULL;
    EXPECT_OK(trisect_complement(a, &complement));
    EXPECT(trisect_solid_mesh(complement, &mesh) == TRISECT_UNSUPPORTED);
    EXPECT(mesh == NULL);
    EXPECT_OK(trisect_complement(complement, &result));
    int is_equal = 0;
    EXPECT_OK(trisect_solid_equals(a, result, &is_equal));
    EXPECT(is_equal);
    EXPECT_OK(trisect_solid_equals(a, b, &is_equal));
    EXPECT(!is_equal);
    trisect_solid_free(result);
    trisect_solid_free(complement);
    trisect_solid_free(b);
    trisect_solid_free(a);
}

static void test_edited_booleans(void) {
    trisect_solid* solids[3];
    solids[0] = box(0, 0, 0, 9, 9, 1);
    solids[1] = box(1, 1, -1, 2, 2, 2);
    solids[2] = box(5, 5, -1, 7, 6, 2);
    const trisect_solid* operands[2] = {solids[0], solids[1]};
    trisect_edited* edited = NULL;
    trisect_solid* result = NULL;
    int evaluated_all = 0;
    EXPECT_OK(trisect_edited_new(&edited));
    EXPECT_OK(
        trisect_edited_boolean(edited, TRISECT_DIFFERENCE, operands, 2, &evaluated_all, &result));
    EXPECT(evaluated_all == 1);
    EXPECT(volume_of(result) == 80);
    trisect_solid_free(result);
    operands[1] = solids[2];
    EXPECT_OK(
        trisect_edited_boolean(edited, TRISECT_DIFFERENCE, operands, 2, &evaluated_all, &result));
    EXPECT(evaluated_all == 0);
    EXPECT(volume_of(result) == 79);
    trisect_solid_free(result);
    operands[1] = NULL;
    EXPECT(trisect_edited_boolean(edited, TRISECT_DIFFERENCE, operands, 2, NULL, &result) ==
           TRISECT_USAGE);
    EXPECT(result == NULL);
    trisect_edited_free(edited);
    for (int i = 0; i < 3; ++i) trisect_solid_free(solids[i]);
}

static void test_parts(void) {
    trisect_solid* a = box(0, 0, 0, 4, 1, 1);
    trisect_solid* cutter = box(1, -1, -1, 2, 2, 2);
    trisect_solid* inside = NULL;
    trisect_solid* outside = NULL;
    EXPECT_OK(trisect_split(a, cutter, &inside, &outside));
    EXPECT(volume_of(inside) == 1);
    EXPECT(volume_of(outside) == 3);
    trisect_solid_list* parts = NULL;
    EXPECT_OK(trisect_components(outside, &parts));
    EXPECT(trisect_solid_list_count(parts) == 2);
    trisect_solid* part = NULL;
    EXPECT_OK(trisect_solid_list_get(parts, 0, &part));
    EXPECT(trisect_solid_list_get(parts, 2, &part) == TRISECT_USAGE);
    EXPECT(part == NULL);
    trisect_solid_list_free(parts);
    trisect_solid_free(inside);
    trisect_solid_free(outside);

    const double plane[4] = {1, 0, 0, -3};
    EXPECT_OK(trisect_split_by_plane(a, plane, &inside, &outside));
    EXPECT(volume_of(inside) == 3);
    EXPECT(volume_of(outside) == 1);
    trisect_solid_free(inside);
    trisect_solid_free(outside);
    trisect_solid_free(cutter);
    trisect_solid_free(a);
}

static void test_meshes_and_measures(void) {
    trisect_solid* a = box(0, 0, 0, 1, 2, 3);
    trisect_mesh* mesh = NULL;
    EXPECT_OK(trisect_solid_mesh(a, &mesh));
    EXPECT(trisect_mesh_vertex_count(mesh) == 8);
    EXPECT(trisect_mesh_face_count(mesh) == 12);
    trisect_solid* again = NULL;
    EXPECT_OK(trisect_solid_from_triangles(trisect_mesh_vertices(mesh), 8, trisect_mesh_faces(mesh),
                                           12, NULL, &again));
    EXPECT(volume_of(again) == 6);
    uint32_t id = 0;
    EXPECT_OK(trisect_solid_source_id(a, &id));
    for (size_t f = 0; f < 12; ++f) {
        EXPECT(trisect_mesh_sources(mesh)[2 * f] == id);
        EXPECT(trisect_mesh_sources(mesh)[2 * f + 1] < 6);
    }
    trisect_mesh_free(mesh);
    double area = 0;
    double center[3];
    double low[3];
    double high[3];
    EXPECT_OK(trisect_area(a, &area));
    EXPECT(area == 22);
    EXPECT_OK(trisect_centroid(a, center));
    EXPECT(center[0] == 0.5 && center[1] == 1 && center[2] == 1.5);
    EXPECT_OK(trisect_bounds(a, low, high));
    EXPECT(low[0] == 0 && high[2] == 3);
    trisect_solid* empty = NULL;
    EXPECT_OK(trisect_solid_empty(&empty));
    EXPECT(trisect_centroid(empty, center) == TRISECT_UNSUPPORTED);
    int is_empty = 0;
    EXPECT_OK(trisect_solid_is_empty(empty, &is_empty));
    EXPECT(is_empty);

    const double turn[12] = {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 5};
    double move = -1;
    trisect_solid* turned = NULL;
    EXPECT_OK(trisect_solid_transform(a, turn, &move, &turned));
    EXPECT(move == 0);
    EXPECT_OK(trisect_bounds(turned, low, high));
    EXPECT(low[0] == -2 && high[0] == 0 && low[2] == 5 && high[2] == 8);
    trisect_solid_free(turned);
    trisect_solid_free(empty);
    trisect_solid_free(again);
    trisect_solid_free(a);
}

static void test_exact_text(void) {
    trisect_solid* a = NULL;
    EXPECT_OK(trisect_solid_sphere(1, 2, &a));
    trisect_text* text = NULL;
    EXPECT_OK(trisect_solid_exact_text(a, &text));
    size_t length = 0;
    const char* const data = trisect_text_data(text, &length);
    trisect_solid* b = NULL;
    EXPECT_OK(trisect_solid_from_exact_text(data, length, &b));
    int is_equal = 0;
    EXPECT_OK(trisect_solid_equals(a, b, &is_equal));
    EXPECT(is_equal);
    EXPECT(trisect_solid_from_exact_text("nonsense", 8, &b) == TRISECT_INPUT);
    EXPECT(b == NULL);
    trisect_text_free(text);
    trisect_solid_free(a);
}

static void test_csg(void) {
    const char program[] = "cube(size = [1, 2, 3], center = false);";
    trisect_solid* a = NULL;
    EXPECT_OK(trisect_solid_from_csg(program, sizeof(program) - 1, &a));
    double volume = 0;
    EXPECT_OK(trisect_volume(a, &volume));
    EXPECT(volume == 6);
    trisect_solid_free(a);
    EXPECT(trisect_solid_from_csg("cube(", 5, &a) == TRISECT_INPUT);
    EXPECT(a == NULL);
    EXPECT(strstr(trisect_error_message(), "text:1") != NULL);
    const char import[] = "import(file = \"a.stl\");";
    EXPECT(trisect_solid_from_csg(import, sizeof(import) - 1, &a) == TRISECT_UNSUPPORTED);
}

static void test_files(void) {
    trisect_solid* a = box(0, 0, 0, 1, 1, 1);
    EXPECT_OK(trisect_solid_write(a, "c_interface_test.off"));
    trisect_solid* b = NULL;
    EXPECT_OK(trisect_solid_read("c_interface_test.off", NULL, &b));
    EXPECT(volume_of(b) == 1);
    remove("c_interface_test.off");
    EXPECT(trisect_solid_read("c_interface_test.off", NULL, &b) == TRISECT_INPUT);
    EXPECT(strstr(trisect_error_message(), "c_interface_test.off") != NULL);
    trisect_solid_free(a);
}

static void test_native_files(void) {
    const char* name = "c_interface_test.trisect";
    const double plane[4] = {0, 0, 1, 0};
    trisect_solid* below = NULL;
    EXPECT_OK(trisect_solid_half_space(plane, &below));
    EXPECT_OK(trisect_solid_write(below, name));
    trisect_solid* again = NULL;
    EXPECT_OK(trisect_solid_read(name, NULL, &again));
    int equal = 0;
    EXPECT_OK(trisect_solid_equals(below, again, &equal));
    EXPECT(equal);
    trisect_solid_free(again);
    trisect_solid_free(below);
    remove(name);
    EXPECT(trisect_solid_read(name, NULL, &again) == TRISECT_INPUT);
    EXPECT(again == NULL);
}

static void test_queries(void) {
    trisect_solid* a = box(0, 0, 0, 2, 2, 2);
    const double points[15] = {1, 1, 1, 3, 1, 1, 2, 1, 1, 2, 2, 1, 2, 2, 2};
    uint8_t locations[5];
    EXPECT_OK(trisect_locate(a, points, 5, locations));
    EXPECT(locations[0] == TRISECT_INSIDE && locations[1] == TRISECT_OUTSIDE);
    EXPECT(locations[2] == TRISECT_ON_FACE && locations[3] == TRISECT_ON_EDGE);
    EXPECT(locations[4] == TRISECT_ON_VERTEX);
    double distances[5];
    EXPECT_OK(trisect_signed_distances(a, points, 5, distances));
    EXPECT(fabs(distances[0] + 1) < 1e-12 && fabs(distances[1] - 1) < 1e-12 && distances[2] == 0);

    const double origins[6] = {-1, 1, 1, -1, 5, 1};
    const double directions[6] = {1, 0, 0, 1, 0, 0};
    double parameters[2];
    uint32_t faces[4];
    EXPECT_OK(trisect_first_hits(a, origins, directions, 2, parameters, faces));
    EXPECT(parameters[0] == 1 && isinf(parameters[1]));
    EXPECT(trisect_first_hits(a, origins, points + 3, 2, NULL, faces) == TRISECT_USAGE);

    const double plane[4] = {0, 0, 1, -1};
    trisect_section* section = NULL;
    EXPECT_OK(trisect_solid_section(a, plane, &section));
    EXPECT(trisect_section_loop_count(section) == 1);
    EXPECT(!trisect_section_is_hole(section, 0));
    size_t count = 0;
    EXPECT(trisect_section_points(section, 0, &count) != NULL);
    EXPECT(count == 4);
    EXPECT(trisect_section_points(section, 1, &count) == NULL);
    trisect_section_free(section);
    trisect_solid_free(a);
}

static void test_interference(void) {
    trisect_solid* a = box(0, 0, 0, 1, 1, 1);
    const int64_t quarter[4] = {1, 0, 0, 1};
    const double by[3] = {2, 0, 0};
    trisect_pose* pose = NULL;
    EXPECT_OK(trisect_pose_from_quaternion(quarter, by, &pose));
    trisect_relation relation = TRISECT_EQUAL;
    EXPECT_OK(trisect_interfere(a, NULL, a, pose, &relation));
    EXPECT(relation == TRISECT_TOUCHING);
    EXPECT_OK(trisect_interfere(a, NULL, a, NULL, &relation));
    EXPECT(relation == TRISECT_EQUAL);
    trisect_pose_free(pose);

    const double shift[12] = {1, 0, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0};
    EXPECT_OK(trisect_pose_from_rows(shift, &pose));
    double lower = 0;
    double upper = 0;
    EXPECT_OK(trisect_distance(a, NULL, a, pose, &lower, &upper));
    EXPECT(lower <= 2 && 2 <= upper && upper - lower < 1e-9);
    int are_nearer = 1;
    EXPECT_OK(trisect_are_nearer_than(a, NULL, a, pose, 2, &are_nearer));
    EXPECT(!are_nearer);

    const double way[3] = {-4, 0, 0};
    trisect_motion* motion = NULL;
    EXPECT_OK(trisect_motion_translation(pose, way, &motion));
    int exists = 0;
    double time = 0;
    EXPECT_OK(trisect_first_contact(a, NULL, a, motion, 0, &exists, &time));
    EXPECT(exists && time == 0.5);
    trisect_motion_free(motion);
    trisect_pose_free(pose);
    const double flat[12] = {0};
    EXPECT(trisect_pose_from_rows(flat, &pose) == TRISECT_USAGE);
    EXPECT(pose == NULL);
    trisect_solid_free(a);
}

static void test_scene(void) {
    trisect_solid* a = box(0, 0, 0, 1, 1, 1);
    trisect_scene* scene = NULL;
    EXPECT_OK(trisect_scene_create(&scene));
    trisect_body bodies[3];
    for (int i = 0; i < 3; ++i) {
        const double rows[12] = {1, 0, 0, 2.0 * i, 0, 1, 0, 0, 0, 0, 1, 0};
        trisect_pose* pose = NULL;
        EXPECT_OK(trisect_pose_from_rows(rows, &pose));
        EXPECT_OK(trisect_scene_add(scene, a, pose, &bodies[i]));
        trisect_pose_free(pose);
    }
    const trisect_pair* pairs = NULL;
    size_t count = 1;
    EXPECT_OK(trisect_scene_interfering(scene, &pairs, &count));
    EXPECT(count == 0);
    EXPECT_OK(trisect_scene_set_pose(scene, bodies[1], NULL));
    EXPECT_OK(trisect_scene_interfering(scene, &pairs, &count));
    EXPECT(count == 1 && pairs[0].relation == TRISECT_EQUAL);
    EXPECT_OK(trisect_scene_remove(scene, bodies[1]));
    EXPECT(trisect_scene_set_pose(scene, bodies[1], NULL) == TRISECT_USAGE);
    trisect_scene_free(scene);
    trisect_solid_free(a);
}

static void test_checks(void) {
    trisect_report* report = NULL;
    EXPECT_OK(trisect_check(tetrahedron_points, 4, tetrahedron_faces, 3, &report));
    EXPECT(!trisect_report_is_solid(report));
    EXPECT(trisect_report_count(report) >= 1);
    trisect_finding finding;
    EXPECT_OK(trisect_report_finding(report, 0, &finding));
    EXPECT(strcmp(finding.kind, "open_edge") == 0 && finding.is_error);
    EXPECT(finding.vertex_count == 2 && finding.vertices != NULL);
    EXPECT(trisect_report_finding(report, 1000, &finding) == TRISECT_USAGE);
    trisect_report_free(report);

    const trisect_triangles mesh = {tetrahedron_points, 4, tetrahedron_faces, 4};
    trisect_triangles operands[2];
    operands[0] = mesh;
    operands[1] = mesh;
    trisect_verdict verdict = TRISECT_VERDICT_UNDECIDED;
    EXPECT_OK(trisect_verify(TRISECT_UNION, operands, 2, &mesh, -1, &verdict, NULL, NULL));
    EXPECT(verdict == TRISECT_VERDICT_EQUAL);
    EXPECT_OK(trisect_verify(TRISECT_DIFFERENCE, operands, 2, &mesh, -1, &verdict, NULL, NULL));
    EXPECT(verdict == TRISECT_VERDICT_DIFFERENT);
}

static void test_limits(void) {
    trisect_cancel* cancel = NULL;
    EXPECT_OK(trisect_cancel_create(&cancel));
    trisect_limits limits = {sizeof(limits), 1, 0, 0, NULL};
    limits.cancel = cancel;
    EXPECT_OK(trisect_set_limits(&limits));
    trisect_solid* a = box(0, 0, 0, 1, 1, 1);
    trisect_cancel_set(cancel, 1);
    trisect_solid* sphere = NULL;
    EXPECT(trisect_solid_sphere(1, 3, &sphere) == TRISECT_CANCELLED);
    EXPECT_OK(trisect_set_limits(NULL));
    EXPECT_OK(trisect_solid_sphere(1, 3, &sphere));
    limits.cancel = NULL;
    limits.max_work = 1;
    EXPECT_OK(trisect_set_limits(&limits));
    const trisect_solid* operands[2];
    operands[0] = a;
    operands[1] = sphere;
    trisect_solid* result = NULL;
    EXPECT(trisect_boolean(TRISECT_DIFFERENCE, operands, 2, &result) == TRISECT_LIMIT);
    EXPECT(result == NULL);
    limits.size = 1;
    EXPECT(trisect_set_limits(&limits) == TRISECT_USAGE);
    EXPECT_OK(trisect_set_limits(NULL));
    EXPECT_OK(trisect_boolean(TRISECT_DIFFERENCE, operands, 2, &result));
    trisect_solid_free(result);
    trisect_solid_free(sphere);
    trisect_solid_free(a);
    trisect_cancel_free(cancel);
}

int main(void) {
    test_version();
    test_solids_of_arrays();
    test_refused_arrays();
    test_booleans();
    test_edited_booleans();
    test_parts();
    test_meshes_and_measures();
    test_exact_text();
    test_csg();
    test_files();
    test_native_files();
    test_queries();
    test_interference();
    test_scene();
    test_checks();
    test_limits();
    if (failures != 0) printf("%d failures\n", failures);
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
