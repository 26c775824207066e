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
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

namespace {

constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();
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

// Two bodies that meet.
struct Pair {
  const char *name, *reason;
  double modulus, mass, radius, speed;    // E*, and effective ones
};

void run(const TimestepOptions &o)
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
  const Elastic grains = {value_of(o.young, "--young", grain, "youngs_modulus"),
                          value_of(o.poisson, "--poisson", grain, "poissons_ratio")};
  const double density = value_of(o.density, "--density", grain, "density");
  // Without other words the wall has the material of the grains.
  const bool same = o.on.empty();
  const Elastic walls = {same && std::isnan(o.wall_young)
                             ? grains.youngs_modulus
                             : value_of(o.wall_young, "--wall-young", wall, "youngs_modulus"),
                         same && std::isnan(o.wall_poisson)
                             ? grains.poissons_ratio
                             : value_of(o.wall_poisson, "--wall-poisson", wall, "poissons_ratio")};

  // The smallest grains need the smallest timestep.
  const double least = *std::min_element(o.radius.begin(), o.radius.end());
  const double mass = density * 4 / 3 * kPi * least * least * least;
  const double own = contact_moduli(grains, grains).youngs,
               at_wall = contact_moduli(grains, walls).youngs;
  const double rayleigh =
      rayleigh_time(least, density, grains.youngs_modulus, grains.poissons_ratio);
  ContactLaw law = granular_law(NormalModel::hertz);
  law.k_normal = at_wall * 4 / 3;
  const double warned = contact_time(law, mass, least, 1) / kStepsPerContact;

  double dt = kRayleighShare * rayleigh;
  const char *why = "the Rayleigh time";
  const auto takes = [&](double other, const char *reason) {
    if (other >= dt) return;
    dt = other;
    why = reason;
  };
  const Pair pairs[] = {
      {"grain on grain", "the impact of grain on grain", own, mass / 2, least / 2, o.speed},
      {"grain on wall", "the impact on the wall", at_wall, mass, least, o.speed + o.wall_speed}};
  double deepest = 0;
  std::string rows;
  nlohmann::json impacts;
  for (const Pair &pair : pairs) {
    const HertzImpact impact = hertz_impact(pair.modulus, pair.mass, pair.radius, pair.speed);
    const double overlap = impact.overlap / least, allowed = impact.time / kStepsPerImpact;
    takes(allowed, pair.reason);
    deepest = std::max(deepest, overlap);
    char row[128];
    std::snprintf(row, sizeof row, "%-18s %-10.4g %-14.4g %-20.3g %.4g\n", pair.name, pair.speed,
                  impact.time, overlap, allowed);
    rows += row;
    impacts.push_back({{"of", pair.name},
                       {"speed", pair.speed},
                       {"time", impact.time},
                       {"overlap_per_radius", overlap},
                       {"timestep", allowed}});
  }
  takes(warned, "the limit of the fix");
  const double way = (o.speed + o.wall_speed) * dt / least, kn_own = own * 4 / 3,
               kn_wall = at_wall * 4 / 3;
  if (o.json) {
    const nlohmann::json all = {{"smallest_radius", least},
                                {"rayleigh_time", rayleigh},
                                {"impacts", impacts},
                                {"fix_warns_above", warned},
                                {"timestep", dt},
                                {"set_by", why},
                                {"way_per_radius", way},
                                {"hertz_kn", {{"grains", kn_own}, {"wall", kn_wall}}},
                                {"too_soft", deepest > kDeep}};
    print_json(stdout, all);
    return;
  }
  std::printf("smallest radius    %.6g\n", least);
  std::printf("Rayleigh time      %.4g    %g of it: %.4g\n", rayleigh, kRayleighShare,
              kRayleighShare * rayleigh);
  std::printf(
      "impact             speed      time           overlap per radius   1/%g of the time\n%s",
      kStepsPerImpact, rows.c_str());
  std::printf(
      "the fix warns      above %.4g, a tenth of a contact with the wall at an overlap of 1 %%\n",
      warned);
  std::printf("\ntimestep           %.3g    set by %s\n", dt, why);
  std::printf("way in a step      %.3g of the radius\n", way);
  std::printf("hertz/history      kn %.6g on grains, %.6g on the wall (4/3 of E*)\n", kn_own,
              kn_wall);
  if (deepest > kDeep)
    std::printf("Overlaps exceed %g of the radius: a stiffer material is needed at this speed.\n",
                kDeep);
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
