# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The recipe 'Adding a normal law' of doc/design.md, followed: the normal sub-model stiffening, a force k d (1 + d/R) of an
overlap d.

EDITS has the files in the order of the recipe, each with pieces of it and what stands in their place.
"""

EDITS = {
    "src/law/submodels/normal.h": [
        # Its name.
        ("""\
  thornton
};
""", """\
  thornton,
  stiffening
};
"""),
        # It does not pull, and no damping is known that returns a restitution.
        ("""\
    case NormalModel::dmt:
    case NormalModel::jkr:
      return {true, 0};
""", """\
    case NormalModel::dmt:
    case NormalModel::jkr:
      return {true, 0};
    case NormalModel::stiffening:
      return {false, 0};
"""),
        # Its formulas.
        ("""\
    if (!uses_contact_radius()) return k * c.overlap;
""", """\
    if (model == NormalModel::stiffening) return k * c.overlap * (1 + c.overlap / c.radius);
    if (!uses_contact_radius()) return k * c.overlap;
"""),
        ("""\
  LSDCD_FN Real secant(const Contact &, Real a) const { return uses_contact_radius() ? a * k : k; }
  LSDCD_FN Real tangent(const Contact &, Real a) const
  {
    return uses_contact_radius() ? a * (1.5 * k) : k;
""", """\
  LSDCD_FN Real secant(const Contact &c, Real a) const
  {
    if (model == NormalModel::stiffening) return k * (1 + c.overlap / c.radius);
    return uses_contact_radius() ? a * k : k;
  }
  LSDCD_FN Real tangent(const Contact &c, Real a) const
  {
    if (model == NormalModel::stiffening) return k * (1 + 2 * c.overlap / c.radius);
    return uses_contact_radius() ? a * (1.5 * k) : k;
"""),
        ("""\
    if (!uses_contact_radius()) return 0.5 * k * c.overlap * c.overlap;
""", """\
    if (model == NormalModel::stiffening)
      return 0.5 * k * c.overlap * c.overlap * (1 + 2 * c.overlap / (3 * c.radius));
    if (!uses_contact_radius()) return 0.5 * k * c.overlap * c.overlap;
"""),
    ],
    "src/law/submodels/plastic.h": [
        ("""\
                TouchingModel<NormalModel::dmt>>;
""", """\
                TouchingModel<NormalModel::dmt>, TouchingModel<NormalModel::stiffening>>;
"""),
    ],
    "src/law/sub_models.cpp": [
        ("""\
      {F::normal, "hertz", at(N::hertz), """, """\
      {F::normal, "stiffening", at(N::stiffening), {kStiffness, kEtaAlone}, set_stiffness<N::stiffening>,
       kNothing, "stiffening spring", "spring that stiffens with the overlap"},
      {F::normal, "hertz", at(N::hertz), """),
    ],
    "src/effects/effect_cases.cpp": [
        ("""\
  add("hertz", "granular hertz, """, """\
  add("stiffening", "granular stiffening", "granular hooke", normal(NormalModel::stiffening));
  add("hertz", "granular hertz, """),
    ],
    "doc/contact_laws.rst": [
        ("""\
   "granular hertz kn eta|e", """, """\
   "granular stiffening kn eta", "kn: force/length, eta: of the damping", "", "spring that stiffens with the overlap"
   "granular hertz kn eta|e", """),
        ("""\
   "granular dmt E eta nu gamma", "L gamma"
""", """\
   "granular stiffening kn eta", "L kn"
   "granular dmt E eta nu gamma", "L gamma"
"""),
    ],
}


def follow(folder):
    """Edits the sources in a folder."""
    for name, edits in EDITS.items():
        path = folder / name
        text = path.read_text()
        for old, new in edits:
            if text.count(old) != 1:
                raise AssertionError(f"{name} has {text.count(old)} times, not once:\n{old}Change EDITS in tests/recipes/stiffening.py, and the recipe "
                                     "'Adding a normal law' of doc/design.md if what it tells has changed")
            text = text.replace(old, new)
        path.write_text(text)
