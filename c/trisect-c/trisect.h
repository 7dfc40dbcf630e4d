/* SPDX-License-Identifier: Apache-2.0 */
/*
 * C interface of Trisect, for C and for other languages.
 *
 * Objects are opaque handles. A function that makes one writes it through its last argument and
 * returns a status; whoever gets a handle ends it with the _free function of its type, which
 * takes NULL as well. Handles of solids are immutable: any number of threads may read one.
 *
 * No exception leaves a function. Where the status is not TRISECT_OK, trisect_error_message() of
 * the same thread says what was wrong and where, and nothing was written but NULL to handles.
 *
 * Arrays come as pointer and length; lengths count vertices, faces or points, not numbers. An
 * array that a handle owns lives as long as the handle.
 *
 * Structs of options begin with their size, so that later versions can add to them:
 *     trisect_solid_options options = {sizeof(options)};
 * Members that are zero have their defaults, and NULL for the struct means all defaults.
 */
#ifndef TRISECT_C_TRISECT_H
#define TRISECT_C_TRISECT_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define TRISECT_C_API __attribute__((visibility("default")))
#else
#define TRISECT_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Version ------------------------------------------------------------------------------------- */

#define TRISECT_C_VERSION_MAJOR 0
#define TRISECT_C_VERSION_MINOR 1
#define TRISECT_C_VERSION_PATCH 0

/* That of the library that runs, as "0.1.0". */
TRISECT_C_API const char* trisect_version(void);
/* 1 where programs that were compiled with this header's version may use the library that runs:
 * trisect_is_compatible(TRISECT_C_VERSION_MAJOR, TRISECT_C_VERSION_MINOR) */
TRISECT_C_API int trisect_is_compatible(int major, int minor);

/* Errors -------------------------------------------------------------------------------------- */

/* The values are the exit codes of the command. */
typedef enum trisect_status {
    TRISECT_OK = 0,
    TRISECT_USAGE = 2,         /* a call that makes no sense */
    TRISECT_INPUT = 3,         /* an unreadable or malformed file */
    TRISECT_INVALID_SOLID = 4, /* data that does not bound a solid */
    TRISECT_LIMIT = 5,         /* a limit of work, memory or coordinates */
    TRISECT_CANCELLED = 6,
    TRISECT_UNSUPPORTED = 7, /* a valid request that this version cannot carry out */
    TRISECT_INTERNAL = 70,   /* a broken promise of the library */
    TRISECT_NO_MEMORY = 71
} trisect_status;

/* Of the last call of this thread that failed; "" before there is one. Valid until the next call
 * of this thread that fails. */
TRISECT_C_API const char* trisect_error_message(void);

/* Limits -------------------------------------------------------------------------------------- */

/* A flag that any thread may set to stop calls. */
typedef struct trisect_cancel trisect_cancel;
TRISECT_C_API trisect_status trisect_cancel_create(trisect_cancel** cancel);
TRISECT_C_API void trisect_cancel_set(trisect_cancel* cancel, int is_set);
TRISECT_C_API void trisect_cancel_free(trisect_cancel* cancel);

typedef struct trisect_limits {
    size_t size;                  /* sizeof(trisect_limits) */
    uint32_t threads;             /* that a call may use; 0: one for every processor */
    uint64_t max_work;            /* units of work of one call; 0: no limit */
    uint64_t max_memory;          /* bytes of one boolean; 0: no limit */
    const trisect_cancel* cancel; /* NULL: none; must outlive the calls */
} trisect_limits;

/* For all calls of this thread from now on; NULL for none. */
TRISECT_C_API trisect_status trisect_set_limits(const trisect_limits* limits);

/* Texts --------------------------------------------------------------------------------------- */

typedef struct trisect_text trisect_text;
/* Ends with a zero byte, which `length` does not count; `length` may be NULL. */
TRISECT_C_API const char* trisect_text_data(const trisect_text* text, size_t* length);
TRISECT_C_API void trisect_text_free(trisect_text* text);

/* Solids -------------------------------------------------------------------------------------- */

typedef struct trisect_solid trisect_solid;

typedef enum trisect_embedding {
    TRISECT_EMBEDDING_ASSUME = 0,  /* the boundary does not meet itself */
    TRISECT_EMBEDDING_RESOLVE = 1, /* it may */
    TRISECT_EMBEDDING_CHECK = 2    /* find out first */
} trisect_embedding;

typedef struct trisect_solid_options {
    size_t size; /* sizeof(trisect_solid_options) */
    trisect_embedding embedding;
    int accept_inside_out; /* for evaluation by winding numbers that are not zero */
} trisect_solid_options;

/* Of three coordinates a vertex and three indices a face, counter-clockwise seen from outside. */
TRISECT_C_API trisect_status trisect_solid_from_triangles(const double* vertices,
                                                          size_t vertex_count,
                                                          const uint32_t* faces, size_t face_count,
                                                          const trisect_solid_options* options,
                                                          trisect_solid** solid);
/* Face f has the corners from face_begin[f] up to but not including face_begin[f + 1]; face_begin
 * has face_count + 1 entries, the first of which is 0. */
TRISECT_C_API trisect_status
trisect_solid_from_polygons(const double* vertices, size_t vertex_count, const uint32_t* corners,
                            const uint32_t* face_begin, size_t face_count,
                            const trisect_solid_options* options, trisect_solid** solid);
TRISECT_C_API trisect_status trisect_solid_empty(trisect_solid** solid);
TRISECT_C_API trisect_status trisect_solid_whole_space(trisect_solid** solid);
/* The points with p[0] x + p[1] y + p[2] z + p[3] <= 0. */
TRISECT_C_API trisect_status trisect_solid_half_space(const double plane[4], trisect_solid** solid);
TRISECT_C_API trisect_status trisect_solid_box(const double low[3], const double high[3],
                                               trisect_solid** solid);
/* About the z axis, from z = 0 upwards. */
TRISECT_C_API trisect_status trisect_solid_cylinder(double radius, double height, uint32_t segments,
                                                    trisect_solid** solid);
TRISECT_C_API trisect_status trisect_solid_cone(double bottom_radius, double top_radius,
                                                double height, uint32_t segments,
                                                trisect_solid** solid);
/* 20 * 4^subdivisions triangles. */
TRISECT_C_API trisect_status trisect_solid_sphere(double radius, uint32_t subdivisions,
                                                  trisect_solid** solid);
TRISECT_C_API trisect_status trisect_solid_torus(double major_radius, double minor_radius,
                                                 uint32_t major_segments, uint32_t minor_segments,
                                                 trisect_solid** solid);
/* OBJ, STL, OFF or PLY; or a native file, where the name ends in .trisect, which has the solid to
 * the last bit. Its faces name operands by numbers that nothing else in this process has. */
TRISECT_C_API trisect_status trisect_solid_read(const char* path,
                                                const trisect_solid_options* options,
                                                trisect_solid** solid);
TRISECT_C_API trisect_status trisect_solid_write(const trisect_solid* solid, const char* path);
/* The exact boundary as text, and back, to the last bit. */
TRISECT_C_API trisect_status trisect_solid_exact_text(const trisect_solid* solid,
                                                      trisect_text** text);
TRISECT_C_API trisect_status trisect_solid_from_exact_text(const char* text, size_t length,
                                                           trisect_solid** solid);
/* The set that a program in OpenSCAD's evaluated form describes, as `trisect eval` has it; a region
 * of the plane is the prism over it from z = 0 to z = 1. No file is read for import() and
 * surface(): TRISECT_UNSUPPORTED. */
TRISECT_C_API trisect_status trisect_solid_from_csg(const char* text, size_t length,
                                                    trisect_solid** solid);
/* Another handle of the same solid; costs nothing. */
TRISECT_C_API trisect_status trisect_solid_copy(const trisect_solid* from, trisect_solid** solid);
TRISECT_C_API void trisect_solid_free(trisect_solid* solid);

/* What the sources of triangles call this operand, of a solid made of a mesh. */
TRISECT_C_API trisect_status trisect_solid_source_id(const trisect_solid* solid, uint32_t* id);
TRISECT_C_API trisect_status trisect_solid_is_empty(const trisect_solid* solid, int* is_empty);
TRISECT_C_API trisect_status trisect_solid_is_whole_space(const trisect_solid* solid,
                                                          int* is_whole_space);
/* Whether both are the same set, exactly. */
TRISECT_C_API trisect_status trisect_solid_equals(const trisect_solid* a, const trisect_solid* b,
                                                  int* is_equal);

/* Booleans ------------------------------------------------------------------------------------ */

typedef enum trisect_operation {
    TRISECT_UNION = 0,
    TRISECT_INTERSECTION = 1,
    TRISECT_DIFFERENCE = 2, /* the first operand without all others */
    TRISECT_XOR = 3         /* points in an odd number of operands */
} trisect_operation;

/* Of one operand or more, in one pass. */
TRISECT_C_API trisect_status trisect_boolean(trisect_operation operation,
                                             const trisect_solid* const* operands, size_t count,
                                             trisect_solid** result);
/* Keeps the last operands and their result, and evaluates the next ones only near those that
 * changed. Copies of one solid are the same operand. The result is that of trisect_boolean().
 * `evaluated_all` may be NULL; it is 1 where all was evaluated, as the first time. Threads are
 * those of the limits when it is made. Not for several threads at once. */
typedef struct trisect_edited trisect_edited;
TRISECT_C_API trisect_status trisect_edited_new(trisect_edited** edited);
TRISECT_C_API trisect_status trisect_edited_boolean(trisect_edited* edited,
                                                    trisect_operation operation,
                                                    const trisect_solid* const* operands,
                                                    size_t count, int* evaluated_all,
                                                    trisect_solid** result);
TRISECT_C_API void trisect_edited_free(trisect_edited* edited);
TRISECT_C_API trisect_status trisect_complement(const trisect_solid* solid, trisect_solid** result);
/* The parts below and above a plane, or inside and outside of another solid. */
TRISECT_C_API trisect_status trisect_split_by_plane(const trisect_solid* solid,
                                                    const double plane[4], trisect_solid** below,
                                                    trisect_solid** above);
TRISECT_C_API trisect_status trisect_split(const trisect_solid* solid, const trisect_solid* cutter,
                                           trisect_solid** inside, trisect_solid** outside);

/* The matrix (M | t), row by row. Maps that keep the lattice are exact; of others each vertex is
 * rounded once. `largest_move` may be NULL; 0 says that nothing was rounded. */
TRISECT_C_API trisect_status trisect_solid_transform(const trisect_solid* solid,
                                                     const double rows[12], double* largest_move,
                                                     trisect_solid** result);

typedef struct trisect_solid_list trisect_solid_list;
/* The connected parts. */
TRISECT_C_API trisect_status trisect_components(const trisect_solid* solid,
                                                trisect_solid_list** parts);
TRISECT_C_API size_t trisect_solid_list_count(const trisect_solid_list* list);
/* A new handle of one of them. */
TRISECT_C_API trisect_status trisect_solid_list_get(const trisect_solid_list* list, size_t index,
                                                    trisect_solid** solid);
TRISECT_C_API void trisect_solid_list_free(trisect_solid_list* list);

/* Meshes -------------------------------------------------------------------------------------- */

typedef struct trisect_mesh trisect_mesh;
/* The boundary as triangles; coordinates are rounded once. */
TRISECT_C_API trisect_status trisect_solid_mesh(const trisect_solid* solid, trisect_mesh** mesh);
TRISECT_C_API size_t trisect_mesh_vertex_count(const trisect_mesh* mesh);
TRISECT_C_API size_t trisect_mesh_face_count(const trisect_mesh* mesh);
/* Three numbers a vertex, three indices a face, the operand and the operand's face of each face. */
TRISECT_C_API const double* trisect_mesh_vertices(const trisect_mesh* mesh);
TRISECT_C_API const uint32_t* trisect_mesh_faces(const trisect_mesh* mesh);
TRISECT_C_API const uint32_t* trisect_mesh_sources(const trisect_mesh* mesh);
TRISECT_C_API void trisect_mesh_free(trisect_mesh* mesh);

/* Measures ------------------------------------------------------------------------------------ */

TRISECT_C_API trisect_status trisect_volume(const trisect_solid* solid, double* volume);
TRISECT_C_API trisect_status trisect_area(const trisect_solid* solid, double* area);
/* "p" or "p/q" in decimal. */
TRISECT_C_API trisect_status trisect_exact_volume(const trisect_solid* solid,
                                                  trisect_text** volume);
/* TRISECT_UNSUPPORTED for the empty set, which has none. */
TRISECT_C_API trisect_status trisect_centroid(const trisect_solid* solid, double centroid[3]);
TRISECT_C_API trisect_status trisect_bounds(const trisect_solid* solid, double low[3],
                                            double high[3]);

/* Queries ------------------------------------------------------------------------------------- */

typedef enum trisect_location {
    TRISECT_OUTSIDE = 0,
    TRISECT_ON_FACE = 1,
    TRISECT_ON_EDGE = 2,
    TRISECT_ON_VERTEX = 3,
    TRISECT_INSIDE = 4
} trisect_location;

/* One byte a point: a trisect_location. */
TRISECT_C_API trisect_status trisect_locate(const trisect_solid* solid, const double* points,
                                            size_t count, uint8_t* locations);
/* The first hit of each ray: its parameter in lengths of the direction, infinite where nothing is
 * hit, and two numbers, the operand and its face. `faces` may be NULL. */
TRISECT_C_API trisect_status trisect_first_hits(const trisect_solid* solid, const double* origins,
                                                const double* directions, size_t count,
                                                double* parameters, uint32_t* faces);
/* Below 0 inside, 0 on the boundary: the sign is exact. */
TRISECT_C_API trisect_status trisect_signed_distances(const trisect_solid* solid,
                                                      const double* points, size_t count,
                                                      double* distances);

typedef struct trisect_section trisect_section;
/* The points of a solid in the plane p[0] x + p[1] y + p[2] z + p[3] = 0. */
TRISECT_C_API trisect_status trisect_solid_section(const trisect_solid* solid,
                                                   const double plane[4],
                                                   trisect_section** section);
/* Loops of all regions, one region after the other, the outline of each first. */
TRISECT_C_API size_t trisect_section_loop_count(const trisect_section* section);
TRISECT_C_API size_t trisect_section_region(const trisect_section* section, size_t loop);
TRISECT_C_API int trisect_section_is_hole(const trisect_section* section, size_t loop);
/* NULL for a loop that does not exist; `count` is then 0. */
TRISECT_C_API const double* trisect_section_points(const trisect_section* section, size_t loop,
                                                   size_t* count);
TRISECT_C_API void trisect_section_free(trisect_section* section);

/* Poses and interference ---------------------------------------------------------------------- */

/* An exact affine map; where a pose may be NULL, that is the identity. */
typedef struct trisect_pose trisect_pose;
TRISECT_C_API trisect_status trisect_pose_from_rows(const double rows[12], trisect_pose** pose);
/* The rotation by the quaternion (w, x, y, z) of integers, then a translation. */
TRISECT_C_API trisect_status trisect_pose_from_quaternion(const int64_t quaternion[4],
                                                          const double translation[3],
                                                          trisect_pose** pose);
/* First b, then a. */
TRISECT_C_API trisect_status trisect_pose_product(const trisect_pose* a, const trisect_pose* b,
                                                  trisect_pose** pose);
TRISECT_C_API trisect_status trisect_pose_inverse(const trisect_pose* of, trisect_pose** pose);
/* The numbers nearest in double precision. */
TRISECT_C_API trisect_status trisect_pose_rows(const trisect_pose* pose, double rows[12]);
TRISECT_C_API void trisect_pose_free(trisect_pose* pose);

typedef enum trisect_relation {
    TRISECT_DISJOINT = 0,
    TRISECT_TOUCHING = 1,
    TRISECT_OVERLAPPING = 2,
    TRISECT_IS_INSIDE = 3,
    TRISECT_CONTAINS = 4,
    TRISECT_EQUAL = 5
} trisect_relation;

/* How solid A under its pose lies to solid B under its pose, exactly. */
TRISECT_C_API trisect_status trisect_interfere(const trisect_solid* a, const trisect_pose* pose_a,
                                               const trisect_solid* b, const trisect_pose* pose_b,
                                               trisect_relation* relation);
/* Of the boundaries: lower <= distance <= upper. Infinite where a solid is empty. */
TRISECT_C_API trisect_status trisect_distance(const trisect_solid* a, const trisect_pose* pose_a,
                                              const trisect_solid* b, const trisect_pose* pose_b,
                                              double* lower, double* upper);
TRISECT_C_API trisect_status trisect_are_nearer_than(const trisect_solid* a,
                                                     const trisect_pose* pose_a,
                                                     const trisect_solid* b,
                                                     const trisect_pose* pose_b, double distance,
                                                     int* are_nearer);

/* Motion -------------------------------------------------------------------------------------- */

/* A pose for every parameter from 0 to 1; NULL stands still where the solid was modelled. */
typedef struct trisect_motion trisect_motion;
TRISECT_C_API trisect_status trisect_motion_still(const trisect_pose* pose,
                                                  trisect_motion** motion);
TRISECT_C_API trisect_status trisect_motion_translation(const trisect_pose* start,
                                                        const double by[3],
                                                        trisect_motion** motion);
TRISECT_C_API trisect_status trisect_motion_screw(const trisect_pose* start,
                                                  const int64_t quaternion[4],
                                                  const double center[3], const double shift[3],
                                                  trisect_motion** motion);
TRISECT_C_API void trisect_motion_free(trisect_motion* motion);

/* The first time at which the solids have a point in common, or from which on their interiors meet
 * (until_overlap). Where `exists` is 0 it is proved that there is none. `time` is the exact one,
 * rounded once. */
TRISECT_C_API trisect_status trisect_first_contact(const trisect_solid* a,
                                                   const trisect_motion* motion_a,
                                                   const trisect_solid* b,
                                                   const trisect_motion* motion_b,
                                                   int until_overlap, int* exists, double* time);

/* Scenes -------------------------------------------------------------------------------------- */

/* Many solids under poses. One thread may use a scene at a time. */
typedef struct trisect_scene trisect_scene;
typedef struct trisect_body {
    uint32_t index;
    uint32_t generation;
} trisect_body;
typedef struct trisect_pair {
    trisect_body a;
    trisect_body b;
    trisect_relation relation;
} trisect_pair;
TRISECT_C_API trisect_status trisect_scene_create(trisect_scene** scene);
TRISECT_C_API trisect_status trisect_scene_add(trisect_scene* scene, const trisect_solid* solid,
                                               const trisect_pose* pose, trisect_body* body);
TRISECT_C_API trisect_status trisect_scene_set_pose(trisect_scene* scene, trisect_body body,
                                                    const trisect_pose* pose);
TRISECT_C_API trisect_status trisect_scene_replace(trisect_scene* scene, trisect_body body,
                                                   const trisect_solid* solid);
TRISECT_C_API trisect_status trisect_scene_remove(trisect_scene* scene, trisect_body body);
/* All pairs that are not disjoint. The array is the scene's until the next call with it. */
TRISECT_C_API trisect_status trisect_scene_interfering(trisect_scene* scene,
                                                       const trisect_pair** pairs, size_t* count);
TRISECT_C_API void trisect_scene_free(trisect_scene* scene);

/* Checks -------------------------------------------------------------------------------------- */

typedef struct trisect_report trisect_report;
typedef struct trisect_finding {
    const char* kind; /* such as "open_edge" */
    int is_error;     /* 0: a warning */
    double place[3];
    const char* sentence;
    const uint32_t* vertices;
    size_t vertex_count;
    const uint32_t* faces;
    size_t face_count;
} trisect_finding;
/* What keeps triangles from bounding a solid. */
TRISECT_C_API trisect_status trisect_check(const double* vertices, size_t vertex_count,
                                           const uint32_t* faces, size_t face_count,
                                           trisect_report** report);
TRISECT_C_API int trisect_report_is_solid(const trisect_report* report);
TRISECT_C_API size_t trisect_report_count(const trisect_report* report);
/* Pointers in the finding are the report's. TRISECT_USAGE for an index that is too large. */
TRISECT_C_API trisect_status trisect_report_finding(const trisect_report* report, size_t index,
                                                    trisect_finding* finding);
TRISECT_C_API void trisect_report_free(trisect_report* report);

typedef enum trisect_verdict {
    TRISECT_VERDICT_EQUAL = 0,
    TRISECT_VERDICT_WITHIN = 1,
    TRISECT_VERDICT_DIFFERENT = 2,
    TRISECT_VERDICT_UNDECIDED = 3,
    TRISECT_VERDICT_NOT_CLOSED = 4
} trisect_verdict;
/* A mesh that lies in the caller's memory. */
typedef struct trisect_triangles {
    const double* vertices;
    size_t vertex_count;
    const uint32_t* faces;
    size_t face_count;
} trisect_triangles;
/* Proves that a mesh is the result of a boolean, up to a distance where `within` is not negative,
 * or that it is not. Some point is wrong by at least `lower`, none by more than `upper`. */
TRISECT_C_API trisect_status trisect_verify(trisect_operation operation,
                                            const trisect_triangles* operands, size_t count,
                                            const trisect_triangles* result, double within,
                                            trisect_verdict* verdict, double* lower, double* upper);

#ifdef __cplusplus
}
#endif

#endif
