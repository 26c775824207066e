// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/lammps_host.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_box.h"

#include "atom.h"
#include "domain.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

LammpsHost::LammpsHost(FixWallLsdcd &fix) : MpiNodeHost(fix.world), fix(fix) {}

int LammpsHost::find_variable(const std::string &name) const
{
  Variable &all = *fix.input->variable;
  const int variable = all.find(name.c_str());
  if (variable < 0)
    throw lsdcd::InputError("there is no variable '" + name + "', which the wall reads");
  if (!all.equalstyle(variable))
    throw lsdcd::InputError("variable '" + name + "', which the wall reads, is not of style equal");
  return variable;
}

// Equal-style variables are the same on all processes. A variable's computes keep their values until
// they are cleared. Where one is no number nothing would touch the wall, or a servo would run away.
std::vector<double> LammpsHost::variables(const std::vector<std::string> &names)
{
  std::vector<double> values;
  if (names.empty()) return values;
  fix.modify->clearstep_compute();
  for (const std::string &name : names) {
    values.push_back(fix.input->variable->compute_equal(find_variable(name)));
    if (!std::isfinite(values.back()))
      throw lsdcd::InputError("variable '" + name + "', which the wall reads, is " +
                              lsdcd::number_text(values.back()) + " in step " +
                              std::to_string(fix.update->ntimestep) +
                              ": it must be a finite number in every step");
  }
  fix.modify->addstep_compute(fix.update->ntimestep + 1);
  return values;
}

void LammpsHost::check_variables(const std::vector<std::string> &names)
{
  for (const std::string &name : names) find_variable(name);
}

lsdcd::PeriodicBox LammpsHost::box() const
{
  lsdcd::PeriodicBox box = lsdcd::host_box(*fix.domain);
  box.margin = fix.neighbor->skin;
  return box;
}

lsdcd::SphereGroup LammpsHost::group() const
{
  return {fix.group->names[fix.igroup], fix.group->dynamic[fix.igroup] != 0};
}

lsdcd::Spheres LammpsHost::spheres_on_cpu()
{
  fix.need_on_host();
  return fix.spheres_in_atom();
}

std::int64_t LammpsHost::tag(int sphere)
{
  return fix.tag_of(sphere);
}

std::int64_t LammpsHost::highest_tag()
{
  fix.need_on_host();
  tagint highest = 0;
  const Atom &atom = *fix.atom;
  for (int i = 0; atom.tag_enable && i < atom.nlocal; i++) highest = std::max(highest, atom.tag[i]);
  return highest;
}

double LammpsHost::radius_of_tag(std::int64_t tag)
{
  fix.need_on_host();
  const Atom &atom = *fix.atom;
  double radius = 0;
  for (int i = 0; atom.tag_enable && i < atom.nlocal; i++)
    if (atom.tag[i] == tag) radius = atom.radius[i];
  return radius;
}

void LammpsHost::show(const std::string &text, bool is_warning)
{
  if (is_warning)
    fix.warn(text);
  else
    fix.log(text);
}
