// What the fix shows: totals, per-atom contacts, memory, and its picture.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"
#include "comm.h"
#include "memory.h"

#include <algorithm>

using namespace LAMMPS_NS;

// One round of messages per step, and only in steps that ask.
void FixWallLsdcd::reduce_totals()
{
  if (reduced) return;
  constexpr int kSums = 10;
  std::vector<double> sum, most;
  for (const MeshPart &m : parts) {
    lsdcd::WallTotals t;
    if (cutoff() > 0) t = several() ? engine->mesh_totals(m.index) : engine->totals();
    sum.insert(sum.end(), {t.force.x, t.force.y, t.force.z, t.torque.x, t.torque.y, t.torque.z,
                           static_cast<double>(t.contacts), 0.0, static_cast<double>(t.uncertified),
                           t.energy});
    most.push_back(t.largest_overlap_ratio);
  }
  const int n = static_cast<int>(parts.size());
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), kSums * n, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, most.data(), n, MPI_DOUBLE, MPI_MAX, world);
  for (MeshPart &m : parts) {
    const double *mine = sum.data() + kSums * m.index;
    std::copy(mine, mine + kTotals, m.totals);
    m.energy = mine[kTotals];
    m.totals[7] = most[m.index];
    m.finish_totals();
  }
  reduced = true;
}

// Where the wall does not act, as in a minimization, those of the last step would be added to its
// energy and pressure.
void FixWallLsdcd::clear_outputs()
{
  std::fill(virial, virial + 6, 0.0);
  for (MeshPart &m : parts) {
    std::fill(m.totals, m.totals + kTotals, 0.0);
    m.torque_at_origin = {0, 0, 0};
    m.power = m.energy = 0;
  }
  reduced = true;
  for (int i = 0; settings.contacts && i < atom->nlocal; i++)
    std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
}

double FixWallLsdcd::compute_scalar()
{
  reduce_totals();
  double all = parts.front().energy;
  for (std::size_t k = 1; k < parts.size(); k++) all += parts[k].energy;
  return all;
}

// Of one mesh. Collective.
double FixWallLsdcd::output_of(MeshPart &m, int i)
{
  reduce_totals();
  if (i < kTotals) return m.totals[i];
  if (i == kTotals + 1) return m.power;
  if (i >= kVector) return m.servo().present ? servo_output(m, i - kVector) : 0;
  return settings.wears() ? loads->worn(m.index) : 0;
}

double FixWallLsdcd::compute_array(int mesh, int i)
{
  return output_of(parts[mesh], i);
}

bool FixWallLsdcd::torques_share_a_point() const
{
  const lsdcd::MeshSettings &first = parts.front().settings;
  for (const MeshPart &m : parts)
    if (several() &&
        (m.settings.torque_about_mesh || !(m.settings.torque_about == first.torque_about)))
      return false;
  return true;
}

// Sums over the meshes; the largest overlap of all; and of the one servo, if there is one.
double FixWallLsdcd::compute_vector(int i)
{
  if (i >= kVector) {
    MeshPart *with_servo = only_servo();
    return with_servo ? output_of(*with_servo, i) : 0;
  }
  const bool at_origin = i >= 3 && i < 6 && !torques_share_a_point();
  double all = 0;
  for (MeshPart &m : parts) {
    double one = output_of(m, i);
    if (at_origin) one = m.torque_at_origin[i - 3];
    all = m.index == 0 ? one : i == 7 ? std::max(all, one) : all + one;
  }
  return all;
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
