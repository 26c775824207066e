// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_grid_*
#include "api/c_border.h"
#include "api/call_threads.h"
#include "api/objects.h"
#include "base/input_words.h"
#include "engine/wall_engine.h"
#include "grid/cache/load_or_build.h"

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
  if (o.nearest < 0 || o.nearest > kMaxNearest)
    refuse("nearest is " + std::to_string(o.nearest) + "; it is 0, for all, or up to " +
           std::to_string(kMaxNearest));
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

// Memory of this process.
class OwnPlace : public GridPlace {
 public:
  explicit OwnPlace(FlatGrid &grid) : grid_(grid) {}

  char *allocate(std::size_t bytes) override
  {
    grid_ = FlatGrid(bytes);
    return grid_.block();
  }

 private:
  FlatGrid &grid_;
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
    const GridSettings settings = settings_of(o, from.normals_agree());
    std::string why;
    if (o.device == LSDCD_CUDA && !cuda_available(&why))
      throw ApiError(LSDCD_ERROR_DEVICE, "CUDA: " + why + "; build with LSDCD_CPU");
    const CallThreads threads(o.threads);
    auto made = std::make_shared<ApiGrid>(mesh->in);
    OwnPlace place(made->flat);
    const LoadedGrid loaded = load_or_build_grid(o.cache ? o.cache : "", from.mesh, settings,
                                                 o.device == LSDCD_CUDA, place);
    made->from_cache = loaded.from_cache;
    made->report = describe(loaded.report);
    for (const std::string &line : {loaded.cache_warning, loaded.cache_text})
      if (!line.empty()) made->report += "\n  " + line;
    made->grid = HostGrid(made->flat.view());
    made->sides_by_normals = settings.sides && made->grid.view.outside != 0;
    made->has_sides = made->sides_by_normals || has_inside(from.mesh);
    if (made->has_sides && !made->sides_by_normals)
      made->report +=
          "\n  sides on the host alone: triangles of the mesh cut, overlap or touch each other";
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
