// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/output_row.h"

#include <sstream>

namespace lsdcd {

std::string output_name(const OutputRow &row, int d)
{
  std::istringstream components(row.components);
  std::string component;
  for (int k = 0; k <= d; k++) components >> component;
  return component.empty() ? row.name : row.name + ("_" + component);
}

std::vector<NamedElement> named_elements(const std::vector<OutputRow> &rows, bool with_scalar)
{
  std::vector<NamedElement> all;
  for (const OutputRow &row : rows)
    for (int d = 0; d < row.n; d++)
      all.push_back({output_name(row, d), static_cast<int>(all.size())});
  if (with_scalar) all.back().column = NamedElement::kScalar;
  return all;
}

int n_elements(const std::vector<OutputRow> &rows)
{
  int n = 0;
  for (const OutputRow &row : rows) n += row.n;
  return n;
}

const std::vector<OutputRow> &massflow_outputs()
{
  static const std::vector<OutputRow> all = {
      {1, "forward", "", "number of atoms that passed forward", ""},
      {1, "forward_mass", "", "their mass", "mass"},
      {1, "backward", "", "number of atoms that passed backward", ""},
      {1, "backward_mass", "", "their mass", "mass"},
      {1, "net_mass", "", "mass forward less mass backward", "mass"},
      {1, "mass_rate", "",
       "net mass per time, averaged over the last full window of *every* steps; 0 before the first "
       "window is full",
       "mass/time"},
      {1, "deleted", "", "number of atoms deleted", ""},
      {1, "deleted_mass", "", "their mass", "mass"}};
  return all;
}

const std::vector<OutputRow> &massflow_outputs_by_type()
{
  static const std::vector<OutputRow> all(massflow_outputs().begin(),
                                          massflow_outputs().begin() + 4);
  return all;
}

const std::vector<OutputRow> &insertion_outputs()
{
  static const std::vector<OutputRow> all = {
      {1, "inserted", "", "number of grains inserted", ""},
      {1, "inserted_mass", "", "their mass", "mass"},
      {1, "late", "", "number of grains that are due and have no place yet", ""},
      {1, "late_mass", "", "their mass", "mass"},
      {3, "refused", "grain wall outside",
       "places that were refused because a grain was there, because a wall was there, or because "
       "they lay outside of the region or mesh",
       ""}};
  return all;
}

const std::vector<OutputRow> &energy_outputs()
{
  static const std::vector<OutputRow> all = {
      {5, "dissipated_power", kCauseNames,
       "power that contacts between grains dissipate in the step: damping, slider, rolling, "
       "twisting, adhesion",
       "energy/time"},
      {5, "dissipated", kCauseNames,
       "energy that contacts between grains have dissipated since the beginning: damping, slider, "
       "rolling, twisting, adhesion",
       "energy"},
      {4, "lost", kOtherLossNames,
       "energy that is lost by lever arms, stiffness, turned springs, and with contacts that are "
       "inserted and deleted",
       "energy"},
      {1, "contact_work", "", "work of grains on their contacts", "energy"},
      {1, "held_energy", "", "elastic energy of contacts", "energy"},
      {1, "remainder", "", "the remainder: work that contacts do not hold and no row has",
       "energy"},
      {1, "kinetic_energy", "", "kinetic energy of grains, with that of their rotation", "energy"},
      {1, "gravity_energy", "", "potential energy by fix gravity", "energy"},
      {1, "all_held_energy", "", "elastic energy of all contacts, those with walls included",
       "energy"},
      {1, "all_lost", "", "all that is lost: elements 6-14 and 24, and the same of walls",
       "energy"},
      {1, "drive_work", "", "work of the moving meshes and their surfaces on the grains", "energy"},
      {1, "dissipated_power_plastic", "",
       "power that contacts between grains dissipate by yielding", "energy/time"},
      {1, "dissipated_plastic", "",
       "energy that contacts between grains have dissipated since the beginning by yielding",
       "energy"},
      {1, "balance", "",
       "the scalar: 18 + 19 + 20 + 21 less 22, which keeps its value but for the remainders",
       "energy"}};
  return all;
}

const std::vector<OutputRow> &impact_outputs()
{
  static const std::vector<OutputRow> all = {
      {1, "impacts", "", "number of impacts since the beginning", ""},
      {1, "impact_energy", "",
       "their energy, the sum of m v^2/2 with the reduced mass and the speed along the normal",
       "energy"}};
  return all;
}

const std::vector<OutputRow> &impact_outputs_by_types()
{
  static const std::vector<OutputRow> all = {
      {1, "type_i", "", "the lower one of the two types", ""},
      {1, "type_j", "", "the other one", ""},
      {1, "impacts", "", "number of impacts between grains of these types", ""},
      {1, "impact_energy", "", "their energy", "energy"},
      {1, "energy_i", "", "the share of it that grains of type_i take", "energy"},
      {1, "energy_j", "", "the share of those of type_j", "energy"}};
  return all;
}

const std::vector<OutputRow> &collide_outputs()
{
  static const std::vector<OutputRow> all = {
      {1, "pairs", "", "number of pairs, of all bodies", ""},
      {1, "bodies", "", "number of bodies", ""},
      {1, "uncertified", "",
       "number of pieces of bodies for which pairs may be missing; 0 unless you use *nearest* N",
       ""},
      {1, "meeting_bodies", "", "the scalar: number of bodies that meet the wall", ""}};
  return all;
}

const std::vector<OutputRow> &collide_outputs_by_body()
{
  static const std::vector<OutputRow> all = {
      {1, "molecule", "", "molecule ID, 0 with *bodies one*", ""},
      {1, "pairs", "", "number of pairs of this body", ""}};
  return all;
}

std::vector<OutputRow> contact_outputs(bool heat)
{
  std::vector<OutputRow> all = {
      {1, "contacts", "", "number of contacts that carry a force", ""},
      {3, "force", "x y z", "force on the atom, x y z", "force"},
      {3, "point", "x y z", "contact point, x y z, the mean weighted by normal forces", "distance"},
      {1, "radius", "", "radius of the atom, of an ellipsoid that of the sphere around it",
       "distance"}};
  if (heat) all.push_back({1, "heat", "", "with *heat*: heat that flows into the atom", "power"});
  return all;
}

std::vector<OutputRow> each_contact_outputs(bool energy)
{
  std::vector<OutputRow> all = {
      {1, "atom", "", "ID of the atom", ""},
      {1, "mesh", "", "number of the mesh, from 1", ""},
      {3, "force", "x y z", "force on the atom, x y z", "force"},
      {3, "point", "x y z",
       "contact point, x y z: the point of the mesh that is closest to the atom there, or deepest "
       "in an ellipsoid",
       "distance"},
      {1, "overlap", "", "overlap", "distance"}};
  if (energy)
    all.insert(
        all.end(),
        {{5, "dissipated_power", kCauseNames,
          "with *energy*: power that the contact dissipates by damping, slider, rolling, twisting, "
          "adhesion",
          "power"},
         {5, "dissipated", kCauseNames, "energy that it has dissipated since it began, likewise",
          "energy"},
         {1, "has_ended", "", "1 in the step in which it has ended, else 0", ""}});
  return all;
}

}    // namespace lsdcd
