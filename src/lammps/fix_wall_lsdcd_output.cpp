// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What the fix shows: totals, per-atom contacts, memory, and its picture.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"
#include "comm.h"
#include "memory.h"

#include <algorithm>

using namespace LAMMPS_NS;

// Collective.
void FixWallLsdcd::reduce_totals()
{
  std::vector<lsdcd::WallPose> poses;
  for (const MeshPart &m : parts) poses.push_back(m.motion.pose());
  totals->reduce(cutoff() > 0 ? engine.get() : nullptr, poses);
}

// Where the wall does not act, as in a minimization, those of the last step would be added to its
// energy and pressure.
void FixWallLsdcd::clear_outputs()
{
  std::fill(virial, virial + 6, 0.0);
  totals->clear();
  for (int i = 0; settings.contacts && i < atom->nlocal; i++)
    std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
}

double FixWallLsdcd::compute_scalar()
{
  reduce_totals();
  return totals->of_all().energy;
}

// In the columns of the vector.
static double column(const lsdcd::MeshTotals &t, int i)
{
  const double after_torque[] = {t.contacts, t.overlap, t.uncertified};
  return i < 3 ? t.force[i] : i < 6 ? t.torque[i - 3] : after_torque[i - 6];
}

// Of one mesh. Collective.
double FixWallLsdcd::output_of(MeshPart &m, int i)
{
  reduce_totals();
  const lsdcd::MeshTotals &t = totals->mesh(m.index);
  if (i < kTotals) return column(t, i);
  if (i == kWorn) return settings.wears() ? loads->worn(m.index) : 0;
  if (i == kPower) return t.power;
  return m.servo().present ? servo_output(m, i - kVector) : 0;
}

double FixWallLsdcd::compute_array(int mesh, int i)
{
  return output_of(parts[mesh], i);
}

// Of all meshes; and of the one servo, if there is one.
double FixWallLsdcd::compute_vector(int i)
{
  if (i >= kVector) {
    MeshPart *with_servo = only_servo();
    return with_servo ? output_of(*with_servo, i) : 0;
  }
  reduce_totals();
  const lsdcd::MeshTotals all = totals->of_all();
  if (i < kTotals) return column(all, i);
  if (i == kPower) return all.power;
  double worn = 0;
  for (MeshPart &m : parts) worn += output_of(m, i);
  return worn;
}

void FixWallLsdcd::fill_contacts()
{
  for (int i = 0; i < atom->nlocal; i++)
    std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
  if (cutoff() == 0) return;
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
  double bytes =
      engine->bytes() + loads->bytes() + history->bytes() + mass_seen.capacity() * sizeof(double);
  for (const MeshPart &m : parts) bytes += m.wall.bytes();
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
  if (comm->me == 0 && (first || any_moves())) {
    const int corners = faces ? 3 : 2;
    image_data.clear();
    image_rows.clear();
    for (MeshPart &m : parts) {
      if (first) m.strokes = lsdcd::draw_mesh(*m.wall.mesh(), settings.draw);
      for (lsdcd::ImageObject s : m.strokes) {
        lsdcd::Vec3 centre = {0, 0, 0};
        for (lsdcd::Vec3 &c : s.corner) c = m.motion.pose().to_box(c);
        for (int k = 0; k < corners; k++) centre += (1.0 / corners) * s.corner[k];
        if (settings.cut && dot(settings.cut_normal, centre) > settings.cut_offset) continue;
        image_data.push_back(settings.draw_type);
        for (const lsdcd::Vec3 &c : s.corner) image_data.insert(image_data.end(), {c.x, c.y, c.z});
      }
    }
    drawn = true;
    image_kind.assign(image_data.size() / kRow, faces ? kTriangle : kLine);
    for (std::size_t i = 0; i < image_data.size(); i += kRow)
      image_rows.push_back(image_data.data() + i);
    // LAMMPS does not say which diameter the deck gives.
    if (!settings.brief && !faces && first)
      log(with_fix_id("dump image draws the mesh as " + std::to_string(image_kind.size()) +
                      " lines; where nothing is seen of it, their diameter is 0: write fix " +
                      std::string(id) + " type DIAMETER 0"));
  }
  kinds = image_kind.data();
  rows = image_rows.data();
  return static_cast<int>(image_kind.size());
}
