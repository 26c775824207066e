// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/surface/node_meshes.h"

#include <cstdint>

namespace lsdcd {

void NodeMeshes::add(MeshNodes *nodes)
{
  of_mesh_.push_back(nodes);
  if (nodes) all_.push_back(nodes);
}

void NodeMeshes::set_engine(WallEngine &engine)
{
  if (!any()) return;
  if (engine_) {
    engine.nodes()->take_over(*engine_->nodes());
    for (MeshNodes *nodes : all_) nodes->set_engine(*engine.nodes());
  } else {
    run_collectively(host_, true, [&] {
      for (MeshNodes *nodes : all_) nodes->start(*engine.nodes());
    });
  }
  engine_ = &engine;
}

void NodeMeshes::begin_choice(Real cutoff, int n)
{
  for (MeshNodes *nodes : all_) {
    const bool is_grid_due = nodes->needs_grid(cutoff);
    if (is_grid_due) nodes->build_grid(cutoff);
    if (is_grid_due || nodes->needs_choice(cutoff)) engine_->expire_choice();
  }
  for (MeshNodes *nodes : all_) nodes->turn_springs(n);
}

void NodeMeshes::note_choice()
{
  for (MeshNodes *nodes : all_) nodes->note_choice();
}

void NodeMeshes::see_forces()
{
  for (MeshNodes *nodes : all_) nodes->see_forces();
}

void NodeMeshes::agree_on_forces(bool failed)
{
  if (!any() || host_.processes() == 1) return;
  std::vector<Real> counts, exponents;
  for (const MeshNodes *nodes : all_) {
    const SummandRange mine = failed ? SummandRange{0, kNotFinite} : nodes->range();
    counts.push_back(static_cast<Real>(mine.count));
    exponents.push_back(static_cast<Real>(mine.exponent));
  }
  const int n = static_cast<int>(all_.size());
  host_.sum_and_max(counts.data(), n, exponents.data(), n);
  for (int k = 0; k < n; k++) {
    if (failed)
      all_[k]->have_no_forces();
    else
      all_[k]->add_forces(
          {static_cast<std::uint64_t>(counts[k]), static_cast<std::uint64_t>(exponents[k])});
  }
}

void NodeMeshes::clear_forces()
{
  for (MeshNodes *nodes : all_) nodes->clear_forces();
}

std::vector<NodeLoad> NodeMeshes::loads()
{
  std::vector<NodeLoad> loads;
  if (!any()) return loads;
  for (MeshNodes *nodes : of_mesh_)
    loads.push_back(nodes ? NodeLoad{true, nodes->power(), nodes->moment()} : NodeLoad());
  return loads;
}

}    // namespace lsdcd
