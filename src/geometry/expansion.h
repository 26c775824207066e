// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers without rounding, for signs that must be exact.
#pragma once

#include "base/real.h"

#include <cmath>
#include <vector>

namespace lsdcd {

// Adds a to n terms of a sum that do not overlap, the largest last (Shewchuk 1997, grow-expansion).
// There must be room for one more. Returns how many terms there are then, without those that are 0.
LSDCD_FN int grow_expansion(Real *terms, int n, Real a)
{
  int kept = 0;
  for (int k = 0; k < n; k++) {
    const Real sum = a + terms[k], of_term = sum - a;
    const Real lost = (a - (sum - of_term)) + (terms[k] - of_term);
    if (lost != 0) terms[kept++] = lost;
    a = sum;
  }
  if (a != 0) terms[kept++] = a;
  return kept;
}

// The sum of such terms. Sums and products are exact as long as no term leaves the range of Real.
class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(Real a) { add(a); }

  void add(Real a)
  {
    const int n = static_cast<int>(terms_.size());
    terms_.resize(n + 1);
    terms_.resize(grow_expansion(terms_.data(), n, a));
  }
  void add_product(Real a, Real b)
  {
    const Real product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign() const { return terms_.empty() ? 0 : (terms_.back() > 0 ? 1 : -1); }

  friend Expansion operator+(Expansion a, const Expansion &b)
  {
    for (const Real term : b.terms_) a.add(term);
    return a;
  }
  friend Expansion operator-(Expansion a, const Expansion &b)
  {
    for (const Real term : b.terms_) a.add(-term);
    return a;
  }
  friend Expansion operator*(const Expansion &a, const Expansion &b)
  {
    Expansion product;
    for (const Real s : a.terms_)
      for (const Real t : b.terms_) product.add_product(s, t);
    return product;
  }

 private:
  std::vector<Real> terms_;
};

// An Expansion with room for a fixed number of terms, for any backend.
template <int kRoom>
class FixedExpansion {
 public:
  LSDCD_FN FixedExpansion() : n_(0) {}
  // a - b
  LSDCD_FN FixedExpansion(Real a, Real b) : n_(0)
  {
    add(a);
    add(-b);
  }

  LSDCD_FN void add(Real a) { n_ = grow_expansion(terms_, n_, a); }
  LSDCD_FN int sign() const { return n_ == 0 ? 0 : (terms_[n_ - 1] > 0 ? 1 : -1); }

  template <int kOther>
  LSDCD_FN FixedExpansion<kRoom + kOther> plus(const FixedExpansion<kOther> &b) const
  {
    FixedExpansion<kRoom + kOther> sum;
    for (int k = 0; k < n_; k++) sum.add(terms_[k]);
    for (int k = 0; k < b.n_; k++) sum.add(b.terms_[k]);
    return sum;
  }
  template <int kOther>
  LSDCD_FN FixedExpansion<2 * kRoom * kOther> times(const FixedExpansion<kOther> &b,
                                                    Real sign = 1) const
  {
    FixedExpansion<2 * kRoom * kOther> product;
    for (int i = 0; i < n_; i++)
      for (int k = 0; k < b.n_; k++) {
        const Real s = sign * terms_[i], high = s * b.terms_[k];
        product.add(std::fma(s, b.terms_[k], -high));
        product.add(high);
      }
    return product;
  }

 private:
  template <int kOther>
  friend class FixedExpansion;

  Real terms_[kRoom];
  int n_;
};

}    // namespace lsdcd
