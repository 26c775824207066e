#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Adds `rolling plastic K MU` to copies of the files that doc/design.md names, as it tells.

usage: rolling_model.py SRC OUT     the sources, and where the two changed files go

It takes two files: the formula in the header of its family, and the row.
"""
import sys

from edit_copy import edit_copy

FORMULA = """\
// `plastic` K MU: a contact torque that grows by K per angle rolled, up to MU |F| R.
struct PlasticRolling {
  static constexpr RollingModel kModel = RollingModel::plastic;
  static constexpr bool kStoresVector = true;

  template <class Memory>
  LSDCD_FN static Vec3 contact_torque(const Real *n, const RollingInput &in, Memory &m, int at)
  {
    const Contact &c = in.contact;
    Vec3 held = m.vec(at);
    if (c.update) held -= (n[0] * c.dt) * rolling_part(c.omega, c.normal);
    const Real size = norm(held), limit = n[1] * in.limit * c.radius;
    if (size > limit) held = (limit / size) * held;
    m.put(at, held);
    return held;
  }
  template <class Memory>
  LSDCD_FN static Real energy(const Real *n, const RollingInput &, const Memory &m, int at)
  {
    return 0.5 * norm_sq(m.vec(at)) / n[0];
  }
};

"""
ROW = """\
      {F::rolling, "plastic", at(R::plastic), kGranular,
       {{"K", "torque/angle", kAboveZero}, {"MU", "1"}}, copied, {"plastic torque", 3},
       "plastic rolling", "torque up to a limit"},
"""
EDITS = {
    "law/submodels/rolling.h": [
        ("enum class RollingModel { none, sds, cdt, epsd2 };",
         "enum class RollingModel { none, sds, cdt, epsd2, plastic };"),
        ("// ---- the family ", FORMULA + "// ---- the family "),
        ("using GranularRolling = Rolling<SdsRolling>;",
         "using GranularRolling = Rolling<SdsRolling, PlasticRolling>;")],
    "law/sub_models.cpp": [("      {F::rolling, \"cdt\"", ROW + "      {F::rolling, \"cdt\"")],
}


def main():
    src, out = sys.argv[1:]
    for path, edits in EDITS.items():
        edit_copy(src, out, path, edits)


if __name__ == "__main__":
    main()
