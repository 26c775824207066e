#include "law/contact_slope.h"

#include "law/submodels/damping.h"
#include "law/submodels/normal.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kHertzSlope = 1.5;    // tangent over secant stiffness

ContactSlope classic_slope(const ContactLaw &law, Real overlap, Real radius, Real mass)
{
  const bool hertz = law.style == LawStyle::hertz_history;
  const Real scale = hertz ? std::sqrt(radius * overlap) : 1;
  return {scale * std::max((hertz ? kHertzSlope : 1) * law.k_normal, law.k_tangent),
          scale * mass * std::max(law.gamma_normal, law.gamma_tangent)};
}

ContactSlope granular_slope(const GranularLaw &law, Real overlap, Real radius, Real mass)
{
  Contact<Real> c = {};
  c.overlap = overlap;
  c.radius = radius;
  c.mass = mass;
  const Real a = law.normal == NormalModel::jkr
                     ? JkrNormal<Real>(law.modulus, law.cohesion).contact_radius(c)
                     : std::sqrt(overlap * radius);
  const Real k = law.normal == NormalModel::hooke ? law.k_normal : kHertzSlope * law.k_normal * a;
  Real kt = 0;
  if (law.tangential == TangentialModel::linear_history) kt = law.k_tangent;
  if (law.tangential >= TangentialModel::mindlin) kt = law.k_tangent * a;
  const Real damping = GranularDamping<Real>{law.damping, law.eta}.coefficient(c, a, k * overlap);
  return {std::max(k, kt), damping * std::max(Real(1), law.x_tangent)};
}

}    // namespace

ContactSlope contact_slope(const ContactLaw &law, Real overlap, Real radius, Real mass)
{
  return law.style == LawStyle::granular ? granular_slope(law.granular, overlap, radius, mass)
                                         : classic_slope(law, overlap, radius, mass);
}

Real pull_off_slope(const ContactLaw &law, Real radius)
{
  const bool jkr = law.is(NormalModel::jkr);
  if (!jkr && !law.is(NormalModel::dmt)) return 0;
  const Real pi = 3.14159265358979323846,
             pull = (jkr ? 3 : 4) * pi * law.granular.cohesion * radius,
             overlap = std::pow(pull / (law.granular.k_normal * std::sqrt(radius)), 2. / 3);
  return contact_slope(law, overlap, radius, 1).stiffness / pull;
}

}    // namespace lsdcd
