// Warnings of atoms that are deep in the wall: those that sank in, and those that were put there.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"

#include "atom.h"
#include "comm.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using lsdcd::number_text;

// Of one atom, on whichever process it is; 0 where atoms have no IDs. Collective.
double FixWallLsdcd::radius_of(tagint tag)
{
  need_on_host();
  double radius = 0;
  for (int i = 0; atom->tag_enable && i < atom->nlocal; i++)
    if (atom->tag[i] == tag) radius = atom->radius[i];
  MPI_Allreduce(MPI_IN_PLACE, &radius, 1, MPI_DOUBLE, MPI_MAX, world);
  return radius;
}

// Collective.
std::string FixWallLsdcd::overlap_text(double overlap, tagint tag)
{
  const double radius = radius_of(tag);
  return number_text(100 * overlap) + " % of its radius" +
         (radius > 0 ? " " + number_text(radius) : "");
}

// A sphere whose centre is past the wall overlaps by more than its radius, with side in or out.
static const char *wrong_side_text()
{
  return "its centre is past the wall: is the side that side in or out names that of the spheres, "
         "or should it be both?";
}

void FixWallLsdcd::look()
{
  note_overlap(read_notes());
}

// The atom that sank deepest, for a warning. One that was put into the wall has not sunk, until it
// was out of it or is deeper again.
void FixWallLsdcd::note_overlap(const lsdcd::StepDiagnostics &seen)
{
  if (seen.deepest <= kLargeOverlap) placed_overlap = 0;
  if (overlap_warned || seen.deepest <= std::max(worst_overlap, kLargeOverlap)) return;
  const tagint tag = tag_of(seen.deepest_sphere);
  if (tag > placed_after && tag <= placed_until && seen.deepest <= kWorse * placed_overlap) {
    placed_overlap = std::min(placed_overlap, seen.deepest);
    return;
  }
  worst_overlap = seen.deepest;
  worst_step = update->ntimestep;
  worst_tag = tag;
}

// Collective where `worst` is the largest of all processes.
void FixWallLsdcd::check_overlap(double worst)
{
  if (overlap_warned || worst <= kLargeOverlap) return;
  overlap_warned = true;
  struct {
    double value;
    int rank;
  } most = {worst_overlap, comm->me};
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  bigint which[2] = {worst_tag, worst_step};
  MPI_Bcast(which, 2, MPI_LMP_BIGINT, most.rank, world);
  const std::string overlap = overlap_text(most.value, which[0]);
  warn("atom " + std::to_string(which[0]) + " sank into the wall by " + overlap + " by step " +
       std::to_string(which[1]) + ": " +
       (most.value > 1 ? wrong_side_text() : "stiffen the contact (kn) or lower speeds") +
       "; shown once");
}

// The deepest of atoms that came to be in the wall, in the step that they came with: what inserts
// atoms numbers them on from the highest that there is. Those of a run that goes on have sunk in.
// Collective.
void FixWallLsdcd::check_inserted()
{
  if (!may_be_new) return;
  may_be_new = false;
  const lsdcd::StepDiagnostics seen = read_notes();
  need_on_host();
  tagint highest = 0;
  for (int i = 0; i < atom->nlocal; i++) highest = std::max(highest, tag_on_host(i));
  const tagint mine = seen.deepest > kLargeOverlap ? tag_of(seen.deepest_sphere) : 0;
  const bool goes_on = highest_tag < 0 && (continued || update->ntimestep > 0);
  const bool is_new = mine > highest_tag && !goes_on;
  struct {
    double value;
    int rank;
  } most = {is_new ? seen.deepest : 0, comm->me};
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  MPI_Allreduce(MPI_IN_PLACE, &highest, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (!is_new) note_overlap(seen);
  if (most.value > kLargeOverlap) {
    if (placed_overlap == 0) placed_after = highest_tag;
    placed_until = highest;
    placed_overlap = std::max(placed_overlap, most.value);
  }
  highest_tag = std::max(highest_tag, highest);
  if (most.value <= worst_inserted) return;
  worst_inserted = kWorse * most.value;
  tagint which = mine;
  MPI_Bcast(&which, 1, MPI_LMP_TAGINT, most.rank, world);
  const std::string overlap = overlap_text(most.value, which);
  warn("atom " + std::to_string(which) + " comes to be in the wall, which it overlaps by " +
       overlap + " in step " + std::to_string(update->ntimestep) + ": " +
       (most.value > 1 ? wrong_side_text()
                       : "it will be thrown out; keep what inserts or creates atoms a radius away "
                         "from the mesh") +
       ". A deeper one is reported again");
}
