// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/lammps_host.h"

#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_box.h"

#include "domain.h"
#include "neighbor.h"


using namespace LAMMPS_NS;

LammpsHost::LammpsHost(FixWallLsdcd &fix) : MpiNodeHost(fix.world), fix(fix)
{
  names_.sphere = "atom";
  names_.wall = "this fix";
  names_.saved = "restart file";
  names_.margin = "skin";
  names_.units = "the input script's units";
  names_.replay = "rerun";
  names_.record = "dump";
  names_.unset_radius = 0.5;    // from when atoms are created
}

lsdcd::PeriodicBox LammpsHost::box() const
{
  lsdcd::PeriodicBox box = lsdcd::host_box(*fix.domain);
  box.margin = fix.neighbor->skin;
  return box;
}

std::string LammpsHost::remedy(lsdcd::Remedy problem) const
{
  using lsdcd::Remedy;
  switch (problem) {
    case Remedy::wrap_sooner:
      return "use neigh_modify delay 0 every 1 check yes";
    case Remedy::put_clear:
      return "keep what inserts or creates atoms a radius away from the mesh";
    case Remedy::stay_in_plane:
      return "fix enforce2d throws away what they push along z";
    case Remedy::give_radii:
      return "set diameter";
    case Remedy::give_other_radii:
      return "write 'set group all diameter D'";
    case Remedy::set_radii:
      return "write 'set group all diameter D': atoms have radius 0.5 until a diameter is set";
    case Remedy::follow_spheres:
      return "its boundary shrink-wrapped";
    case Remedy::make_room:
      return "give a smaller skin, so that they are selected more often, or continue from a "
             "restart file, which makes room for them";
    case Remedy::announce_growth:
      return "radii that something else than fix adapt changes in a run need 'neigh_modify delay 0 "
             "every 1 check no'";
    case Remedy::begin_motion:
      return "start another motion from where the mesh is by fix_modify motion";
    case Remedy::begin_servo:
      return "let it go on by fix_modify servo";
    case Remedy::give_velocities:
      return "give v_vx v_vy v_vz instead of NULL";
    case Remedy::give_displacements:
      return "give its variable instead of NULL";
    case Remedy::compute_on_host:
      return "use fix wall/lsdcd without the suffix /kk (suffix off), which computes on the CPU";
    case Remedy::begin_replay:
      return "before the fix is defined, reset_timestep to the step in which the run that was "
             "dumped defined it";
  }
  return "";
}

void LammpsHost::show(const std::string &text, bool is_warning)
{
  if (is_warning)
    fix.warn(text);
  else
    fix.log(text);
}
