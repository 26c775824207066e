// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The candidates of a wall of more than one mesh, or with laws by type, sorted into candidate-mesh pairs,
// which the code calls slots. First come the candidates of a single mesh, mesh after mesh and kind after
// kind. Then come multi-mesh spheres, which are candidates of more than one mesh and have a slot for each
// (sphere, mesh).
#pragma once

#include "base/countable.h"
#include "engine/settings.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

// A set of meshes, a bit for each.
using MeshSet = std::uint32_t;
static_assert(kMaxMeshes <= 8 * sizeof(MeshSet), "a bit for each");

LSDCD_FN bool has_mesh(MeshSet set, int mesh)
{
  return set >> mesh & 1;
}
LSDCD_FN bool is_single(MeshSet set)
{
  return (set & (set - 1)) == 0;
}

// Flags candidates of this kind that are near this mesh only.
struct FlagSingle {
  const int *found;
  const MeshSet *set;
  SphereKinds kind;
  int of_kind;
  char *flags;

  LSDCD_FN void operator()(std::size_t k) const
  {
    flags[k] = is_single(set[found[k]]) && kind[found[k]] == of_kind;
  }
};
// Flags multi-mesh spheres. Each is counted with the first of its meshes.
struct FlagMultiMesh {
  const int *found;
  const MeshSet *set;
  int mesh;
  char *flags;

  LSDCD_FN void operator()(std::size_t k) const
  {
    const MeshSet of = set[found[k]], before = (MeshSet(1) << mesh) - 1;
    flags[k] = !is_single(of) && (of & before) == 0;
  }
};

// Multi-mesh spheres and their slots.
struct MultiMeshSlots {
  const int *multi_mesh;
  const MeshSet *set;
  int *first, *sphere, *mesh;
};
struct CountMeshes {
  MultiMeshSlots to;

  LSDCD_FN void operator()(std::size_t g) const
  {
    int count = 0;
    for (MeshSet of = to.set[to.multi_mesh[g]]; of != 0; of &= of - 1) count++;
    to.first[g] = count;
  }
};
struct PutSlots {
  MultiMeshSlots to;
  int begin;    // of the slots of multi-mesh spheres among all slots

  LSDCD_FN void operator()(std::size_t g) const
  {
    int k = to.first[g] += begin;
    for (int m = 0; m < kMaxMeshes; m++)
      if (has_mesh(to.set[to.multi_mesh[g]], m)) {
        to.sphere[k] = to.multi_mesh[g];
        to.mesh[k++] = m;
      }
  }
};

template <class B>
class CandidateSlots {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Begins the search for n spheres.
  void clear(B &b, std::size_t n)
  {
    n_spheres_ = n;
    n_found_ = 0;
    end_.clear();
    set_.reserve(n);
    put_all(b, set_.data(), n, 0);
  }

  // Adds the n candidates of the next mesh.
  void add(B &b, const int *candidates, std::size_t n)
  {
    const int mesh = static_cast<int>(end_.size());
    reserve(b, n_found_ + n);
    MeshSet *set = set_.data();
    int *to = found_.data() + n_found_;
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      to[k] = candidates[k];
      set[candidates[k]] |= MeshSet(1) << mesh;
    });
    n_found_ += n;
    end_.push_back(n_found_);
  }

  // Ends the search and makes the slots. `kind`: of each sphere, in [0, kinds).
  void finish(B &b, const SphereKinds &kind, int kinds)
  {
    kinds_ = kinds;
    const std::size_t most = n_found_;
    sphere_.reserve(most);
    mesh_.reserve(most);
    multi_mesh_.reserve(most);
    first_.reserve(most + 1);
    flags_.reserve(most);
    begin_.assign(1, 0);
    n_multi_mesh_ = 0;
    for (std::size_t m = 0; m < end_.size(); m++) {
      const std::size_t from = m == 0 ? 0 : end_[m - 1], n = end_[m] - from;
      const int *found = found_.data() + from;
      const std::size_t at = begin_.back();
      for (int k = 0; k < kinds; k++) {
        const std::size_t to = begin_.back();
        b.for_each(n, FlagSingle{found, set_.data(), kind, k, flags_.data()});
        begin_.push_back(to + compact(b, found, n, sphere_.data() + to));
      }
      put_all(b, mesh_.data() + at, begin_.back() - at, m);
      b.for_each(n, FlagMultiMesh{found, set_.data(), static_cast<int>(m), flags_.data()});
      n_multi_mesh_ += compact(b, found, n, multi_mesh_.data() + n_multi_mesh_);
    }
    n_slots_ = numbered(begin_.back());
    if (n_multi_mesh_ > 0) make_multi_mesh_slots(b);
  }

  // Returns where slots begin. Slots [begin(m), begin(m + 1)) are of candidates of mesh m only; those of
  // kind k start at begin(m, k). The slots of multi-mesh spheres start at begin(number of meshes).
  std::size_t begin(int mesh, int kind = 0) const { return begin_[mesh * kinds_ + kind]; }
  int n_meshes() const { return static_cast<int>(end_.size()); }
  std::size_t n_slots() const { return n_slots_; }
  const int *sphere() const { return sphere_.data(); }    // of each slot
  const int *mesh() const { return mesh_.data(); }        // of each slot
  std::size_t n_multi_mesh() const { return n_multi_mesh_; }
  const int *first() const
  {
    return first_.data();
  }    // first slot of each multi-mesh sphere, and the end
  const MeshSet *meshes_of() const { return set_.data(); }    // of each sphere
  std::size_t n_spheres() const { return n_spheres_; }

  std::size_t bytes() const
  {
    return (found_.size() + sphere_.size() + mesh_.size() + multi_mesh_.size() + first_.size()) *
               sizeof(int) +
           set_.size() * sizeof(MeshSet) + flags_.size();
  }

 private:
  void reserve(B &b, std::size_t n)
  {
    if (found_.size() >= n) return;
    Array<int> wider(n + n / 2);
    copy_all(b, found_.data(), wider.data(), n_found_);
    b.wait();
    found_ = std::move(wider);
  }

  static int numbered(std::int64_t n)
  {
    return countable(n, "pairs of a sphere and a mesh near it in one process",
                     "use more processes");
  }

  void make_multi_mesh_slots(B &b)
  {
    const std::size_t n = n_multi_mesh_;
    const MultiMeshSlots slots = {multi_mesh_.data(), set_.data(), first_.data(), sphere_.data(),
                                  mesh_.data()};
    b.for_each(n, CountMeshes{slots});
    const int begin = numbered(n_slots_), total = numbered(b.exclusive_scan(first_.data(), n));
    n_slots_ = numbered(std::int64_t(begin) + total);
    b.for_each(n, PutSlots{slots, begin});
    put_one(b, first_.data() + n, begin + total);
  }

  std::size_t compact(B &b, const int *found, std::size_t n, int *to)
  {
    if (n == 0) return 0;
    b.compact(n, found, flags_.data(), to, count_.data());
    return read_one(b, count_.data());
  }

  int kinds_ = 1;
  std::size_t n_spheres_ = 0, n_found_ = 0, n_slots_ = 0, n_multi_mesh_ = 0;
  std::vector<std::size_t> end_, begin_ = {0};
  Array<MeshSet> set_;    // the meshes that each sphere is near
  Array<int> found_;      // candidates, mesh after mesh
  Array<int> sphere_, mesh_, multi_mesh_, first_;
  Array<char> flags_;
  Array<std::uint32_t> count_ = Array<std::uint32_t>(1);
};

}    // namespace lsdcd
