// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The spheres of a process as its host has them: their arrays, and their names in messages.
#pragma once

#include "engine/engine.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

namespace lsdcd {

// IDs of spheres, above 0, as integers of 32 or 64 bits in memory of the CPU; all are 0 where there are none.
class TagView {
 public:
  TagView() = default;
  TagView(const std::int32_t *tags) : narrow_(tags) {}
  TagView(const std::int64_t *tags) : wide_(tags) {}
  std::int64_t operator[](int i) const { return narrow_ ? narrow_[i] : wide_ ? wide_[i] : 0; }

 private:
  const std::int32_t *narrow_ = nullptr;
  const std::int64_t *wide_ = nullptr;
};

// Spheres are counted from 0, in the order of the arrays.
struct HostSpheres : Spheres {
  HostSpheres() = default;
  HostSpheres(const Spheres &spheres) : Spheres(spheres) {}

  TagView tag;
  const char *group = nullptr;    // of the spheres that the wall acts on; null: it has no name
  bool group_changes = false;     // spheres may join and leave it between steps

  bool is_in_group(int i) const { return !mask || (mask[i] & group_bit); }
  // Returns whether sphere i is in the group, or may join it before the host says so.
  bool may_be_in_group(int i) const { return group_changes || is_in_group(i); }
  std::int64_t highest_tag() const
  {
    std::int64_t highest = 0;
    for (int i = 0; i < n; i++) highest = std::max(highest, tag[i]);
    return highest;
  }
  // Returns the radius of the sphere with this ID (length); 0: this process has no such sphere.
  Real radius_of(std::int64_t id) const
  {
    for (int i = 0; id > 0 && i < n; i++)
      if (tag[i] == id) return radius[i];
    return 0;
  }
};

// Arrays that are wanted in memory of the CPU: positions, radii, masses, groups, types and tags, or tags alone.
enum class CpuArrays { all, tags };

// Returns the spheres of a host, whose arrays are in other memory, with arrays in memory of the CPU. Empty: they are there already.
using ToCpu = std::function<HostSpheres(const HostSpheres &, CpuArrays)>;

// Spheres that are brought to memory of the CPU when they are asked for. `spheres` must outlive this object.
class SpheresOnCpu {
 public:
  explicit SpheresOnCpu(const HostSpheres &spheres, ToCpu to_cpu = {}) :
      spheres_(spheres), to_cpu_(std::move(to_cpu))
  {
  }
  bool are_there() const { return !to_cpu_; }    // nothing has to be brought
  HostSpheres all() const { return get(CpuArrays::all); }
  std::int64_t tag(int i) const { return get(CpuArrays::tags).tag[i]; }
  std::int64_t highest_tag() const { return get(CpuArrays::tags).highest_tag(); }

 private:
  HostSpheres get(CpuArrays arrays) const { return to_cpu_ ? to_cpu_(spheres_, arrays) : spheres_; }

  const HostSpheres &spheres_;
  ToCpu to_cpu_;
};

}    // namespace lsdcd
