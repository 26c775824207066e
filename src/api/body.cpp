// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_body_*, lsdcd_collide
#include "api/c_border.h"
#include "api/call_progress.h"
#include "api/call_threads.h"
#include "api/cell_options.h"
#include "api/device_memory.h"
#include "api/objects.h"
#include "base/input_words.h"
#include "bodies/mesh_collision.h"
#include "bodies/read_pose.h"
#include "engine/engine.h"

#include <cmath>
#include <cstddef>
#include <limits>

using namespace lsdcd;

struct lsdcd_body {
  MeshCollision in;
  int nearest, device;
  int gpu = -1;    // on which, where it is one
};

namespace {

int current_gpu(int device)
{
#if defined(LSDCD_HAVE_CUDA)
  if (device == LSDCD_CUDA) return current_cuda_device();
#endif
  (void) device;
  return -1;
}

MeshCollisionSettings settings_of(const lsdcd_body_options &o)
{
  check_cell_options("lsdcd_body_options", o);
  std::string why;
  if (o.device == LSDCD_CUDA && !cuda_available(&why))
    throw ApiError(LSDCD_ERROR_DEVICE, "CUDA: " + why + "; use LSDCD_CPU");
  MeshCollisionSettings s;
  s.cell = o.cell;
  s.cell_name = "`cell`";
  s.nearest = o.nearest;
  s.memory = static_cast<std::size_t>(o.memory);
  s.device = o.device == LSDCD_CUDA ? Device::cuda : Device::cpu;
  return s;
}

void check_gpu(const lsdcd_body &body)
{
  if (current_gpu(body.device) != body.gpu)
    throw ApiError(LSDCD_ERROR_DEVICE, "the body is on CUDA device " + std::to_string(body.gpu) +
                                           ", and another one is current: call cudaSetDevice()");
}

lsdcd_body *with_same_wall(const lsdcd_mesh *wall, const lsdcd_mesh &mesh,
                           const lsdcd_body_options &o)
{
  if (wall || o.cell != 0 || o.nearest != 0 || o.memory != 0 || o.device != 0)
    refuse_option("lsdcd_body_options",
                  "same_wall is given, so wall, cell, nearest, memory and device are that body's: "
                  "leave them out");
  check_gpu(*o.same_wall);
  return new lsdcd_body{MeshCollision(o.same_wall->in, mesh.in->mesh), o.same_wall->nearest,
                        o.same_wall->device, o.same_wall->gpu};
}

BodyPose pose_of(const lsdcd_collision &c)
{
  if (c.matrix && (c.position || c.quaternion))
    throw ApiError(LSDCD_ERROR_ARGUMENT, "`matrix` is given beside `position` or `quaternion`");
  if (!c.matrix && !c.position && !c.quaternion)
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "there is no pose: give `matrix`, or `position`, `quaternion` or both");
  if (c.matrix) return pose_of_matrix(c.matrix);
  const double as_it_is[4] = {1, 0, 0, 0};
  const Vec3 at = c.position ? Vec3{c.position[0], c.position[1], c.position[2]} : Vec3{0, 0, 0};
  return pose_of_quaternion(at, c.quaternion ? c.quaternion : as_it_is);
}

lsdcd_collision checked_collision(const lsdcd_collision *given)
{
  const lsdcd_collision c = checked(given, "lsdcd_collision");
  check_threads(c.threads);
  if (c.room == 0 && (c.wall_triangle || c.body_triangle || c.segment))
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "there are arrays for pairs, but `room` is 0: give how many pairs they hold");
  const std::pair<const void *, const char *> arrays[] = {{c.matrix, "matrix"},
                                                          {c.position, "position"},
                                                          {c.quaternion, "quaternion"},
                                                          {c.wall_triangle, "wall_triangle"},
                                                          {c.body_triangle, "body_triangle"},
                                                          {c.segment, "segment"}};
  const DeviceMemory device;
  for (const auto &[array, name] : arrays) device.refuse_there(array, name, "give the host's");
  return c;
}

void copy_out_pairs(const MeshCollision &of, const Collision &found, const lsdcd_collision &c)
{
  const std::size_t n = std::min(c.room, found.pairs.size());
  for (std::size_t i = 0; i < n; i++) {
    if (c.wall_triangle) c.wall_triangle[i] = of.wall_triangle(found.pairs[i]);
    if (c.body_triangle) c.body_triangle[i] = of.body_triangle(found.pairs[i]);
    if (!c.segment) continue;
    const MeetingSegment &s = found.segments[i];
    for (int k = 0; k < 3; k++) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      c.segment[6 * i + k] = s.flat ? none : s.from[k];
      c.segment[6 * i + 3 + k] = s.flat ? none : s.to[k];
    }
  }
}

}    // namespace

extern "C" {

int lsdcd_body_make(const lsdcd_mesh *wall, const lsdcd_mesh *mesh,
                    const lsdcd_body_options *options, lsdcd_body **body)
{
  return guard([&] {
    need(body, "body");
    need(mesh, "mesh");
    lsdcd_body_options o = {};
    o.size = sizeof o;
    if (options) o = checked(options, "lsdcd_body_options");
    check_threads(o.threads);
    const CallThreads threads(o.threads);
    if (o.same_wall) {
      *body = with_same_wall(wall, *mesh, o);
      return;
    }
    need(wall, "wall");
    CallProgress progress(o.progress, o.data);
    MeshCollisionSettings settings = settings_of(o);
    settings.progress = progress.listener();
    *body = new lsdcd_body{MeshCollision(wall->in->mesh, mesh->in->mesh, settings), o.nearest,
                           o.device, current_gpu(o.device)};
  });
}

int lsdcd_body_get_facts(const lsdcd_body *body, lsdcd_body_facts *facts)
{
  return guard([&] {
    need(body, "body");
    lsdcd_body_facts f = checked(facts, "lsdcd_body_facts");
    f.triangles = body->in.n_triangles();
    f.pieces = body->in.n_pieces();
    f.cell = body->in.grid().length;
    f.grid_bytes = body->in.grid().bytes;
    f.nearest = body->nearest;
    f.device = body->device;
    copy_out(f, facts);
  });
}

int lsdcd_collide(lsdcd_body *body, lsdcd_collision *collision)
{
  return guard([&] {
    need(body, "body");
    lsdcd_collision c = checked_collision(collision);
    const BodyPose pose = pose_of(c);
    check_gpu(*body);
    const CallThreads threads(c.threads);
    const Collision found = body->in.collide(pose, c.segment != nullptr);
    copy_out_pairs(body->in, found, c);
    c.collides = found.any();
    c.pairs = found.pairs.size();
    c.uncertain = found.uncertain;
    copy_out(c, collision);
  });
}

void lsdcd_body_free(lsdcd_body *body)
{
  delete body;
}

}    // extern "C"
