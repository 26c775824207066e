#include "engine/engine_base.h"

#include "engine/choose/select_near.h"
#include "engine/results/sphere_error.h"

#include <algorithm>
#include <string>

namespace lsdcd {

SearchSettings search_settings(const EngineSettings &engine)
{
  SearchSettings s;
  s.blend = engine.corner == Corner::blend;
  s.side = engine.side == Side::both ? 0 : (engine.side == Side::out ? 1 : -1);
  return s;
}

ForceSettings force_settings(const EngineSettings &engine, const StepSettings &step)
{
  ForceSettings s;
  s.dt = step.dt;
  s.update = step.update_history;
  s.search = search_settings(engine);
  s.with_point = step.per_sphere;
  s.wall_temperature = step.wall_temperature;
  s.surface = engine.surface;
  s.wear = engine.wear;
  return s;
}

namespace {

// The same rows, further apart.
template <class T>
void widen(std::vector<T> &rows, std::size_t from, std::size_t to)
{
  if (from == 0) return;
  const std::size_t n = rows.size() / from;
  std::vector<T> wide(n * to);
  for (std::size_t k = 0; k < n; k++)
    std::copy(rows.begin() + k * from, rows.begin() + (k + 1) * from, wide.begin() + k * to);
  rows.swap(wide);
}

}    // namespace

EngineBase::EngineBase(const EngineSettings &settings) :
    settings_(settings), law_(host_law(settings))
{
}

void EngineBase::begin(const GridView &grid, const Spheres &spheres, const StepSettings &step,
                       SpringStore *springs)
{
  spheres_ = spheres;
  springs_ = springs;
  step_ = step;
  force_settings_ = force_settings(settings_, step);
  select_near(grid, spheres, settings_.law.pull_off(), results_.near, scratch_);
}

LawJob EngineBase::host_job(const GridView &grid, SphereResult *result,
                            const SphereSink &sink) const
{
  LawJob job = job_of(grid, force_settings_, spheres_);
  job.near = results_.near.data();
  if (springs_) job.springs = springs_->view();
  return_results(job, result);
  job.sink = sink;
  return job;
}

int EngineBase::redo_crowded(const LawJob &job, std::vector<Spring> &springs,
                             std::vector<Real> &extra, std::vector<ContactRecord> &records)
{
  const std::size_t n_extra = law_.traits.n_extra;
  int stride = kPlaces;
  for (std::size_t k = 0; k < results_.near.size(); k++) {
    if (job.result[k].n_contacts != kOverflow) continue;
    std::vector<Spring> more(law_.traits.history ? kMostPlaces : 0);
    std::vector<Real> more_extra(more.size() * n_extra);
    std::vector<ContactRecord> more_records(law_.traits.records ? kMostPlaces : 0);
    SphereSink sink = {more.data(), more_extra.data(), nullptr, more_records.data()};
    if (law_.traits.heat) sink.heat = job.sink.heat + k;
    if (!law_.redo(law_.law, job, k, sink))
      throw SphereError(results_.near[k],
                        "touches the wall in more than " + std::to_string(kMostPlaces) +
                            " separate places; the mesh is far finer than its overlap");
    if (!law_.traits.history && !law_.traits.records) continue;
    const int n = job.result[k].n_contacts;
    if (n > stride) {
      widen(springs, stride, n);
      widen(extra, stride * n_extra, n * n_extra);
      widen(records, stride, n);
      stride = n;
    }
    if (law_.traits.history) {
      std::copy(more.begin(), more.begin() + n, springs.begin() + k * stride);
      std::copy(more_extra.begin(), more_extra.begin() + n * n_extra,
                extra.begin() + k * stride * n_extra);
    }
    if (law_.traits.records)
      std::copy(more_records.begin(), more_records.begin() + n, records.begin() + k * stride);
  }
  return stride;
}

void EngineBase::finish(const SphereResult *result, const SphereSink &sink, int stride)
{
  results_.result = result;
  results_.heat = law_.traits.heat ? sink.heat : nullptr;
  add_forces(results_, spheres_);
  totals_ = sum_totals(results_, spheres_);
  touching_.clear();
  output_.clear();
  heat_.clear();
  if (step_.per_sphere) fill_sphere_output(results_, spheres_, touching_, output_, heat_);
  records_.clear();
  if (law_.traits.records) keep_records(result, sink.records, stride);
  if (!law_.traits.history || !step_.update_history) return;
  counts_.resize(results_.near.size());
  for (std::size_t k = 0; k < counts_.size(); k++) counts_[k] = result[k].n_contacts;
  springs_->replace(results_.near.data(), n_near(), counts_.data(), sink.springs, sink.extra,
                    stride);
}

void EngineBase::keep_records(const SphereResult *result, const ContactRecord *records, int stride)
{
  std::size_t packed = 0;
  for (std::size_t k = 0; k < results_.near.size(); k++) {
    const std::size_t n = result[k].n_contacts;
    const ContactRecord *from = records + (stride == kPacked ? packed : k * stride);
    records_.insert(records_.end(), from, from + n);
    packed += n;
  }
}

std::size_t EngineBase::shared_bytes() const
{
  return (results_.near.capacity() + scratch_.capacity()) * sizeof(int) +
         counts_.capacity() * sizeof(int) + touching_.capacity() * sizeof(int) +
         output_.capacity() * sizeof(SphereOutput) + heat_.capacity() * sizeof(Real) +
         records_.capacity() * sizeof(ContactRecord);
}

}    // namespace lsdcd
