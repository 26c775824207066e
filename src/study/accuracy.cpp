// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/accuracy.h"

#include "backend/backend_cpu.h"
#include "base/input_error.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

template <class F>
double milliseconds(F f)
{
  return CpuBackend().milliseconds(f);
}

SphereBox box_round(const Vec3 &middle, const Vec3 &half, Real largest, std::uint64_t seed)
{
  return {middle - half, middle + half, largest, seed};
}

}    // namespace

AccuracyStudy::AccuracyStudy(const CylinderMesh &shape, Real cube, Real largest,
                             const StudySettings &settings) :
    settings_(settings),
    is_cylinder_(true), shape_(shape), mesh_(weld(make_cylinder(shape), -1)),
    box_(box_round({0, 0, shape.height / 2}, {cube / 2, cube / 2, cube / 2}, largest,
                   settings.seed)),
    query_(make_sphere_query(settings.device))
{
  if (!(cube > 0) || !(largest > 0))
    throw InputError("the cube's side and the largest radius must be above 0");
}

AccuracyStudy::AccuracyStudy(const TriangleSoup &soup, Real largest,
                             const StudySettings &settings) :
    settings_(settings),
    is_cylinder_(false), mesh_(weld(soup, -1)),
    box_(box_round(0.5 * (mesh_.report.lo + mesh_.report.hi),
                   0.5 * (mesh_.report.hi - mesh_.report.lo) + Vec3{largest, largest, largest},
                   largest, settings.seed)),
    query_(make_sphere_query(settings.device))
{
  if (!(largest > 0)) throw InputError("the largest radius must be above 0");
}

void AccuracyStudy::set_spheres(std::size_t n)
{
  spheres_ = make_spheres(box_, n, settings_.order);
  upload_ms_ = milliseconds([&] { query_->set_spheres(spheres_.data(), n); });
  StudyLists complete;
  complete.length = box_.largest / 2;
  set_grid(complete);
  query_->run(QuerySettings());
  exact_ = query_->distance();
  truth_.assign(n, 0);
  CpuBackend().for_each(n, [&](std::size_t i) {
    const Real d = is_cylinder_
                       ? cylinder_distance(spheres_[i].centre(), shape_.radius, shape_.height)
                       : exact_[i];
    truth_[i] = d < spheres_[i].r;
  });
  best_ = agreement(query_->status());
  never_ = agreement(std::vector<std::uint8_t>(n, 0));
}

// Formula (6) of the paper.
Real AccuracyStudy::agreement(const std::vector<std::uint8_t> &touching) const
{
  std::size_t same = 0;
  for (std::size_t i = 0; i < truth_.size(); i++) same += (touching[i] & kFound) == truth_[i];
  return truth_.empty() ? 1 : Real(same) / truth_.size();
}

void AccuracyStudy::set_grid(const StudyLists &lists)
{
  if (has_grid_ && lists.length == of_grid_.length &&
      (lists.every_face || lists.nearest == of_grid_.nearest))
    return;
  QueryGridSettings grid;
  grid.length = lists.length;
  grid.cutoff = box_.largest;
  grid.nearest = lists.nearest;
  grid.memory_budget = settings_.memory_budget;
  const bool on_cuda = settings_.device != Device::cpu && cuda_available(nullptr);
  grid_ = QueryGrid();
  grid_ = build_grid(mesh_, grid, on_cuda);
  query_->set_grid(grid_, mesh_);
  of_grid_ = lists;
  has_grid_ = true;
}

StudyRow AccuracyStudy::measure(const StudyLists &lists)
{
  set_grid(lists);
  QuerySettings query;
  query.inside = settings_.inside;
  query.every_face = lists.every_face;

  StudyRow row;
  row.device = query_->device();
  row.triangles = mesh_.faces.size();
  row.spheres = spheres_.size();
  row.inside = settings_.inside;
  row.lists = lists;
  row.best = best_;
  row.never = never_;
  if (!lists.every_face) {
    row.build_s = grid_.report.seconds;
    row.bytes = grid_.report.bytes;
  }
  // The answer that is timed is the paper's: the status.
  query.distance = false;
  row.query = query_->time(query, lists.every_face ? 1 : settings_.repeats);
  row.upload_ms = upload_ms_;
  std::vector<std::uint8_t> status;
  row.download_ms = milliseconds([&] { status = query_->status(); });

  query.distance = true;
  query_->run(query);
  compare(row, status, query_->distance());
  std::size_t entries = 0, readers = 0;
  for (std::uint32_t n : query_->entries(query)) {
    entries += n;
    readers += n > 0;
  }
  row.entries = readers > 0 ? Real(entries) / readers : 0;
  return row;
}

void AccuracyStudy::compare(StudyRow &row, const std::vector<std::uint8_t> &status,
                            const std::vector<Real> &distance) const
{
  row.accuracy = agreement(status);
  std::vector<Real> errors;
  std::size_t certified = 0;
  for (std::size_t i = 0; i < spheres_.size(); i++) {
    certified += (status[i] & kCertified) > 0;
    const bool found = status[i] & kFound, touches = exact_[i] < spheres_[i].r;
    if (!found && !touches) continue;
    row.touching += touches;
    row.missed += touches && !found;
    row.false_ones += found && !touches;
    const Real overlap = found ? spheres_[i].r - distance[i] : 0,
               exact = touches ? spheres_[i].r - exact_[i] : 0, off = std::fabs(overlap - exact);
    row.largest_overlap_error = std::max(row.largest_overlap_error, off / box_.largest);
    if (touches) errors.push_back(off / exact);
  }
  row.certified = spheres_.empty() ? 1 : Real(certified) / spheres_.size();
  if (errors.empty()) return;
  for (Real e : errors) row.mean_force_error += e / errors.size();
  const auto middle = errors.begin() + errors.size() / 2;
  std::nth_element(errors.begin(), middle, errors.end());
  row.median_force_error = *middle;
}

}    // namespace lsdcd
