// What engines share: choosing spheres, repeating crowded ones, collecting.
#pragma once

#include "engine/results/collect.h"
#include "engine/force/host_law.h"

#include <vector>

namespace lsdcd {

SearchSettings search_settings(const EngineSettings &engine);
ForceSettings force_settings(const EngineSettings &engine, const StepSettings &step);

class EngineBase : public WallEngine {
 public:
  explicit EngineBase(const EngineSettings &settings);

  const WallTotals &totals() const override { return totals_; }
  int n_touching() const override { return static_cast<int>(touching_.size()); }
  const int *touching() const override { return touching_.data(); }
  const SphereOutput *sphere_output() const override { return output_.data(); }
  const Real *sphere_heat() const override { return law_.traits.heat ? heat_.data() : nullptr; }
  int n_records() const override { return static_cast<int>(records_.size()); }
  const ContactRecord *records() const override { return records_.data(); }
  int n_near() const override { return static_cast<int>(results_.near.size()); }

 protected:
  // Chooses the spheres near the wall.
  void begin(const GridView &grid, const Spheres &spheres, const StepSettings &step,
             SpringStore *springs);

  LawJob host_job(const GridView &grid, SphereResult *result, const SphereSink &sink) const;

  // Spheres whose contacts did not fit are done again on the host with more places; what
  // they keep goes where the others' is. Returns the new stride of the vectors, in
  // contacts.
  int redo_crowded(const LawJob &job, std::vector<Spring> &springs, std::vector<Real> &extra,
                   std::vector<ContactRecord> &records);

  // The contacts of two spheres are `stride` places apart in the sink's arrays.
  void finish(const SphereResult *result, const SphereSink &sink, int stride);

  std::size_t shared_bytes() const;

  EngineSettings settings_;
  HostLaw law_;
  Spheres spheres_;
  StepSettings step_;
  ForceSettings force_settings_;
  SpringStore *springs_ = nullptr;
  StepResults results_;

 private:
  void keep_records(const SphereResult *result, const ContactRecord *records, int stride);

  WallTotals totals_;
  std::vector<int> touching_, counts_, scratch_;
  std::vector<SphereOutput> output_;
  std::vector<Real> heat_;    // of touching_
  std::vector<ContactRecord> records_;
};

}    // namespace lsdcd
