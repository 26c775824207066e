// lsdcd_grid_*
#include "api/c_border.h"
#include "api/call_threads.h"
#include "api/objects.h"
#include "base/input_words.h"
#include "engine/wall_engine.h"
#include "grid/cache/grid_cache.h"

#include <cmath>

using namespace lsdcd;

namespace {

void refuse(const std::string &text)
{
  throw ApiError(LSDCD_ERROR_ARGUMENT, "`lsdcd_grid_options`: " + text);
}

GridSettings settings_of(const lsdcd_grid_options &o, bool with_sides)
{
  if (!(o.cutoff > 0) || !std::isfinite(o.cutoff))
    refuse("cutoff is " + number_text(o.cutoff) + "; give the largest distance that matters");
  if (!(o.cell >= 0) || !std::isfinite(o.cell))
    refuse("cell is " + number_text(o.cell) + "; give a length, or 0 to have it chosen");
  if (o.nearest < 0 || o.nearest > kMostNearest)
    refuse("nearest is " + std::to_string(o.nearest) + "; it is 0, for all, or up to " +
           std::to_string(kMostNearest));
  if (o.precision != LSDCD_DOUBLE && o.precision != LSDCD_FLOAT)
    refuse("precision is neither LSDCD_DOUBLE nor LSDCD_FLOAT");
  if (!(o.memory >= 0) || !(o.memory < 1e18))
    refuse("memory is " + number_text(o.memory) + "; give bytes, or 0 for the default");
  check_threads(o.threads);
  if (o.device != LSDCD_CPU && o.device != LSDCD_CUDA)
    refuse("device is neither LSDCD_CPU nor LSDCD_CUDA");
  GridSettings s;
  s.length = o.cell;
  s.length_name = "`cell`";
  s.cutoff = o.cutoff;
  s.memory_budget = static_cast<std::size_t>(o.memory);
  s.limited = true;
  s.sides = with_sides;
  s.nearest = o.nearest;
  s.in_floats = o.precision == LSDCD_FLOAT;
  return s;
}

// The grid and its report, from the cache where that has it.
class CachedGridBuild {
 public:
  CachedGridBuild(ApiGrid &grid, const WallMesh &mesh, const GridSettings &settings, bool on_cuda) :
      grid_(grid), mesh_(mesh), settings_(settings), on_cuda_(on_cuda)
  {
  }

  void without_cache()
  {
    const TriangleGrid made = build_grid(mesh_, settings_, on_cuda_);
    grid_.flat = FlatGrid(made);
    report_ = made.report;
    grid_.report = describe(report_);
  }
  void with_cache(const std::string &file)
  {
    const GridKey key = grid_key(mesh_, settings_);
    CachedGrid cached(file, key);
    if (cached.state() == CacheState::usable) {
      FlatGrid read(cached.block_bytes());
      if (cached.read(read.block())) {
        grid_.flat = std::move(read);
        grid_.from_cache = true;
        grid_.report =
            describe(cached.report()) + "\n  not built now, read from cache '" + file + "'";
        return;
      }
    }
    without_cache();
    grid_.report += "\n  " + keep(file, key, cached);
  }

 private:
  // A cache that cannot be written costs a line of the report, no more.
  std::string keep(const std::string &file, const GridKey &key, const CachedGrid &cached)
  {
    const std::string name = "cache '" + file + "' ";
    if (cached.state() == CacheState::foreign)
      return name + cached.problem() + "; it is left as it is and the grid is not kept";
    try {
      const GridView view = grid_.flat.view();
      write_grid_cache(file, key, report_, view.block, grid_.flat.bytes());
    } catch (const InputError &e) {
      return "the grid is not kept: cache " + std::string(e.what());
    }
    if (cached.state() == CacheState::missing) return "written to " + name;
    return name + cached.problem() + "; the grid was built and the file replaced";
  }

  ApiGrid &grid_;
  const WallMesh &mesh_;
  const GridSettings &settings_;
  bool on_cuda_;
  GridReport report_;
};

}    // namespace

extern "C" {

int lsdcd_grid_build(const lsdcd_mesh *mesh, const lsdcd_grid_options *options, lsdcd_grid **grid)
{
  return guard([&] {
    need(grid, "grid");
    need(mesh, "mesh");
    const lsdcd_grid_options o = checked(options, "lsdcd_grid_options");
    const ApiMesh &from = *mesh->in;
    const GridSettings settings = settings_of(o, from.has_sides());
    std::string why;
    if (o.device == LSDCD_CUDA && !cuda_available(&why))
      throw ApiError(LSDCD_ERROR_DEVICE, "CUDA: " + why + "; build with LSDCD_CPU");
    const CallThreads threads(o.threads);
    auto made = std::make_shared<ApiGrid>(from.mesh);
    CachedGridBuild making(*made, from.mesh, settings, o.device == LSDCD_CUDA);
    if (o.cache && *o.cache)
      making.with_cache(o.cache);
    else
      making.without_cache();
    made->grid = HostGrid(made->flat.view());
    made->has_sides = settings.sides && made->grid.view.outside != 0;
    if (settings.sides && !made->has_sides)
      made->report += "\n  no sides: triangles of the mesh cut, overlap or touch each other";
    *grid = new lsdcd_grid{std::move(made)};
  });
}

int lsdcd_grid_get_facts(const lsdcd_grid *grid, lsdcd_grid_facts *facts)
{
  return guard([&] {
    need(grid, "grid");
    lsdcd_grid_facts f = checked(facts, "lsdcd_grid_facts");
    const ApiGrid &g = *grid->in;
    f.cutoff = g.grid.view.cutoff;
    f.cell = g.grid.view.length;
    f.bytes = g.flat.bytes();
    f.nearest = g.grid.view.nearest;
    f.has_sides = g.has_sides;
    f.from_cache = g.from_cache;
    copy_out(f, facts);
  });
}

const char *lsdcd_grid_report(const lsdcd_grid *grid)
{
  return grid ? grid->in->report.c_str() : "";
}

void lsdcd_grid_free(lsdcd_grid *grid)
{
  delete grid;
}

}    // extern "C"
