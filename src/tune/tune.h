// The cheapest grid, lists and precision whose error stays below a bound.
#pragma once

#include "mesh/wall_mesh.h"
#include "tune/trial_grid.h"
#include "tune/wall_answers.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

struct TuneSettings {
  // Largest error to accept, in [0, 1): of the missed contacts / contacts and of the
  // largest relative error of a sphere's force.
  Real bound = 0;
  GridSettings grid;        // cutoff > 0, memory, sides; a length, lists and precision to keep
  EngineSettings engine;    // law, corner, side, device; a precision to keep
  bool keep_lists = false, keep_precision = false;    // a grid.length > 0 is kept
  // Spheres of the scene, or some of them; none: the wall's surroundings alone, and all
  // radii the cutoff.
  SphereSample scene;
  std::uint64_t seed = 1;
};

struct TuneRow {
  GridChoice choice;
  AnswerError error;
  double ns_per_sphere;    // near the wall, in one step
  double bytes;            // of the whole grid; extrapolated where not all of it was built
  bool accepted;
};

struct TuneReport {
  Real bound;
  std::vector<TuneRow> rows;
  int taken;               // index in rows
  int scene, band;         // spheres of the sample
  int parts, all_parts;    // cubes of the wall's surroundings that were tried, and all
  Real part_side;          // length
  double seconds;
  std::string device;

  bool extrapolated() const { return parts < all_parts; }
  const GridChoice &choice() const { return rows[taken].choice; }
};

// Which row to take: of those accepted and no more than a tenth slower than the quickest,
// the most precise, then the smallest; where none fits the budget the smallest with a good
// error, -1 where none has one. Nearest lists without `exact` are never accepted: a contact
// that they miss is an error of 1, and a sample without one does not tell of the next sphere.
int choose(std::vector<TuneRow> &rows, Real bound, std::size_t memory_budget);

// Tries cells of half to four times the default length, all kinds of list and precision,
// in a random choice of the cubes that the wall's surroundings are cut into, so that large
// meshes take no longer. The same sample and errors whenever it is called; times differ.
// Throws InputError where what is kept has no error below the bound.
TuneReport tune(const WallMesh &mesh, const TuneSettings &settings);

// The table as lines for the log.
std::string describe(const TuneReport &report);

}    // namespace lsdcd
