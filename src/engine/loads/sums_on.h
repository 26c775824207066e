// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What engines add up by feature in memory of a backend: loads, and what becomes of energy.
#pragma once

#include "backend/backend.h"
#include "engine/loads/energy_engine.h"
#include "engine/loads/feature_sums.h"
#include "engine/loads/load.h"
#include "engine/nodes/node_forces.h"

#include <vector>

namespace lsdcd {

// The items of loads (feature_sums.h): candidates, each with its contacts.
struct LoadItems {
  NodeContacts of;
  LoadOf row;

  LSDCD_FN std::size_t n() const { return of.n; }
  LSDCD_FN int count(std::size_t k) const { return of.count(k); }
  LSDCD_FN const StepContact &at(std::size_t k, int c) const
  {
    return of.contacts[of.first_contact[k] + c];
  }
  LSDCD_FN void note(const StepContact &) const {}
};

// The items of energy: places for records of all meshes, each with one record of this mesh or none. Impacts go into their spectrum,
// too.
struct EnergyItems {
  const EnergyRecord *records;
  std::size_t room;
  const int *n_records;
  std::uint32_t mesh;
  ImpactBins bins;
  PlaceEnergyOf row;

  LSDCD_FN std::size_t n() const { return room; }
  LSDCD_FN int count(std::size_t k) const
  {
    return k < static_cast<std::size_t>(*n_records) && records[k].mesh == mesh;
  }
  LSDCD_FN const EnergyRecord &at(std::size_t k, int) const { return records[k]; }
  LSDCD_FN void note(const EnergyRecord &record) const
  {
    if (record.impact > 0) bins.add(record.impact);
  }
};

// The sums by feature of all meshes. Base: what the engine gives, FeatureEngine<Row> or a class derived from it.
template <class B, class Row, class Base = FeatureEngine<Row>>
class SumsOn : public Base {
 public:
  // The backend must outlive this object.
  SumsOn(B &b, int meshes) : b_(b), sums_(static_cast<std::size_t>(meshes)) {}

  std::vector<RowOfFeature<Row>> take(int mesh) override { return of(mesh).take(b_); }
  std::size_t bytes() const
  {
    std::size_t bytes = 0;
    for (const auto &sums : sums_) bytes += sums.bytes();
    return bytes;
  }

 protected:
  // Adds the items of a step. `wall`: the features of the mesh, with their images.
  template <class Items>
  void add_items(int mesh, const FeatureCounts &counts, const MeshFeaturesView &wall,
                 const Items &items)
  {
    of(mesh).add(b_, items, {wall, counts.faces, counts.edges}, counts.all());
  }
  std::size_t n_meshes() const { return sums_.size(); }

  B &b_;

 private:
  FeatureSums<B, Row> &of(int mesh) { return sums_.at(static_cast<std::size_t>(mesh)); }

  std::vector<FeatureSums<B, Row>> sums_;    // of each mesh
};

template <class B>
class EngineOn;

template <class B>
class LoadsOn : public SumsOn<B, Load> {
  using Sums = SumsOn<B, Load>;

 public:
  // The engine must outlive this object.
  explicit LoadsOn(EngineOn<B> &engine) : Sums(engine.b_, engine.settings_.meshes), e_(engine) {}

  void add(int mesh, const FeatureCounts &counts, Real dt) override
  {
    const NodeContacts of = e_.contacts_on(mesh);
    this->add_items(mesh, counts, of.wall, LoadItems{of, {dt, 1}});
  }

 private:
  EngineOn<B> &e_;
};

template <class B>
class EnergiesOn : public SumsOn<B, PlaceEnergy, EnergyEngine> {
  using Sums = SumsOn<B, PlaceEnergy, EnergyEngine>;
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // The engine must outlive this object.
  explicit EnergiesOn(EngineOn<B> &engine) :
      Sums(engine.b_, engine.settings_.meshes), e_(engine), bins_(this->n_meshes())
  {
  }

  void add(int mesh, const FeatureCounts &counts, Real) override
  {
    B &b = this->b_;
    if (begins_.size() == 0) begins_ = from_cpu(b, begins_of_bins());
    Array<ImpactBin> &bins = bins_.at(static_cast<std::size_t>(mesh));
    if (bins.size() == 0) bins = from_cpu(b, std::vector<ImpactBin>(kImpactBins));
    this->add_items(mesh, counts, e_.features(mesh),
                    e_.energy_items(mesh, {bins.data(), begins_.data()}));
  }
  std::vector<ImpactBin> take_bins(int mesh) override
  {
    Array<ImpactBin> &bins = bins_.at(static_cast<std::size_t>(mesh));
    std::vector<ImpactBin> taken = to_cpu(this->b_, bins, bins.size());
    put_all(this->b_, bins.data(), bins.size(), ImpactBin());
    return taken;
  }
  std::size_t bytes() const
  {
    std::size_t bytes = Sums::bytes() + begins_.size() * sizeof(Real);
    for (const Array<ImpactBin> &bins : bins_) bytes += bins.size() * sizeof(ImpactBin);
    return bytes;
  }

 private:
  EngineOn<B> &e_;
  std::vector<Array<ImpactBin>> bins_;    // of each mesh
  Array<Real> begins_;                    // of bins
};

}    // namespace lsdcd
