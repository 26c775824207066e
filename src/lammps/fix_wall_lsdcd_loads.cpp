// What the fix adds up of a wall's loads and wear: of all processes, and in restart files.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"
#include "comm.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using lsdcd::WallLoads;

// Of restart data: kFormat, time of the run, how many numbers of the motion, these; then time of
// the average, facets, edges and vertices of the mesh, number of rows of loads, these.
static constexpr int kHeader = 5;
static constexpr double kFormat = -3;

// Of the last step; what setup computes has no duration.
void FixWallLsdcd::add_loads()
{
  if (update->setupflag) return;
  const bool any = wall->cutoff() > 0;
  loads.add(any ? engine->records() : nullptr, any ? engine->n_records() : 0, update->dt,
            settings.wear.per_work, any ? wall->view().wall : lsdcd::WallFeaturesView());
}

// Of all processes, on the first one; the others get none. Collective.
WallLoads FixWallLsdcd::gathered_loads() const
{
  const std::vector<double> mine = loads.packed();
  int n = static_cast<int>(mine.size());
  std::vector<int> count(comm->nprocs), first(comm->nprocs, 0);
  MPI_Gather(&n, 1, MPI_INT, count.data(), 1, MPI_INT, 0, world);
  for (int p = 1; p < comm->nprocs; p++) first[p] = first[p - 1] + count[p - 1];
  std::vector<double> rows(comm->me == 0 ? first.back() + count.back() : 0);
  MPI_Gatherv(mine.data(), n, MPI_DOUBLE, rows.data(), count.data(), first.data(), MPI_DOUBLE, 0,
              world);
  WallLoads all;
  all.set_time(loads.time());
  all.add_packed(rows.data(), rows.size() / WallLoads::kPackedLoad);
  return all;
}

void FixWallLsdcd::write_restart(FILE *file)
{
  const WallLoads all = gathered_loads();
  if (comm->me != 0) return;
  const lsdcd::MeshReport &r = wall->report();
  const std::vector<double> rows = all.packed();
  const std::vector<double> motion = motion_data();
  std::vector<double> data = {kFormat, double(run_clock.now()), double(motion.size())};
  data.insert(data.end(), motion.begin(), motion.end());
  data.insert(data.end(), {all.time(), double(r.facets), double(r.edges), double(r.vertices),
                           double(rows.size() / WallLoads::kPackedLoad)});
  data.insert(data.end(), rows.begin(), rows.end());
  const int bytes = static_cast<int>(data.size() * sizeof(double));
  fwrite(&bytes, sizeof bytes, 1, file);
  fwrite(data.data(), sizeof(double), data.size(), file);
}

// LAMMPS hands the same bytes to every process; the first one keeps them.
void FixWallLsdcd::restart(char *buffer)
{
  continued = true;
  double start[3];
  std::memcpy(start, buffer, sizeof start);
  if (start[0] != kFormat) {
    warn("motion, loads and wear begin anew: the restart file is of another version of this fix");
    return;
  }
  run_clock.base = start[1];
  std::vector<double> motion(static_cast<std::size_t>(start[2]));
  std::memcpy(motion.data(), buffer + sizeof start, motion.size() * sizeof(double));
  restart_motion(motion);
  buffer += sizeof start + motion.size() * sizeof(double);
  if (!records) return;
  double header[kHeader];
  std::memcpy(header, buffer, sizeof header);
  const lsdcd::MeshReport &r = wall->report();
  if (header[1] != double(r.facets) || header[2] != double(r.edges) ||
      header[3] != double(r.vertices)) {
    warn("loads and wear begin at zero: the restart file was written with another mesh");
    return;
  }
  loads.set_time(header[0]);
  if (comm->me != 0) return;
  std::vector<double> rows(static_cast<std::size_t>(header[4]) * WallLoads::kPackedLoad);
  std::memcpy(rows.data(), buffer + sizeof header, rows.size() * sizeof(double));
  loads.add_packed(rows.data(), rows.size() / WallLoads::kPackedLoad);
}
