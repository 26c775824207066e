# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""dump of meshes and of grains."""
import re
from pathlib import Path

from .errors import Left

MESH_DUMPS = {"mesh/stl", "stl", "mesh/vtk", "mesh/vtm", "mesh/gran/VTK"}
SAME_DUMPS = {"atom", "xyz", "image", "local", "custom", "movie"}
MESH_FIELDS = set("""aedges area acorners distaa id interpolate nneigh nneighs overlap owner stress stresscomponents temp vel
wear""".split())    # words of dump mesh/vtk that are no IDs of meshes
COLUMNS = set("""angmomx angmomy angmomz diameter element fx fy fz id ix iy iz mass mol mu mux muy muz omegax omegay omegaz proc q
radius tqx tqy tqz type vx vy vz x xs xsu xu y ys ysu yu z zs zsu zu""".split())    # of dump custom in both


class Dumps:
    """dump of meshes and of grains."""

    def dump_words(self, line, mesh, wall_line):
        """Of dump ID group style N file [...] for one mesh."""
        w = line.words
        named = self.dumped_meshes(line)
        if named and mesh.id not in named:
            return ""
        keyword, end = ("mesh_stl", ".stl") if w[3] in ("mesh/stl", "stl") else ("mesh_fields", ".vtp")
        if keyword in mesh.written:
            return ""    # one file of a kind for each mesh: the other dump is left
        try:
            every, name = (self.carry(x, line, [], to=wall_line) for x in w[4:6])
        except Left:
            return ""
        mesh.written.add(keyword)
        self.dumped[line].add(mesh.id)
        path = re.sub(r"_?\*", f"_{mesh.id}_*", name) if "*" in name else str(Path(name).with_suffix("")) + f"_{mesh.id}"
        return f" {keyword} {re.sub('[.](stl|vtk|vtp|vtm)$', '', path)}{end} every {every}"

    @staticmethod
    def dumped_meshes(line):
        """The IDs that a dump of meshes names; none: all meshes."""
        w = line.words
        return [x for k, x in enumerate(w[6:], 6) if x not in ("local", "owned", "ghost", "region") and w[k - 1] != "region" and
                (w[3] in ("mesh/stl", "stl") or x not in MESH_FIELDS)]

    def mesh_dump(self, line):
        """The text in place of a dump of meshes, when all walls are known."""
        w, names, written = line.words, self.dumped_meshes(line), self.dumped[line]
        missing = [i for i in names if i not in written]
        if missing or not written:
            why, do = f"the dump of {', '.join(missing) or 'meshes'} that no converted wall has", "mesh_stl or mesh_fields of the wall with that mesh"
            keyword = "mesh_stl" if "stl" in w[3] else "mesh_fields"
            if any(keyword in m.written for m in self.meshes.values() if m.id in missing or not names):
                why, do = "a second dump of a mesh", f"one of both: a mesh has one {keyword}"
            self.left.append(f"{self.at(line)}: {why}; do: {do}")
            return f"# LEFT {self.left[-1]}\n" + "\n".join("# " + t for t in line.text.splitlines())
        return f"# dump {w[1]}: see {'mesh_stl' if 'stl' in w[3] else 'mesh_fields'} of the wall"

    def dump(self, line):
        w = line.words
        self.texts.discard(w[1])
        if line in self.dumps:
            self.gone[w[1]] = Left("a file of the wall", "nothing")
            self.put(line)
        elif w[3] in ("custom/vtk", "atom/vtk"):
            self.texts.add(w[1])
            columns = self.columns(line, w[6:]) if w[3] == "custom/vtk" else ["id", "type", "x", "y", "z", "radius"]
            self.put(self.renamed(line, f"dump            {w[1]} {w[2]} custom {w[4]} "
                                  f"{re.sub('[.]vt[kp]$', '.txt', w[5])} {' '.join(columns)}"))
            self.note(line, "text in place of VTK; dump vtk has the same words where LAMMPS has the package VTK")
        elif w[3] == "custom":
            self.put(self.renamed(line, " ".join(w[:6] + self.columns(line, w[6:]))))
        elif w[3] in SAME_DUMPS:
            self.put(self.renamed(line, line.text))
        elif w[3] == "decomposition/vtk" or w[3] in MESH_DUMPS:
            self.plain.add(w[1])
            self.put(f"# {' '.join(w)}")
            self.note(line, "no picture of what each process has")
        else:
            raise Left(f"dump {w[3]}", "dump custom, or mesh_fields of the wall")

    def columns(self, line, words):
        kept = [x for x in words if x in COLUMNS or "$" in x or (x[:2] in ("f_", "c_", "v_") and self.is_here(x))]
        for name in (x for x in words if x not in kept):
            self.note(line, f"without {name}, which is not here")
        return kept
