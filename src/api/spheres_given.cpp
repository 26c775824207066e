// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "api/spheres_given.h"

#include "api/c_border.h"
#include "api/device_memory.h"
#include "base/input_words.h"
#include "base/vector_text.h"
#include "shape/superellipsoid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace lsdcd {

namespace {

// Numbers of spheres: how many bytes from row to row, and how many of these they take.
struct Rows {
  const void *at;
  const char *name;
  std::ptrdiff_t row, width;
};

template <class T>
Rows rows_of(const T *at, const char *name, std::ptrdiff_t row, std::ptrdiff_t width)
{
  constexpr std::ptrdiff_t kNumber = sizeof(T);
  return {at, name, kNumber * row, kNumber * width};
}

// Do n rows of each have a byte in common? Rows of one array may lie between those of another. Of two with different rows the
// shorter ones have no gaps.
bool share_memory(const Rows &a, const Rows &b, std::ptrdiff_t n)
{
  if (a.row < b.row) return share_memory(b, a, n);
  const auto first = reinterpret_cast<std::intptr_t>(a.at),
             second = reinterpret_cast<std::intptr_t>(b.at);
  if (a.row == b.row) {
    // The rows of b begin `behind` after rows of a, and after the one before it.
    const std::ptrdiff_t apart = second - first, behind = (apart % a.row + a.row) % a.row,
                         rows = (apart - behind) / a.row;
    return (behind < a.width && -n < rows && rows < n) ||
           (a.row - behind < b.width && -n < rows + 1 && rows + 1 < n);
  }
  // Which row of a is the first that ends behind where the numbers of b begin?
  const std::ptrdiff_t k = second < first + a.width ? 0 : (second - first - a.width) / a.row + 1;
  return k < n && first + k * a.row < second + n * b.row;
}

// Arrays that are written have memory of their own: forces that are torques, too, are neither.
void check_apart(const lsdcd_spheres &s, std::ptrdiff_t row)
{
  const Rows all[] = {rows_of(s.force, "force", row, 3),
                      rows_of(s.torque, "torque", row, 3),
                      rows_of(s.heat, "heat", 1, 1),
                      rows_of(s.x, "x", row, 3),
                      rows_of(s.v, "v", row, 3),
                      rows_of(s.omega, "omega", row, 3),
                      rows_of(s.radius, "radius", 1, 1),
                      rows_of(s.mass, "mass", 1, 1),
                      rows_of(s.temperature, "temperature", 1, 1),
                      rows_of(s.type, "type", 1, 1),
                      rows_of(s.half_axes, "half_axes", 3, 3),
                      rows_of(s.exponents, "exponents", 2, 2),
                      rows_of(s.quaternions, "quaternions", 4, 4),
                      rows_of(s.inertia, "inertia", 3, 3)};
  constexpr std::size_t kWritten = 3, kAll = sizeof all / sizeof all[0];
  for (std::size_t i = 0; i < kWritten; i++)
    for (std::size_t j = i + 1; j < kAll; j++)
      if (all[i].at && all[j].at && share_memory(all[i], all[j], static_cast<std::ptrdiff_t>(s.n)))
        throw ApiError(LSDCD_ERROR_ARGUMENT, std::string("`") + all[i].name + "` and `" +
                                                 all[j].name +
                                                 "` share memory: give each an array of its own");
}

[[noreturn]] void refuse_sphere(const char *name, int i, const std::string &what)
{
  throw ApiError(LSDCD_ERROR_ARGUMENT,
                 std::string(name) + "[" + std::to_string(i) + "] is " + what);
}

}    // namespace

// Before anything is read or written there.
void check_positions(const lsdcd_spheres &s, const GpuArrays *gpu)
{
  const struct {
    const void *pointer;
    const char *name;
  } given[] = {{s.x, "x"},           {s.v, "v"},       {s.omega, "omega"},
               {s.radius, "radius"}, {s.mass, "mass"}, {s.force, "force"},
               {s.torque, "torque"}, {s.type, "type"}, {s.temperature, "temperature"},
               {s.heat, "heat"}};
  const DeviceMemory device;
  for (const auto &one : given) {
    if (!one.pointer) continue;
    if (!gpu) device.refuse_there(one.pointer, one.name, "make the wall with device LSDCD_CUDA");
    try {
      if (gpu) gpu->check(one.pointer, one.name, "the wall");
    } catch (const InputError &e) {
      throw ApiError(LSDCD_ERROR_DEVICE,
                     std::string(e.what()) + ": make the wall where the arrays of spheres are");
    }
  }
}

Spheres spheres_of(const lsdcd_spheres &s, bool has_heat, bool has_types)
{
  Spheres out;
  out.n = static_cast<int>(s.n);
  if (s.n == 0) return out;
  const struct {
    const void *pointer;
    const char *name;
  } needed[] = {{s.x, "x"},       {s.v, "v"},         {s.omega, "omega"},  {s.radius, "radius"},
                {s.mass, "mass"}, {s.force, "force"}, {s.torque, "torque"}};
  for (const auto &one : needed) need(one.pointer, one.name);
  if (has_heat) {
    need(s.temperature, "temperature", "a law of the wall conducts heat");
    need(s.heat, "heat", "a law of the wall conducts heat");
  }
  if (has_types) need(s.type, "type", "laws of the wall go by types");
  const std::ptrdiff_t row = s.row ? s.row : 3;
  if (row < 3 && s.n > 1)
    throw ApiError(LSDCD_ERROR_ARGUMENT, "row is " + std::to_string(row) +
                                             ": vectors of 3 numbers need 3 or more, 0 is 3");
  check_apart(s, s.n > 1 ? row : 3);
  out.x = {s.x, row, 1};
  out.v = {s.v, row, 1};
  out.omega = {s.omega, row, 1};
  out.force = {s.force, row, 1};
  out.torque = {s.torque, row, 1};
  out.radius = s.radius;
  out.mass = s.mass;
  out.temperature = s.temperature;
  out.heat_flow = s.heat;
  out.type = s.type;
  return out;
}

void GrainRows::put(const lsdcd_spheres &given, Spheres &s)
{
  if (s.n == 0) return;
  need(given.half_axes, "half_axes");
  need(given.quaternions, "quaternions");
  need(given.inertia, "inertia");
  shapes_.assign(s.n, GrainShape());
  radius_.assign(s.radius, s.radius + s.n);
  for (int i = 0; i < s.n; i++) {
    const std::size_t at = static_cast<std::size_t>(i);
    const double *half = given.half_axes + 3 * at, *q = given.quaternions + 4 * at,
                 *inertia = given.inertia + 3 * at;
    GrainShape &row = shapes_[i];
    row.half = {half[0], half[1], half[2]};
    if (row.half == Vec3{0, 0, 0}) continue;
    if (given.exponents) {
      row.n1 = given.exponents[2 * at];
      row.n2 = given.exponents[2 * at + 1];
    }
    try {
      check_shape(row.half, row.n1, row.n2);
    } catch (const InputError &e) {
      throw ApiError(LSDCD_ERROR_ARGUMENT, "grain " + std::to_string(i) + ": " + e.what());
    }
    const Real size = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(size > 0) || !std::isfinite(size))
      refuse_sphere("quaternions", i, "0 or no number; it is w i j k of a rotation");
    row.turn = normalised({q[0], {q[1], q[2], q[3]}});
    const Vec3 moments = {inertia[0], inertia[1], inertia[2]};
    for (int k = 0; k < 3; k++)
      if (!(inertia[k] > 0) || !std::isfinite(inertia[k]))
        refuse_sphere("inertia", i, vector_text(moments) + "; moments are above 0, and finite");
    row.inertia_over_mass = (1 / s.mass[i]) * moments;
    radius_[i] = circumscribed_radius(row.half, row.n1, row.n2);
  }
  s.shapes = shapes_.data();
  s.radius = radius_.data();
}

void refuse_shapes(const lsdcd_spheres &given)
{
  if (given.half_axes || given.exponents || given.quaternions || given.inertia)
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "`half_axes` to `inertia` are of a wall whose words have shapes: leave them "
                   "null, or make such a wall");
}

void check_types(const Spheres &s)
{
  for (int i = 0; i < s.n; i++)
    if (s.type[i] < 1)
      throw ApiError(LSDCD_ERROR_ARGUMENT, "type[" + std::to_string(i) + "] is " +
                                               std::to_string(s.type[i]) + ", below 1");
}

// Nothing touches a radius below 0, and a mass of 0 has no damping.
void check_sizes(const Spheres &s)
{
  for (int i = 0; i < s.n; i++) {
    if (!(s.radius[i] >= 0) || !std::isfinite(s.radius[i]))
      refuse_sphere("radius", i, number_text(s.radius[i]) + "; it is 0 or more, and finite");
    if (!(s.mass[i] > 0) || !std::isfinite(s.mass[i]))
      refuse_sphere("mass", i, number_text(s.mass[i]) + "; it is above 0, and finite");
  }
}

// One that is not finite would give a force that is no number.
void check_motion(const Spheres &s)
{
  for (int i = 0; i < s.n; i++) {
    for (const auto &[name, vector] : {std::pair{"v", Vec3(s.v[i])}, {"omega", Vec3(s.omega[i])}})
      if (!(norm_sq(0 * vector) == 0))
        refuse_sphere(name, i, vector_text(vector) + ", which is not finite");
    if (s.temperature && !std::isfinite(s.temperature[i]))
      refuse_sphere("temperature", i, number_text(s.temperature[i]) + "; it is finite");
  }
}

// Nothing touches a place that is no number. In each step, so with a few operations for each sphere.
Box checked_extents(const Spheres &s)
{
  Box around = {kNoLimit.hi, kNoLimit.lo};
  Vec3 zero = {0, 0, 0};    // unless one is no number
  for (int i = 0; i < s.n; i++) {
    const Vec3 x = s.x[i];
    zero += 0 * x;
    around.lo = {std::min(around.lo.x, x.x), std::min(around.lo.y, x.y),
                 std::min(around.lo.z, x.z)};
    around.hi = {std::max(around.hi.x, x.x), std::max(around.hi.y, x.y),
                 std::max(around.hi.z, x.z)};
  }
  for (int i = 0; i < s.n && !(norm_sq(zero) == 0); i++)
    if (!(norm_sq(0 * s.x[i]) == 0))
      refuse_sphere("x", i,
                    vector_text(s.x[i]) +
                        ", which is not finite: a shorter dt, or softer contacts, may help");
  return around;
}

Outside outside(const PeriodicBox &box, const Spheres &s, const Box &extents)
{
  Outside found;
  Box room = kNoLimit;
  bool all_in = true;
  for (int k = 0; k < 3; k++) {
    if (box.periodic[k] || box.follows(k)) continue;
    room.lo[k] = box.corner[k];
    room.hi[k] = box.corner[k] + box.edge[k][k];
    all_in = all_in && extents.lo[k] >= room.lo[k] && extents.hi[k] <= room.hi[k];
  }
  for (int i = all_in ? -1 : s.n - 1; i >= 0; i--) {
    const Vec3 x = s.x[i];
    if (overlap(Box{x, x}, room)) continue;
    found.n++;
    found.first = i;
  }
  return found;
}

}    // namespace lsdcd
