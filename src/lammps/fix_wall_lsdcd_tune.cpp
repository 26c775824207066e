// The spheres that tune tries settings on.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"

#include <algorithm>
#include <cstdint>

using namespace LAMMPS_NS;

static constexpr double kSampled = 65536;    // spheres of the scene, over all processes

// A number from a tag that is spread evenly (the mixer of SplitMix64, Steele et al. 2014).
static std::uint64_t scattered(std::uint64_t tag)
{
  std::uint64_t z = tag * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

// On the mesh of most triangles, for all. Spheres are chosen by tag, so that the choice does not
// depend on how many processes there are.
void FixWallLsdcd::tune(double cutoff)
{
  need_on_host();
  MeshPart &m = *std::max_element(parts.begin(), parts.end(), [](const auto &a, const auto &b) {
    return a.wall.report().facets < b.wall.report().facets;
  });
  bigint mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++) mine += (atom->mask[i] & groupbit) != 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const double share = kSampled / all;
  std::vector<lsdcd::TaggedSphere> chosen;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const std::uint64_t tag = atom->tag ? atom->tag[i] : i;
    if (share < 1 && scattered(tag) >= share * 18446744073709551615.0) continue;
    const double *x = atom->x[i];
    chosen.push_back({tag, m.motion.pose().to_mesh({x[0], x[1], x[2]}), atom->radius[i]});
  }
  m.wall.tune(cutoff, m.box_seen(simulation_box()), chosen);
  const lsdcd::WallSettings &tuned = m.wall.settings();
  for (MeshPart &other : parts) other.wall.take_choice(tuned);
  settings.nearest = tuned.nearest;
  settings.exact = tuned.exact;
  settings.precision = tuned.precision;
  make_engine();
}
