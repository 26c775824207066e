// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A copy of the host's spheres, for a host whose arrays the engine cannot use directly: they are in memory of the CPU while
// the engine is on a GPU, or they are in float. The engine has arrays of its own, in double, in its memory, with the host's
// indices. A candidate search gets the places and radii of all spheres. A step gets what it reads of the candidates, which
// are few, and their forces are copied back.
#pragma once

#include "backend/backend.h"
#include "backend/threads.h"
#include "engine/broad_phase/broad_phase.h"
#include "engine/grains.h"
#include "engine/settings.h"

#include <vector>

namespace lsdcd {

// The numbers that a step reads of a sphere, as they are sent, and those that it leaves, as they come back.
struct SphereRow {
  Vec3 x, v, omega;
  Real radius, mass, temperature;
};
struct Response {
  Vec3 force, torque;
  Real heat_flow;
};

// The arrays of an engine, by the host's indices. Those of heat are null if there is none.
struct MirrorArrays {
  StridedView<Real> x, v, omega, force, torque;
  Real *radius, *mass, *temperature, *heat_flow;

  // Stores what a step reads of sphere i, and sets its force to 0.
  LSDCD_FN void put(std::size_t i, const SphereRow &row) const
  {
    x.put(i, row.x);
    v.put(i, row.v);
    omega.put(i, row.omega);
    force.put(i, {0, 0, 0});
    torque.put(i, {0, 0, 0});
    radius[i] = row.radius;
    mass[i] = row.mass;
    if (!heat_flow) return;
    temperature[i] = row.temperature;
    heat_flow[i] = 0;
  }
};

// Reads three floats as doubles, which is exact.
LSDCD_FN Vec3 in_double(const StridedView<const float> &from, std::size_t i)
{
  const float *p = from.of(i);
  return {Real(p[0]), Real(p[from.column]), Real(p[2 * from.column])};
}

// The kernels. The following ones are for each candidate, index[k]:

struct PutRows {
  MirrorArrays to;
  const int *index;
  const SphereRow *from;
  LSDCD_FN void operator()(std::size_t k) const { to.put(index[k], from[k]); }
};
struct GetResponses {
  MirrorArrays from;
  const int *index;
  Response *to;
  LSDCD_FN void operator()(std::size_t k) const
  {
    const std::size_t i = index[k];
    to[k] = {from.force[i], from.torque[i], from.heat_flow ? from.heat_flow[i] : 0};
  }
};
struct PutFloats {
  MirrorArrays to;
  const int *index;
  FloatSpheres from;
  const Real *mass;    // instead of the floats; null: there is none
  LSDCD_FN void operator()(std::size_t k) const
  {
    const std::size_t i = index[k];
    to.put(i, {in_double(from.x, i), in_double(from.v, i), in_double(from.omega, i),
               Real(from.radius[i]), mass ? mass[i] : Real(from.mass[i]), 0});
  }
};
struct AddToFloats {
  MirrorArrays from;
  const int *index;
  FloatSpheres to;
  LSDCD_FN static void add(const StridedView<float> &to, std::size_t i, const Vec3 &more)
  {
    float *p = to.of(i);
    for (int d = 0; d < 3; d++, p += to.column) *p = static_cast<float>(Real(*p) + more[d]);
  }
  LSDCD_FN void operator()(std::size_t k) const
  {
    const std::size_t i = index[k];
    add(to.force, i, from.force[i]);
    add(to.torque, i, from.torque[i]);
  }
};
// The following kernels are for all spheres:
struct PlacesInDouble {
  StridedView<const float> from;
  StridedView<Real> to;
  LSDCD_FN void operator()(std::size_t i) const { to.put(i, in_double(from, i)); }
};
struct FlagNear {
  const MeshSet *set;
  char *flags;
  LSDCD_FN void operator()(std::size_t i) const { flags[i] = set[i] != 0; }
};

template <class B>
class SphereMirror {
  template <class T>
  using Array = typename B::template Array<T>;
  template <class T>
  using CpuArray = typename B::template CpuArray<T>;

 public:
  SphereMirror(HostArrays arrays, bool heat) :
      arrays_(arrays), heat_(heat && arrays == HostArrays::apart)
  {
  }

  // Each of these functions returns the engine's spheres: with places, with radii, or with all that a candidate search reads.
  Spheres bring_places(B &b, const Spheres &host)
  {
    Spheres s = members(b, host);
    const std::size_t n = host.n;
    x_.reserve(3 * n);
    if (is_apart())
      copy_places(b, host.x, n);
    else
      b.for_each(n, PlacesInDouble{host.in_float->x, x_.data()});
    s.x = x_.data();
    return s;
  }
  Spheres bring_radii(B &b, const Spheres &host)
  {
    Spheres s = members(b, host);
    put_radii(b, host);
    s.radius = radius_.data();
    return s;
  }
  Spheres bring_for_choice(B &b, const Spheres &host)
  {
    Spheres s = bring_places(b, host);
    put_radii(b, host);
    s.radius = radius_.data();
    if (is_apart() && host.type) {
      type_.reserve(host.n);
      b.copy_in(host.type, type_.data(), host.n);
      s.type = type_.data();
    }
    return s;
  }

  // Reserves memory for steps over the candidates of a search among n spheres.
  void make_room(B &b, const BroadPhase<B> &chosen, std::size_t n)
  {
    index_ = chosen.candidates();
    n_ = chosen.n();
    if (chosen.uses_slots()) list_each_once(b, chosen.slots());
    for (Array<Real> *vectors : {&v_, &omega_, &force_, &torque_}) vectors->reserve(3 * n);
    mass_.reserve(n);
    if (heat_) temperature_.reserve(n);
    if (heat_) heat_flow_.reserve(n);
    if (!is_apart()) return;
    index_on_cpu_.resize(n_);
    b.copy_out(index_, index_on_cpu_.data(), n_);
    rows_.reserve(n_);
    rows_on_cpu_.reserve(n_);
    responses_.reserve(n_);
    responses_on_cpu_.reserve(n_);
    b.wait();
  }

  // Returns the engine's spheres with what a step reads of the candidates. Does not wait.
  Spheres bring_candidates(B &b, const Spheres &host)
  {
    host_ = host;
    Spheres s = host;
    s.in_float = nullptr;
    const MirrorArrays to = arrays();
    s.x = to.x;
    s.v = to.v;
    s.omega = to.omega;
    s.radius = to.radius;
    s.mass = to.mass;
    s.mask = nullptr;    // no step reads it
    if (is_apart() || host.in_float->force.at) {
      s.force = to.force;
      s.torque = to.torque;
    }
    if (is_apart() && host.type) s.type = type_.data();
    if (heat_) s.temperature = to.temperature;
    if (heat_) s.heat_flow = to.heat_flow;
    if (n_ == 0) return s;
    if (is_apart()) {
      pack(host);
      b.copy_in(rows_on_cpu_.data(), rows_.data(), n_);
      b.for_each(n_, PutRows{to, index_, rows_.data()});
    } else {
      b.for_each(n_, PutFloats{to, index_, *host.in_float, host.mass});
    }
    return s;
  }

  // Starts to copy forces back, after the work of the step. Does not wait.
  void start_back(B &b)
  {
    if (n_ == 0) return;
    if (is_apart()) {
      b.for_each(n_, GetResponses{arrays(), index_, responses_.data()});
      b.copy_out(responses_.data(), responses_on_cpu_.data(), n_);
    } else if (host_.in_float->force.at) {
      b.for_each(n_, AddToFloats{arrays(), index_, *host_.in_float});
    }
  }
  // Waits for forces that are copied, and adds them to the host's.
  void collect(B &b)
  {
    if (!is_apart() || n_ == 0) return;
    b.wait();
    add_responses();
  }

  // Returns the radius of sphere i in the last step (length), if the host has its arrays in float, else 0.
  Real radius_of(B &b, int i) { return is_apart() || i < 0 ? 0 : read_one(b, radius_.data() + i); }

  std::size_t bytes() const
  {
    std::size_t reals = 0;
    for (const Array<Real> *a :
         {&x_, &v_, &omega_, &radius_, &mass_, &force_, &torque_, &temperature_, &heat_flow_})
      reals += a->size();
    return reals * sizeof(Real) + (mask_.size() + type_.size() + once_.size()) * sizeof(int) +
           flags_.size() + index_on_cpu_.capacity() * sizeof(int) +
           places_on_cpu_.size() * sizeof(Real) +
           (rows_.size() + rows_on_cpu_.size()) * sizeof(SphereRow) +
           (responses_.size() + responses_on_cpu_.size()) * sizeof(Response);
  }

 private:
  bool is_apart() const { return arrays_ == HostArrays::apart; }
  MirrorArrays arrays()
  {
    return {x_.data(),      v_.data(),    omega_.data(),       force_.data(),    torque_.data(),
            radius_.data(), mass_.data(), temperature_.data(), heat_flow_.data()};
  }

  // Returns spheres that only say who is in the group.
  Spheres members(B &b, const Spheres &host)
  {
    Spheres s;
    s.n = host.n;
    s.group_bit = host.group_bit;
    s.mask = host.mask;
    s.type = host.type;
    if (!is_apart() || !host.mask) return s;
    mask_.reserve(host.n);
    b.copy_in(host.mask, mask_.data(), host.n);
    s.mask = mask_.data();
    return s;
  }
  void put_radii(B &b, const Spheres &host)
  {
    radius_.reserve(host.n);
    if (is_apart())
      b.copy_in(host.radius, radius_.data(), host.n);
    else
      copy_all(b, host.in_float->radius, radius_.data(), host.n);
  }
  void copy_places(B &b, const StridedView<const Real> &x, std::size_t n)
  {
    if (x.row == 3 && x.column == 1) return b.copy_in(x.at, x_.data(), 3 * n);
    places_on_cpu_.reserve(3 * n);
    const StridedView<Real> to(places_on_cpu_.data());
#pragma omp parallel for schedule(static) num_threads(threads()) if (n > 4096)
    for (std::size_t i = 0; i < n; i++) to.put(i, x[i]);
    b.copy_in(places_on_cpu_.data(), x_.data(), 3 * n);
    b.wait();
  }

  // Lists each candidate once, because those near several meshes have a candidate-mesh pair for each mesh, and forces are
  // copied back once.
  void list_each_once(B &b, const CandidateSlots<B> &slots)
  {
    const std::size_t n = slots.n_spheres();
    flags_.reserve(n);
    once_.reserve(n);
    b.for_each(n, FlagNear{slots.meshes_of(), flags_.data()});
    b.compact(n, nullptr, flags_.data(), once_.data(), n_once_.data());
    n_ = read_one(b, n_once_.data());
    index_ = once_.data();
  }

  // Fills the rows of candidates. These are far apart in the host's memory, so they are prefetched.
  void pack(const Spheres &s)
  {
    constexpr int kAhead = 16;
    const int n = static_cast<int>(n_), *index = index_on_cpu_.data();
    SphereRow *to = rows_on_cpu_.data();
#pragma omp parallel for schedule(static) num_threads(threads()) if (n > 4096)
    for (int k = 0; k < n; k++) {
      if (k + kAhead < n) {
        const int next = index[k + kAhead];
        __builtin_prefetch(s.x.of(next));
        __builtin_prefetch(s.v.of(next));
        __builtin_prefetch(s.omega.of(next));
      }
      const int i = index[k];
      to[k] = {s.x[i], s.v[i], s.omega[i], s.radius[i], s.mass[i], heat_ ? s.temperature[i] : 0};
    }
  }
  // Adds the forces that were copied back to the host's, and skips spheres that feel nothing, which are most.
  void add_responses()
  {
    const int n = static_cast<int>(n_), *index = index_on_cpu_.data();
    const Response *response = responses_on_cpu_.data();
    const Spheres host = host_;
    const bool heat = heat_;
#pragma omp parallel for schedule(static) num_threads(threads()) if (n > 4096)
    for (int k = 0; k < n; k++) {
      const Response &r = response[k];
      if (r.force == Vec3{0, 0, 0} && r.torque == Vec3{0, 0, 0} && r.heat_flow == 0) continue;
      const int i = index[k];
      host.force.add(i, r.force);
      host.torque.add(i, r.torque);
      if (heat) host.heat_flow[i] += r.heat_flow;
    }
  }

  HostArrays arrays_;
  bool heat_;
  Array<Real> x_, v_, omega_, radius_, mass_, force_, torque_, temperature_, heat_flow_;
  Array<int> mask_, type_;    // as of the candidate search
  CpuArray<Real> places_on_cpu_;

  std::size_t n_ = 0;             // number of candidates, each counted once
  const int *index_ = nullptr;    // their indices
  Array<int> once_;               // the same, if slots name some of them several times
  Array<char> flags_;
  Array<std::uint32_t> n_once_ = Array<std::uint32_t>(1);
  std::vector<int> index_on_cpu_;
  Array<SphereRow> rows_;
  CpuArray<SphereRow> rows_on_cpu_;
  Array<Response> responses_;
  CpuArray<Response> responses_on_cpu_;
  Spheres host_;    // of the step that runs
};

}    // namespace lsdcd
