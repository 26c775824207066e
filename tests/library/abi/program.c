/* SPDX-FileCopyrightText: 2026 LSDCD contributors */
/* SPDX-License-Identifier: BSD-3-Clause */

/* A program of 0.9.0: it calls each function of that version with the structs of that version. Run in a folder of its
 * own, where it writes floor.stl. Behind each struct that the library fills lies a guard, which must stay as it is. */
#include "lsdcd.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void require(int line, int good, const char *what)
{
  if (good) return;
  printf("line %d: not so: %s (%s)\n", line, what, lsdcd_last_error());
  exit(1);
}
#define IS(what) require(__LINE__, (what), #what)
#define OK(call) require(__LINE__, (call) == LSDCD_OK, #call)

enum { GUARD = 512 };
#define GUARDED(type, name) \
  struct {                  \
    type of;                \
    unsigned char behind[GUARD]; \
  } name;                   \
  memset(&name, 0, sizeof name); \
  memset(name.behind, 0x5a, GUARD); \
  name.of.size = sizeof name.of

static int is_whole(const unsigned char *behind)
{
  for (int k = 0; k < GUARD; k++)
    if (behind[k] != 0x5a) return 0;
  return 1;
}

static int is_near(double a, double b)
{
  return fabs(a - b) <= 1e-12;
}

/* A square of side 20 in z = 0, its normal up, and a tetrahedron with corners at the origin and at 1 on each axis. */
static const double FLOOR_CORNERS[18] = {-10, -10, 0, 10, -10, 0, 10,  10, 0,
                                         -10, -10, 0, 10, 10,  0, -10, 10, 0};
static const double FLOOR_VERTICES[12] = {-10, -10, 0, 10, -10, 0, 10, 10, 0, -10, 10, 0};
static const uint32_t FLOOR_FACES[6] = {0, 1, 2, 0, 2, 3};
static const double SOLID_VERTICES[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const uint32_t SOLID_FACES[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

static int calls;
static int on_progress(void *data, const char *what, double done)
{
  ++*(int *) data;
  return what == NULL || done < 0 || done > 1;
}

static int messages;
static void on_message(void *data, int warning, const char *text)
{
  IS(data == &messages && text != NULL && (warning == 0 || warning == 1));
  ++messages;
}

static int same(void *data, double *numbers, int n)
{
  return data != &messages || numbers == NULL || n < 0;
}

static int same_bytes(void *data, void *bytes, size_t n, int from)
{
  return data != &messages || bytes == NULL || n == 0 || from != 0;
}

static void use_meshes(lsdcd_mesh **floor, lsdcd_mesh **solid)
{
  lsdcd_mesh *read = NULL, *corners = NULL;
  FILE *file = fopen("floor.stl", "w");
  fprintf(file, "solid floor\n");
  for (int f = 0; f < 2; f++) {
    fprintf(file, "facet normal 0 0 1\nouter loop\n");
    for (int k = 0; k < 3; k++)
      fprintf(file, "vertex %g %g %g\n", FLOOR_CORNERS[9 * f + 3 * k],
              FLOOR_CORNERS[9 * f + 3 * k + 1], FLOOR_CORNERS[9 * f + 3 * k + 2]);
    fprintf(file, "endloop\nendfacet\n");
  }
  fprintf(file, "endsolid floor\n");
  fclose(file);
  OK(lsdcd_mesh_read("floor.stl", -1, &read));
  OK(lsdcd_mesh_from_corners(FLOOR_CORNERS, 2, -1, &corners));
  OK(lsdcd_mesh_from_faces(FLOOR_VERTICES, LSDCD_DOUBLE, 4, FLOOR_FACES, 2, -1, floor));
  OK(lsdcd_mesh_from_faces(SOLID_VERTICES, LSDCD_DOUBLE, 4, SOLID_FACES, 4, -1, solid));
  IS(lsdcd_mesh_read("there is none.stl", -1, &read) == LSDCD_ERROR_INPUT);
  IS(strlen(lsdcd_last_error()) > 0);

  const lsdcd_mesh *const floors[3] = {read, corners, *floor};
  for (int k = 0; k < 3; k++) {
    GUARDED(lsdcd_mesh_facts, facts);
    OK(lsdcd_mesh_get_facts(floors[k], &facts.of));
    IS(is_whole(facts.behind));
    IS(facts.of.triangles == 2 && facts.of.faces == 2 && facts.of.edges == 5);
    IS(facts.of.vertices == 4 && facts.of.open_edges == 4 && !facts.of.closed);
    IS(is_near(facts.of.area, 400) && facts.of.lo[0] == -10 && facts.of.hi[1] == 10);
  }
  GUARDED(lsdcd_mesh_facts, facts);
  OK(lsdcd_mesh_get_facts(*solid, &facts.of));
  IS(facts.of.closed && facts.of.oriented && is_near(facts.of.volume, 1. / 6));

  double vertices[12];
  uint32_t faces[6], face_edges[6], triangle[2], edges[10], edge_first[6], edge_faces[6];
  GUARDED(lsdcd_mesh_arrays, arrays);
  arrays.of.vertices = vertices;
  arrays.of.faces = faces;
  arrays.of.face_edges = face_edges;
  arrays.of.triangle = triangle;
  arrays.of.edges = edges;
  arrays.of.edge_first = edge_first;
  arrays.of.edge_faces = edge_faces;
  OK(lsdcd_mesh_get_arrays(*floor, &arrays.of));
  IS(is_whole(arrays.behind) && edge_first[5] == 6 && triangle[1] == 1);
  IS(strlen(lsdcd_mesh_report(*floor)) > 0);
  lsdcd_mesh_free(read);
  lsdcd_mesh_free(corners);
  lsdcd_mesh_free(NULL);
}

static lsdcd_grid *grid_of(const lsdcd_mesh *mesh, double cutoff)
{
  lsdcd_grid *grid = NULL;
  GUARDED(lsdcd_grid_options, options);
  options.of.cutoff = cutoff;
  options.of.cell = cutoff;
  options.of.progress = on_progress;
  options.of.data = &calls;
  OK(lsdcd_grid_build(mesh, &options.of, &grid));
  return grid;
}

static void use_queries(const lsdcd_mesh *floor, const lsdcd_mesh *solid)
{
  lsdcd_grid *near = grid_of(floor, 2), *any = grid_of(solid, 0);
  GUARDED(lsdcd_grid_facts, facts);
  OK(lsdcd_grid_get_facts(near, &facts.of));
  IS(is_whole(facts.behind) && facts.of.cutoff == 2 && facts.of.bytes > 0);
  IS(strlen(lsdcd_grid_report(near)) > 0);

  /* Two points beside the tetrahedron's corner at the origin, one of them in it. */
  const double points[6] = {0.1, 0.1, 0.1, 0.25, 0.25, -1};
  double distance[2], closest[6], normal[6], winding[2];
  uint32_t triangle[2], feature[2];
  int8_t side[2];
  uint8_t status[2];
  GUARDED(lsdcd_query, query);
  query.of.n = 2;
  query.of.points = points;
  query.of.distance = distance;
  query.of.closest = closest;
  query.of.normal = normal;
  query.of.triangle = triangle;
  query.of.feature = feature;
  query.of.side = side;
  query.of.status = status;
  query.of.winding = winding;
  OK(lsdcd_query_host(any, &query.of));
  IS(is_whole(query.behind));
  IS(is_near(distance[0], 0.1) && is_near(distance[1], 1) && closest[5] == 0 && normal[5] == -1);
  IS(side[0] == -1 && side[1] == 1 && is_near(winding[0], 1) && is_near(winding[1], 0));
  IS(triangle[1] == 0 && LSDCD_FEATURE_KIND(feature[1]) == 0);
  IS(status[0] == (LSDCD_FOUND | LSDCD_CERTIFIED));

  const double centre[3] = {3, 4, 0.4};
  size_t first[2];
  double point[3], overlap, weight;
  GUARDED(lsdcd_contacts, contacts);
  contacts.of.n = 1;
  contacts.of.points = centre;
  contacts.of.radius = 0.5;
  contacts.of.first = first;
  contacts.of.room = 1;
  contacts.of.point = point;
  contacts.of.overlap = &overlap;
  contacts.of.weight = &weight;
  OK(lsdcd_contacts_host(near, &contacts.of));
  IS(is_whole(contacts.behind) && first[1] == 1 && contacts.of.contacts == 1);
  IS(is_near(overlap, 0.1) && weight == 1 && point[2] == 0);

  /* Without a device these are refused with the reason; arrays of the host are no arrays of a device. */
  lsdcd_stream *stream = NULL;
  if (lsdcd_has_cuda()) {
    OK(lsdcd_stream_open(any, NULL, &stream));
    IS(lsdcd_query_stream(stream, &query.of) == LSDCD_ERROR_DEVICE);
  } else {
    IS(lsdcd_stream_open(any, NULL, &stream) == LSDCD_ERROR_DEVICE);
    IS(lsdcd_query_stream(stream, &query.of) == LSDCD_ERROR_ARGUMENT);
  }
  lsdcd_stream_free(stream);
  lsdcd_grid_free(near);
  lsdcd_grid_free(any);
}

static void use_body(const lsdcd_mesh *floor, const lsdcd_mesh *solid)
{
  lsdcd_body *body = NULL, *second = NULL;
  OK(lsdcd_body_make(floor, solid, NULL, &body));
  GUARDED(lsdcd_body_options, options);
  options.of.same_wall = body;
  OK(lsdcd_body_make(NULL, solid, &options.of, &second));
  GUARDED(lsdcd_body_facts, facts);
  OK(lsdcd_body_get_facts(second, &facts.of));
  IS(is_whole(facts.behind) && facts.of.triangles == 4);
  uint32_t wall[8], of_body[8];
  double segment[48];
  for (int k = 0; k < 2; k++) {    /* half of it below the floor, then all of it above */
    const double position[3] = {2, 1, k == 0 ? -0.5 : 0.5};
    GUARDED(lsdcd_collision, collision);
    collision.of.position = position;
    collision.of.room = 8;
    collision.of.wall_triangle = wall;
    collision.of.body_triangle = of_body;
    collision.of.segment = segment;
    OK(lsdcd_collide(k == 0 ? body : second, &collision.of));
    IS(is_whole(collision.behind) && collision.of.collides == (k == 0));
    IS(collision.of.pairs == (k == 0 ? 3 : 0) && collision.of.uncertain == 0);
  }
  lsdcd_body_free(second);
  lsdcd_body_free(body);
}

static const char *const WORDS[] = {"hooke/history", "1000", "NULL", "10", "NULL", "0.5", "1",
                                    "mesh", "floor.stl", "motion", "linear", "0", "0", "0.1"};
enum { N_WORDS = sizeof WORDS / sizeof WORDS[0] };

static lsdcd_wall *wall_of(lsdcd_host *host)
{
  lsdcd_wall *wall = NULL;
  GUARDED(lsdcd_wall_options, options);
  options.of.show = on_message;
  options.of.data = &messages;
  options.of.host = host;
  OK(lsdcd_wall_make(WORDS, N_WORDS, &options.of, &wall));
  return wall;
}

static double x[6] = {0, 0, 0.4, 5, 5, 3}, v[6] = {1, 0, 0, 0, 0, 0}, omega[6], radius[2] = {0.5, 0.5},
              mass[2] = {1, 1};

/* The force on the first sphere, which is 0.5 in radius at a height of 0.4. */
static void step_to(lsdcd_wall *wall, size_t n, double *force)
{
  double torque[6] = {0};
  memset(force, 0, 6 * sizeof *force);
  GUARDED(lsdcd_spheres, spheres);
  spheres.of.n = n;
  spheres.of.x = x;
  spheres.of.v = v;
  spheres.of.omega = omega;
  spheres.of.radius = radius;
  spheres.of.mass = mass;
  spheres.of.force = force;
  spheres.of.torque = torque;
  GUARDED(lsdcd_wall_step, step);
  step.of.dt = 0.001;
  OK(lsdcd_wall_step_spheres(wall, &spheres.of, &step.of));
}

static void use_wall(void)
{
  lsdcd_host host = {sizeof host, 0, 1, 0, &messages, same, same, same_bytes};
  lsdcd_wall *wall = wall_of(NULL), *second = wall_of(&host);
  double force[6], other[6], matrix[12];
  step_to(wall, 2, force);
  IS(force[2] > 100 && force[5] == 0 && force[0] < 0 && messages > 0);

  GUARDED(lsdcd_wall_totals, totals);
  OK(lsdcd_wall_get_totals(wall, -1, &totals.of));
  IS(is_whole(totals.behind) && totals.of.contacts == 1 && is_near(totals.of.force[2], -force[2]));
  OK(lsdcd_wall_get_pose(wall, 0, matrix));
  IS(matrix[0] == 1 && is_near(matrix[11], 1e-4));

  /* What one wall has saved, another goes on from: the same bits. */
  size_t count = 0;
  OK(lsdcd_wall_save(wall, NULL, 0, &count));
  double *saved = malloc(count * sizeof *saved);
  OK(lsdcd_wall_save(wall, saved, count, &count));
  IS(lsdcd_wall_restore(second, saved, count - 1) == LSDCD_ERROR_ARGUMENT);
  OK(lsdcd_wall_restore(second, saved, count));
  step_to(wall, 2, force);
  step_to(second, 2, other);
  IS(memcmp(force, other, sizeof force) == 0);
  free(saved);

  /* The spheres in turn, then the contacts of one handed to the other wall. */
  const ptrdiff_t turned[2] = {1, 0}, one[1] = {1};
  OK(lsdcd_wall_renumber(wall, turned, 2));
  OK(lsdcd_wall_pack(wall, one, 1, NULL, 0, &count));
  double *packed = malloc(count * sizeof *packed);
  OK(lsdcd_wall_pack(wall, one, 1, packed, count, &count));
  OK(lsdcd_wall_unpack(second, one, 1, packed, count));
  free(packed);

  const char *const stop[] = {"motion", "none"};
  OK(lsdcd_wall_change(second, stop, 2));
  OK(lsdcd_wall_get_pose(second, 0, matrix));
  const double height = matrix[11];
  step_to(second, 2, other);
  OK(lsdcd_wall_get_pose(second, 0, matrix));
  IS(matrix[11] == height);
  lsdcd_wall_free(wall);
  lsdcd_wall_free(second);
}

int main(void)
{
  lsdcd_mesh *floor = NULL, *solid = NULL;
  IS(strlen(lsdcd_version()) > 0 && strcmp(lsdcd_error_name(LSDCD_ERROR_CUTOFF), "cutoff") == 0);
  use_meshes(&floor, &solid);
  use_queries(floor, solid);
  use_body(floor, solid);
  use_wall();
  lsdcd_mesh_free(floor);
  lsdcd_mesh_free(solid);
  printf("a program of %d.%d.%d runs with %s\n", LSDCD_VERSION_MAJOR, LSDCD_VERSION_MINOR,
         LSDCD_VERSION_PATCH, lsdcd_version());
  return 0;
}
