// The one door between a host code (the fix, the tool, tests, benches) and the wall.
#pragma once

#include "base/rows.h"
#include "base/vec3.h"
#include "contact/spring_store.h"
#include "engine/force/on_wall.h"
#include "grid/triangle_grid.h"
#include "mesh/wall_mesh.h"
#include "model/contact_law.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace lsdcd {

enum class Corner { blend, sum };
enum class Side { both, in, out };
enum class Device { automatic, cpu, cuda };

// double_: everything in double. mixed: contacts are found in float, in the frame of a
// brick of the grid, forces are computed in double. single_: forces in float too.
// Sums, springs at rest and the spheres themselves are double in all three.
enum class Precision { double_, mixed, single_ };

struct EngineSettings {
  ContactLaw law;
  Corner corner = Corner::blend;
  Side side = Side::both;
  Precision precision = Precision::double_;
  SurfaceMotion surface;               // of the wall, in the plane of each contact
  bool records = false;                // keep what every contact does to the wall
  WearModel wear = WearModel::none;    // where records are kept
  Device device = Device::automatic;
  int device_rank = 0;    // which of the GPUs this process takes (node-local rank, wrapped)
};

// Sphere data of a host code, borrowed for one step; n is the number of owned spheres.
struct Spheres {
  int n = 0;
  Rows<const Real> x;              // length
  Rows<const Real> v;              // length/time
  Rows<const Real> omega;          // 1/time
  const Real *radius = nullptr;    // length
  const Real *mass = nullptr;      // mass that damping sees (a rigid member's body mass)
  const int *mask = nullptr;       // group bits, or null: all spheres
  int group_bit = 0;
  Rows<Real> force;                     // added to
  Rows<Real> torque;                    // added to
  const Real *temperature = nullptr;    // where the law has heat
  Real *heat_flow = nullptr;            // power; added to where the law has heat
};

struct StepSettings {
  Real dt = 0;                   // time
  bool update_history = true;    // false in setup: springs act but do not move
  bool per_sphere = false;       // fill SphereOutput
  Real wall_temperature = 0;     // where the law has heat
};

// Sums over the spheres of the last step on this process.
struct WallTotals {
  Real energy = 0;            // elastic energy in normal overlaps and tangential springs
  Vec3 force = {0, 0, 0};     // on the mesh
  Vec3 torque = {0, 0, 0};    // on the mesh, about the origin
  std::int64_t contacts = 0;
  std::int64_t uncertified = 0;       // spheres whose answer was not certified exact
  Real largest_uncertain = 0;         // overlap / radius of the deepest contact they may miss
  Real largest_overlap_ratio = 0;     // overlap / radius
  int largest_overlap_sphere = -1;    // index in Spheres, -1 if none touches
  int pad = 0;                        // keeps the record free of indeterminate bytes
};

// One sphere's contacts in the columns of `fix wall/gran ... contacts`.
struct SphereOutput {
  Real contacts;    // number of contacts
  Vec3 force;       // sum over them, on the sphere
  Vec3 point;       // mean contact point on the wall, weighted by normal force
  Real radius;      // 0 where nothing touches
};

// Computes wall forces for the spheres of one process. A step is start() then
// collect(); between the two the host code must not change x, v or omega, and
// may change force and torque. A CUDA engine works between the two calls.
class WallEngine {
 public:
  virtual ~WallEngine() = default;

  // Backend in words, for the log: "CPU, 4 threads" or "CUDA, NVIDIA H200".
  virtual std::string backend() const = 0;

  // The grid to use from now on; borrowed, must outlive its use.
  virtual void set_grid(const GridView &grid) = 0;

  // Chooses the spheres near the wall and starts on them. `springs` may be null
  // where the law has no history, and keeps law.n_extra() numbers otherwise. Throws InputError if a sphere is larger than
  // the grid's reach (index and radius in the message).
  virtual void start(const Spheres &spheres, const StepSettings &step, SpringStore *springs) = 0;

  // Adds forces and torques, replaces the springs (unless update_history is
  // false) and the totals.
  virtual void collect() = 0;

  virtual const WallTotals &totals() const = 0;

  // Of the spheres with a contact in the last step: how many, which, and what.
  // Valid after collect() of a step with per_sphere.
  virtual int n_touching() const = 0;
  virtual const int *touching() const = 0;
  virtual const SphereOutput *sphere_output() const = 0;
  // Power into each of them; null where the law has no heat.
  virtual const Real *sphere_heat() const = 0;

  // What the contacts of the last step did to the wall, in the order of the spheres;
  // valid after collect() where settings.records is set.
  virtual int n_records() const = 0;
  virtual const ContactRecord *records() const = 0;

  // Spheres that passed the near test in the last step; bytes held by the engine.
  virtual int n_near() const = 0;
  virtual std::size_t bytes() const = 0;
};

// True if this build has the CUDA engine and a usable GPU is present; `why`
// says what is missing otherwise.
bool cuda_available(std::string *why);

// Are there forces in float? There are for the classic styles with nothing
// beside them, on walls that only bear.
bool has_single(const EngineSettings &settings);

// Device::cuda without a GPU throws InputError; Device::automatic takes the CPU then.
std::unique_ptr<WallEngine> make_engine(const EngineSettings &settings);

}    // namespace lsdcd
