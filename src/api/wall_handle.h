// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The object behind a handle lsdcd_wall, and the wrapper of every function of one.
#pragma once

#include "wall/wall.h"

#include "api/c_border.h"
#include "api/spheres_given.h"
#include "api/wall_caller.h"
#include "api/wall_parts.h"
#include "backend/gpu_arrays.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsdcd {

// The history of each sphere, as HistoryExchange::pack_saved() writes it.
using SphereHistories = std::vector<std::vector<Real>>;

// A number made of all poses and nodes that a program has set: it is equal on processes that have set the same ones.
class PosesGiven {
 public:
  void add(int mesh, const Pose &pose)
  {
    add_bytes(&mesh, sizeof mesh);
    for (const Vec3 &v :
         {pose.row[0], pose.row[1], pose.row[2], pose.shift, pose.velocity, pose.angular})
      for (int k = 0; k < 3; k++) {
        const Real number = v[k] + 0;    // not -0
        add_bytes(&number, sizeof number);
      }
  }
  void add(int mesh, const std::vector<Real> &numbers)
  {
    add_bytes(&mesh, sizeof mesh);
    for (const Real given : numbers) {
      const Real number = given + 0;
      std::uint64_t bits;
      std::memcpy(&bits, &number, sizeof bits);
      hash_ = (hash_ ^ bits ^ bits >> 32) * 0x100000001b3;
    }
  }
  // Returns the part that fits a double, exactly.
  Real number() const { return static_cast<Real>(hash_ >> 11); }

 private:
  // FNV-1a
  void add_bytes(const void *data, std::size_t n)
  {
    const auto *bytes = static_cast<const unsigned char *>(data);
    for (std::size_t i = 0; i < n; i++) hash_ = (hash_ ^ bytes[i]) * 0x100000001b3;
  }
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}    // namespace lsdcd

namespace lsdcd {

// The rows of arrays of nodes are the vertices of a mesh as its caller has them, each of which is a node of the wall's mesh.
struct NodeRows {
  std::vector<int> node;         // kNoVertex: the vertex is of no triangle
  std::vector<int> first_row;    // of each node; the others were welded to it
  bool are_one_each = true;      // each row is a node of its own
};

}    // namespace lsdcd

struct lsdcd_wall {
  lsdcd::WallCaller caller;
  std::unique_ptr<lsdcd::GpuArrays> gpu;    // that has the arrays of spheres; null: the host has
  int threads;
  lsdcd::GrainRows grains;
  std::int64_t number = 0;    // of the last step
  lsdcd::Real dt = 0;
  bool begun = false;                // since spheres were renumbered, too
  lsdcd::Real largest_radius = 0;    // of this process, in the last step that looked
  lsdcd::Failure late;               // of this process, which the next call reports to all
  lsdcd::WallParts made;             // made_parts()
  std::string failed;                // why a step failed half-way; empty: none did
  bool is_restored = false;          // until the first step
  bool outside_warned = false;
  lsdcd::PosesGiven poses;
  std::vector<lsdcd::NodeRows> node_rows;    // of each mesh that deforms
  std::vector<std::optional<lsdcd::Real>>
      inputs;    // the values of spec().inputs, as far as they are given
  std::unique_ptr<lsdcd::Wall> in;

  explicit lsdcd_wall(const lsdcd_wall_options &o) : caller(o), threads(o.threads) {}

  // A step does not wait for other processes, nor for a GPU, to know of errors.
  bool tells_late() const { return gpu || !caller.is_alone(); }
};

namespace lsdcd {

// What a wall is made of.
struct GivenWall {
  WallSpec spec;
  std::string material;    // the report of its materials, for the log
};
// Makes a wall with options of the caller, null: all defaults. `given` is asked once the wall knows its processes and its GPU.
std::unique_ptr<lsdcd_wall> make_wall(const lsdcd_wall_options *options,
                                      const std::function<GivenWall(lsdcd_wall &)> &given);

// Throws where a step failed half-way: springs and motions may be those of that step, and forces were added.
void check_can_go_on(const lsdcd_wall &wall);

// Wraps every function of a wall but the one that frees it: its GPU is current.
template <class Body>
int guard_wall(lsdcd_wall *wall, const Body &body) noexcept
{
  return guard([&] {
    need(wall, "wall");
    check_can_go_on(*wall);
    if (wall->gpu)
      wall->gpu->run(body);
    else
      body();
    wall->caller.tell_what_show_threw();
  });
}

// Throws where there is no such mesh; `least`: -1 where that is all of them.
void check_mesh(const lsdcd_wall &wall, int mesh, int least);

// Before any vertex moves: which one each of the caller's meshes has become.
void note_vertices(lsdcd_wall &wall);

// Stores errors of the last step's spheres that were not thrown at once.
void note_late(lsdcd_wall &wall);
// Throws it on all processes. Collective.
void tell_late(lsdcd_wall &wall);

}    // namespace lsdcd
