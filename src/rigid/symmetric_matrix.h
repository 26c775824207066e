// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Symmetric matrices: inertia tensors, and the eigenvalues of these and of larger ones.
#pragma once

#include "base/vec3.h"

#include <cmath>

namespace lsdcd {

// Elements of a tensor; xy is the element itself, - integral of x y for an inertia.
struct SymmetricMatrix {
  Real xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  Real trace() const { return xx + yy + zz; }
  LSDCD_FN Vec3 operator*(const Vec3 &a) const
  {
    return {xx * a.x + xy * a.y + xz * a.z, xy * a.x + yy * a.y + yz * a.z,
            xz * a.x + yz * a.y + zz * a.z};
  }
  SymmetricMatrix &operator+=(const SymmetricMatrix &b)
  {
    xx += b.xx;
    yy += b.yy;
    zz += b.zz;
    xy += b.xy;
    xz += b.xz;
    yz += b.yz;
    return *this;
  }
};

inline SymmetricMatrix operator*(Real s, const SymmetricMatrix &a)
{
  return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.xz, s * a.yz};
}

// a a'
inline SymmetricMatrix outer_square(const Vec3 &a)
{
  return {a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.x * a.z, a.y * a.z};
}

inline SymmetricMatrix unit_matrix()
{
  return {1, 1, 1, 0, 0, 0};
}

// Returns the inertia of a unit mass at d about the origin: d.d - d d'.
inline SymmetricMatrix inertia_of_point(const Vec3 &d)
{
  SymmetricMatrix m = norm_sq(d) * unit_matrix();
  m += -1 * outer_square(d);
  return m;
}

// Jacobi's method: a symmetric matrix becomes diagonal, and columns of `vectors` its eigenvectors, of length 1. Golub
// and Van Loan, Matrix Computations, section 8.5.
template <int N>
void diagonalise(Real (&a)[N][N], Real (&vectors)[N][N])
{
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) vectors[i][j] = i == j;
  for (int sweep = 0; sweep < 50; sweep++) {
    bool any = false;
    for (int p = 0; p < N; p++)
      for (int q = p + 1; q < N; q++) {
        // Below this the rotation changes no bit of the diagonal.
        if (std::fabs(a[p][q]) <= 1e-17 * std::sqrt(std::fabs(a[p][p] * a[q][q]))) continue;
        any = true;
        const Real theta = (a[q][q] - a[p][p]) / (2 * a[p][q]),
                   t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::hypot(theta, Real(1))),
                   c = 1 / std::hypot(t, Real(1)), s = t * c;
        for (int k = 0; k < N; k++) {
          const Real at_p = a[k][p], at_q = a[k][q];
          a[k][p] = c * at_p - s * at_q;
          a[k][q] = s * at_p + c * at_q;
        }
        for (int k = 0; k < N; k++) {
          const Real at_p = a[p][k], at_q = a[q][k];
          a[p][k] = c * at_p - s * at_q;
          a[q][k] = s * at_p + c * at_q;
        }
        a[p][q] = a[q][p] = 0;
        for (int k = 0; k < N; k++) {
          const Real at_p = vectors[k][p], at_q = vectors[k][q];
          vectors[k][p] = c * at_p - s * at_q;
          vectors[k][q] = s * at_p + c * at_q;
        }
      }
    if (!any) return;
  }
}

struct PrincipalAxes {
  Real value[3];
  Vec3 axis[3];    // right-handed
};

inline PrincipalAxes principal_axes(const SymmetricMatrix &m)
{
  Real a[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}, v[3][3];
  diagonalise(a, v);
  PrincipalAxes p;
  for (int k = 0; k < 3; k++) {
    p.value[k] = a[k][k];
    p.axis[k] = {v[0][k], v[1][k], v[2][k]};
  }
  p.axis[2] = cross(p.axis[0], p.axis[1]);
  return p;
}

// f(matrix), for a function of its eigenvalues.
template <class Function>
SymmetricMatrix function_of(const SymmetricMatrix &m, const Function &f)
{
  const PrincipalAxes p = principal_axes(m);
  SymmetricMatrix out;
  for (int k = 0; k < 3; k++) out += f(p.value[k]) * outer_square(p.axis[k]);
  return out;
}

}    // namespace lsdcd
