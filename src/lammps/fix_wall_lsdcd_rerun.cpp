// A snapshot of the command rerun: forces of one step, with no steps before it.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"

#include "atom.h"
#include "update.h"

using namespace LAMMPS_NS;

// What follows from the time alone is right in a snapshot; what is added up from step to step is
// not known there.
void FixWallLsdcd::begin_snapshot()
{
  for (const MeshPart &m : parts) check_snapshot(m);
  springs_to_host();
  for (int i = 0; history && i < atom->nlocal; i++) springs.clear(i);
  if (rerun_told) return;
  rerun_told = true;
  if (history)
    warn("a rerun does not know the springs of contacts, which no dump has: friction, rolling, "
         "twisting and adhesion past touch begin at 0 in each snapshot");
  if (settings.has_loads())
    warn("a rerun has no steps over which loads and wear add up: no wear is counted and no "
         "mesh_fields are written");
}

void FixWallLsdcd::check_snapshot(const MeshPart &m) const
{
  if (m.servo().present && !m.servo().holds)
    refuse(of(m, "in a rerun a servo is not where it was, as it follows from the loads of all "
                 "steps before: leave servo out, and give its places by motion variable"));
  if (m.takes_differences())
    refuse(of(m, "in a rerun there is no step over which the velocity of motion variable could be "
                 "a difference: give v_vx v_vy v_vz in place of NULL"));
  StepClock at = m.clock;
  at.jump_to(*update);
  if (m.settings.motion.moves() && at.now() < 0)
    refuse(of(
        m,
        "in a rerun the snapshot of step " + std::to_string(update->ntimestep) +
            " is before step " + std::to_string(m.clock.base_step) +
            ", in which the motion of the mesh begins: before the fix is defined, reset_timestep "
            "to the step in which the run that was dumped defined it"));
}
