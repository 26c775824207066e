// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The arrays of a view in one list: View::each_array(s, visit) calls visit() with each array of `s`, which is a
// View with its pointers or their owner with vectors of the same names.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace lsdcd {

template <class T>
std::size_t array_bytes(const std::vector<T> &a)
{
  return a.size() * sizeof(T);
}

template <class View>
constexpr int count_arrays()
{
  View view = {};
  int n = 0;
  View::each_array(view, [&](auto &) { n++; });
  return n;
}

// Points the arrays of a view to `at`, one after another.
template <class View>
void point(View &view, const void *const *at)
{
  View::each_array(view, [&](auto *&pointer) {
    pointer = static_cast<std::remove_reference_t<decltype(pointer)>>(*at++);
  });
}

// Points the arrays of a view to those of their owner; null where one is empty.
template <class View, class Owner>
void point_to(View &view, const Owner &owner)
{
  const void *at[count_arrays<View>()];
  int i = 0;
  View::each_array(owner, [&](const auto &a) { at[i++] = a.empty() ? nullptr : a.data(); });
  point(view, at);
}

}    // namespace lsdcd
