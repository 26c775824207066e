// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers of many spheres in memory of any layout, borrowed; on the CPU or on a device.
#pragma once

#include "base/vec3.h"

#include <cstddef>

namespace lsdcd {

// One number a sphere, `step` numbers apart.
template <class T>
struct Column {
  T *at = nullptr;
  std::ptrdiff_t step = 1;

  LSDCD_FN T &operator[](std::size_t i) const { return at[static_cast<std::ptrdiff_t>(i) * step]; }
};

// One three-vector a sphere. A pointer stands for x y z x y z.
template <class T>
struct StridedView {
  T *at = nullptr;
  std::ptrdiff_t row = 3;       // from one sphere to the next
  std::ptrdiff_t column = 1;    // from one component to the next

  StridedView() = default;
  StridedView(T *packed) : at(packed) {}
  StridedView(T *first, std::ptrdiff_t row, std::ptrdiff_t column) :
      at(first), row(row), column(column)
  {
  }
  // To what may only be read.
  template <class U>
  StridedView(const StridedView<U> &rows) : at(rows.at), row(rows.row), column(rows.column)
  {
  }

  LSDCD_FN T *of(std::size_t i) const { return at + static_cast<std::ptrdiff_t>(i) * row; }
  LSDCD_FN Vec3 operator[](std::size_t i) const
  {
    const T *p = of(i);
    return {p[0], p[column], p[2 * column]};
  }
  LSDCD_FN void put(std::size_t i, const Vec3 &v) const
  {
    T *p = of(i);
    p[0] = v.x;
    p[column] = v.y;
    p[2 * column] = v.z;
  }
  LSDCD_FN void add(std::size_t i, const Vec3 &v) const { put(i, (*this)[i] + v); }
};

}    // namespace lsdcd
