// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "contact/grain_rule.h"

namespace lsdcd {

void GrainRule::begin(const Superellipsoid &shape, const std::vector<SharingContact> &contacts)
{
  set_.n = static_cast<int>(contacts.size());
  set_.radius = shape.farthest;
  set_.feature.clear();
  set_.distance.clear();
  set_.normal.clear();
  set_.foot.clear();
  set_.cover.clear();
  set_.fade.assign(contacts.size(), 0);
  for (std::size_t i = 0; i < contacts.size(); i++) {
    const SharingContact &c = contacts[i];
    set_.feature.push_back(c.feature);
    set_.distance.push_back(set_.radius - c.overlap);
    set_.normal.push_back(c.normal);
    set_.foot.push_back(c.foot());
    for (std::size_t j = 0; j < i; j++) set_.cover.push_back(cover_of(shape, c, contacts[j]));
  }
}

void GrainRule::add_pass(int i, int j, Real pass)
{
  set_.fade[i] = std::fmax(set_.fade[i], fade_beside(overlap(i), overlap(j), pass));
}

void GrainRule::solve(Real tolerance, Real *weight)
{
  if (set_.n <= kFew) return few_.solve(set_, set_.radius, weight, tolerance);
  if (many_.empty()) many_.resize(1);
  many_.front().solve(set_, set_.radius, weight, tolerance);
}

}    // namespace lsdcd
