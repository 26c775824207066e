// Files that the fix writes every so many steps. One that cannot be written is warned of and the
// run goes on: it may be weeks old.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_error.h"
#include "base/whole_file.h"
#include "output/mesh_fields.h"
#include "output/mesh_stl.h"

#include "comm.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;

// Whether files can be made where they are wanted: told before a run, not hours into it.
void FixWallLsdcd::check_file(const MeshPart &m, const char *keyword,
                              const lsdcd::FileEvery &file) const
{
  if (file.every == 0) return;
  try {
    lsdcd::together(world, comm->me == 0,
                    [&] { lsdcd::WholeFile(lsdcd::file_of_step(file.name, update->ntimestep)); });
  } catch (const lsdcd::InputError &e) {
    refuse(of(m, "in '" + std::string(keyword) + "', " + e.what() +
                     "; make the folder, or name another"));
  }
}

// Where the first process cannot do this, what is lost is told once a run. Collective.
template <class Work>
bool FixWallLsdcd::try_to_write(const std::string &lost, const Work &work)
{
  try {
    lsdcd::together(world, comm->me == 0, work);
    return true;
  } catch (const lsdcd::InputError &e) {
    if (!file_warned)
      warn(std::string(e.what()) + ": " + lost +
           "; older files are as they were. Make room, or mend the path: the run goes on, tries "
           "again with the next file and tells of no other that cannot be written");
    file_warned = true;
    return false;
  }
}

// An average that could not be written goes on to the next file.
void FixWallLsdcd::write_fields(MeshPart &m)
{
  const std::string file = lsdcd::file_of_step(m.settings.fields.name, update->ntimestep);
  const double time = static_cast<double>(run_clock.now());
  const lsdcd::WallLoads all = gathered_loads(m);
  const auto write = [&] {
    lsdcd::write_mesh_fields(
        file, *m.wall.mesh(),
        lsdcd::load_fields(*m.wall.mesh(), all, force->nktv2p, settings.wears(), m.pose),
        update->ntimestep, time, m.pose);
  };
  if (!try_to_write("there are no mesh_fields of this step, and the next file averages over these "
                    "steps, too",
                    write))
    return;
  m.loads.begin_average();
  if (file == m.settings.fields.name) return;
  const auto list = [&] {
    if (!m.series) {
      m.series = std::make_unique<lsdcd::FileSeries>(m.settings.fields.name);
      if (continued) m.series->read();
    }
    m.series->add(update->ntimestep, time);
    m.series->write();
  };
  try_to_write("the list of mesh_fields lacks this step until it can be written", list);
}

void FixWallLsdcd::end_of_step()
{
  const auto due = [this](const lsdcd::FileEvery &file) {
    return file.every > 0 && update->ntimestep % file.every == 0;
  };
  for (MeshPart &m : parts) {
    if (due(m.settings.fields) && !rerun) write_fields(m);
    if (due(m.settings.stl))
      try_to_write("there is no mesh_stl of this step", [&] {
        lsdcd::write_mesh_stl(lsdcd::file_of_step(m.settings.stl.name, update->ntimestep),
                              *m.wall.mesh(), m.pose);
      });
  }
}
