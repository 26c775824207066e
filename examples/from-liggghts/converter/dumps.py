# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""dump of meshes and of grains."""
import re
from pathlib import Path

from .errors import Left

MESH_DUMPS = {"mesh/stl", "stl", "mesh/vtk", "mesh/vtm", "mesh/gran/VTK"}
MESH_FIELDS = {"id", "stress", "stresscomponents", "wear"}    # words of dump mesh/vtk that are no IDs of meshes
GONE_FIELDS = set("""aedges area acorners contact_area contact_area_step distaa face_id nneigh nneighs overlap owner pt1 pt2 pt3 temp vel""".split())
COLUMNS = set("""angmomx angmomy angmomz diameter element fx fy fz id ix iy iz mass mol mu mux muy muz omegax omegay omegaz proc q
radius tqx tqy tqz type vx vy vz x xs xsu xu y ys ysu yu z zs zsu zu""".split())    # of dump custom in both
GONE_COLUMNS = set("""blockiness1 blockiness2 density eradius erforce ervel id_multisphere inertiax inertiay inertiaz p quat1 quat2 quat3 quat4 rho
roundness1 roundness2 shapex shapey shapez spin thread""".split())    # of LIGGGHTS alone
OF_PICTURES = f"""(OUTPUT|{'|'.join(sorted(COLUMNS))}) (OUTPUT|{'|'.join(sorted(COLUMNS))}) [adiam NUMBER] [atom|box|axes|shiny|ssao YES|NUMBER NUMBER? NUMBER?] [bond NAME NAME]
[size COUNT COUNT] [view VALUE VALUE] [center s|d VALUE VALUE VALUE] [up VALUE VALUE VALUE] [zoom VALUE] [persp VALUE]""".replace("\n", " ")
DUMPS = {"atom": "", "xyz": "", "local": "(index|OUTPUT)+", "image": OF_PICTURES, "movie": OF_PICTURES}
DUMP_MODIFY = "NAME [append|first|flush|image|scale|unwrap YES] [element NAME+] [every COUNT|VARIABLE] [fileper|nfile|pad COUNT] [label TEXT] [region NAME|none] " \
              "[sort off|id|COUNT] [thresh NAME <|<=|>|>=|==|!= NUMBER] [thresh none]"
# Of a dump that becomes text.
TEXT_DUMP_WORDS = {**dict.fromkeys("append binary first flush unwrap".split(), "YES"), "every": "COUNT|VARIABLE", "sort": "off|id|COUNT", "pad": "COUNT",
                   "element": "NAME+", "region": "NAME|none", "thresh": "NAME <|<=|>|>=|==|!= NUMBER", "compressor": "NAME"}


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
        if w[3] in ("mesh/stl", "stl"):
            return [x for x in w[6:] if x not in ("all", "binary", "local", "owned", "ghost")]
        return [x for k, x in enumerate(w[6:], 6) if x != "output" and w[k - 1] != "output" and x not in MESH_FIELDS | GONE_FIELDS]

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
        gone = " ".join(x for x in w[6:] if x in GONE_FIELDS) if "stl" not in w[3] else ""
        return f"# dump {w[1]}: see {'mesh_stl' if 'stl' in w[3] else 'mesh_fields'} of the wall, which writes none where the first run begins" + (
            f"\n# NOTE {self.at(line)}: without {gone}, which is not here" if gone else "")

    def dump(self, line):
        w = line.words
        self.texts.discard(w[1])
        if line in self.dumps:
            self.read_mesh_dump(line)
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
        elif w[3] in DUMPS:
            self.read(line, f"dump {w[3]}", DUMPS[w[3]], 6)
            self.put(self.renamed(line, line.text))
        elif w[3] == "decomposition/vtk" or w[3] in MESH_DUMPS:
            self.plain.add(w[1])
            self.put(f"# {' '.join(w)}")
            self.note(line, "no picture of what each process has")
        else:
            raise Left(f"dump {w[3]}", "dump custom, or mesh_fields of the wall")

    def read_mesh_dump(self, line):
        """Raises Left for a word of a dump of meshes that is not known, and for parts of meshes."""
        w = line.words
        if w[3] in ("mesh/stl", "stl"):
            if "region" in w[6:]:
                raise Left("a dump of the part of a mesh in a region", "mesh_stl of the wall, which writes the whole mesh")
        else:
            for k, x in enumerate(w[6:], 6):
                if w[k - 1] == "output" and x not in ("face", "interpolate", "original"):
                    raise Left(f"output {x}", "face")

    def columns(self, line, words):
        kept = [x for x in words if x in COLUMNS or "$" in x or (x[:2] in ("f_", "c_", "v_") and self.is_here(x))]
        for name in (x for x in words if x not in kept):
            if name not in GONE_COLUMNS and name[:2] not in ("f_", "c_", "v_", "i_", "d_"):
                raise Left(f"the word {name} of a dump", "a word that both programs have")
            self.note(line, f"without {name}, which is not here")
        return kept
