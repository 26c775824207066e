// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Steps of small walls on a CPU, each function of which the compiler reports as it is entered and left (-finstrument-functions).
// Prints the name of each step that is traced, and its functions by their addresses in this program, for test_trace.py.
#include "host/host.h"
#include "mesh/welded_mesh.h"
#include "wall/wall.h"

#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

// Addresses of functions that are entered; null where one is left.
std::vector<void *> *seen = nullptr;

}    // namespace

extern "C" {
__attribute__((no_instrument_function)) void __cyg_profile_func_enter(void *function, void *)
{
  if (seen) seen->push_back(function);
}
__attribute__((no_instrument_function)) void __cyg_profile_func_exit(void *, void *)
{
  if (seen) seen->push_back(nullptr);
}
}

namespace lsdcd {
namespace {

constexpr Real kDt = 1e-3, kRadius = 0.5;

std::shared_ptr<const WeldedMesh> mesh_of(const std::vector<Vec3> &corners)
{
  TriangleSoup soup;
  soup.source = "mesh";
  soup.corners = corners;
  return std::make_shared<const WeldedMesh>(weld(soup, 0));
}

// A plate in the plane at this height, with normals up, which no edge of a contact is near.
std::shared_ptr<const WeldedMesh> plate(Real z)
{
  const Vec3 a = {-10, -10, z}, b = {10, -10, z}, c = {10, 10, z}, d = {-10, 10, z};
  return mesh_of({a, b, c, a, c, d});
}

std::shared_ptr<const WeldedMesh> box(const Vec3 &lo, const Vec3 &hi)
{
  std::vector<Vec3> corners;
  const auto at = [&](int k) {
    return Vec3{k & 1 ? hi.x : lo.x, k & 2 ? hi.y : lo.y, k & 4 ? hi.z : lo.z};
  };
  for (const auto &[a, b, c, d] : {std::array<int, 4>{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}})
    corners.insert(corners.end(), {at(a), at(b), at(c), at(a), at(c), at(d)});
  return mesh_of(corners);
}

MeshSpec mesh_spec(std::shared_ptr<const WeldedMesh> mesh)
{
  MeshSpec spec;
  spec.name = "mesh";
  spec.mesh = std::move(mesh);
  return spec;
}

MotionTerm rotation()
{
  MotionTerm term;
  term.kind = MotionKind::rotate;
  term.axis = {0, 0, 1};
  term.period = 1;
  return term;
}

// A wall of these meshes, with a sphere that rests on what is at the height 0.
class Scene {
 public:
  explicit Scene(std::vector<MeshSpec> meshes) :
      wall_(host_, spec_of(std::move(meshes)), {}, {}, "", {0, 0, 0, kDt}, spheres())
  {
    wall_.begin_run(0, false);
    step(Step::setup, true);
  }

  Wall &wall() { return wall_; }
  Step now() const { return {number_, kDt}; }

  // Makes steps in which lists hold, so that memory is taken and contacts are known.
  void warm_up(int steps)
  {
    for (int k = 0; k < steps; k++) step(Step::step, false);
  }
  void trace(const std::string &name, bool look)
  {
    std::vector<void *> all;
    all.reserve(1 << 20);
    before_step();
    const StepInput input = input_of(Step::step, look);
    const HostSpheres given = spheres();
    seen = &all;
    wall_.begin(given, input);
    wall_.submit(given);
    wall_.finish(given);
    seen = nullptr;
    Dl_info program;
    dladdr(reinterpret_cast<void *>(&__cyg_profile_func_exit), &program);
    std::printf("# %s, force %.6g\n", name.c_str(), force_[2]);
    for (void *f : all)
      std::printf("%lx\n", f ? reinterpret_cast<std::uintptr_t>(f) -
                                   reinterpret_cast<std::uintptr_t>(program.dli_fbase)
                             : 0);
    if (force_[2] == 0) std::exit(1);    // the step had no contact
  }

  std::function<void()> before_step = [] {};
  Real place[3] = {3, 1, kRadius - 0.05};

 private:
  static WallSpec spec_of(std::vector<MeshSpec> meshes)
  {
    WallSpec wall;
    ContactLaw law = classic_law(NormalModel::hooke, true);
    law.k_normal = 1000;
    law.k_tangent = 300;
    law.mu = 0.5;
    wall.laws.front().law = law;
    wall.device = Device::cpu;
    wall.brief = true;
    wall.meshes = std::move(meshes);
    return wall;
  }

  HostSpheres spheres()
  {
    HostSpheres all;
    all.n = 1;
    all.x = place;
    all.v = v_;
    all.omega = omega_;
    all.force = force_;
    all.torque = torque_;
    all.radius = &radius_;
    all.mass = &mass_;
    return all;
  }
  StepInput input_of(Step::Kind kind, bool look)
  {
    for (int d = 0; d < 3; d++) force_[d] = torque_[d] = 0;
    StepInput input;
    input.step = {kind == Step::setup ? number_ : ++number_, kDt, kind};
    input.look = look;
    input.new_spheres = kind == Step::setup;
    input.drift.kind = SphereDrift::bounded;
    input.drift.distance = 0.1;
    input.drift.has_begun = !look;
    return input;
  }
  void step(Step::Kind kind, bool look)
  {
    before_step();
    const StepInput input = input_of(kind, look);
    const HostSpheres given = spheres();
    wall_.begin(given, input);
    wall_.submit(given);
    wall_.finish(given);
  }

  Host host_;
  std::int64_t number_ = 0;
  Real v_[3] = {0.1, 0, 0}, omega_[3] = {}, force_[3] = {}, torque_[3] = {};
  Real radius_ = kRadius, mass_ = 1;
  Wall wall_;
};

void mesh_at_rest()
{
  Scene scene({mesh_spec(plate(0))});
  scene.warm_up(4);
  scene.trace("a mesh at rest", false);
  scene.place[0] += 0.2;
  scene.place[2] -= 0.01;
  scene.trace("a mesh at rest, choice and new list", true);
}

void mesh_that_was_stopped()
{
  MeshSpec floor = mesh_spec(plate(0));
  floor.motion.add(rotation());
  Scene scene({floor});
  scene.warm_up(4);
  scene.wall().set_motion(0, RigidMotion(), scene.now());
  scene.warm_up(4);
  scene.trace("a mesh that was stopped", false);
}

void rotation_and_servo()
{
  MeshSpec floor = mesh_spec(plate(0)), lid = mesh_spec(plate(5));
  floor.motion.add(rotation());
  Servo &servo = lid.motion.servo();
  servo.present = true;
  servo.target = 3;
  servo.max_speed = 0.2;
  Scene scene({floor, lid});
  scene.warm_up(4);
  scene.trace("two meshes, a rotation and a servo", false);
}

void nodes()
{
  MeshSpec floor = mesh_spec(plate(0));
  floor.has_nodes = true;
  std::vector<Vec3> at = floor.mesh->vertices;
  Scene scene({floor});
  scene.before_step = [&] {
    for (Vec3 &x : at) x.z += 1e-6;
    scene.wall().set_nodes(0, &at[0].x, nullptr);
  };
  scene.warm_up(4);
  scene.trace("a mesh with nodes", false);
}

void body_with_coat()
{
  MeshSpec floor = mesh_spec(plate(-2)), body = mesh_spec(box({2.2, 0.2, -1.9}, {3.8, 1.8, 0}));
  body.body.present = true;
  body.body.density = 1;
  body.body.coat.present = true;
  body.body.coat.spacing = 1;
  body.body.coat.radius = 0.11;
  Scene scene({body, floor});
  scene.warm_up(4);
  scene.trace("a body with a coat", false);
}

}    // namespace
}    // namespace lsdcd

int main()
{
  lsdcd::mesh_at_rest();
  lsdcd::mesh_that_was_stopped();
  lsdcd::rotation_and_servo();
  lsdcd::nodes();
  lsdcd::body_with_coat();
}
