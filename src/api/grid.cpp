// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_grid_*
#include "api/c_border.h"
#include "api/call_progress.h"
#include "api/call_threads.h"
#include "api/cell_options.h"
#include "api/objects.h"
#include "base/input_words.h"
#include "engine/engine.h"
#include "grid/cache/load_or_build.h"
#include "mesh/measure_mesh.h"
#include "mesh/meets_itself.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>

using namespace lsdcd;

namespace {

[[noreturn]] void refuse(const std::string &text)
{
  refuse_option("lsdcd_grid_options", text);
}

// Does a choice ask for cells, not for a tree?
bool names_cells(const lsdcd_grid_options &o)
{
  return o.cell > 0 || o.nearest > 0 || o.precision != LSDCD_DOUBLE || o.memory > 0 || o.cache ||
         o.device != LSDCD_CPU;
}

QueryGridSettings settings_of(const lsdcd_grid_options &o, bool with_sides)
{
  if (!(o.cutoff >= 0) || !std::isfinite(o.cutoff))
    refuse("cutoff is " + number_text(o.cutoff) +
           "; give the largest distance that matters, or 0 for any");
  if (o.cutoff > kLargestLength)
    refuse("cutoff is " + number_text(o.cutoff) +
           ", beyond 1e100, which no coordinate of a mesh exceeds: leave it 0 for any distance");
  check_cell_options("lsdcd_grid_options", o);
  if (o.precision != LSDCD_DOUBLE && o.precision != LSDCD_FLOAT)
    refuse("precision is neither LSDCD_DOUBLE nor LSDCD_FLOAT");
  check_threads(o.threads);
  if (o.cutoff == 0 && names_cells(o))
    refuse("cell, nearest, precision, memory, cache and device are of the cells of a grid, which "
           "need a "
           "cutoff: give the largest distance that matters, or leave them 0");
  QueryGridSettings s;
  s.length = o.cell;
  s.length_name = "`cell`";
  s.cutoff = o.cutoff;
  s.memory_budget = static_cast<std::size_t>(o.memory);
  s.sides = with_sides;
  s.nearest = o.nearest;
  s.in_floats = o.precision == LSDCD_FLOAT;
  return s;
}

std::unique_ptr<ApiCells> make_cells(const std::string &cache, const ApiMesh &from,
                                     const QueryGridSettings &settings, bool on_cuda)
{
  auto made = std::make_unique<ApiCells>();
  Host alone;
  const LoadedGrid loaded =
      load_or_build_grid(cache, from.mesh, settings, on_cuda, alone, made->memory);
  made->from_cache = loaded.from_cache;
  made->report = describe(loaded.report);
  for (const std::string &line : {loaded.cache_warning, loaded.cache_text})
    if (!line.empty()) made->report += "\n  " + line;
  made->grid = CpuGrid(ViewOf<QueryGrid>(flat_view(made->memory.block.get())));
  made->sides_by_normals = settings.sides && made->grid.view.outside != 0;
  if (!made->sides_by_normals && has_inside(from.mesh))
    made->report +=
        "\n  sides on the host alone: triangles of the mesh cut, overlap or touch each other";
  return made;
}

std::string text_of(const TriangleTree &tree, Real cutoff, double seconds)
{
  char text[128];
  std::snprintf(text, sizeof text, "%s: %s, %.1f MB, built in %.3f s",
                cutoff > 0 ? (", cutoff " + number_text(cutoff)).c_str() : "",
                counted(tree.n_primitives(), "triangle").c_str(),
                static_cast<double>(tree.bytes()) / 1e6, seconds);
  return std::string("  tree") + text;
}

}    // namespace

namespace lsdcd {

ApiGrid::ApiGrid(std::shared_ptr<const ApiMesh> from, const lsdcd_grid_options &o,
                 const ProgressListener &progress) :
    mesh(std::move(from)),
    names(mesh->mesh), has_sides(has_inside(mesh->mesh)), cutoff_(o.cutoff),
    settings_(settings_of(o, mesh->normals_agree())), cache_(o.cache ? o.cache : ""),
    on_cuda_(o.device == LSDCD_CUDA)
{
  std::string why;
  if (on_cuda_ && !cuda_available(&why))
    throw ApiError(LSDCD_ERROR_DEVICE, "CUDA: " + why + "; build with LSDCD_CPU");
  if (names_cells(o)) {
    report = cells(false, progress).report;
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  const TriangleTree &made = tree(progress);
  near(progress);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  report = text_of(made, cutoff_, passed.count());
}

Real ApiGrid::cutoff() const
{
  return is_limited() ? cutoff_ : HUGE_VAL;
}

const TriangleTree &ApiGrid::tree(const ProgressListener &progress) const
{
  return tree_.get([&] { return std::make_unique<TriangleTree>(mesh->mesh, names, progress); });
}

const CutoffBoxes *ApiGrid::near(const ProgressListener &progress) const
{
  if (!is_limited()) return nullptr;
  return &boxes_.get(
      [&] { return std::make_unique<CutoffBoxes>(tree(), mesh->mesh, cutoff_, progress); });
}

const ApiCells &ApiGrid::cells(bool on_cuda, const ProgressListener &progress) const
{
  return cells_.get([&] {
    QueryGridSettings settings = settings_;
    settings.progress = progress;
    return make_cells(cache_, *mesh, settings, on_cuda || on_cuda_);
  });
}

bool ApiGrid::sides_by_normals() const
{
  if (is_limited()) return cells().sides_by_normals;
  return mesh->normals_agree() && !meets_itself_.get([&] {
    return std::make_unique<bool>(lsdcd::meets_itself(mesh->mesh).pairs > 0);
  });
}

bool ApiGrid::host_sides_by_normals() const
{
  return !uses_tree() && !settings_.in_floats && cells().sides_by_normals;
}

std::size_t ApiGrid::bytes() const
{
  const ApiCells *cells = cells_.made();
  return bytes_of(tree_.made(), boxes_.made()) + (cells ? cells->memory.bytes : 0);
}

}    // namespace lsdcd

extern "C" {

int lsdcd_grid_build(const lsdcd_mesh *mesh, const lsdcd_grid_options *options, lsdcd_grid **grid)
{
  return guard([&] {
    need(grid, "grid");
    need(mesh, "mesh");
    const lsdcd_grid_options o = checked(options, "lsdcd_grid_options");
    const CallThreads threads(std::max(o.threads, 0));
    CallProgress progress(o.progress, o.data);
    *grid = new lsdcd_grid{std::make_shared<const ApiGrid>(mesh->in, o, progress.listener())};
  });
}

int lsdcd_grid_get_facts(const lsdcd_grid *grid, lsdcd_grid_facts *facts)
{
  return guard([&] {
    need(grid, "grid");
    lsdcd_grid_facts f = checked(facts, "lsdcd_grid_facts");
    const ApiGrid &g = *grid->in;
    f.has_sides = g.has_sides;
    const ApiCells *cells = g.cells_made();
    f.cutoff = g.cutoff();
    f.cell = cells ? cells->grid.view.length : 0;
    f.bytes = g.bytes();
    f.nearest = g.nearest();
    f.from_cache = cells && cells->from_cache;
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
