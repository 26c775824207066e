// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The limit-space grid. Every cell near the wall has a list of what a sphere with its centre in that cell can touch. A complete
// list has every such feature. A nearest list has the N primitives of the wall that are nearest to the cell's centre: the method
// of Yong et al. (2017), whose Table 1 shows such lists. doc/paper.md compares the two, formula by formula.
#pragma once

#include "base/progress.h"
#include "base/vec3.h"
#include "box/periodic_box.h"
#include "grid/brick_records.h"
#include "mesh/mesh_features.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

constexpr int kBrickSide = 8;    // cells along a brick edge
constexpr int kBrickCells = kBrickSide * kBrickSide * kBrickSide;
constexpr int kLayers = kBrickSide;

// An entry of a cell's list: the feature or primitive, and a lower bound of its distance from the cell centre. Lists are sorted
// by (bound, feature), ascending.
struct CellEntry {
  FeatureCode feature;
  float bound;    // length
};

// The same in one word, for steps. The kind of the code is in the two top bits, and its index in the lowest bits, as many as the
// wall needs. Between them is the bound in steps; all steps that fit add up to a length `largest`. Each operation of steps() is
// monotonic, so that
//
//   bound <= limit => steps(bound) <= steps(limit),
//
// and a search up to a limit finds in a packed list all that it finds in a full one. It may also try an entry whose bound is less
// than one step past the limit, which costs time but changes no contact.
struct PackedEntry {
  std::uint32_t word;
};
struct EntryPacking {
  Real steps_per_length = 0;      // 1/length
  std::uint32_t code_bits = 0;    // 0: lists are not packed
  std::uint32_t shift = 0;        // of the steps

  EntryPacking() = default;
  // Packs codes with indices below n. `largest`: a length above 0.
  EntryPacking(std::uint64_t n, Real largest)
  {
    while (shift < kFeatureIndexBits && n > std::uint64_t(1) << shift) shift++;
    code_bits = ~(((std::uint32_t(1) << (kFeatureIndexBits - shift)) - 1) << shift);
    steps_per_length = most() / largest;
  }

  LSDCD_FN std::uint32_t most() const { return ~code_bits >> shift; }    // steps that fit
  // Returns the steps of a bound or a limit as a word has them: 0 for a negative limit, and the largest number for a longer limit
  // or for one that is not a number.
  LSDCD_FN std::uint32_t steps(Real length) const
  {
    const Real n = length * steps_per_length;
    return (n < most() ? (n > 0 ? static_cast<std::uint32_t>(n) : 0) : most()) << shift;
  }
  LSDCD_FN PackedEntry pack(const CellEntry &c) const { return {c.feature | steps(c.bound)}; }
  LSDCD_FN FeatureCode feature(PackedEntry c) const { return c.word & code_bits; }
  LSDCD_FN std::uint32_t bound(PackedEntry c) const { return c.word & ~code_bits; }
};
static_assert(sizeof(EntryPacking) == 16, "flat blocks have its bytes, and no padding");

// A cell. A single entry is held inline (count 1, first = its feature code).
struct Cell {
  std::uint32_t first;
  std::uint32_t count;
};

// 64 cells of a brick, x fastest, then y: a bit for each cell that has entries, and the place of the first of these in
// CellListsView::cells. It has 16 bytes, which are loaded at once: a sphere reads one layer of a brick.
struct alignas(16) BrickLayer {
  std::uint64_t mask;
  std::uint32_t first_cell;
  std::uint32_t pad;
};
struct Brick {
  BrickLayer layer[kLayers];    // z upwards
};

constexpr int kMaxNearest = 32;

// Which features the list of a cell has: all that a sphere can touch (complete), the N primitives nearest to the cell's centre,
// or every primitive within the cutoff, as collisions of bodies need. It is a single number in cache files and in what kernels
// compare, so it has no initial value.
class ListKind {
 public:
  ListKind() = default;
  static constexpr ListKind complete() { return ListKind(0); }
  // n: 1 to kMaxNearest
  static constexpr ListKind nearest(int n) { return ListKind(n); }
  static constexpr ListKind every() { return ListKind(kEvery); }
  // Returns the kind for a value of `nearest` in scripts and in the library: 0 is complete.
  static constexpr ListKind of_option(int n) { return n == 0 ? complete() : nearest(n); }

  LSDCD_FN bool is_complete() const { return n_ == 0; }
  LSDCD_FN bool has_primitives() const { return n_ > 0; }
  LSDCD_FN bool is_every() const { return n_ == kEvery; }
  // Returns how many primitives of a list are read. The next one is a bound of all that were left out.
  LSDCD_FN std::uint32_t most() const { return static_cast<std::uint32_t>(n_); }

  friend bool operator==(ListKind a, ListKind b) { return a.n_ == b.n_; }

 private:
  static constexpr std::int32_t kEvery = 0x7ffffffe;
  constexpr explicit ListKind(std::int32_t n) : n_(n) {}

  std::int32_t n_;
};

// Lists of one kind for all cells.
struct CellListsView {
  const std::int32_t *brick_of;    // x fastest; -1 if no brick is near the wall
  const Brick *bricks;
  const Cell *cells;
  const CellEntry *entries;
  const PackedEntry *packed;    // in the places of their entries
  EntryPacking packing;

  LSDCD_FN bool is_packed() const { return packing.code_bits != 0; }

  // Calls visit() with each array of a view or of CellLists.
  template <class Lists, class Visit>
  static constexpr void each_array(Lists &lists, const Visit &visit)
  {
    visit(lists.brick_of);
    visit(lists.bricks);
    visit(lists.cells);
    visit(lists.entries);
    visit(lists.packed);
  }
};

// A borrowed view of a grid on the CPU or on a device; trivially copyable.
struct GridView {
  MeshFeaturesView wall;
  Vec3 origin;                // corner of brick (0, 0, 0); length
  Real length, inv_length;    // cell edge
  Real cutoff;                // largest radius for which the lists are complete
  Real tolerance;             // closes gaps between face, edge and vertex regions; length
  Real margin;                // lists are valid up to this far from the cell, too; length
  Real outside;               // +1 if normals point out of a closed wall, -1 if in; 0: unknown
  std::int32_t n_bricks[3];
  ListKind list_kind;
  std::int32_t in_floats;    // codes in lists are of brick records
  std::int32_t is_large;     // do the wall's records exceed a processor's cache?
  CellListsView lists;
  BrickRecordsView records;
  const char *block;    // the flat block all of this lies in, or null
  std::size_t block_bytes;

  // Calls visit() with each array of a view or of a TriangleGrid, in the order of a flat block.
  template <class Grid, class Visit>
  static constexpr void each_array(Grid &grid, const Visit &visit)
  {
    MeshFeaturesView::each_array(grid.wall, visit);
    CellListsView::each_array(grid.lists, visit);
    BrickRecordsView::each_array(grid.records, visit);
  }
};

// Settings with which any grid is built.
struct GridSettings {
  Real length = 0;                  // 0: chosen from the mesh, the cutoff and the budget
  Real cutoff = 0;                  // > 0
  std::size_t memory_budget = 0;    // bytes, of the whole grid; 0: kListBudget for lists
  bool sides = false;               // store what `side in|out` needs
  int nearest = 0;                  // primitives in a list, 1 to kMaxNearest; 0: all that it is for
  bool for_gpu = false;             // spheres are on a GPU: the length that is selected is shorter
  bool may_coarsen = false;         // a given length may grow, too, until the grid fits the budget
  // The region in which centres of spheres can be. The grid is cut off there.
  Box within = kNoLimit;
  std::string length_name = "grid";    // of `length`, for messages: what the caller calls it
  // Called between the parts of a build, and on a CPU also within them.
  ProgressListener progress;
};

// A grid serves only the purpose for which it was built. Settings, grids and views of each purpose are types of their own, so
// that a grid does not compile where it cannot serve.
//
// Steps store what they find for many steps, and read packed entries of complete lists.
struct StepGridSettings : GridSettings {};
// Queries read a list for each point.
struct QueryGridSettings : GridSettings {
  bool in_floats = false;    // brick records, for queries in float
};
// Collisions of bodies read every primitive within the cutoff, or the nearest.
struct BodyGridSettings : GridSettings {};

enum class GridPurpose { steps, queries, bodies };

// Settings for any purpose, in the form that planning and building read.
struct AnyGridSettings : GridSettings {
  GridPurpose purpose;
  bool in_floats = false;

  AnyGridSettings(const StepGridSettings &s) : GridSettings(s), purpose(GridPurpose::steps) {}
  AnyGridSettings(const QueryGridSettings &s) :
      GridSettings(s), purpose(GridPurpose::queries), in_floats(s.in_floats)
  {
  }
  AnyGridSettings(const BodyGridSettings &s) : GridSettings(s), purpose(GridPurpose::bodies) {}

  ListKind list_kind() const
  {
    const bool every = purpose == GridPurpose::bodies && nearest == 0;
    return every ? ListKind::every() : ListKind::of_option(nearest);
  }
  bool is_packed() const { return purpose == GridPurpose::steps && nearest == 0; }
  // Is the build limited by BuildLimit? A length that is given for steps may take any time.
  bool is_limited() const
  {
    return memory_budget == 0 && !(purpose == GridPurpose::steps && length > 0);
  }
};
constexpr std::size_t kListBudget = 1ull << 30;    // bytes, beside the records of the wall

// A limit of the time and memory of a build. A length that the build selects grows until the limit holds; a length of the caller
// is refused. Work is in units of a distance test, 10 to 20 ns of one core; bytes do not include the records of the wall.
struct BuildLimit {
  double work, bytes;

  explicit BuildLimit(std::size_t triangles) :
      work(1e8 + 2e3 * double(triangles)), bytes(128e6 + 2e3 * double(triangles))
  {
  }
};

struct ListReport {
  std::size_t bricks = 0, cells = 0, entries = 0;    // cells that have entries
  std::size_t longest = 0;
  Real mean = 0;
  std::size_t distance_tests = 0;    // feature against cell, at most; after the bricks were found
  double seconds = 0;                // of the build alone, without copies to and from a device
};

struct GridReport {
  Real length = 0, cutoff = 0;
  bool length_chosen = false;
  Real too_fine = 0;    // the length selected first, if that took too much; else 0
  ListKind list_kind = ListKind::complete();
  ListReport lists;
  std::size_t records = 0, record_bytes = 0;
  std::size_t bytes = 0;
  double seconds = 0;
  std::string device;
};

struct CellLists {
  std::vector<std::int32_t> brick_of;
  std::vector<Brick> bricks;
  std::vector<Cell> cells;
  std::vector<CellEntry> entries;
  std::vector<PackedEntry> packed;
  EntryPacking packing;
};

// Owns a grid and the wall records that it points to, on the host. Every device builds the same bits.
struct TriangleGrid {
  MeshFeatures wall;
  Vec3 origin = {0, 0, 0};
  Real length = 0, cutoff = 0, tolerance = 0, margin = 0, outside = 1;
  std::int32_t n_bricks[3] = {0, 0, 0};
  ListKind list_kind = ListKind::complete();
  bool in_floats = false;
  CellLists lists;
  BrickRecords records;
  GridReport report;

  GridView view() const;
};

// Does the work of build_grid().
TriangleGrid build_any_grid(const WeldedMesh &mesh, const AnyGridSettings &settings, bool on_cuda);

// The type of the view of a grid of that type.
template <class Grid>
struct ViewOf : GridView {
  explicit ViewOf(const GridView &view) : GridView(view) {}
};

// The type of a grid that was built with such settings.
template <class Settings>
struct GridFor : TriangleGrid {
  GridFor() = default;
  GridFor(const WeldedMesh &mesh, const Settings &settings, bool on_cuda) :
      TriangleGrid(build_any_grid(mesh, settings, on_cuda))
  {
  }
  ViewOf<GridFor> view() const { return ViewOf<GridFor>(TriangleGrid::view()); }
};
using StepGrid = GridFor<StepGridSettings>;
using QueryGrid = GridFor<QueryGridSettings>;
using BodyGrid = GridFor<BodyGridSettings>;

// Builds a grid. Throws InputError if the grid would not fit the budget; the message says which cell length would.
template <class Settings>
GridFor<Settings> build_grid(const WeldedMesh &mesh, const Settings &settings, bool on_cuda = false)
{
  return {mesh, settings, on_cuda};
}

// Returns the report as lines for the log.
std::string describe(const GridReport &report);

// A whole grid can be one flat, relocatable block of bytes, so that the processes of a node can share it: pack it into memory of
// flat_bytes(), and view it anywhere. The block must be 64-byte aligned. A CUDA engine takes only views of flat blocks.
std::size_t flat_bytes(const TriangleGrid &grid);
// A grid whose parts are in separate memory, for flat_bytes() and flatten().
struct GridParts {
  const MeshFeatures &wall;
  const CellLists &lists;
  const BrickRecords &records;
  GridView all;    // everything except arrays

  GridView view() const { return all; }
};
std::size_t flat_bytes(const GridParts &grid);
void flatten(const GridParts &grid, char *block);
// Returns the bytes of the part that any grid of this wall has, including padding for the rest.
std::size_t flat_wall_bytes(const TriangleGrid &grid);
// Returns the bytes that the whole grid may take according to the settings.
std::size_t budget_of(const GridSettings &settings, const TriangleGrid &grid);
void flatten(const TriangleGrid &grid, char *block);
// Flattens the grid into `block`, and frees each array of the grid once it is copied.
void move_flat(TriangleGrid &grid, char *block);
GridView flat_view(const char *block);

// Returns the view of a flat block as a view of the copy of that block at `to`.
GridView moved_view(const GridView &view, const char *to);

// Returns the centre of the brick at an index in the table.
Vec3 brick_centre(const TriangleGrid &grid, std::size_t index);

}    // namespace lsdcd
