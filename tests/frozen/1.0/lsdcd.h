/* SPDX-FileCopyrightText: 2026 LSDCD contributors */
/* SPDX-License-Identifier: BSD-3-Clause */

/* Distances from points to a triangle mesh, exact and many at once, on the CPU or an NVIDIA GPU; which
 * triangles of a rigid body meet which of a wall; and a wall that pushes spheres, step by step.
 *
 *   mesh -> grid, for distances at any range or up to a cutoff -> queries of points in arrays of the caller
 *   two meshes -> body -> its collisions with the wall, pose by pose
 *   meshes, contact laws -> wall -> forces and torques on the caller's spheres, step by step
 *
 * A function returns LSDCD_OK, 0, or the code of an error, whose text lsdcd_last_error() has. It
 * then has changed nothing but, where a query failed, the arrays of its answers, which hold
 * nothing of use. Structs begin with their size, for later versions; what is 0 or null in them has
 * its default. Lengths are in the unit of the mesh.
 *
 * Threads: each function says "any" where any number of threads may call it at once, with the same
 * objects; "own" where no other thread may use the object that it takes at the same time.
 * The objects that a grid, stream or body is made from may be freed before it. A child of fork() may use what its parent has
 * made, with any number of threads, but for what is on a CUDA device: CUDA does not work in a child whose parent has
 * used it.
 */
#ifndef LSDCD_H
#define LSDCD_H

#include <stddef.h>
#include <stdint.h>

#if defined(__cplusplus)
extern "C" {
#endif

#define LSDCD_VERSION_MAJOR 0
#define LSDCD_VERSION_MINOR 10
#define LSDCD_VERSION_PATCH 0

#if defined(__GNUC__)
#define LSDCD_API __attribute__((visibility("default")))
#else
#define LSDCD_API
#endif

/* ---- errors --------------------------------------------------------------------------------- */

enum {
  LSDCD_OK = 0,
  LSDCD_ERROR_ARGUMENT = 1, /* a null pointer, words, a number or a struct that make no sense */
  LSDCD_ERROR_INPUT = 2,    /* a file, mesh or setting that cannot be used */
  LSDCD_ERROR_CUTOFF = 3,   /* a radius beyond the grid's cutoff */
  LSDCD_ERROR_SIDE = 4,     /* the side of a mesh that has none: open, not oriented, or with
                               triangles in both windings that enclose a space; or, on a device, it
                               cuts itself */
  LSDCD_ERROR_DEVICE = 5,   /* no CUDA, or an array where it cannot be reached */
  LSDCD_ERROR_MEMORY = 6,   /* none left */
  LSDCD_ERROR_INTERNAL = 7, /* a defect of this library */
  LSDCD_ERROR_CANCELLED = 8 /* `progress` asked for it, or `show` threw */
};

/* "0.10.0". Any. */
LSDCD_API const char *lsdcd_version(void);
/* "cutoff" for LSDCD_ERROR_CUTOFF. Any. */
LSDCD_API const char *lsdcd_error_name(int code);
/* The error of the last call of this thread that failed, and what to do; until its next call. Any. */
LSDCD_API const char *lsdcd_last_error(void);

/* Hears of a long call: what it does now, a text that lives as long as this call, and how much of that is done, from
 * 0 to 1. If it returns not 0, the call ends with LSDCD_ERROR_CANCELLED. It is called by the thread of the call, some
 * ten times a second, and may call any function but with objects of that call. `data` is the one beside it in a
 * struct. */
typedef int lsdcd_progress(void *data, const char *what, double done);

/* ---- meshes --------------------------------------------------------------------------------- */

typedef struct lsdcd_mesh lsdcd_mesh;

/* Reads a mesh file, by the end of its name: STL, OBJ, PLY or OFF. Polygons are cut into triangles.
 * Corners closer than `weld` (length) become one; < 0: equal ones, and those on open edges within 1e-6 of the part of the
 * mesh that edges connect. The mesh need be neither closed nor manifold. Any. */
LSDCD_API int lsdcd_mesh_read(const char *file, double weld, lsdcd_mesh **mesh);
/* The same from corners: nine numbers a triangle, copied. Any. */
LSDCD_API int lsdcd_mesh_from_corners(const double *corners, size_t n_triangles, double weld,
                                      lsdcd_mesh **mesh);
/* The same from vertices, three numbers each, of `type` LSDCD_DOUBLE or LSDCD_FLOAT, and faces, three
 * vertices each, numbered from 0; copied. A vertex of no face is left out. LSDCD_ERROR_INPUT names a face
 * whose vertex is not there or not finite. Any. */
LSDCD_API int lsdcd_mesh_from_faces(const void *vertices, int type, size_t n_vertices,
                                    const uint32_t *faces, size_t n_faces, double weld,
                                    lsdcd_mesh **mesh);

typedef struct lsdcd_mesh_facts {
  size_t size;                   /* of this struct; set by the caller */
  size_t triangles;              /* as given */
  size_t faces, edges, vertices; /* after welding; faces without area are none, nor are those whose
                                    height is at most 8 * 2.2e-16 times their largest coordinate:
                                    their edges and corners stand for them, and distances over them
                                    are too large by up to half that height */
  size_t open_edges;             /* edges of one face */
  int closed, oriented;          /* oriented: closed, windings agree, those of closed shells with
                                    each other, too, no shells meet, and no triangle is there in
                                    both windings */
  double area, volume;           /* the volume is < 0 where normals point in; what lies in two
                                    shells counts twice */
  double lo[3], hi[3];
  size_t meeting_pairs; /* of triangles of different closed shells, which cut, overlap or
                                    touch each other there */
  /* The vertices of lsdcd_mesh_from_faces(), or of a file of a format other than STL; else three corners a triangle. */
  size_t given_vertices;
} lsdcd_mesh_facts;
/* Any. */
LSDCD_API int lsdcd_mesh_get_facts(const lsdcd_mesh *mesh, lsdcd_mesh_facts *facts);

/* The welded mesh, copied into arrays of the caller; those that are null are not asked for. How many faces,
 * edges and vertices there are, lsdcd_mesh_facts has. Their numbers, from 0, are those of features in
 * answers. A face is a triangle with an area; edges and vertices of those without one may have no face. */
typedef struct lsdcd_mesh_arrays {
  size_t size;      /* of this struct */
  double *vertices; /* 3 numbers each, length */
  uint32_t *faces;  /* 3 vertices each, in the order given */
  /* 3 edges each; edge k is from vertex k to vertex k + 1, the last one to 0 */
  uint32_t *face_edges;
  uint32_t *triangle; /* of each face its number as given, from 0 */
  uint32_t *edges;    /* 2 vertices each, the lower number first */
  /* The faces at edge e: edge_faces[edge_first[e]] up to before edge_faces[edge_first[e + 1]]. */
  uint32_t *edge_first; /* edges + 1 numbers */
  uint32_t *edge_faces; /* 3 * faces numbers */
  /* `given_vertices` numbers: of each vertex as given the one here that it was welded to, at most `weld` away. The vertices of an
   * STL file or of corners are the corners, three a triangle, in their order. LSDCD_NONE: a vertex of no triangle; of a
   * file one at whose place no triangle has a corner. */
  uint32_t *welded_vertex;
  /* `triangles` numbers: of each triangle as given its face. One that has the corners of another, in either winding, has
   * that one's face, whose `triangle` is the first of them. LSDCD_NONE: one without area, which is no face. */
  uint32_t *welded_face;
} lsdcd_mesh_arrays;
/* Any. */
LSDCD_API int lsdcd_mesh_get_arrays(const lsdcd_mesh *mesh, const lsdcd_mesh_arrays *arrays);
/* The text of `lsdcd inspect`, until the mesh is freed. Any. */
LSDCD_API const char *lsdcd_mesh_report(const lsdcd_mesh *mesh);
/* Null is fine. Own. */
LSDCD_API void lsdcd_mesh_free(lsdcd_mesh *mesh);

/* ---- grids ---------------------------------------------------------------------------------- */

typedef struct lsdcd_grid lsdcd_grid;

/* A tree answers points at any range, exactly, and the same whatever the cutoff: on the CPU in double, and on GPUs
 * where there is no cutoff. Cells with lists serve GPUs up to a cutoff, where they are quicker, LSDCD_FLOAT,
 * `nearest` and contacts. lsdcd_grid_build() makes them where an option from `cell` to `cache`, or `device`, is
 * set; else the first stream or call for contacts does. */

/* Distances of a grid with precision LSDCD_FLOAT are off by at most 3e-6 (cutoff + 14 cell); on a device sides may be those of the
 * other face where the mesh is thinner. */
enum { LSDCD_DOUBLE = 0, LSDCD_FLOAT = 1 };
enum { LSDCD_CPU = 0, LSDCD_CUDA = 1 };

typedef struct lsdcd_grid_options {
  size_t size;       /* of this struct */
  double cutoff;     /* the largest distance that will be asked for; 0: any */
  double cell;       /* edge of a cell: time against memory; 0: chosen */
  int nearest;       /* 0: complete lists, always exact; N: the N triangles nearest to a cell */
  int precision;     /* of the search: LSDCD_DOUBLE, or LSDCD_FLOAT, quicker on a GPU */
  double memory;     /* most bytes; 0: 1 GiB beside the mesh's own records */
  const char *cache; /* file that stores the cells; one that does not fit is replaced; null: none */
  int threads;       /* that build it; 0: OMP_NUM_THREADS, or one */
  int device;        /* that builds cells: LSDCD_CPU or LSDCD_CUDA; they are the same */
  lsdcd_progress *progress; /* of this call; null: none */
  void *data;
} lsdcd_grid_options;
/* Any. */
LSDCD_API int lsdcd_grid_build(const lsdcd_mesh *mesh, const lsdcd_grid_options *options,
                               lsdcd_grid **grid);

typedef struct lsdcd_grid_facts {
  size_t size;   /* of this struct; set by the caller */
  double cutoff; /* infinite: any */
  double cell;   /* 0: there are no cells yet */
  size_t bytes;
  int nearest;
  int has_sides; /* do as many triangles run one way along each edge as the other? Those in both windings
                     must not enclose a space, nor be all that there is */
  int from_cache; /* was it read, not built? */
} lsdcd_grid_facts;
/* Any. */
LSDCD_API int lsdcd_grid_get_facts(const lsdcd_grid *grid, lsdcd_grid_facts *facts);
/* A text on the grid, and on its cache file; until the grid is freed. Any. */
LSDCD_API const char *lsdcd_grid_report(const lsdcd_grid *grid);
/* Null is fine. Own. */
LSDCD_API void lsdcd_grid_free(lsdcd_grid *grid);

/* ---- queries -------------------------------------------------------------------------------- */

/* Bits of a point's status. Only a certified answer is sure: what is FOUND is the nearest of the
 * whole mesh, and where nothing is, nothing is within the radius. All are certified but with
 * `nearest` N. SIDE_ESTIMATED: the side is not certified, whatever CERTIFIED says of the rest. */
enum { LSDCD_FOUND = 1, LSDCD_CERTIFIED = 2, LSDCD_SIDE_ESTIMATED = 4 };

/* A feature is 0 (face), 1 (edge) or 2 (vertex) and a number of the welded mesh, lsdcd_mesh_arrays. */
#define LSDCD_FEATURE_KIND(feature) ((feature) >> 30)
#define LSDCD_FEATURE_INDEX(feature) ((feature) &0x3fffffffu)
#define LSDCD_NONE 0xffffffffu

/* Points, and arrays for what is asked of them; those that are null are not asked for. Arrays of
 * numbers are of one type. Number k of point i is at [i * row + k * column], those of one number at
 * [i * step]; 0: packed. No two answers have one place. All others have one number a point.
 * Nothing at `radius` or farther is found: there the distance is infinite, the closest point the
 * point itself, the normal 0, triangle and feature LSDCD_NONE. A point that is no
 * number is far from everything. */
typedef struct lsdcd_query {
  size_t size; /* of this struct */
  size_t n;
  int type;    /* LSDCD_DOUBLE or LSDCD_FLOAT: of all arrays of numbers here */
  int threads; /* on the CPU; 0: OMP_NUM_THREADS, or one */
  const void *points;
  ptrdiff_t points_row, points_column;
  const void *radii; /* of each point, >= 0, at 0 nothing is found; null: `radius` is that of all */
  ptrdiff_t radii_step;
  double radius; /* >= 0; 0: the cutoff, or any distance without one */
  void *distance;
  ptrdiff_t distance_step;
  void *closest;
  ptrdiff_t closest_row, closest_column;
  void *normal; /* unit, from the mesh to the point */
  ptrdiff_t normal_row, normal_column;
  uint32_t *triangle; /* by its number as given, from 0; of several at the same distance, rounded,
                         the lowest; LSDCD_NONE also for the edge or corner of a triangle without
                         area */
  uint32_t *feature;
  int8_t *side; /* 1 outside, and on the mesh; -1 inside; at any distance, but 0 where a coordinate
                   is no number. On a device see LSDCD_FLOAT, and 0 also where not found or not certified, and where an
                   edge or corner of triangles without area is nearest */
  uint8_t *status;
  /* On the host, of any mesh: how often it winds round the point, the solid angle under which it is seen over
   * 4 pi, counted > 0 where normals point away. A whole number where grids have sides; else off by rounding,
   * at most 2e-12 for each open edge, and near edges of the mesh by 1e-15 times their length over how far
   * they are. On the mesh the mean of both sides; no number where a coordinate is none. Takes the time of
   * the open edges, at most of all triangles. */
  void *winding;
  ptrdiff_t winding_step;
  int estimate_sides; /* on the host; 1: where the grid has no sides, `side` is -1 where the whole number
                         nearest to `winding` is not 0, else 1, and `status` has LSDCD_SIDE_ESTIMATED.
                         0: asking for these is an error */
  lsdcd_progress *progress; /* on the host; with it points are answered in parts; null: none */
  void *data;
  /* The distance, negative where `side` is -1: > 0 outside, < 0 inside, 0 on the mesh; infinite, with its sign, where
   * nothing is found. Asked for under the conditions of `side`, `estimate_sides` included, with or without it. Where that
   * would be 0, as on a device where nothing is found, no number. */
  void *signed_distance;
  ptrdiff_t signed_distance_step;
  /* 3 numbers, the barycentric coordinates of the closest point in `triangle`: the point is the sum of the triangle's
   * welded corners, in the order given, times these. Each is >= 0 and their sum 1, up to its rounding; that of a corner
   * that the closest feature does not have is 0. The sum is off from `closest` by no more than that is off, also in thin
   * triangles. No numbers where `triangle` is LSDCD_NONE. */
  void *barycentric;
  ptrdiff_t barycentric_row, barycentric_column;
} lsdcd_query;

/* Answers in arrays of the host. Any. */
LSDCD_API int lsdcd_query_host(const lsdcd_grid *grid, const lsdcd_query *query);

/* Spheres, and arrays for their contacts: each place of the mesh whose distance to a centre is a local
 * minimum below the radius, however many there are. Triangles that form one plane give one contact.
 * Contacts of sphere i are first[i] up to before first[i + 1], ascending in features. Arrays of contacts
 * hold `room` of them, packed; those that are null are not asked for. Steps of points and radii are as in
 * lsdcd_query. A sphere whose centre is no number has none. */
typedef struct lsdcd_contacts {
  size_t size; /* of this struct */
  size_t n;
  int type;           /* LSDCD_DOUBLE or LSDCD_FLOAT: of all arrays of numbers here */
  int threads;        /* 0: OMP_NUM_THREADS, or one */
  const void *points; /* centres */
  ptrdiff_t points_row, points_column;
  /* The radius of each sphere, >= 0 and at most the cutoff; null: `radius` is that of all. */
  const void *radii;
  ptrdiff_t radii_step;
  double radius; /* >= 0; 0: the cutoff */
  size_t *first; /* n + 1 numbers, the last one how many contacts there are */
  size_t room;
  void *point;    /* 3 numbers each, on the mesh */
  void *distance; /* >= 0, from there to the centre */
  void *overlap;  /* radius - distance, > 0 */
  void *normal;   /* 3 numbers each, unit, from the mesh to the centre */
  /* 0 to 1: the share of the contact, by the rule with which the wall adds up forces at corners: as one where
   * the mesh is smooth, all where faces are square to each other. */
  void *weight;
  uint32_t *triangle, *feature; /* as in lsdcd_query */
  /* Answer: all there are, so the room that all take; with less room only `first` is written. */
  size_t contacts;
  lsdcd_progress *progress; /* null: none */
  void *data;
} lsdcd_contacts;
/* In arrays of the host. The grid has a cutoff, precision LSDCD_DOUBLE, and no `nearest`; its first call
 * makes cells. LSDCD_ERROR_CUTOFF: a radius beyond the cutoff, or no cutoff; LSDCD_ERROR_INPUT: a sphere
 * with more than 512 contacts. Any. */
LSDCD_API int lsdcd_contacts_host(const lsdcd_grid *grid, lsdcd_contacts *contacts);

/* A grain that is the body (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 <= 1 in its own frame: an ellipsoid where both exponents
 * are 2, a box with rounded edges where they are large. */
typedef struct lsdcd_shape_facts {
  size_t size; /* of this struct; set by the caller */
  double volume;
  double inertia[3];    /* about the axes, over the mass, at uniform density: length^2 */
  double circumscribed; /* radius of the smallest sphere about the centre that holds it */
  double inscribed;     /* radius of the largest one that it holds */
  /* Least radius of curvature. Contacts with an overlap above it may jump where they leave a fold or an edge. */
  double curvature_radius;
  /* Least mass with which a point of its surface meets a plane, over the mass: 1 for a sphere, 1/4 for a long rod. */
  double least_mass;
} lsdcd_shape_facts;
/* half_axes: a b c; exponents: n1 n2, from 2 to 20, null: 2. LSDCD_ERROR_INPUT: numbers that make no shape. Any. */
LSDCD_API int lsdcd_shape_get_facts(const double *half_axes, const double *exponents,
                                    lsdcd_shape_facts *facts);

/* Ellipsoids and superellipsoids, and arrays for their contacts and distances, packed; those that are null are not asked for.
 * The signed distance of a place of the mesh from a grain is that from its surface, below 0 inside. Contacts are its local
 * minima over the mesh below 0, however many there are: they do not depend on how the mesh is cut into triangles, and a plane
 * has one. Those of grain i are first[i] up to before first[i + 1], ascending in features. */
typedef struct lsdcd_shapes {
  size_t size; /* of this struct */
  size_t n;
  int threads;           /* 0: OMP_NUM_THREADS, or one */
  int one_shape;         /* 1: half_axes and exponents are those of all; 0: of each */
  const double *centres; /* 3 numbers each */
  /* w i j k each, of any length above 0: turn a grain's frame to where it is; null: not turned. */
  const double *quaternions;
  const double *half_axes; /* a b c each, > 0 */
  /* n1 (along z) and n2 (in the plane of x and y) each, from 2 to 20; null: 2, ellipsoids. */
  const double *exponents;
  /* n + 1 numbers, the last one how many contacts there are; null: contacts are not asked for. */
  size_t *first;
  size_t room;
  double *point;                /* 3 numbers each, on the mesh */
  double *of_grain;             /* 3 numbers each, of the grain's surface: where a force acts */
  double *overlap;              /* > 0, from one to the other */
  double *normal;               /* 3 numbers each, unit, from the mesh into the grain */
  uint32_t *triangle, *feature; /* as in lsdcd_query */
  /* Of each grain n numbers, not only of those that touch: its signed distance from the mesh, the overlap with a minus where it
   * touches, and where that is. At any range; infinite with LSDCD_NONE where a coordinate of the centre is no number. */
  double *distance;
  double *closest;          /* 3 numbers each, on the mesh */
  double *closest_of_grain; /* 3 numbers each */
  double *closest_normal;   /* 3 numbers each */
  uint32_t *closest_triangle, *closest_feature;
  /* Answer: all contacts, so the room that all take; with less room only `first` and the arrays of grains are written. */
  size_t contacts;
  lsdcd_progress *progress; /* null: none */
  void *data;
} lsdcd_shapes;
/* In arrays of the host. The grid has precision LSDCD_DOUBLE and no `nearest`; its cutoff does not matter. LSDCD_ERROR_INPUT
 * names a grain whose numbers make no shape. Any. */
LSDCD_API int lsdcd_shapes_host(const lsdcd_grid *grid, lsdcd_shapes *shapes);

/* A grid on the CUDA device that is current, and a stream (cudaStream_t) of that device, null: the
 * default one. Without a cutoff the grid's tree answers, with the numbers of lsdcd_query_host(). Queries
 * need the stream. Streams of one grid share its copy on a device. Any. */
typedef struct lsdcd_stream lsdcd_stream;
LSDCD_API int lsdcd_stream_open(const lsdcd_grid *grid, void *cuda_stream, lsdcd_stream **stream);
/* Answers in arrays of that device, or managed ones, in the order of the stream and without waiting
 * for it, but for `radii`, which are checked. Distance and status alone are quickest, most of all
 * where points and radii lie as x y z r x y z r, aligned to 16 bytes. Own. */
LSDCD_API int lsdcd_query_stream(lsdcd_stream *stream, const lsdcd_query *query);
/* Waits for the device; the CUDA stream may be gone. Null is fine. Own. */
LSDCD_API void lsdcd_stream_free(lsdcd_stream *stream);
/* 1 where there is a CUDA device that this library can use; else 0, and lsdcd_last_error() says
 * why. Any. */
LSDCD_API int lsdcd_has_cuda(void);

/* ---- bodies --------------------------------------------------------------------------------- */

/* A rigid body against a wall, both meshes, neither need be closed. Faces count, not volumes: a body
 * that is whole inside a closed wall meets nothing. */
typedef struct lsdcd_body lsdcd_body;

typedef struct lsdcd_body_options {
  size_t size; /* of this struct */
  double cell; /* edge of a cell of the wall's grid, to which the body is cut; 0: the median edge of
                    the body. Longer ones take less memory, and are quicker until the wall has many
                    triangles in one */
  int nearest; /* 0: exact; N, up to 32: the N triangles of the wall nearest to a cell, which may
                    miss pairs */
  double memory; /* most bytes of the grid; 0: 1 GiB beside the wall's own records */
  int threads;   /* that make it, on the CPU; 0: OMP_NUM_THREADS, or one */
  int device; /* LSDCD_CPU or LSDCD_CUDA, the device that is current: for all that the body does */
  const lsdcd_body *same_wall; /* a body whose wall this one shares, with its grid and device: then
                                  `wall`, and `cell` to `device`, are not given; null: none */
  lsdcd_progress *progress;    /* of lsdcd_body_make(), on the grid; null: none */
  void *data;
} lsdcd_body_options;
/* `options` may be null: all defaults. Any. */
LSDCD_API int lsdcd_body_make(const lsdcd_mesh *wall, const lsdcd_mesh *mesh,
                              const lsdcd_body_options *options, lsdcd_body **body);

typedef struct lsdcd_body_facts {
  size_t size;      /* of this struct; set by the caller */
  size_t triangles; /* those with an area */
  size_t pieces;    /* that they are cut into */
  double cell;
  size_t grid_bytes;
  int nearest, device;
} lsdcd_body_facts;
/* Any. */
LSDCD_API int lsdcd_body_get_facts(const lsdcd_body *body, lsdcd_body_facts *facts);

/* A pose, arrays of the caller, and what is found. A pose is `matrix`, or `position`, `quaternion`
 * or both: a point x of the body's mesh is at R x + t in the wall's frame. Corners in a pose are
 * rounded to doubles; for these the answer is exact, and touching is meeting.
 * Pairs ascend by the body's triangle; each array is of `room` pairs, or null: not asked for. */
typedef struct lsdcd_collision {
  size_t size;              /* of this struct */
  int threads;              /* on the CPU; 0: OMP_NUM_THREADS, or one */
  int collides;             /* answer: does any pair meet? */
  const double *matrix;     /* 12 numbers, rows of R, each with its t behind it. R is a rotation to
                               1e-6, as floats are, and made one */
  const double *position;   /* 3 numbers, t; null: 0 */
  const double *quaternion; /* 4 numbers, w x y z, R; null: as the mesh is */
  size_t room;              /* pairs that the arrays hold; of more, the first are written */
  uint32_t *wall_triangle;  /* by its number as given, from 0; LSDCD_NONE: one without area */
  uint32_t *body_triangle;
  double *segment;  /* 6 numbers a pair: from x y z to x y z, what both have in common, rounded; not
                        numbers where they lie in one plane */
  size_t pairs;     /* answer: all there are, so the room that all take */
  size_t uncertain; /* answer, with `nearest` N: pieces where pairs may be missing; 0: exact */
} lsdcd_collision;
/* Own. */
LSDCD_API int lsdcd_collide(lsdcd_body *body, lsdcd_collision *collision);
/* Null is fine. Own. */
LSDCD_API void lsdcd_body_free(lsdcd_body *body);

/* ---- contact laws --------------------------------------------------------------------------- */

/* The facts of a sub-model, a formula of contact laws that words name: "hooke/history", or "tangential mindlin" behind a normal one. Numbers stand in
 * their order behind its name, in the caller's units: force/length, 1/time, ...; a pressure is a force/length^2. Texts live as long as the library. */
typedef struct lsdcd_sub_model_facts {
  size_t size;        /* of this struct; set by the caller */
  const char *family; /* "style", "normal", or the word in front of its name: "tangential" */
  const char *name;   /* "mindlin" */
  const char *source; /* one line: what it is, and where its formula comes from */
  int beside_style; /* 1: it may stand beside a classic style or is one; 0: beside a normal sub-model alone */
  int n;            /* how many numbers it has; of number k, from 0: */
  const char *number[8];    /* its name: "kt" */
  const char *unit[8];      /* "force/length^2"; "1": none */
  double least[8], most[8]; /* its range */
  int may_be_derived[8];    /* 1: it may be NULL, and is derived from others */
} lsdcd_sub_model_facts;
/* The facts of sub-model number k, from 0, of all that this library has; LSDCD_ERROR_ARGUMENT: there are not so many. Any. */
LSDCD_API int lsdcd_sub_model_get_facts(size_t k, lsdcd_sub_model_facts *facts);

/* ---- walls ---------------------------------------------------------------------------------- */

/* The wall of fix wall/lsdcd, for any program that moves spheres: every contact law, meshes that move,
 * servos, wear, files. Units are any that are consistent. Spheres are counted from 0, meshes too. */
typedef struct lsdcd_wall lsdcd_wall;

/* A message of a wall: a line for the log, or with `warning` 1 what is probably not meant. It may call any function but
 * with this wall. What it throws in C++ does not interrupt the call, which then returns LSDCD_ERROR_CANCELLED with its
 * text, though all is done; a wall is not made. */
typedef void lsdcd_message(void *data, int warning, const char *text);

/* For a program of several processes, as with MPI. Each has a wall of the same words, for spheres of its own,
 * and all call the functions of the wall together, in the same order, but for those that say "alone". All
 * processes then fail together, too, but for out of memory and errors of CUDA: end all of them there.
 * A callback is called by all processes in the calls of their walls, and calls nothing with the wall; it changes the
 * array in place and returns 0, or what the call then fails with, as MPI_Allreduce and MPI_Bcast do. */
typedef struct lsdcd_host {
  size_t size;         /* of this struct */
  int rank, processes; /* this process, from 0, of how many */
  int node_rank; /* of this process among those of its computer, from 0: they share out the GPUs */
  void *data;    /* handed to the callbacks */
  /* Each of the n numbers becomes the sum, or the largest, of all processes. */
  int (*sum)(void *data, double *numbers, int n);
  int (*max)(void *data, double *numbers, int n);
  /* The bytes of process `from` replace those of the others. */
  int (*broadcast)(void *data, void *bytes, size_t n, int from);
} lsdcd_host;

typedef struct lsdcd_wall_options {
  size_t size; /* of this struct */
  /* Where centres of spheres can be; all 0: wherever they go. One that is outside is warned of, as
   * the wall may not reach there: give both corners, not one. */
  double lo[3], hi[3];
  int periodic[3];        /* 1: the box repeats along x, y, z. Spheres are put back by the caller */
  double margin;          /* length > 0 with `periodic`: how far past a face a sphere may go */
  double time;            /* of the first step, for files */
  lsdcd_message *show;    /* called in calls of this wall only; null: nothing is shown */
  void *data;             /* handed to `show` */
  int threads;            /* on the CPU; 0: OMP_NUM_THREADS, or one */
  const lsdcd_host *host; /* copied; null: one process */
  /* Where the arrays of spheres are, and so the wall computes: LSDCD_CPU, in the host's memory, or LSDCD_CUDA, on the
   * device that is current, in the order of `stream`, as lsdcd_stream_open() takes one. The stream must outlive the
   * wall. */
  void *stream;
  int device;
  /* Those of numbers from files of materials, "si", "cgs", "micro" or "nano"; null: "si". */
  const char *units;
} lsdcd_wall_options;

/* A value of the program, which words name as $NAME. Numbers stand for as many words, with all digits; NaN is NULL. */
enum { LSDCD_VALUE_NUMBERS = 0, LSDCD_VALUE_MESH = 1, LSDCD_VALUE_ROWS = 2, LSDCD_VALUE_TEXT = 3 };
typedef struct lsdcd_value {
  const char *name; /* letters, digits and _, without $ */
  int kind;         /* LSDCD_VALUE_... */
  const lsdcd_mesh *mesh;
  const double *numbers; /* n of them; of rows one row behind the other */
  size_t n;
  int columns;      /* of rows: numbers in each, as a file of `motion table` has them */
  const char *text; /* a single word, with its blanks: the name of a file */
} lsdcd_value;
/* A wall by the words that stand behind `wall/lsdcd` in a script (doc/fix_wall_lsdcd.rst), with values of the program:
 *
 *   "hooke/history $steel  mesh $floor  mesh $lid motion caller law hooke/history 2e4 5e3 20 NULL 0.1 1"
 *
 * Lines and # are as in scripts. What differs: `mesh $NAME` is a mesh of the program, called NAME where it has no keyword `name`; `motion
 * caller` has its poses by lsdcd_wall_set_pose(), `nodes caller` its nodes by lsdcd_wall_set_nodes(); `shapes` says that grains may be no
 * spheres; v_NAME is an input of lsdcd_wall_set_input(); device is cpu, and gravity of a body 0, where the words give none; `contacts`, `draw`
 * and `cut` are LAMMPS's alone. `values` has n elements, each of which is named in the words. `options` may be null. LSDCD_ERROR_ARGUMENT has the
 * word that makes no sense and what to give. Any. */
LSDCD_API int lsdcd_wall_create(const char *words, const lsdcd_value *values, size_t n,
                                const lsdcd_wall_options *options, lsdcd_wall **wall);
/* Refuses what lsdcd_wall_create() would refuse of words and values, and makes nothing. It reads files of materials, and no mesh. Any. */
LSDCD_API int lsdcd_wall_check(const char *words, const lsdcd_value *values, size_t n,
                               const lsdcd_wall_options *options);
/* Changes a wall by the words of fix_modify: "[mesh NAME] motion ...", "motion none", "servo ...", "servo none" or "body ..." of what is to
 * change, from where the mesh is. LSDCD_ERROR_ARGUMENT: the wall stays as it is. Own. */
LSDCD_API int lsdcd_wall_change(lsdcd_wall *wall, const char *words, const lsdcd_value *values,
                                size_t n);
/* The value of v_NAME in the words from the next step on, the same on all processes; `name` is without v_. A step whose words read one that has
 * none is refused. Alone. Own. */
LSDCD_API int lsdcd_wall_set_input(lsdcd_wall *wall, const char *name, double value);
/* A keyword of words, as doc/fix_wall_lsdcd.rst explains it. Texts live as long as the library. */
typedef struct lsdcd_keyword_facts {
  size_t size;          /* of this struct; set by the caller */
  const char *name;     /* "scale" */
  const char *values;   /* what stands behind it: "s | sx sy sz" */
  const char *unit;     /* "length"; empty: none */
  const char *range;    /* "> 0"; empty: any */
  const char *fallback; /* what holds without it; empty: it is required */
  const char *meaning;
  int of_mesh; /* 1: it is of the mesh before it; 0: of the wall */
  int repeats; /* 1: it may be given more than once */
} lsdcd_keyword_facts;
/* The facts of keyword number k, from 0, of all that words may have; LSDCD_ERROR_ARGUMENT: there are not so many. Any. */
LSDCD_API int lsdcd_keyword_get_facts(size_t k, lsdcd_keyword_facts *facts);
/* The number of a mesh, from 0, by its name. LSDCD_ERROR_ARGUMENT: none is called so, or several are. Alone. Own. */
LSDCD_API int lsdcd_wall_get_mesh(lsdcd_wall *wall, const char *name, int *mesh);

/* Spheres in arrays of doubles, on the device of the wall all of them. Number k of sphere i of a vector is at
 * [i * row + k]. Others than said are refused, LSDCD_ERROR_ARGUMENT, with the first one's i; and force, torque or heat
 * that share memory with another array, though rows of several may lie between each other. */
typedef struct lsdcd_spheres {
  size_t size; /* of this struct */
  size_t n;
  ptrdiff_t row;             /* of all arrays of vectors, 3 at least; 0: 3 */
  const double *x;           /* length, finite */
  const double *v;           /* length/time, finite */
  const double *omega;       /* 1/time, finite */
  const double *radius;      /* >= 0, finite */
  const double *mass;        /* > 0, finite */
  double *force;             /* added to */
  double *torque;            /* added to, about the centre */
  const double *temperature; /* for a law with heat; else null */
  double *heat;              /* power into the sphere, added to; likewise */
  const int *type;           /* from 1, for laws by type; else null */
  /* Of a wall with shapes, rows without gaps; else null. The body is that of lsdcd_shape_get_facts(), and torques are about
   * its centre. A grain whose half-axes are all 0 is a sphere; the radius of others is not read. */
  const double *half_axes; /* 3 each, length */
  const double *exponents; /* n1 and n2 each, 2 to 20; null: all are 2, ellipsoids */
  const double
      *quaternions; /* w i j k each, of any length above 0, from the axes of the grain to the box */
  /* 3 each, about its axes, mass length^2, of a grain of `mass`; > 0 but for spheres */
  const double *inertia;
} lsdcd_spheres;

typedef struct lsdcd_wall_step {
  size_t size; /* of this struct */
  double dt;   /* time since the last step; > 0 */
  int setup; /* 1: no time has passed, and springs do not move: the forces with which a run begins */
  int changed; /* 1: spheres came at the end, radii grew or types changed since the last step. The first step and those
                    with `setup` look at that anyway */
  double reach; /* length; near spheres are chosen when one has gone farther; 0: a tenth of the
                    largest radius of the last step that looked */
  int synchronous; /* 1: the velocities of spheres, poses and nodes are of the time of their places; 0: of half a step
                    before, as velocity Verlet has them when it asks for forces. Not beside bodies */
} lsdcd_wall_step;
/* Adds the wall's forces and torques of this step. Velocities are those that the caller's integrator has
 * when it asks for forces; with velocity Verlet they are those of the half step, as in LAMMPS, and with `synchronous` those of the
 * places. `dt`, `setup` and `synchronous` are the same on all processes; `changed` and `reach` of one hold for all.
 *
 * An error of a sphere names it by its place in the arrays, from 0, and its process where there are several. What process 0
 * says of a sphere of another one names it by its order of coming, from 1: of those that come in the same step process p of P has
 * p + 1, p + 1 + P and so on.
 *
 * What is refused before a step begins, as an array that is missing, changes nothing. A wall whose step failed half-way, as by a
 * sphere that outgrew its grid, has added some forces and moved some springs: it refuses every call from then on
 * (LSDCD_ERROR_INPUT), and can only be freed.
 *
 * With a `host`, and on a device, a step does not wait to know of each sphere: their errors come with the next
 * call that is not "alone", and the arrays of a step stay until then. On a device forces are there once the
 * stream has done all its work. Only steps that look, see `changed`, copy some of the arrays to the host, and
 * only these check types, radii, masses, velocities and, on a device, places. Own. */
LSDCD_API int lsdcd_wall_step_spheres(lsdcd_wall *wall, const lsdcd_spheres *spheres,
                                      const lsdcd_wall_step *step);
/* Before the next step: sphere i of n is the one that was from[i], or with -1 a new one. The history of its
 * contacts follows it. Alone. Own. */
LSDCD_API int lsdcd_wall_renumber(lsdcd_wall *wall, const ptrdiff_t *from, size_t n);

/* A sphere goes to another process: before lsdcd_wall_renumber() lsdcd_wall_pack() writes what the contacts
 * of the n spheres which[i] keep, and their names, *count doubles. As many as fit in `room` are written; with
 * `room` 0 the array may be null. There lsdcd_wall_unpack() reads them, after lsdcd_wall_renumber() has made room:
 * sphere to[i] has them from then on. Numbers that no wall of this kind packed are refused, and a sphere that would be
 * there twice. Alone. Own. */
LSDCD_API int lsdcd_wall_pack(lsdcd_wall *wall, const ptrdiff_t *which, size_t n, double *numbers,
                              size_t room, size_t *count);
LSDCD_API int lsdcd_wall_unpack(lsdcd_wall *wall, const ptrdiff_t *to, size_t n,
                                const double *numbers, size_t count);

typedef struct lsdcd_wall_totals {
  size_t size;                /* of this struct; set by the caller */
  double force[3], torque[3]; /* of the spheres on the mesh; the torque about the point asked for */
  double contacts;            /* that carry a force */
  double overlap;             /* the largest overlap / radius, or least half-axis */
  double uncertified;         /* spheres whose answer was not certified exact; see `nearest` */
  double worn_volume;         /* worn off so far */
  double power; /* of the mesh on the spheres, by its motion; of nodes half a step before */
  double servo_position, servo_velocity, servo_push; /* 0 without a servo */
  /* With `wear ... deform`, volumes times its factor: by which wear has moved the mesh so far, and what has worn
   * at vertices that stay, as a triangle would fold over or meet another part of the mesh. */
  double removed_volume, held_back_volume;
  /* On a mesh with `nodes caller`, which none of its nodes gets: the torque is that of their forces. */
  double couple[3];
  /* With `average N`, means over the last N steps that ended with one whose number divides by N, counted from
   * the first step of the wall; weighted by time. 0 before, and without it. */
  double mean_force[3], mean_torque[3]; /* the torque about `torque_about` of each mesh */
  /* With `energy`; else 0. By cause: damping, slider, rolling, twisting, adhesion. Power in the last step, and energy since
   * the first one. */
  double dissipated_power[5], dissipated[5];
  /* Energy lost by lever arms, stiffness, turned springs, and with contacts that are inserted and deleted. */
  double lost[4];
  /* Work of spheres and mesh on their contacts, of the mesh on the spheres, what contacts hold, and the remainder: contact_work less
   * all that is held or lost. */
  double contact_work, drive_work, held_energy, remainder;
  /* With `impacts`: the number of impacts since the first step, and their energy, the sum of m v^2/2 with the speed along the
   * normal, and with a body's mobility in m. */
  double impacts, impact_energy;
  /* With `energy` and `wear ... deform`: energy that contacts lose as wear moves the mesh. */
  double lost_wear;
  /* With `energy` and a law that yields, by yielding: power in the last step, and energy since the first one. */
  double dissipated_power_plastic, dissipated_plastic;
  double elastic_energy; /* of overlaps and tangential springs, by the forces of the last step */
} lsdcd_wall_totals;
/* The totals of a mesh in the last step, over all processes; -1: of all, with the servo of the only mesh that has one. The torque is about the point `about`, of
 * the box, 3 numbers; null: about `torque_about` of each mesh. Own. */
LSDCD_API int lsdcd_wall_get_totals(lsdcd_wall *wall, int mesh, const double *about,
                                    lsdcd_wall_totals *totals);
/* Numbers of a mesh after the last step by their names, which are the same in LAMMPS (doc/wall_output.rst): `names` has n of them, apart
 * by blanks, as "force_z power body_velocity_x"; -1: of all meshes. Torques are about `torque_about` of each mesh. A mesh without
 * a part that another one has, as a servo, has 0 there. LSDCD_ERROR_ARGUMENT: the wall has no such number, with the keyword that it needs,
 * or `names` has not n. Own. */
LSDCD_API int lsdcd_wall_get_outputs(lsdcd_wall *wall, int mesh, const char *names, double *to,
                                     size_t n);
/* Number k, from 0, of all that a wall may have: its name, the kind of its unit, and what it is (that of several
 * components together), texts that stay. LSDCD_ERROR_ARGUMENT: there are not so many. */
LSDCD_API int lsdcd_output_info(size_t k, const char **name, const char **unit, const char **text);
/* Where a mesh is after the last step: what was at x when the wall was made is at R x + t. 12 numbers, rows of R, each
 * with its t, a length, behind it. LSDCD_ERROR_ARGUMENT: no such mesh. Alone. Own. */
LSDCD_API int lsdcd_wall_get_pose(lsdcd_wall *wall, int mesh, double *matrix);
/* Where a mesh with `motion caller` is in the next step and those after it: what was at x when the wall was made is at
 * R x + position, and moves with velocity + angular_velocity x (R x). Velocities count in damping and friction, and
 * in the power of lsdcd_wall_totals. Until the first call the mesh is as its placement has it, at rest.
 *
 * position: length; null: 0. quaternion: w x y z of R, of length 1 to 1e-3; null: no rotation. velocity: length/time, of
 * the point at `position`; null: 0. angular_velocity: 1/time, along the axes of the box, right-handed; null: 0. Both are
 * of the time of the spheres' velocities: with velocity Verlet half a step before the pose. So in a step, but not with `setup`
 * or `synchronous`, R x of the velocity is that of half a step before, too: R x - dt/2 angular_velocity x (R x). All are the same on all
 * processes. LSDCD_ERROR_ARGUMENT: no such mesh, one that is a body or not posed by the caller, a number that is not
 * finite or a quaternion of another length. Alone. Own. */
LSDCD_API int lsdcd_wall_set_pose(lsdcd_wall *wall, int mesh, const double *position,
                                  const double *quaternion, const double *velocity,
                                  const double *angular_velocity);
/* Where the vertices of a mesh with `nodes caller` are in the next step and those after it, and how fast they go, in
 * the box: 3 numbers each, in the order of the caller's vertices: those of lsdcd_mesh_from_faces() or of an OBJ, PLY or OFF file; of
 * STL files and of corners the corners, three a triangle; of a mesh that words name by its file the vertices of the welded mesh. There are `given_vertices` of lsdcd_mesh_facts. Of several that were
 * welded to one the first counts, and the others are where it is; one of no triangle is not read. Between the three nodes of a triangle places and velocities are linear. Until the first call they are as the
 * placement has them, at rest; after lsdcd_wall_restore() as they were saved. Triangles stay the same.
 *
 * positions: length. velocities: length/time, of the time of the spheres' velocities: with velocity Verlet half a step
 * before the positions (lsdcd_wall_step); null: all are 0. Both are copied, and are the same on all processes. A wall with device LSDCD_CUDA
 * takes them from memory of its GPU, too, in the order of its stream (LSDCD_ERROR_DEVICE: of another one); with a single process
 * the host then waits for none of these numbers. LSDCD_ERROR_ARGUMENT: no such mesh, one without `nodes caller`, a number that is not
 * finite, which on a GPU the next step may tell instead (LSDCD_ERROR_INPUT), arrays in different memory. All contacts are found however far nodes go from the last step's, but for one that passes through a sphere: the
 * next step refuses (LSDCD_ERROR_INPUT) a node that goes farther than the largest radius, and a triangle without area. Alone. Own. */
LSDCD_API int lsdcd_wall_set_nodes(lsdcd_wall *wall, int mesh, const double *positions,
                                   const double *velocities);
/* How many vertices the caller has, of a mesh with `nodes caller` or one that wear moves (`wear ... deform`). LSDCD_ERROR_ARGUMENT: no
 * such mesh, another one. Alone. Own. */
LSDCD_API int lsdcd_wall_get_node_count(lsdcd_wall *wall, int mesh, size_t *count);
/* Where the vertices of such a mesh are after the last step, in the box, 3 numbers a vertex (length), to memory and in the order
 * of lsdcd_wall_set_nodes(); no numbers for a vertex of no triangle. Alone. Own. */
LSDCD_API int lsdcd_wall_get_nodes(lsdcd_wall *wall, int mesh, double *positions);
/* Forces on them in the last step, 3 numbers a vertex, over all processes: of each contact its force, shared among the
 * nodes of its triangle or edge so that their sum and moment are those of the force at the closest point, and of
 * `pressure`. Of several vertices that were welded to one the first has its force, and the others 0. What no node gets is a couple: that of rolling and twisting resistance, and that of a tangential force on
 * the arm of the overlap. To memory as of lsdcd_wall_set_nodes(): on a GPU in the order of the wall's stream, where an error of
 * a sphere is told by the next call. Own. */
LSDCD_API int lsdcd_wall_get_node_forces(lsdcd_wall *wall, int mesh, double *forces);

/* Contacts of this process in the last step. Arrays hold `room` of them, packed; those that are null are not asked for. With `energy`
 * those that the step has ended are behind the others, without force and overlap. */
typedef struct lsdcd_wall_contacts {
  size_t size;       /* of this struct */
  size_t room;       /* 0: only `contacts` is asked for */
  ptrdiff_t *sphere; /* its place in the arrays of that step, from 0 */
  int *mesh;         /* from 0 */
  double *force;     /* 3 numbers each, on the sphere */
  double *point;     /* 3 numbers each, of the mesh, where it is closest, of an ellipsoid deepest */
  double *overlap;   /* length, at the begin of the step, as is the point */
  size_t
      contacts; /* answer: all there are, so the room that all take; with less room no array is written */
  /* With `energy`; else 0. 5 numbers each, by cause as in lsdcd_wall_totals: power in the last step, and energy since the contact
   * began. Summed over the contacts of a step the power is that of the totals, less that of coats. */
  double *dissipated_power, *dissipated;
  int *
      has_ended; /* 1: the sphere touched there in the step before, and no more; `point` is where it was */
  /* With `energy`; else 0. 1 number each, likewise by yielding. */
  double *dissipated_power_plastic, *dissipated_plastic;
} lsdcd_wall_contacts;
/* Of a wall with `each_contact`. Of a sphere in several they come one after the other. LSDCD_ERROR_ARGUMENT also before the
 * first step after lsdcd_wall_restore(), as saved numbers have none. Own. */
LSDCD_API int lsdcd_wall_get_contacts(lsdcd_wall *wall, lsdcd_wall_contacts *contacts);
/* The spectrum of the impacts on a mesh since the first step, over all processes: bins of the energy of an impact, of which each begins
 * where the one before it ends, at 10^(k/10) units of energy with a whole k, from the first to the last one with an impact. Arrays hold `room` of
 * them; those that are null are not asked for. Bins reach from 1e-40 to 1e40, and what is beyond is in the outermost. */
typedef struct lsdcd_wall_impacts {
  size_t size;           /* of this struct */
  size_t room;           /* 0: only `bins` is asked for */
  double *begins, *ends; /* energy of an impact */
  double *impacts;       /* number */
  double *energy;        /* the sum of their energies */
  size_t bins;           /* answer: all there are; with less room no array is written */
} lsdcd_wall_impacts;
/* Of a wall with `impacts`. LSDCD_ERROR_ARGUMENT: of another one, or no such mesh. Own. */
LSDCD_API int lsdcd_wall_get_impacts(lsdcd_wall *wall, int mesh, lsdcd_wall_impacts *impacts);
/* A rigid body after the last step, with velocities of the whole step. Vectors are along the axes of the box. */
typedef struct lsdcd_body_state {
  size_t size;                             /* of this struct */
  double centre[3];                        /* of mass, length */
  double quaternion[4];                    /* w x y z: from where the placement has the mesh */
  double velocity[3], angular_velocity[3]; /* of the centre, length/time; 1/time */
  /* What the joint does to the body to hold it, without spring, damping, motor and stops; the torque is about its point,
   * or the centre of mass where it has none. */
  double reaction_force[3], reaction_torque[3];
  double coordinate; /* of a hinge (radians) and a slider (length); else 0 */
  double energy;     /* kinetic, and of its spring */
  /* Of a stop along (about) the axis: what holds the body there, and in the step in which it comes there mass (moment of
   * inertia) times speed over the timestep. */
  double stop_force;
} lsdcd_body_state;
/* LSDCD_ERROR_ARGUMENT: no such mesh, or one that is no body. Own. */
LSDCD_API int lsdcd_wall_get_body(lsdcd_wall *wall, int mesh, lsdcd_body_state *state);
/* All that the wall and the contacts of its spheres keep, to go on from: *count doubles, of this process. Those
 * that fit in `room` are written; with `room` 0 the array may be null. Own. */
LSDCD_API int lsdcd_wall_save(lsdcd_wall *wall, double *numbers, size_t room, size_t *count);
/* Into a wall of the same words, before its first step, whose spheres then have the same order; process by
 * process. Steps count on from the last one of that wall, for files and wear that come every so many steps. All goes on as if that wall
 * did, bit for bit on as many processes, but for the last digits of the worn volume in totals; lsdcd_wall_save() writes the same numbers again. Totals, poses, bodies, nodes and forces on these are those of its last step; a
 * pose and nodes that were set for the next one are set. Numbers of a wall that differs in a word on which a number hangs are refused with what differs (LSDCD_ERROR_ARGUMENT), and
 * the wall stays as it is. These are all but names and files, `device`, `log`, `each_contact`, `periodic`, the steps of `mesh_stl`, without `nearest` also
 * `grid`, `memory` and `rmax`, and of lsdcd_wall_options all but the corners of periodic axes. A motion, servo or body that
 * was set later is set before; inputs get their values again for the next step. Own. */
LSDCD_API int lsdcd_wall_restore(lsdcd_wall *wall, const double *numbers, size_t count);
/* Takes from numbers of another wall what fits this one; what does not, `show` tells. Else as lsdcd_wall_restore(). Own. */
LSDCD_API int lsdcd_wall_restore_what_fits(lsdcd_wall *wall, const double *numbers, size_t count);
/* Null is fine. Alone. Own. */
LSDCD_API void lsdcd_wall_free(lsdcd_wall *wall);

#if defined(__cplusplus)
}
#endif

#endif
