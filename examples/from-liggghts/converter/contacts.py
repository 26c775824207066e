# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""compute pair/gran/local and wall/gran/local: rows of contacts."""
from .errors import Left

# How many columns each word has, in their order in the array; None: that depends on the model.
COLUMNS_OF_CONTACTS = {"pos": 6, "vel": 6, "id": 3, "force": 3, "force_normal": 3, "force_tangential": 3, "torque": 3, "torque_normal": 3,
                       "torque_tangential": 3, "history": None, "contactArea": 1, "delta": 1, "heatFlux": 1, "contactPoint": 3, "ms_id": 2}
DEFAULT = ("pos", "vel", "id", "force", "torque", "history", "contactArea")    # without words
# What stands for a column (word, its number) of a pair and of a wall. Positions, and sums of normal and tangential forces, are no output of LAMMPS.
OF_PAIRS = {**{("id", k): f"c_{{0}}_id[{k}]" for k in (1, 2)}, **{("force_normal", k): f"c_{{0}}[{k}]" for k in (1, 2, 3)},
            **{("force_tangential", k): f"c_{{0}}[{k + 3}]" for k in (1, 2, 3)}}
OF_WALLS = {**{("pos", k): f"f_{{0}}[{k + 5}]" for k in (1, 2, 3)}, **{("contactPoint", k): f"f_{{0}}[{k + 5}]" for k in (1, 2, 3)},
            **{("force", k): f"f_{{0}}[{k + 2}]" for k in (1, 2, 3)}, ("id", 1): "f_{0}[2]", ("id", 3): "f_{0}[1]", ("delta", 1): "f_{0}[9]"}


def columns_of(words):
    """(word, its number) of each column, up to one that depends on the model."""
    found = []
    for word, n in COLUMNS_OF_CONTACTS.items():
        if word in words:
            if n is None:
                break
            found += [(word, k) for k in range(1, n + 1)]
    return found


class Contacts:
    """compute pair/gran/local and wall/gran/local: rows of contacts."""

    def contacts(self, line):
        w = line.words
        self.read(line, f"compute {w[3]}", f"({'|'.join(COLUMNS_OF_CONTACTS)}|verbose)*", 4)
        columns = columns_of([x for x in w[4:] if x != "verbose"] or DEFAULT)
        if w[3] == "pair/gran/local":
            self.names.add(f"c_{w[1]}_id")
            self.put(f"compute         {w[1]}_id {w[2]} property/local patom1 patom2 cutoff radius")
            self.put(f"compute         {w[1]} {w[2]} pair/local fx fy fz p1 p2 p3 cutoff radius")
            self.rows[w[1]] = ("pair/gran/local", [OF_PAIRS.get(c, "").format(w[1]) for c in columns], columns)
            return
        walls = {mesh.wall for mesh in self.meshes.values() if mesh.wall}
        if len(walls) != 1 or w[2] != "all":
            raise Left("wall/gran/local of a group, or not behind one wall of meshes", "each_contact of fix wall/lsdcd, and its array")
        wall = walls.pop()
        self.put(f"# {' '.join(w)}: see each_contact of fix {wall}")
        self.rows[w[1]] = ("wall/gran/local", [OF_WALLS.get(c, "").format(wall) for c in columns], columns)
        if ("id", 1) in columns:
            self.note(line, "meshes of the wall count from 1")

    def wants_each_contact(self, wall_line):
        """Whether a compute wall/gran/local behind a wall needs its rows."""
        return any(x.words[:1] == ["compute"] and x.words[3:4] == ["wall/gran/local"] and x.stage == wall_line.stage for x in self.lines)

    def row_column(self, name, k):
        """What stands for column k of a compute."""
        style, columns, words = self.rows[name]
        if k > len(columns) or not columns[k - 1]:
            what = f", which is {words[k - 1][0]}" if k <= len(words) else ""
            raise Left(f"column {k} of compute {name} {style}{what}", "the columns that there are: of pairs id, force_normal and force_tangential; of walls the "
                       "place of the contact, id, force and delta")
        return columns[k - 1]
