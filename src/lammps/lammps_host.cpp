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
  names_.wrap_sooner = "use neigh_modify delay 0 every 1 check yes";
  names_.put_clear = "keep what inserts or creates atoms a radius away from the mesh";
  names_.stay_in_plane = "fix enforce2d throws away what they push along z";
  names_.give_radii = "set diameter, or shape of ellipsoids";
  names_.give_other_radii = "write 'set group all diameter D'";
  names_.set_radii =
      "write 'set group all diameter D': atoms have radius 0.5 until a diameter is set";
  names_.follow_spheres = "its boundary shrink-wrapped";
  names_.make_room =
      "give a smaller skin, so that they are selected more often, or continue from a "
      "restart file, which makes room for them";
  names_.announce_growth =
      "radii that something else than fix adapt changes in a run need 'neigh_modify delay 0 "
      "every 1 check no'";
  names_.begin_motion = "start another motion from where the mesh is by fix_modify motion";
  names_.begin_servo = "let it go on by fix_modify servo";
  names_.give_velocities = "give v_vx v_vy v_vz instead of NULL";
  names_.give_displacements = "give its variable instead of NULL";
  names_.compute_on_cpu = "use wall/lsdcd/kk/host";
  names_.begin_replay =
      "before the fix is defined, reset_timestep to the step in which the run that was "
      "dumped defined it";
}

lsdcd::PeriodicBox LammpsHost::box() const
{
  lsdcd::PeriodicBox box = lsdcd::host_box(*fix.domain);
  box.margin = fix.neighbor->skin;
  return box;
}

std::optional<double> LammpsHost::power_on_nodes(int mesh, const std::vector<double> &force)
{
  fix.need_nodes();
  for (NodeAtoms &nodes : fix.node_atoms)
    if (nodes.is_of(mesh)) return nodes.power(force);
  return {};
}

void LammpsHost::show(const std::string &text, bool is_warning)
{
  if (is_warning)
    fix.warn(text);
  else
    fix.log(text);
}
