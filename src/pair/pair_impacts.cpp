// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "pair/pair_impacts.h"

#include "base/state_blocks.h"
#include "pair/partners.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lsdcd {

namespace {

constexpr int kContactNumbers = 10;

}    // namespace

template <class Act>
void StepImpacts::for_contacts(const Act &act) const
{
  auto next = begun_.begin();
  for_pairs(step_.list, *step_.history, [&](int i, int j, std::size_t pair) {
    const bool begins = next != begun_.end() && *next == pair;
    if (begins) ++next;
    act(i, j, begins);
  });
}

StepImpacts::StepImpacts(const PairJob &step, Name name) : step_(step), name_(std::move(name))
{
  constexpr Real kSteps = 1.5;    // as at walls: speeds change on the way
  const PairHistory &before = *step.old, &now = *step.history;
  std::size_t last = 0;
  for_pairs(step.list, now, [&](int i, int j, std::size_t pair) {
    const std::size_t key = now.key(pair);
    while (last < before.size() && before.key(last) < key) last++;
    if (last < before.size() && before.key(last) == key) return;
    // A grain that was put into overlap is deeper than it can have come in this step.
    const Strike strike = seen_by(i, j, true).strike;
    if (strike.speed > 0 && strike.overlap <= kSteps * step.dt * strike.speed)
      begun_.push_back(pair);
  });
}

StepImpacts::ContactOfGrain StepImpacts::seen_by(int grain, int other, bool begins) const
{
  const GrainPair p = grain_pair(step_, grain, other, true);
  const Real distance = std::sqrt(p.distance_sq);
  ContactOfGrain c = {};
  c.grain = grain;
  c.begins = begins;
  c.strike.normal = (1 / distance) * p.offset;
  c.strike.speed = -dot(p.velocity, c.strike.normal);
  c.strike.overlap = p.radius_i + p.radius_j - distance;
  c.mass = p.mass;
  const bool is_frozen = step_.mask && (step_.mask[grain] & step_.frozen);
  c.share = is_frozen ? 0 : p.mass / p.mass_i;
  c.is_here = other < step_.n_own;
  std::tie(c.types[0], c.types[1]) = std::minmax(step_.type[grain], step_.type[other]);
  return c;
}

KeptRows StepImpacts::contacts_of_copies(int n_all) const
{
  KeptRows rows(kContactNumbers);
  rows.grow(n_all);
  for_contacts([&](int i, int j, bool begins) {
    if (j < step_.n_own) return;
    const ContactOfGrain c = seen_by(j, i, begins);
    Real *to = rows.add(j, 1);
    for (const Real number : {static_cast<Real>(name_(i)), c.strike.normal.x, c.strike.normal.y,
                              c.strike.normal.z, c.strike.speed, c.share, static_cast<Real>(begins),
                              c.mass, static_cast<Real>(c.types[0]), static_cast<Real>(c.types[1])})
      *to++ = number;
  });
  return rows;
}

std::vector<HalfImpact> StepImpacts::halves(const KeptRows *from_others, std::size_t &n_here) const
{
  std::vector<char> is_struck(static_cast<std::size_t>(step_.n_own), 0);
  std::vector<ContactOfGrain> contacts;
  for (int i = 0; from_others && i < step_.n_own; i++)
    for (int k = 0; k < from_others->count(i); k++) {
      const Real *const from = from_others->row(i, k);
      ContactOfGrain c = {};
      c.grain = i;
      c.partner = static_cast<std::int64_t>(from[0]);
      c.strike = {{from[1], from[2], from[3]}, from[4], 0};
      c.share = from[5];
      c.begins = from[6] != 0;
      c.mass = from[7];
      c.types[0] = static_cast<std::int32_t>(from[8]);
      c.types[1] = static_cast<std::int32_t>(from[9]);
      if (c.begins) is_struck[i] = 1;
      contacts.push_back(c);
    }
  if (any())
    for_contacts([&](int i, int j, bool begins) {
      if (!begins) return;
      is_struck[i] = 1;
      if (j < step_.n_own) is_struck[j] = 1;
    });
  contacts.erase(std::remove_if(contacts.begin(), contacts.end(),
                                [&](const ContactOfGrain &c) { return !is_struck[c.grain]; }),
                 contacts.end());
  if (any() || !contacts.empty())
    for_contacts([&](int i, int j, bool begins) {
      for (const auto &[grain, other] : {std::make_pair(i, j), std::make_pair(j, i)})
        if (grain < step_.n_own && is_struck[grain]) {
          contacts.push_back(seen_by(grain, other, begins));
          contacts.back().partner = name_(other);
        }
    });

  // Of each grain the contacts that touch already come first, then those that begin; of either the fastest.
  std::sort(contacts.begin(), contacts.end(), [](const ContactOfGrain &a, const ContactOfGrain &b) {
    return std::make_tuple(a.grain, a.begins, -a.strike.speed, a.partner) <
           std::make_tuple(b.grain, b.begins, -b.strike.speed, b.partner);
  });
  std::vector<HalfImpact> here, apart;
  TakenAway taken;
  for (std::size_t k = 0; k < contacts.size(); k++) {
    const ContactOfGrain &c = contacts[k];
    if (k == 0 || c.grain != contacts[k - 1].grain) taken = TakenAway();
    const Real left = taken.speed_left(c.strike);
    if (c.begins)
      (c.is_here ? here : apart)
          .push_back({name_(c.grain),
                      c.partner,
                      {c.types[0], c.types[1]},
                      c.strike.speed,
                      c.strike.speed - left,
                      c.mass});
    // What is left of a strike at this speed is the share of what is left of the contact's.
    taken.take({c.strike.normal, c.strike.speed - (1 - c.share) * left, 0});
  }
  n_here = here.size();
  here.insert(here.end(), apart.begin(), apart.end());
  return here;
}

// ---- spectra -----------------------------------------------------------------------------

bool PairSpectra::set(Real least_speed, Real velocity_unit)
{
  const bool differs = least_speed != least_speed_, forgets = differs && !all_.empty();
  if (differs) all_.clear();
  least_speed_ = least_speed;
  velocity_unit_ = velocity_unit;
  return forgets;
}

void PairSpectra::add(std::vector<HalfImpact> &halves)
{
  // A pair that touches two images of a grain has several contacts, whose speeds tell which halves belong together.
  std::sort(halves.begin(), halves.end(), [](const HalfImpact &a, const HalfImpact &b) {
    return std::make_tuple(a.names(), a.speed, a.grain) <
           std::make_tuple(b.names(), b.speed, b.grain);
  });
  for (std::size_t k = 0; k < halves.size(); k++) {
    const HalfImpact &half = halves[k];
    Real taken = half.taken;
    if (k + 1 < halves.size() && halves[k + 1].names() == half.names())
      taken += halves[++k].taken;
    else if (half.grain > half.partner)
      continue;
    const Real speed = half.speed - taken;
    if (speed > least_speed_)
      all_[{half.types[0], half.types[1]}].add(0.5 * half.mass * speed * speed / velocity_unit_);
  }
}

PairSpectra PairSpectra::summed(Host &host, int n_types) const
{
  std::vector<Types> types;
  std::vector<Real> has_any;
  for (int i = 1; i <= n_types; i++)
    for (int j = i; j <= n_types; j++) {
      types.emplace_back(i, j);
      has_any.push_back(all_.count({i, j}) ? 1 : 0);
    }
  host.max(has_any.data(), static_cast<int>(has_any.size()));
  PairSpectra sum;
  sum.least_speed_ = least_speed_;
  sum.velocity_unit_ = velocity_unit_;
  for (std::size_t k = 0; k < types.size(); k++) {
    if (has_any[k] == 0) continue;
    const auto mine = all_.find(types[k]);
    std::vector<Real> numbers = (mine == all_.end() ? ImpactSpectrum() : mine->second).packed();
    host.sum(numbers.data(), static_cast<int>(numbers.size()));
    sum.all_[types[k]].unpack(numbers);
  }
  return sum;
}

std::size_t PairSpectra::bytes() const
{
  return all_.size() * kImpactBins * sizeof(ImpactBin);
}

PairSpectra::Saved PairSpectra::saved() const
{
  Saved saved = {least_speed_, {}};
  for (const auto &[types, spectrum] : all_)
    saved.spectra.push_back({types.first, types.second, spectrum.packed()});
  return saved;
}

void PairSpectra::restore(const Saved &saved)
{
  least_speed_ = saved.least_speed;
  all_.clear();
  for (const Packed &of : saved.spectra) {
    if (of.numbers.size() != ImpactSpectrum::kPacked)
      throw StateError("the impacts between grains of types " + std::to_string(of.type_i) +
                       " and " + std::to_string(of.type_j) + " are no spectrum");
    all_[{of.type_i, of.type_j}].unpack(of.numbers);
  }
}

}    // namespace lsdcd
