// An engine for particles that live where it computes, on a GPU or on the host: it reads
// and adds to their arrays in place and keeps springs beside them, so that a step copies
// nothing and waits for nothing.
#pragma once

#include "engine/wall_engine.h"

#include <cstdint>
#include <memory>

namespace lsdcd {

// What steps have left behind since the host last looked.
struct StepNotes {
  Real deepest = 0;           // largest overlap / radius
  int deepest_sphere = -1;    // its index in the step that it was in
  std::int64_t uncertified = 0;
  Real uncertain = 0;    // overlap / radius of the deepest contact they may have missed
};

// Pointers in Spheres, and those below, are to memory of the backend. start() does all of
// a step; collect() only fetches what the step's settings ask for.
class ResidentEngine : public WallEngine {
 public:
  // Chooses the spheres that steps look at until the next call: those of the group that
  // could be near the wall after moving by up to `margin` (length). Waits. Throws
  // InputError if a sphere is larger than the grid's reach.
  virtual void choose(const Spheres &spheres, Real margin) = 0;

  // Says that spheres have their places of the next step and keep them until start().
  virtual void mark_places() = 0;

  // Begins the search for contacts of the next step, to run beside what the device has been
  // given since mark_places(), such as the forces between particles. Reads places and radii
  // only. To be called once that has been given: the host may wait for it before start(), which
  // searches where this has not been called.
  virtual void search(const Spheres &spheres, const StepSettings &step) = 0;

  // Largest radius in the group. Waits.
  virtual Real largest_radius(const Spheres &spheres) = 0;

  // Throws InputError if a sphere had to be left out of a step: too large, or crowded past
  // all room. Waits, and begins anew.
  virtual StepNotes look() = 0;

  // Springs. Per sphere there are a place and a count, which follow the sphere through
  // sorting; `n` spheres are the process's own.
  virtual void grow(int n) = 0;    // room for n; new spheres have none
  virtual int *first_spring() = 0;
  virtual int *n_springs() = 0;
  virtual void springs_to(SpringStore &store, int n) = 0;
  virtual void springs_from(const SpringStore &store, int n) = 0;

  // Exchange, as LAMMPS's Kokkos communication lays it out: first the place of each
  // sphere's numbers, as an integer in a double; then for each its count of springs and
  // these. Sphere which[k] leaves and sphere from[k], if that is not -1, takes its place.
  // Returns the numbers written.
  virtual int largest_packed_size(int n) = 0;    // numbers of one sphere; waits
  virtual int most_packed_size() const = 0;      // that one can have
  virtual int pack(int n, const int *which, const int *from, double *buffer) = 0;
  // Sphere to[k], if that is not -1, gets the k-th of what came. From n_first on the places
  // are those of a second message, which begins at `second`.
  virtual void unpack(int n, const int *to, const double *buffer, int n_first, int second) = 0;
};

std::unique_ptr<ResidentEngine> make_resident_cpu_engine(const EngineSettings &settings);
// `device` holds the particles, `stream` is a cudaStream_t of it. Throws InputError in a
// build without CUDA.
std::unique_ptr<ResidentEngine> make_resident_cuda_engine(const EngineSettings &settings,
                                                          int device, void *stream);

}    // namespace lsdcd
