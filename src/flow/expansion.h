// Numbers without rounding, for signs that rounding must not decide.
#pragma once

#include "base/real.h"

#include <cmath>
#include <vector>

namespace lsdcd {

// A sum of terms that do not overlap, the largest last (Shewchuk 1997, grow-expansion). Sums and
// products are exact as long as no term leaves the range of Real.
class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(Real a) { add(a); }

  void add(Real a)
  {
    std::size_t kept = 0;
    for (const Real term : terms_) {
      const Real sum = a + term, of_term = sum - a;
      const Real lost = (a - (sum - of_term)) + (term - of_term);
      if (lost != 0) terms_[kept++] = lost;
      a = sum;
    }
    terms_.resize(kept);
    if (a != 0) terms_.push_back(a);
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

}    // namespace lsdcd
