# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""fix massflow/mesh."""
from .errors import Left
from .geometry import cross, dot, minus
from .forms import options
from .lines import is_yes

FLOW_WORDS = {"mesh": "NAME", "vec_side": "NUMBER NUMBER NUMBER", "count": "once|multiple", "delete_atoms": "YES", "file": "FILE", "append": "FILE",
              "writeTime": "", "screen": "YES", "point_at_outlet": "NUMBER NUMBER NUMBER", "inside_out": ""}


class Flows:
    """fix massflow/mesh."""

    def stands_still(self, mesh, line):
        """Raises Left for a mesh that moves where only a wall can."""
        self.sure(mesh.line, line)
        if mesh.id in self.used or mesh.servo or mesh.body:
            raise Left(f"{self.style(line.words)} of the mesh {mesh.id}, which moves", "a mesh that stands: only walls move")

    def massflow(self, line):
        w = line.words
        v = options(w[4:], FLOW_WORDS, (("file", "append"),))
        mesh = self.meshes.get(v["mesh"][0])
        if mesh is None:
            raise Left("massflow/mesh through a mesh that is not converted", "fix massflow/lsdcd mesh FILE")
        self.stands_still(mesh, line)
        if "vec_side" not in v or "point_at_outlet" in v:
            raise Left("massflow/mesh with point_at_outlet", "fix massflow/lsdcd counts along the normals of the triangles, of "
                       "curved meshes too: wind them so that they point to the outlet")
        side = [self.number(x, line) for x in v["vec_side"]]
        ways = {dot(cross(minus(b, a), minus(c, a)), side) > 0 for a, b, c in mesh.triangles(self)}
        if len(ways) > 1:
            raise Left(f"{mesh.file} has triangles wound along vec_side and others against it",
                       f"lsdcd repair {mesh.file} -o FILE winds them alike; then fix massflow/lsdcd, which counts along the winding")
        forward, delete = ways.pop(), is_yes(v, "delete_atoms", "no")
        if delete and not forward:
            raise Left("delete_atoms where the mesh is wound against vec_side",
                       "turn its triangles over: only what passes forward is deleted")
        rows = [v[key][0] for key in ("file", "append") if key in v]
        count = {"once": "once", "multiple": "each"}[v.get("count", ["multiple"])[0]]
        self.put(f"fix             {w[1]} {w[2]} massflow/lsdcd mesh {mesh.file}{mesh.placement()} count {count}" +
                 " delete yes" * delete + "".join(f" file {name}" for name in rows))
        if not forward:
            self.note(line, f"the mesh is wound against vec_side: f_{w[1]}[4] is the mass and f_{w[1]}[3] the number")
        if count == "once":
            self.note(line, "a grain that passes backward first is not counted when it comes again; in LIGGGHTS it is")
        if rows:
            self.note(line, f"{rows[0]} has columns of its own, with all digits" + (
                "" if forward else ", and what LIGGGHTS counts has the direction -1") + (
                "; it begins anew, where LIGGGHTS appends to an older file" if "append" in v else ""))
        if is_yes(v, "screen", "no"):
            self.note(line, "no line on the screen for each grain that has passed")
        number, mass = (1, 2) if forward else (3, 4)
        rate = f"f_{w[1]}[6]" if forward else f"(-f_{w[1]}[6])"
        self.mirror(line, {1: f"f_{w[1]}[{mass}]", 2: f"f_{w[1]}[{number}]", 3: rate, 5: f"f_{w[1]}[8]", 6: f"f_{w[1]}[7]"})

    def mirror(self, line, outputs):
        """Sets what stands for the outputs of a fix."""
        name = line.words[1]
        if self.named_flows.get(name, outputs) != outputs:
            self.leave(line, f"outputs of {name} that lines above take from another fix of this ID", "these lines again below this one")
            self.out.pop()
        self.mirrored[name] = outputs
