// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "base/input_error.h"
#include "law/contact_time.h"
#include "material/contact_moduli.h"
#include "material/material_file.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

namespace {

constexpr double kRayleighShare = 0.2;
constexpr double kStepsPerImpact = 20;
constexpr double kDeep = 0.05;    // overlap / radius; larger overlaps change the results

struct TimestepOptions {
  std::string file, name, on;
  std::vector<double> radius;
  double speed = kNotGiven, wall_speed = 0;
  double young = kNotGiven, poisson = kNotGiven, density = kNotGiven, wall_young = kNotGiven,
         wall_poisson = kNotGiven;
  bool json = false;
};

std::string below_a_half(const std::string &word)
{
  double value;
  return is_number(word, &value) && value > -1 && value <= 0.5
             ? ""
             : word + " is not a number above -1 and up to 0.5";
}

// The value of an option, or that of the file.
double value_of(double given, const char *option, const MaterialSection *material,
                const char *property)
{
  if (!std::isnan(given)) return given;
  if (!material) throw_usage_error(option, "give it, or a material file and a name");
  const Stated *stated = material->find(property);
  if (!stated)
    throw InputError(material->place + ": '" + material->first + "' has no " + property +
                     ": add it there, or give " + option);
  return stated->value;
}

// The materials of the grains and of the wall.
struct Materials {
  Elastic grains, wall;
  double density;    // of the grains
};

// Reads the materials from the options, and from the file what the options do not give.
Materials materials_of(const TimestepOptions &o)
{
  MaterialFile file;
  const MaterialSection *grain = nullptr, *wall = nullptr;
  if (!o.file.empty()) {
    if (o.name.empty()) throw_usage_error("name", "give the name of a material in the file");
    file = read_materials(find_material_file(o.file));
    grain = wall = &file.material(o.name);
    if (!o.on.empty()) wall = &file.material(o.on);
  } else if (!o.on.empty()) {
    throw_usage_error("--on", "names a material of a file: give the file and the grains' name");
  }
  Materials read;
  read.grains = {value_of(o.young, "--young", grain, "youngs_modulus"),
                 value_of(o.poisson, "--poisson", grain, "poissons_ratio")};
  read.density = value_of(o.density, "--density", grain, "density");
  // Without other words the wall has the material of the grains.
  const auto of_wall = [&](double given, double of_grains, const char *option,
                           const char *property) {
    return o.on.empty() && std::isnan(given) ? of_grains : value_of(given, option, wall, property);
  };
  read.wall = {
      of_wall(o.wall_young, read.grains.youngs_modulus, "--wall-young", "youngs_modulus"),
      of_wall(o.wall_poisson, read.grains.poissons_ratio, "--wall-poisson", "poissons_ratio")};
  return read;
}

// Two bodies that meet.
struct Pair {
  const char *name, *reason;              // in the table; in set_by
  double modulus, mass, radius, speed;    // E*, and effective ones
};

struct Impact {
  Pair pair;
  double time;        // from touch to release
  double overlap;     // the largest, per radius of the grain
  double timestep;    // the longest that resolves the impact
};

// Returns the impact of a pair, whose radius is an effective one. `grain_radius`: that of the grain itself.
Impact impact_of(const Pair &pair, double grain_radius)
{
  const HertzImpact impact = hertz_impact(pair.modulus, pair.mass, pair.radius, pair.speed);
  return {pair, impact.time, impact.overlap / grain_radius, impact.time / kStepsPerImpact};
}

// All that the command prints.
struct TimestepAnswer {
  double radius;      // of the smallest grains: they need the smallest timestep
  double rayleigh;    // time
  std::vector<Impact> impacts;
  double fix_limit;          // the timestep above which the fix warns
  double timestep;           // the smallest of all these
  const char *set_by;        // the reason for that one
  double way;                // of a grain towards the wall in one timestep, per radius
  double kn_own, kn_wall;    // of grains on one another and on the wall, for hertz/history

  bool is_too_soft() const
  {
    return std::any_of(impacts.begin(), impacts.end(),
                       [](const Impact &i) { return i.overlap > kDeep; });
  }
};

// Sets the timestep to the smallest of the limits, which `a` has already, and says which one that is.
void choose_timestep(TimestepAnswer &a)
{
  a.timestep = kRayleighShare * a.rayleigh;
  a.set_by = "the Rayleigh time";
  const auto takes = [&a](double other, const char *reason) {
    if (other >= a.timestep) return;
    a.timestep = other;
    a.set_by = reason;
  };
  for (const Impact &i : a.impacts) takes(i.timestep, i.pair.reason);
  takes(a.fix_limit, "the limit of the fix");
}

TimestepAnswer answer_of(const TimestepOptions &o, const Materials &m)
{
  TimestepAnswer a;
  const double radius = *std::min_element(o.radius.begin(), o.radius.end());
  const double mass = m.density * 4 / 3 * kPi * radius * radius * radius;
  const double own = contact_moduli(m.grains, m.grains).youngs,
               at_wall = contact_moduli(m.grains, m.wall).youngs;
  a.radius = radius;
  a.rayleigh = rayleigh_time(radius, m.density, m.grains.youngs_modulus, m.grains.poissons_ratio);
  a.impacts = {impact_of({"grain on grain", "the impact of grain on grain", own, mass / 2,
                          radius / 2, o.speed},
                         radius),
               impact_of({"grain on wall", "the impact on the wall", at_wall, mass, radius,
                          o.speed + o.wall_speed},
                         radius)};
  a.kn_own = own * 4 / 3;
  a.kn_wall = at_wall * 4 / 3;
  ContactLaw law = granular_law(NormalModel::hertz);
  law.k_normal = a.kn_wall;
  a.fix_limit = contact_time(law, mass, radius, 1) / kStepsPerContact;
  choose_timestep(a);
  a.way = (o.speed + o.wall_speed) * a.timestep / radius;
  return a;
}

nlohmann::json as_json(const TimestepAnswer &a)
{
  nlohmann::json impacts;
  for (const Impact &i : a.impacts)
    impacts.push_back({{"of", i.pair.name},
                       {"speed", i.pair.speed},
                       {"time", i.time},
                       {"overlap_per_radius", i.overlap},
                       {"timestep", i.timestep}});
  return {{"smallest_radius", a.radius}, {"rayleigh_time", a.rayleigh},
          {"impacts", impacts},          {"fix_warns_above", a.fix_limit},
          {"timestep", a.timestep},      {"set_by", a.set_by},
          {"way_per_radius", a.way},     {"hertz_kn", {{"grains", a.kn_own}, {"wall", a.kn_wall}}},
          {"too_soft", a.is_too_soft()}};
}

void print(const TimestepAnswer &a)
{
  std::printf("smallest radius    %.6g\n", a.radius);
  std::printf("Rayleigh time      %.4g    %g of it: %.4g\n", a.rayleigh, kRayleighShare,
              kRayleighShare * a.rayleigh);
  std::printf(
      "impact             speed      time           overlap per radius   1/%g of the time\n",
      kStepsPerImpact);
  for (const Impact &i : a.impacts)
    std::printf("%-18s %-10.4g %-14.4g %-20.3g %.4g\n", i.pair.name, i.pair.speed, i.time,
                i.overlap, i.timestep);
  std::printf(
      "the fix warns      above %.4g, a tenth of a contact with the wall at an overlap of 1 %%\n",
      a.fix_limit);
  std::printf("\ntimestep           %.3g    set by %s\n", a.timestep, a.set_by);
  std::printf("way in a step      %.3g of the radius\n", a.way);
  std::printf("hertz/history      kn %.6g on grains, %.6g on the wall (4/3 of E*)\n", a.kn_own,
              a.kn_wall);
  if (a.is_too_soft())
    std::printf("Overlaps exceed %g of the radius: a stiffer material is needed at this speed.\n",
                kDeep);
}

void run(const TimestepOptions &o)
{
  const TimestepAnswer answer = answer_of(o, materials_of(o));
  if (o.json)
    print_json(stdout, as_json(answer));
  else
    print(answer);
}

}    // namespace

void add_timestep_command(Command &program)
{
  const auto o = std::make_shared<TimestepOptions>();
  Command command =
      program.command("timestep", "computes a timestep from material, radius and speed");
  command.footer(
      "The timestep is the smallest of\n"
      "  0.2 of the Rayleigh time: a wave along the surface of the smallest grain,\n"
      "      pi R sqrt(density / G) / (0.1631 nu + 0.8766), G = E / (2 (1 + nu))\n"
      "      (Li, Xu and Thornton 2005)\n"
      "  1/20 of the time of an impact, 2.943 overlap / speed, with\n"
      "      overlap = (15 m v^2 / (16 E* sqrt(R)))^(2/5) (Hertz; Johnson 1985, chapter 11)\n"
      "  1/10 of a contact with the wall at an overlap of 1 % of the radius: above it the fix "
      "warns.\n"
      "Two equal grains have effective mass m/2 and radius R/2; a grain and the wall have m and "
      "R.\n"
      "So the same impact takes longer at the wall, and goes deeper. A wall that is stiffer than\n"
      "the grains, or moves towards them, shortens it. Damping does not change these times much.\n"
      "A softer material (--young) allows a longer timestep, which goes with 1 / sqrt(E). "
      "Overlaps\n"
      "should stay below 0.05 of the radius. Units are those of the script; a file has SI "
      "units.\n\n"
      "Example:\n"
      "  lsdcd timestep glass.lsdcd glass --on steel --radius 0.0009 0.0011 --speed 2");
  command.option("file", o->file, "material file, looked for as in an input script");
  command.option("name", o->name, "material of the grains");
  command.option("--on", o->on, "material of the wall in the file (default: the grains')");
  command.option("--radius", o->radius, "radii of the grains; the smallest counts")
      .required()
      .words(1, -1)
      .check(above_zero);
  command.option("--speed", o->speed, "speed of the fastest impact").required().check(above_zero);
  command.option("--wall-speed", o->wall_speed, "speed of the fastest point of a wall that moves")
      .check(not_below_zero)
      .shows_default();
  command.option("--young", o->young, "Young's modulus of the grains, instead of the file's")
      .check(above_zero);
  command.option("--poisson", o->poisson, "Poisson's ratio of the grains").check(below_a_half);
  command.option("--density", o->density, "their density").check(above_zero);
  command.option("--wall-young", o->wall_young, "Young's modulus of the wall").check(above_zero);
  command.option("--wall-poisson", o->wall_poisson, "Poisson's ratio of the wall")
      .check(below_a_half);
  command.flag("--json", o->json, "print JSON");
  command.runs([o] { run(*o); });
}

}    // namespace lsdcd
