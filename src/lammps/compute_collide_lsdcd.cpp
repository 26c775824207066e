// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/compute_collide_lsdcd.h"

#include "base/input_error.h"
#include "base/number_words.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_box.h"
#include "lammps/host_fixes.h"
#include "lammps/mpi_host.h"
#include "lammps/mpi_mesh.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using lsdcd::BodyPose;
using lsdcd::Vec3;

namespace {

constexpr double kRim = 1e-6;    // for rounding

BodyPose moved(BodyPose pose, const Vec3 &by)
{
  pose.shift += by;
  return pose;
}

// A pose in the box, as seen from a mesh.
BodyPose in_frame_of(const lsdcd::Pose &wall, const BodyPose &pose)
{
  BodyPose there;
  for (int d = 0; d < 3; d++) {
    const Vec3 column = wall.turn_to_mesh({pose.row[0][d], pose.row[1][d], pose.row[2][d]});
    for (int r = 0; r < 3; r++) there.row[r][d] = column[r];
  }
  there.shift = wall.to_mesh(pose.shift);
  return there;
}

}    // namespace

ComputeCollideLsdcd::ComputeCollideLsdcd(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), OwnMessages(lmp, "Compute", id, "lsdcd/collide"),
    variables(lmp, std::string("c_") + id)
{
  std::vector<std::string> names;    // with what follows the word, which comes last
  run_core([&] {
    std::vector<std::string> words = words_of(arg + 3, arg + narg);
    const auto begins = std::find(words.begin(), words.end(), "names");
    names.assign(begins, words.end());
    words.erase(begins, words.end());
    settings = lsdcd::parse_collide(words);
    lsdcd::MpiHost mpi(world);
    const lsdcd::WeldedMesh mesh = lsdcd::read_together(mpi, settings.mesh);
    if (mesh.faces.empty())
      throw lsdcd::InputError(
          settings.mesh.file +
          ": none of its triangles has an area; check the file, or make weld smaller");
    middle = 0.5 * (mesh.report.lo + mesh.report.hi);
    for (const Vec3 &x : mesh.vertices) reach = std::max(reach, norm(x - middle));
    find_bodies();
    make_collisions(mesh);
    log_mesh(mesh);
  });
  found.assign(bodies.size() + 1, 0.0);

  scalar_flag = vector_flag = array_flag = 1;
  extscalar = extvector = extarray = 0;
  size_vector = lsdcd::n_elements(lsdcd::collide_outputs()) - 1;
  size_array_rows = static_cast<int>(bodies.size());
  size_array_cols = lsdcd::n_elements(lsdcd::collide_outputs_by_body());
  vector = new double[size_vector];
  memory->create(array, size_array_rows, size_array_cols, "lsdcd/collide:array");
  run_core([&] {
    if (!names.empty())
      variables.make(names, lsdcd::named_elements(lsdcd::collide_outputs(), true));
  });
}

ComputeCollideLsdcd::~ComputeCollideLsdcd()
{
  delete[] vector;
  memory->destroy(array);
}

const FixWallLsdcd &ComputeCollideLsdcd::wall() const
{
  const Fix *fix = lsdcd::host_fix(*modify, settings.wall);
  if (!fix)
    fatal("there is no fix '" + settings.wall +
          "': give the ID of a fix wall/lsdcd, which is defined before the compute");
  const auto *wall = dynamic_cast<const FixWallLsdcd *>(fix);
  if (!wall)
    fatal("fix " + settings.wall + " is of style " + fix->style +
          "; give the ID of a fix wall/lsdcd");
  return *wall;
}

std::vector<lsdcd::RunFile> ComputeCollideLsdcd::files() const
{
  std::vector<lsdcd::RunFile> all = {{"mesh", settings.mesh.file}};
  if (!settings.atoms_file.empty()) all.push_back({"atoms", settings.atoms_file});
  return all;
}

bool ComputeCollideLsdcd::is_mine(int body) const
{
  return body % comm->nprocs == comm->me;
}
bool ComputeCollideLsdcd::has_any() const
{
  return comm->me < static_cast<int>(bodies.size());
}

// Only processes that have bodies keep grids.
void ComputeCollideLsdcd::make_collisions(const lsdcd::WeldedMesh &body)
{
  lsdcd::MeshCollisionSettings how;
  how.cell = settings.grid_length;
  how.nearest = settings.nearest;
  how.memory = settings.memory;
  how.device = settings.device;
  lsdcd::MpiHost mpi(world);
  check_shapes(wall());
  for (const lsdcd::MeshPart &part : wall().meshes()) {
    const lsdcd::WeldedMesh mesh = lsdcd::copy_together(mpi, part.grid.mesh());
    Against one;
    one.fingerprint = part.grid.mesh_fingerprint();
    one.bounds = part.bounds(0);
    lsdcd::run_collectively(mpi, has_any(), [&] {
      one.collision = std::make_unique<lsdcd::MeshCollision>(mesh, body, how);
    });
    meshes.push_back(std::move(one));
  }
}

// Grids of the compute are those of the meshes as they were when it was defined.
void ComputeCollideLsdcd::check_shapes(const FixWallLsdcd &fix) const
{
  for (const lsdcd::MeshPart &part : fix.meshes())
    if (part.surface->changes())
      fatal("fix " + settings.wall + " has a mesh " +
            (part.nodes() ? "whose nodes move" : "that wear moves (deform)") +
            ", and bodies collide with rigid meshes only");
}

// Checks that the wall is the one that there was when the compute was defined.
void ComputeCollideLsdcd::check_wall(const FixWallLsdcd &fix) const
{
  bool same = fix.meshes().size() == meshes.size();
  for (std::size_t m = 0; same && m < meshes.size(); m++)
    same = fix.meshes()[m].grid.mesh_fingerprint() == meshes[m].fingerprint;
  if (!same)
    fatal("fix " + settings.wall +
          " has different meshes than when the compute was defined: define the compute again");
}

void ComputeCollideLsdcd::init()
{
  check_shapes(wall());
  check_wall(wall());
  evaluated_at = -1;    // atoms may have been moved since
}

// What a variable has asked for as the step began is of that time: LAMMPS has cleared the flags since.
void ComputeCollideLsdcd::evaluate()
{
  if (invoked_flag != INVOKED_NONE && evaluated_at == update->ntimestep) return;
  const FixWallLsdcd &fix = wall();
  const lsdcd::PeriodicBox box = lsdcd::host_box(*domain);
  const std::vector<double> sums = gather_sums();
  found.assign(bodies.size() + 1, 0.0);
  const int n = static_cast<int>(bodies.size());
  lsdcd::MpiHost mpi(world);
  const std::string error = lsdcd::error_of([&] {
    lsdcd::run_collectively(mpi, true, [&] {
      for (int body = 0; body < n; body++)
        if (is_mine(body)) collide(body, pose_of(body, sums), fix, box);
    });
  });
  if (!error.empty()) fatal("at step " + std::to_string(update->ntimestep) + ": " + error);
  MPI_Allreduce(MPI_IN_PLACE, found.data(), n + 1, MPI_DOUBLE, MPI_SUM, world);
  evaluated_at = update->ntimestep;
  constexpr int kX = 2;    // of the sums
  for (int body = 0; body < n; body++) {
    const double *s = &sums[lsdcd::PosePoints::kSums * body];
    bodies[body].near += (1 / s[0]) * Vec3{s[kX], s[kX + 1], s[kX + 2]};
  }
}

// A body and its images in a periodic box, against each mesh where that is now. A pair of triangles
// counts once, whichever images meet.
void ComputeCollideLsdcd::collide(int body, const BodyPose &pose, const FixWallLsdcd &fix,
                                  const lsdcd::PeriodicBox &box)
{
  for (std::size_t m = 0; m < meshes.size(); m++) {
    const lsdcd::Pose &wall = fix.meshes()[m].pose();
    std::vector<lsdcd::BodyPair> pairs;
    for_images(pose, wall, meshes[m].bounds, box, [&](const Vec3 &shift) {
      const lsdcd::Collision meets =
          meshes[m].collision->collide(in_frame_of(wall, moved(pose, shift)));
      pairs.insert(pairs.end(), meets.pairs.begin(), meets.pairs.end());
      found.back() += static_cast<double>(meets.uncertain);
    });
    std::sort(pairs.begin(), pairs.end());
    found[body] += static_cast<double>(std::unique(pairs.begin(), pairs.end()) - pairs.begin());
  }
}

// Calls visit(shift) for images of the body, in the box's frame, whose ball reaches into the box
// around a mesh.
template <class Visit>
void ComputeCollideLsdcd::for_images(const BodyPose &pose, const lsdcd::Pose &wall,
                                     const lsdcd::Box &bounds, const lsdcd::PeriodicBox &box,
                                     const Visit &visit) const
{
  const Vec3 centre = pose.corner_at(middle), at = box.fraction(centre);
  int first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k]) continue;
    double lo = HUGE_VAL, hi = -HUGE_VAL;    // of the mesh, from the body, in boxes
    lsdcd::for_corners(bounds, [&](const Vec3 &corner) {
      const double f = box.fraction(wall.to_box(corner))[k] - at[k];
      lo = std::min(lo, f);
      hi = std::max(hi, f);
    });
    const double past = reach / box.width(k) + kRim;
    first[k] = static_cast<int>(std::ceil(lo - past));
    last[k] = static_cast<int>(std::floor(hi + past));
  }
  for (int i = first[0]; i <= last[0]; i++)
    for (int j = first[1]; j <= last[1]; j++)
      for (int k = first[2]; k <= last[2]; k++) {
        const Vec3 shift =
            double(i) * box.edge[0] + double(j) * box.edge[1] + double(k) * box.edge[2];
        const Vec3 c = wall.to_mesh(centre + shift);
        Vec3 out = {0, 0, 0};
        for (int d = 0; d < 3; d++)
          out[d] = std::max({bounds.lo[d] - c[d], c[d] - bounds.hi[d], 0.0});
        if (norm(out) <= reach * (1 + kRim)) visit(shift);
      }
}

// Bodies that meet the wall.
double ComputeCollideLsdcd::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  evaluate();
  return scalar = static_cast<double>(
             std::count_if(found.begin(), found.end() - 1, [](double pairs) { return pairs > 0; }));
}

// Pairs of all bodies; bodies; pieces that may have missed pairs.
void ComputeCollideLsdcd::compute_vector()
{
  invoked_vector = update->ntimestep;
  evaluate();
  vector[0] = 0;
  for (std::size_t body = 0; body < bodies.size(); body++) vector[0] += found[body];
  vector[1] = static_cast<double>(bodies.size());
  vector[2] = found.back();
}

// A row for each body: its molecule, 0 where there is one body; its pairs.
void ComputeCollideLsdcd::compute_array()
{
  invoked_array = update->ntimestep;
  evaluate();
  for (std::size_t body = 0; body < bodies.size(); body++) {
    array[body][0] = static_cast<double>(bodies[body].molecule);
    array[body][1] = found[body];
  }
}

double ComputeCollideLsdcd::memory_usage()
{
  double bytes =
      static_cast<double>(body_point_of.size()) * (sizeof(BodyPoint) + 4 * sizeof(void *));
  for (const Against &one : meshes)
    if (one.collision) bytes += static_cast<double>(one.collision->grid().bytes);
  return bytes;
}

void ComputeCollideLsdcd::log_mesh(const lsdcd::WeldedMesh &mesh) const
{
  if (comm->me != 0) return;
  std::string text = lsdcd::counted(bodies.size(), "body", "bodies") + " of " +
                     lsdcd::counted(points->size(), "atom") + " and " +
                     lsdcd::counted(mesh.faces.size(), "triangle");
  for (std::size_t m = 0; m < meshes.size(); m++) {
    const Against &one = meshes[m];
    char line[160];
    std::snprintf(line, sizeof line, "\n  against %s of fix %s: %s, cells of %g, %.3g MB",
                  lsdcd::counted(wall().meshes()[m].grid.report().facets, "triangle").c_str(),
                  settings.wall.c_str(), lsdcd::counted(one.collision->n_pieces(), "piece").c_str(),
                  one.collision->grid().length,
                  1e-6 * static_cast<double>(one.collision->grid().bytes));
    if (!settings.brief) text += line;
  }
  if (!settings.brief) {
    if (settings.atoms_file.empty())
      text += "\n  the compute assumes that the mesh is where " + name_of(0) + " is now, in step " +
              std::to_string(update->ntimestep) + "; if it is not, give the keyword atoms";
    text += '\n';
    text += describe(mesh.report, settings.mesh.file);
  }
  log(text);
}
