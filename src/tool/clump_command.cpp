// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "base/number_words.h"
#include "clump/atom_masses.h"
#include "clump/fill_mesh.h"
#include "clump/molecule_file.h"
#include "clump/principal_frame.h"
#include "clump/sphere_union.h"
#include "clump/surface_gap.h"
#include "tool/ball_reader.h"
#include "tool/load_mesh.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"
#include "tool/output_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsdcd {

namespace {

struct ClumpOptions {
  std::string mesh, list, output;
  PlacementOptions place;
  std::size_t spheres = 0;    // 0: not given
  double least_radius = 0, stick_out = 0, density = 1, weld = -1;
  int type = 1;
  bool principal = false, json = false;
};

// What the mesh has, for which a clump stands.
struct MeshFacts {
  MassProperties properties;
  Principal principal;
  SurfaceGap gap;
};

// All that the command prints.
struct ClumpAnswer {
  std::vector<Ball> balls;
  std::size_t covered = 0;    // spheres of a list that lie within others
  SphereUnion all;
  Principal principal, of_atoms;
  AtomMasses atoms;
  Real radius = 0;    // around it, from the centre of mass
  std::optional<MeshFacts> mesh;
};

Real percent(Real is, Real wanted)
{
  return 100 * (is / wanted - 1);
}

void check_volume(const WeldedMesh &mesh)
{
  if (mesh.report.oriented) return;
  std::string why = why_no_inside(mesh);
  if (!why.empty()) throw InputError(mesh.source + ": no clump fills it: " + why);
  for (const std::string &problem : problems_of(mesh.report))
    why += (why.empty() ? "" : ", ") + problem;
  throw InputError(
      mesh.source + ": no clump fills it, as it bounds no volume: " + why +
      "; mend it by lsdcd repair, and unite parts that overlap where you make the mesh");
}

// Throws what wrong words of the command throw.
void check(const ClumpOptions &o)
{
  if (o.mesh.empty() && o.list.empty())
    throw_usage_error("mesh", "give a mesh and --spheres, or --list, a file of spheres");
  if (o.list.empty() && o.spheres == 0)
    throw_usage_error("--spheres", "is required: how many spheres may fill the mesh?");
  if (o.output.empty() && (o.principal || o.type != 1))
    throw_usage_error(o.principal ? "--principal" : "--type",
                      "is of the molecule file: give --output, too");
  if (!(o.stick_out < 1)) throw_usage_error("--stick-out", "give a share of the radius below 1");
  if (o.list.empty()) return;
  if (!o.place.matrix.empty())
    throw_usage_error("--matrix", "places no list of spheres: place the mesh by lsdcd convert");
  if (o.place.scale.size() > 1 || (o.place.scale.size() == 1 && !(o.place.scale[0] > 0)))
    throw_usage_error("--scale", "of a list of spheres is one factor above 0");
  if (o.least_radius > 0 || o.stick_out > 0)
    throw_usage_error(o.least_radius > 0 ? "--least-radius" : "--stick-out",
                      "is for filling a mesh; a list is taken as it is");
}

ClumpAnswer answer_of(const ClumpOptions &o)
{
  ClumpAnswer a;
  if (!o.list.empty()) {
    a.balls = read_balls(o.list, o.place.scale.empty() ? 1 : o.place.scale[0]);
    a.covered = remove_covered(a.balls);
  }
  std::optional<WeldedMesh> mesh;
  std::optional<InsideMesh> inside;
  if (!o.mesh.empty()) {
    mesh = load_wall(o.mesh, o.place, o.weld);
    check_volume(*mesh);
    inside.emplace(*mesh);
  }
  if (o.list.empty()) {
    a.balls = fill_mesh(*inside, {o.spheres, o.least_radius, o.stick_out});
    if (a.balls.empty())
      throw InputError(o.mesh + ": no sphere" +
                       (o.least_radius > 0
                            ? " of a radius of " + number_text(o.least_radius) +
                                  " is inside; give a smaller --least-radius"
                            : " that can be measured is inside; is it as thin as a sheet?"));
    remove_covered(a.balls);
  }
  a.all = union_of(a.balls, o.density);
  check_mass_properties(a.all.properties, o.list.empty() ? o.mesh : o.list);
  a.principal = principal_of(a.all.properties.inertia);
  a.radius = radius_around(a.balls, a.all.properties.centre);
  a.atoms = atom_masses(a.balls, a.all.properties);
  a.of_atoms = principal_of(a.atoms.sums.inertia);
  if (inside) {
    MeshFacts facts;
    facts.properties = mass_properties(*mesh, o.density);
    facts.principal = principal_of(facts.properties.inertia);
    facts.gap = surface_gap(*inside, a.balls);
    a.mesh = facts;
  }
  return a;
}

// How far the inertia that the atoms sum to is from the union's: the greatest difference of an element, over the largest moment.
Real atoms_off(const ClumpAnswer &a)
{
  const SymmetricMatrix &i = a.all.properties.inertia, &sum = a.atoms.sums.inertia;
  Real most = 0;
  for (const Real d :
       {sum.xx - i.xx, sum.yy - i.yy, sum.zz - i.zz, sum.xy - i.xy, sum.xz - i.xz, sum.yz - i.yz})
    most = std::fmax(most, std::fabs(d));
  return most / a.principal.moment[2];
}

constexpr Real kExact =
    1e-9;    // what masses of atoms are off at most where they can have the inertia

nlohmann::json as_json(const MassProperties &p, const Principal &principal, double density)
{
  const SymmetricMatrix &i = p.inertia;
  return {{"volume", p.mass / density},
          {"mass", p.mass},
          {"centre", as_json(p.centre)},
          {"inertia", {i.xx, i.yy, i.zz, i.xy, i.xz, i.yz}},
          {"principal_moments", principal.moment},
          {"principal_axes",
           {as_json(principal.axis[0]), as_json(principal.axis[1]), as_json(principal.axis[2])}}};
}

nlohmann::json as_json(const ClumpOptions &o, const ClumpAnswer &a)
{
  nlohmann::json told = as_json(a.all.properties, a.principal, o.density);
  nlohmann::json spheres = nlohmann::json::array();
  for (const Ball &b : a.balls) spheres.push_back({b.centre.x, b.centre.y, b.centre.z, b.radius});
  told.update({{"spheres", a.balls.size()},
               {"covered", a.covered},
               {"density", o.density},
               {"list", spheres},
               {"radius", a.radius},
               {"error", a.all.error},
               {"masses", a.atoms.mass},
               {"inertia_of_masses_off", atoms_off(a)}});
  if (!o.output.empty()) told["output"] = o.output;
  if (!a.mesh) return told;
  const MeshFacts &m = *a.mesh;
  told["mesh"] = as_json(m.properties, m.principal, o.density);
  nlohmann::json moments;
  for (int k = 0; k < 3; k++)
    moments.push_back(percent(a.principal.moment[k], m.principal.moment[k]));
  told["difference"] = {{"volume_percent", percent(a.all.properties.mass, m.properties.mass)},
                        {"centre", norm(a.all.properties.centre - m.properties.centre)},
                        {"principal_moments_percent", moments},
                        {"uncovered", m.gap.uncovered},
                        {"uncovered_at_most", m.gap.uncovered + m.gap.apart},
                        {"stick_out", m.gap.stick_out}};
  return told;
}

// Numbers that are rounding, beside a length or a moment of this scale, are 0.
std::string text_of(std::initializer_list<Real> numbers, Real scale)
{
  std::string text;
  for (const Real x : numbers)
    text += (text.empty() ? "" : " ") + number_text(std::fabs(x) < 1e-12 * scale ? 0 : x);
  return text;
}

std::string text_of(const Vec3 &v, Real scale)
{
  return text_of({v.x, v.y, v.z}, scale);
}

// Differences in percent of three moments.
std::string percents(const Real (&is)[3], const Real (&wanted)[3])
{
  char text[96];
  std::snprintf(text, sizeof text, "%+.3g %+.3g %+.3g %%", percent(is[0], wanted[0]),
                percent(is[1], wanted[1]), percent(is[2], wanted[2]));
  return text;
}

void print_beside(const MeshFacts &m, const ClumpAnswer &a, double density)
{
  const MassProperties &is = a.all.properties, &wanted = m.properties;
  std::printf("\nthe mesh           and how far the clump is from it\n");
  std::printf("  volume           %.9g    %+.3g %%\n", wanted.mass / density,
              percent(is.mass, wanted.mass));
  std::printf("  centre of mass   %s    %.3g away\n", text_of(wanted.centre, a.radius).c_str(),
              norm(is.centre - wanted.centre));
  std::printf(
      "  moments          %s    %s\n",
      text_of({m.principal.moment[0], m.principal.moment[1], m.principal.moment[2]}, 0).c_str(),
      percents(a.principal.moment, m.principal.moment).c_str());
  std::printf(
      "  surface          up to %.3g outside the clump, to %.3g; spheres stick out by up to %.3g\n",
      m.gap.uncovered, m.gap.apart, m.gap.stick_out);
}

void print(const ClumpOptions &o, const ClumpAnswer &a)
{
  const MassProperties &p = a.all.properties;
  const Principal &principal = a.principal;
  const auto [least, most] =
      std::minmax_element(a.balls.begin(), a.balls.end(),
                          [](const Ball &b, const Ball &c) { return b.radius < c.radius; });
  std::printf("spheres            %zu, radii %.6g to %.6g\n", a.balls.size(), least->radius,
              most->radius);
  if (a.covered > 0)
    std::printf("left out           %s of the list, within others\n",
                counted(static_cast<std::int64_t>(a.covered), "sphere").c_str());
  std::printf("volume             %.9g    of the union, to %.0e of it\n", p.mass / o.density,
              std::fmax(a.all.error, 1e-15));
  std::printf("mass               %.9g    at a density of %g\n", p.mass, o.density);
  std::printf("centre of mass     %s\n", text_of(p.centre, a.radius).c_str());
  std::printf(
      "inertia            %s    xx yy zz xy xz yz, about it\n",
      text_of({p.inertia.xx, p.inertia.yy, p.inertia.zz, p.inertia.xy, p.inertia.xz, p.inertia.yz},
              principal.moment[2])
          .c_str());
  for (int k = 0; k < 3; k++)
    std::printf("%s %.9g    along %s\n", k == 0 ? "principal moments " : "                  ",
                principal.moment[k], text_of(principal.axis[k], 1).c_str());
  std::printf("radius             %.6g    of the sphere around it about its centre of mass\n",
              a.radius);
  std::printf("masses of spheres  sum to its mass and centre, %s\n",
              atoms_off(a) < kExact ? "and to its inertia"
                                    : ("and to its principal moments " +
                                       percents(a.of_atoms.moment, principal.moment))
                                          .c_str());
  if (a.mesh) print_beside(*a.mesh, a, o.density);
  if (o.output.empty()) return;
  std::printf("\n%s: a molecule of %s\n", o.output.c_str(),
              counted(static_cast<std::int64_t>(a.balls.size()), "sphere").c_str());
}

void run(const ClumpOptions &o)
{
  check(o);
  check_outputs({{"--output", o.output}}, {o.mesh, o.list});
  const ClumpAnswer answer = answer_of(o);
  std::vector<Ball> balls = answer.balls;
  MassProperties clump = answer.all.properties;
  if (o.principal) place_in_principal_frame(answer.principal, balls, clump);
  if (!o.output.empty())
    write_whole_file(
        o.output,
        molecule_text(balls, answer.atoms.mass, clump, o.type,
                      "a clump of " +
                          counted(static_cast<std::int64_t>(answer.balls.size()), "sphere") +
                          " at a density of " + number_text(o.density) +
                          ", made by lsdcd clump; mass, com and inertia count overlaps once"));
  if (o.json)
    print_json(stdout, as_json(o, answer));
  else
    print(o, answer);
}

}    // namespace

void add_clump_command(Command &program)
{
  const auto o = std::make_shared<ClumpOptions>();
  Command command = program.command(
      "clump", "fills a mesh with overlapping spheres: a molecule file with mass and inertia");
  command.footer(
      "Mass, centre and inertia are those of the union of the spheres, which counts overlaps "
      "once.\n"
      "Of the largest spheres in the mesh that touch points all over its surface (Ferellec and\n"
      "McDowell 2010) it takes the one that adds most volume, then the next one, and so on. With "
      "a\n"
      "mesh it prints how far volume, moments and surface of the clump are from the mesh's: more\n"
      "spheres are nearer, and take more time in each step.\n"
      "The molecule file is for create_atoms, fix deposit, fix pour and fix rigid/small. The "
      "masses\n"
      "of its atoms sum to the mass of the clump, and are chosen to have its centre and inertia.\n"
      "Units are those of the script: scale a mesh in millimetres by 0.001, and give its "
      "density.\n\n"
      "Example:\n"
      "  lsdcd clump wall.stl --spheres 20 --density 2500 -o grain.mol");
  command.option("mesh", o->mesh, "mesh to fill, closed: .stl, .obj, .ply or .off");
  Option spheres =
      command.option("--spheres", o->spheres, "how many spheres may fill the mesh, at most")
          .range(std::size_t(1), std::size_t(100000));
  command
      .option("--list", o->list,
              "file of spheres instead, a line x y z radius each; with a mesh it is compared")
      .excludes(spheres);
  command.option("-o,--output", o->output, "molecule file to write");
  command.option("--type", o->type, "atom type of the spheres in the file")
      .range(1, 2147483647)
      .shows_default();
  command.flag(
      "--principal", o->principal,
      "in the file the origin is the centre of mass, and x, y and z are the principal axes, "
      "the smallest moment first");
  command.option("--density", o->density, "density").check(above_zero).shows_default();
  command.option("--least-radius", o->least_radius, "least radius of a sphere that fills the mesh")
      .check(above_zero);
  command
      .option("--stick-out", o->stick_out,
              "share of its radius by which a sphere may leave the mesh, below 1 (default: 0)")
      .check(not_below_zero);
  add_placement_options(command, o->place, "mesh");
  add_weld_option(command, o->weld);
  command.flag("--json", o->json, "print JSON");
  command.runs([o] { run(*o); });
}

}    // namespace lsdcd
