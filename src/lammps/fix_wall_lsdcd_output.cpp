// What the fix shows: totals, per-atom contacts, memory, and its picture.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"
#include "comm.h"
#include "memory.h"

#include <algorithm>

using namespace LAMMPS_NS;

// Of the sums about the origin: torque about what `torque_about` names, and power.
void FixWallLsdcd::finish_totals()
{
  const lsdcd::Vec3 force = {totals[0], totals[1], totals[2]},
                    torque = {totals[3], totals[4], totals[5]};
  const lsdcd::Vec3 point =
      settings.torque_about_mesh ? pose.to_box(settings.torque_about) : settings.torque_about;
  const lsdcd::Vec3 about = torque - cross(point, force);
  torque_at_origin = torque;
  for (int d = 0; d < 3; d++) totals[3 + d] = about[d];
  // From 0, so that it is not -0 at rest.
  power = 0 - dot(force, pose.velocity) - dot(torque - cross(pose.shift, force), pose.angular);
}

// One round of messages per step, and only in steps that ask.
void FixWallLsdcd::reduce_totals()
{
  if (reduced) return;
  const lsdcd::WallTotals t = wall->cutoff() > 0 ? engine->totals() : lsdcd::WallTotals();
  const double mine[10] = {t.force.x,
                           t.force.y,
                           t.force.z,
                           t.torque.x,
                           t.torque.y,
                           t.torque.z,
                           static_cast<double>(t.contacts),
                           0.0,
                           static_cast<double>(t.uncertified),
                           t.energy};
  double sum[10];
  MPI_Allreduce(mine, sum, 10, MPI_DOUBLE, MPI_SUM, world);
  std::copy(sum, sum + 9, totals);
  energy = sum[9];
  MPI_Allreduce(&t.largest_overlap_ratio, &totals[7], 1, MPI_DOUBLE, MPI_MAX, world);
  finish_totals();
  reduced = true;
}

double FixWallLsdcd::compute_scalar()
{
  reduce_totals();
  return energy;
}

double FixWallLsdcd::compute_vector(int i)
{
  reduce_totals();
  if (i < kTotals) return totals[i];
  if (i == kTotals + 1) return power;
  if (i >= kVector) return servo_output(i - kVector);
  if (!settings.wears()) return 0;
  double worn = loads.worn();
  MPI_Allreduce(MPI_IN_PLACE, &worn, 1, MPI_DOUBLE, MPI_SUM, world);
  return worn;
}

void FixWallLsdcd::fill_contacts()
{
  for (int i = 0; i < atom->nlocal; i++)
    std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
  if (wall->cutoff() == 0) return;
  const int *touching = engine->touching();
  const lsdcd::SphereOutput *out = engine->sphere_output();
  for (int k = 0; k < engine->n_touching(); k++) {
    const lsdcd::SphereOutput &o = out[k];
    const double row[8] = {o.contacts, o.force.x, o.force.y, o.force.z,
                           o.point.x,  o.point.y, o.point.z, o.radius};
    std::copy(row, row + 8, array_atom[touching[k]]);
    if (settings.law.has_heat()) array_atom[touching[k]][8] = engine->sphere_heat()[k];
  }
}

double FixWallLsdcd::memory_usage()
{
  double bytes = engine->bytes() + wall->bytes() + mass_seen.capacity() * sizeof(double);
  if (history) bytes += springs.bytes();
  if (records) bytes += loads.bytes();
  if (settings.contacts) bytes += (double) atom->nmax * size_peratom_cols * sizeof(double);
  return bytes;
}

// dump image: each object is its kind and {atom type, corners}. Processes merge
// their pictures, so one of them draws.
int FixWallLsdcd::image(int *&kinds, double **&rows)
{
#if LSDCD_HOST_VERSION >= 20251001
  constexpr int kLine = 2, kTriangle = 3;    // Graphics::LINE, Graphics::TRI
#else
  constexpr int kLine = 1, kTriangle = 2;
#endif
  constexpr int kRow = 10;
  const bool faces = settings.draw == lsdcd::Draw::faces, first = !drawn;
  if (comm->me == 0 && first) strokes = lsdcd::draw_mesh(*wall->mesh(), settings.draw);
  if (comm->me == 0 && (first || settings.motion.any())) {
    const int corners = faces ? 3 : 2;
    image_data.clear();
    image_rows.clear();
    for (lsdcd::Stroke s : strokes) {
      lsdcd::Vec3 centre = {0, 0, 0};
      for (lsdcd::Vec3 &c : s.corner) c = pose.to_box(c);
      for (int k = 0; k < corners; k++) centre += (1.0 / corners) * s.corner[k];
      if (settings.cut && dot(settings.cut_normal, centre) > settings.cut_offset) continue;
      image_data.push_back(settings.draw_type);
      for (const lsdcd::Vec3 &c : s.corner) image_data.insert(image_data.end(), {c.x, c.y, c.z});
    }
    drawn = true;
    image_kind.assign(image_data.size() / kRow, faces ? kTriangle : kLine);
    for (std::size_t i = 0; i < image_data.size(); i += kRow)
      image_rows.push_back(image_data.data() + i);
    // LAMMPS does not say which diameter the deck gives.
    if (!settings.brief && !faces && first)
      log(signed_text("dump image draws the mesh as " + std::to_string(image_kind.size()) +
                      " lines; where nothing is seen of it, their diameter is 0: write fix " +
                      std::string(id) + " type DIAMETER 0"));
  }
  kinds = image_kind.data();
  rows = image_rows.data();
  return static_cast<int>(image_kind.size());
}
