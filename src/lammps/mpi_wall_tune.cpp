// One process tunes for all: times differ between processes, the wall must not.
#include "lammps/mpi_wall.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace lsdcd {

namespace {

// Everything of `mine` on rank 0, in the order of the processes; nothing elsewhere.
std::vector<TaggedSphere> gathered(const std::vector<TaggedSphere> &mine, MPI_Comm world)
{
  static_assert(std::is_trivially_copyable<TaggedSphere>::value, "sent as bytes");
  int rank, size;
  MPI_Comm_rank(world, &rank);
  MPI_Comm_size(world, &size);
  const int bytes = static_cast<int>(mine.size() * sizeof(TaggedSphere));
  std::vector<int> counts(size), starts(size, 0);
  MPI_Gather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  int total = 0;
  if (rank == 0)
    for (int i = 0; i < size; i++) {
      starts[i] = total;
      total += counts[i];
    }
  std::vector<TaggedSphere> all(total / sizeof(TaggedSphere));
  MPI_Gatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, 0,
              world);
  return all;
}

}    // namespace

void SharedWall::tune(Real cutoff, const PeriodicBox &box, const std::vector<TaggedSphere> &mine)
{
  int rank;
  MPI_Comm_rank(shared_.world(), &rank);
  std::vector<TaggedSphere> all = gathered(mine, shared_.world());
  GridChoice choice = {};
  together(shared_.world(), rank == 0, [&] {
    // The same order however the spheres are spread over processes.
    std::sort(all.begin(), all.end(),
              [](const TaggedSphere &a, const TaggedSphere &b) { return a.tag < b.tag; });
    TuneSettings want;
    want.bound = settings_.tune;
    want.grid = grid_settings(cutoff, box);
    want.engine.law = settings_.law;
    want.engine.corner = settings_.corner;
    want.engine.side = settings_.side;
    want.engine.precision = settings_.precision;
    want.engine.surface = of_mesh_.surface;
    want.engine.moves = settings_.moves();
    want.engine.records = settings_.has_loads();
    want.engine.device = settings_.device;
    want.keep_lists = settings_.nearest_given;
    want.keep_precision = settings_.precision_given;
    for (const TaggedSphere &s : all) want.scene.add(s.x, s.radius);
    const TuneReport report = lsdcd::tune(whole(cutoff, box), want);
    choice = report.choice();
    tune_text_ = describe(report);
  });
  static_assert(std::is_trivially_copyable<GridChoice>::value, "sent as bytes");
  MPI_Bcast(&choice, sizeof choice, MPI_BYTE, 0, shared_.world());
  settings_.grid_length = choice.length;
  settings_.nearest = choice.nearest;
  settings_.exact = choice.exact;
  settings_.precision = choice.precision;
}

void SharedWall::take_choice(const WallSettings &tuned)
{
  settings_.grid_length = tuned.grid_length;
  settings_.nearest = tuned.nearest;
  settings_.exact = tuned.exact;
  settings_.precision = tuned.precision;
}

}    // namespace lsdcd
