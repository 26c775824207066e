// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "law/contact_time.h"
#include "shape/least_mass.h"
#include "shape/superellipsoid.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

namespace {

struct ShapeOptions {
  std::vector<double> lengths, block = {2, 2};
  double density = kNotGiven, kn = kNotGiven;
  bool json = false;
};

// All that the command prints. Numbers that need an option which is not given are NaN.
struct ShapeAnswer {
  Superellipsoid shape;
  double volume, mass;
  Vec3 inertia;            // over the mass, length^2
  double sphere;           // radius of the sphere of this volume
  double least_mass;       // of a point that meets a plane, over the mass
  double at_wall, pair;    // duration of the shortest contact with a wall, and of two such grains
  double timestep;         // above which contacts are not resolved
};

ShapeAnswer answer_of(const ShapeOptions &o)
{
  ShapeAnswer a;
  a.shape = make_superellipsoid({o.lengths[0] / 2, o.lengths[1] / 2, o.lengths[2] / 2}, o.block[0],
                                o.block[1]);
  a.volume = volume(a.shape);
  a.mass = o.density * a.volume;
  a.inertia = inertia_over_mass(a.shape);
  a.sphere = std::cbrt(a.volume / (4 * kPi / 3));
  a.least_mass = least_mass_share(a.shape);
  ContactLaw law = granular_law(NormalModel::hooke);
  law.k_normal = o.kn;
  const double mass = a.least_mass * a.mass;
  a.at_wall = contact_time(law, mass, a.sphere, 1);
  a.pair = contact_time(law, mass / 2, a.sphere, 1);
  a.timestep = a.pair / kStepsPerContact;
  return a;
}

nlohmann::json as_json(const ShapeAnswer &a)
{
  const Superellipsoid &s = a.shape;
  nlohmann::json told = {{"half_axes", {s.half.x, s.half.y, s.half.z}},
                         {"block", {s.n1, s.n2}},
                         {"volume", a.volume},
                         {"sphere_of_this_volume", a.sphere},
                         {"inertia_over_mass", {a.inertia.x, a.inertia.y, a.inertia.z}},
                         {"circumscribed_radius", s.farthest},
                         {"inscribed_radius", s.nearest},
                         {"curvature_radius", s.rho},
                         {"least_mass_over_mass", a.least_mass}};
  if (!std::isnan(a.mass)) told["mass"] = a.mass;
  if (!std::isnan(a.timestep)) {
    told["contact_time"] = {{"wall", a.at_wall}, {"grains", a.pair}};
    told["timestep"] = a.timestep;
  }
  return told;
}

void print(const ShapeAnswer &a)
{
  const Superellipsoid &s = a.shape;
  std::printf("half-axes          %.6g %.6g %.6g, block %g %g\n", s.half.x, s.half.y, s.half.z,
              s.n1, s.n2);
  std::printf("volume             %.9g    of a sphere of radius %.6g\n", a.volume, a.sphere);
  if (!std::isnan(a.mass)) std::printf("mass               %.9g\n", a.mass);
  std::printf("inertia / mass     %.6g %.6g %.6g\n", a.inertia.x, a.inertia.y, a.inertia.z);
  std::printf("spheres            %.6g around it, %.6g inside\n", s.farthest, s.nearest);
  std::printf("curvature          least radius %.6g: deeper contacts may jump at folds and edges\n",
              s.rho);
  std::printf("least mass         %.4g of its mass, where its outermost points meet a plane\n",
              a.least_mass);
  if (!std::isnan(a.timestep)) {
    std::printf("contact            %.4g at a wall, %.4g between two\n", a.at_wall, a.pair);
    std::printf("\ntimestep           %.3g    a tenth of the shortest contact\n", a.timestep);
  }
  if (std::isnan(a.mass)) return;
  std::printf("\nset group all mass %.9g\nset group all shape %.9g %.9g %.9g\n", a.mass,
              2 * s.half.x, 2 * s.half.y, 2 * s.half.z);
  if (!s.is_ellipsoid()) std::printf("set group all block %g %g\n", s.n1, s.n2);
}

void run(const ShapeOptions &o)
{
  if (!std::isnan(o.kn) && std::isnan(o.density))
    throw_usage_error("--kn", "a contact time needs a mass: give --density, too");
  const ShapeAnswer answer = answer_of(o);
  if (o.json)
    print_json(stdout, as_json(answer));
  else
    print(answer);
}

}    // namespace

void add_shape_command(Command &program)
{
  const auto o = std::make_shared<ShapeOptions>();
  Command command = program.command(
      "shape", "computes volume, mass, inertia and timestep of an ellipsoid or superellipsoid");
  command.footer(
      "The grain is |x/a|^n2 + |y/b|^n2 = 1 in its plane of x and y, and with it |z/c|^n1: a box "
      "or\n"
      "a cylinder with rounded edges for large exponents. Volume and inertia are closed forms\n"
      "(Jaklic, Leonardis and Solina 2000, chapter 2).\n"
      "A point of the rim meets a plane with less than the whole mass, as the grain turns:\n"
      "m / (1 + (r x n) I^-1 (r x n) m). The least of these masses sets the timestep; between two\n"
      "grains it is half of that.\n"
      "Units are those of the script. The last lines are those of an input script.\n\n"
      "Example:\n"
      "  lsdcd shape 0.003 0.003 0.0016 --block 6 2 --density 1300 --kn 1000");
  command.option("lengths", o->lengths, "along its three axes, as in set shape")
      .required()
      .words(3, 3)
      .check(above_zero);
  command
      .option("--block", o->block, "exponents n1 (along z) and n2, from 2 to 20, as in set block")
      .words(2, 2)
      .shows_default();
  command.option("--density", o->density, "density").check(above_zero);
  command.option("--kn", o->kn, "stiffness of a linear spring, for the timestep").check(above_zero);
  command.flag("--json", o->json, "print JSON");
  command.runs([o] { run(*o); });
}

}    // namespace lsdcd
