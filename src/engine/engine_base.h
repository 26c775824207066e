// What engines share: choosing spheres, repeating crowded ones, collecting.
#pragma once

#include "engine/collect.h"
#include "engine/laws.h"
#include "engine/select_near.h"

#include <string>
#include <vector>

namespace lsdcd {

// Places for contacts in the kernel: enough for nearly every sphere, and the
// sizes at which a sphere with more is done again.
constexpr int kPlaces = 8;
constexpr int kMorePlaces = 64;
constexpr int kMostPlaces = 512;

template <class Law>
class EngineBase : public WallEngine {
 public:
  EngineBase(const EngineSettings &settings, const Law &law) : settings_(settings), law_(law) {}

  const WallTotals &totals() const override { return totals_; }
  int n_touching() const override { return static_cast<int>(touching_.size()); }
  const int *touching() const override { return touching_.data(); }
  const SphereOutput *sphere_output() const override { return output_.data(); }
  int n_near() const override { return static_cast<int>(results_.near.size()); }

 protected:
  void begin(const GridView &grid, const Spheres &spheres, const StepSettings &step,
             SpringStore *springs)
  {
    spheres_ = spheres;
    springs_ = springs;
    step_ = step;
    force_settings_ = force_settings(settings_, step);
    select_near(grid, spheres, results_.near, scratch_);
  }

  // Spheres whose contacts did not fit are done again on the host with more
  // places; their springs go where the others' are. Returns the new stride.
  int redo_crowded(const GridView &grid, SphereResult *result, std::vector<Spring> &springs,
                   int stride)
  {
    for (std::size_t k = 0; k < results_.near.size(); k++) {
      if (result[k].n_contacts != kOverflow) continue;
      std::vector<Spring> more(Law::kHistory ? kMostPlaces : 0);
      const SphereState s = state_of(results_.near[k]);
      result[k] = wall_force<Law, kMorePlaces>(grid, law_, force_settings_, s, more.data());
      if (result[k].n_contacts == kOverflow)
        result[k] = wall_force<Law, kMostPlaces>(grid, law_, force_settings_, s, more.data());
      if (result[k].n_contacts == kOverflow)
        throw InputError("sphere " + std::to_string(results_.near[k]) +
                         " touches the wall in more than " + std::to_string(kMostPlaces) +
                         " separate places; the mesh is far finer than its overlap");
      if constexpr (Law::kHistory) {
        const int n = result[k].n_contacts;
        if (n > stride) {
          widen(springs, stride, n);
          stride = n;
        }
        std::copy(more.begin(), more.begin() + n, springs.begin() + k * stride);
      }
    }
    return stride;
  }

  void finish(const SphereResult *result, const Spring *springs, int stride)
  {
    results_.result = result;
    add_forces(results_, spheres_);
    totals_ = sum_totals(results_, spheres_);
    touching_.clear();
    output_.clear();
    if (step_.per_sphere) fill_sphere_output(results_, spheres_, touching_, output_);
    if constexpr (Law::kHistory) {
      if (!step_.update_history) return;
      counts_.resize(results_.near.size());
      for (std::size_t k = 0; k < counts_.size(); k++) counts_[k] = result[k].n_contacts;
      springs_->replace(results_.near.data(), n_near(), counts_.data(), springs, stride);
    }
  }

  SphereState state_of(int i) const
  {
    const auto at = [i](const Real *a) { return Vec3{a[3 * i], a[3 * i + 1], a[3 * i + 2]}; };
    SphereState s = {at(spheres_.x),
                     at(spheres_.v),
                     at(spheres_.omega),
                     spheres_.radius[i],
                     spheres_.mass[i],
                     nullptr,
                     0};
    if constexpr (Law::kHistory) {
      s.springs = springs_->of(i);
      s.n_springs = springs_->count(i);
    }
    return s;
  }

  std::size_t shared_bytes() const
  {
    return (results_.near.capacity() + scratch_.capacity()) * sizeof(int) +
           counts_.capacity() * sizeof(int) + touching_.capacity() * sizeof(int) +
           output_.capacity() * sizeof(SphereOutput);
  }

  EngineSettings settings_;
  Law law_;
  Spheres spheres_;
  StepSettings step_;
  ForceSettings force_settings_;
  SpringStore *springs_ = nullptr;
  StepResults results_;

 private:
  static void widen(std::vector<Spring> &springs, int from, int to)
  {
    const std::size_t n = springs.size() / from;
    std::vector<Spring> wide(n * to);
    for (std::size_t k = 0; k < n; k++)
      std::copy(springs.begin() + k * from, springs.begin() + (k + 1) * from,
                wide.begin() + k * to);
    springs.swap(wide);
  }

  WallTotals totals_;
  std::vector<int> touching_, counts_, scratch_;
  std::vector<SphereOutput> output_;
};

}    // namespace lsdcd
