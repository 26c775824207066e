# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""fix move/mesh, and fix_modify of meshes."""
import math

from .errors import Left
from .geometry import cross, short, unit
from .lines import commands_in

# How the styles of move/mesh begin that turn a mesh.
TURNS = ("rotate", "riggle", "vibrot")


class Motions:
    """fix move/mesh, and fix_modify of meshes."""

    def motion(self, line, w):
        style, rest = w[6], w[7:]
        if style == "linear" and len(rest) == 3:
            return "linear " + " ".join(rest)
        if style == "wiggle" and len(rest) == 6 and rest[::4] == ["amplitude", "period"]:
            return f"wiggle {' '.join(rest[1:4])} {rest[5]}"
        if style in ("rotate", "rotate/superposable") and len(rest) == 10 and rest[::4] == ["origin", "axis", "period"]:
            return f"rotate {' '.join(rest[1:4])} {' '.join(rest[5:8])} {rest[9]}"
        if style == "riggle" and len(rest) == 12 and rest[::4] == ["origin", "axis", "period"] and rest[10] == "amplitude":
            return f"riggle {' '.join(rest[1:4])} {' '.join(rest[5:8])} {rest[11]} {rest[9]}"
        if style == "linear/variable" and len(rest) == 3 and all(x.startswith("v_") for x in rest):
            self.note(line, "LIGGGHTS goes on by the speed at the end of a step, here it is the mean of both ends")
            return "variable NULL NULL NULL " + " ".join(rest)
        if style == "rotate/variable" and len(rest) == 10 and rest[::4] == ["origin", "axis", "omega"] and rest[9].startswith("v_"):
            self.note(line, "LIGGGHTS turns by the speed at the end of a step, here it is the mean of both ends")
            return f"rotate {' '.join(rest[1:4])} {' '.join(rest[5:8])} variable NULL {rest[9]}"
        if style == "viblin" and rest[::4][:2] == ["axis", "order"]:
            place, speed = self.waves(line, w[1], rest[4:])
            axis = unit([self.number(x, line) for x in rest[1:4]])
            for name, of in (("x", place), ("v", speed)):
                for k in range(3):
                    self.put(f"variable        {of}{'xyz'[k]} equal {short(axis[k])}*v_{of}")
            return "variable " + " ".join(f"v_{of}{a}" for of in (place, speed) for a in "xyz")
        if style == "vibrot" and rest[::4][:3] == ["origin", "axis", "order"]:
            return f"rotate {' '.join(rest[1:4])} {' '.join(rest[5:8])} variable " + " ".join(
                f"v_{name}" for name in self.waves(line, w[1], rest[8:]))
        if style in ("linear", "wiggle", "rotate", "rotate/superposable", "riggle", "linear/variable", "rotate/variable", "viblin", "vibrot"):
            raise ValueError(style)
        raise Left(f"move/mesh {style}", "motion table for places at times, or motion variable")

    def waves(self, line, name, w):
        """Writes variables of the sum of n waves from their words: order n amplitude C1 ... phase p1 ... period T1 ...; with one period,
        as in LIGGGHTS-PFM, wave k has T/k. The sum is 0 where it begins. Returns the names of the sum and of its derivative."""
        n = int(w[1])
        amplitudes, phases, periods = w[3:3 + n], w[4 + n:4 + 2 * n], w[5 + 2 * n:]
        if [w[0], w[2], w[3 + n], w[4 + 2 * n]] != ["order", "amplitude", "phase", "period"] or len(periods) not in (1, n):
            raise ValueError("waves")
        commands = [(other, c) for other in self.lines for c in commands_in(other.words or [""])]
        run = min([other.index for other, c in commands if c[0] == "run"], default=0)
        if any(c[0] == "timestep" and (other.index > max(line.index, run) or other.loops) or c[3:4] == ["dt/reset"]
               for other, c in commands):
            raise Left("a motion by waves where the timestep changes", "motion table, or variables of the time")
        if any(c[0] == "reset_timestep" and (other.index > line.index or (other.loops and line.loops)) for other, c in commands):
            raise Left("a motion by waves before reset_timestep, which its formula counts on", "motion table, or variables of the time")
        begin = "$(step)" if self.step is None else self.step
        place, speed = f"lsdcd_{name}_s", f"lsdcd_{name}_v"
        self.put(f"variable        lsdcd_{name}_t equal 2*PI*(step-{begin})*dt")
        speeds = [f"{k}/({periods[0]})" if len(periods) < n else f"1/({periods[k - 1]})" for k in range(1, n + 1)]
        turns = [(f"({c})", v, f"v_lsdcd_{name}_t*{v}+({p})", f"({p})") for c, v, p in zip(amplitudes, speeds, phases)]
        self.put(f"variable        {place} equal " + "+".join(f"{c}*(cos({at})-cos{p})" for c, _, at, p in turns))
        self.put(f"variable        {speed} equal -2*PI*(" + "+".join(f"{c}*{v}*sin({at})" for c, v, at, _ in turns) + ")")
        if not self.options.pfm:
            self.note(line, "LIGGGHTS goes on by the speed at the end of a step, here the place is that of the formula")
        return place, speed

    def move(self, line):
        before = []
        if line.words[4] != "mesh":
            raise Left(f"the word {line.words[4]} of move/mesh", "mesh, and its ID")
        w = line.words[:7] + [self.carry(x, line, before) for x in line.words[7:]]
        self.same_mesh(line, w[5])
        replaced = self.moves.pop(w[1], None)
        if replaced:
            replaced[0].moves.remove(replaced[1])
            if replaced[0].moves:
                raise Left(f"one of several motions of {replaced[0].id} is replaced", "fix_modify motion with all that go on: they begin anew")
        mesh = self.meshes.get(w[5])
        if mesh is None:
            raise Left(f"the mesh {w[5]}, which is not converted", "motion, after its file")
        self.sure(mesh.line, line)
        for text in before:
            self.put(text)
        words = self.motion(line, w)
        for name in (x for x in words.split() if x.startswith("v_") and not self.is_here(x)):
            raise Left(f"{name}, which is not here", "another variable")
        active = [m for m in self.moves.values() if m[0] is mesh]
        self.check_motions(line, w, words, mesh, active)
        if mesh.wall is None:
            if not mesh.wall_lines:
                raise Left(f"the mesh {w[5]} is no wall", "fix massflow/lsdcd has no motion")
            following = [other for other in mesh.wall_lines if other.index > line.index]
            if not following:
                raise Left(f"the mesh {w[5]} is in no wall", "add it to the wall")
            self.sure(line, following[0])
            self.note(line, f"a motion of fix {following[0].words[1]}")
        self.moves[w[1]] = [mesh, words, self.ran, w[6], line]
        mesh.moves.append(words)
        if replaced and replaced[0] is not mesh and replaced[0].wall:
            self.put(self.modify(replaced[0], []))
        if mesh.wall is None:
            return
        self.put(self.modify(mesh, mesh.moves))
        if len(mesh.moves) > 1:
            self.note(line, "the first motion of LIGGGHTS is the outer one; here it is the last")

    def same_mesh(self, line, name):
        """Raises Left where the motion that a line replaces or ends may be one of another mesh, or its mesh be in another wall."""
        now = self.moves.get(line.words[1])
        around = [x for first, last in line.loops for x in self.lines[first:last + 1] if x.words[:2] == ["fix", line.words[1]]]
        if any(x.words[5:6] != [name] for x in around) or (now and (
                not now[4].skips <= line.skips or (line.loops and now[0].id != name))):
            raise Left(f"the motion {line.words[1]}, which a jump may have given to another mesh", "an ID for each motion")
        mesh = self.meshes.get(name)
        if mesh and mesh.wall:
            self.same_wall(mesh, line)

    def same_wall(self, mesh, line):
        """Raises Left where a mesh may be in another wall than the last one above."""
        self.sure(mesh.wall_at, line)
        if any(mesh.wall_at.index < first <= x.index <= last for first, last in line.loops for x in mesh.wall_lines):
            raise Left(f"a change of the mesh {mesh.id}, whose wall changes in the loop", "one wall for all turns of the loop")

    def check_motions(self, line, w, words, mesh, active):
        """Raises Left for a motion that does not go with the others of its mesh."""
        if any(m[2] != self.ran for m in active):
            raise Left(f"a second motion of {mesh.id} that begins later",
                       "fix_modify motion begins all anew; write both from the start, the outer one last")
        stays = [x for first, last in line.loops for x in self.lines[first:last + 1] if x is not line and x.words[5:6] == w[5:6] and
                 x.words[1] != w[1] and x.words[0] == "fix" and self.style(x.words) == "move/mesh" and not any(
                     y.words[:2] == ["unfix", x.words[1]] and y.index > x.index and y.skips <= x.skips for y in self.lines[:last + 1])]
        if mesh.unsure or stays or any(m[4].skips != line.skips for m in active):
            raise Left(f"a motion of {mesh.id} beside another one, which a jump may skip or bring back", "one fix_modify motion with both")
        if active and any(x.startswith("riggle") for x in [words, *(m[1] for m in active)]):
            raise Left(f"riggle beside another motion of {mesh.id}", "LIGGGHTS turns about the axis where it was; here it "
                       "moves along with an outer motion: motion riggle and the others, in the order that is meant")
        if words.split()[0] != "rotate" and any(m[1].startswith("rotate") for m in active):
            raise Left("a linear motion after a rotation", "not there: LIGGGHTS adds their velocities and turns about the "
                       "axis where it was; write the linear one first to have the axis move along")
        if words.startswith("rotate"):
            self.check_axes(line, w, words, [m for m in active if m[1].startswith("rotate")])

    def check_axes(self, line, w, words, others):
        """Two turns of one mesh. The axis of LIGGGHTS's rotate stays in space; here the first turn turns the axis of the second,
        as rotate/superposable of LIGGGHTS-PFM does. Both are the same where the axes are parallel."""
        axes = [unit([self.number(x, line) for x in text.split()[4:7]]) for text in [words] + [m[1] for m in others]]
        parallel = all(math.hypot(*cross(axes[0], a)) < 1e-9 for a in axes)
        if len({w[6]} | {m[3] for m in others}) > 1 or (w[6] != "rotate/superposable" and not parallel):
            raise Left("a rotation after another about an axis that is not parallel to it, which stays in space in LIGGGHTS",
                       "not there: here the first rotation turns the axis of the second; rotate/superposable of LIGGGHTS-PFM, too")

    @staticmethod
    def modify(mesh, moves):
        which = f" mesh {mesh.index}" if mesh.several else ""
        return f"fix_modify      {mesh.wall}{which} " + (" ".join(f"motion {m}" for m in reversed(moves)) or "motion none")

    def stop(self, line):
        mesh, words, _, _, where = self.moves[line.words[1]]
        self.same_mesh(line, mesh.id)
        several = len(mesh.moves) > 1
        if line.skips <= where.skips:
            del self.moves[line.words[1]]
            mesh.moves.remove(words)
        else:
            mesh.unsure = True    # a jump may have kept it
        if several:
            raise Left(f"one of several motions of {mesh.id} ends", "fix_modify motion with the others: they begin anew")
        self.put(self.modify(mesh, []) if mesh.wall else f"# {line.text.strip()}")

    def fix_modify(self, line):
        w = line.words
        mesh = self.meshes.get(w[1])
        if mesh is None:
            self.put(line.text)
            return
        if (not mesh.servo and not mesh.body) or mesh.wall is None:
            raise Left(f"fix_modify {w[2]}", "fix_modify of the wall with that mesh: motion, servo or body")
        self.same_wall(mesh, line)
        if mesh.body:
            self.modify_body(line, mesh)
            return
        which = f" mesh {mesh.index}" if mesh.several else ""
        word = w[2].removeprefix("servo/")
        if [word, *w[3:]] == ["integrate", "stop"]:
            self.put(f"fix_modify      {mesh.wall}{which} servo none")
        elif [word, *w[3:]] == ["integrate", "start"] or (word == "target_val" and len(w) == 4):
            kept = []
            target = self.carry(w[3], line, kept) if word == "target_val" else mesh.target
            if mesh.unsure or kept:
                raise Left(f"fix_modify {w[2]} with a target that a jump may change", "fix_modify servo with all its words")
            mesh.unsure = not line.skips <= mesh.line.skips or bool(line.loops)
            mesh.servo = mesh.servo.replace(f" {mesh.target} vmax", f" {target} vmax")
            mesh.target = target
            self.put(f"fix_modify      {mesh.wall}{which} {mesh.servo}")
        else:
            raise Left(f"fix_modify {w[2]}", "fix_modify servo with all its words; it needs no gains")

    def modify_body(self, line, mesh):
        """A free body whose centre stops: LIGGGHTS drops forces and sets the velocity, which is a ball joint where the centre is."""
        w, new = [x.removeprefix("6dof/") for x in line.words[2:]], {}
        while len(w) >= 4 and w[0] in ("forceflags", "vel"):
            new[w[0]], w = [self.number(x, line) for x in w[1:4]], w[4:]
        # Without vel the body would keep its velocity, and a body that is held already has a joint.
        if w or new != {"forceflags": [0, 0, 0], "vel": [0, 0, 0]} or mesh.held:
            raise Left(f"fix_modify {line.words[2]} of a mesh with 6dof", "fix_modify of the wall: body joint, load, moment, spring or limits")
        # LAMMPS knows the place after a run.
        place = [f"$({mesh.output(k, self)}:%.17g)" for k in (7, 8, 9)] if self.ran else mesh.com
        which = f" mesh {mesh.index}" if mesh.several else ""
        mesh.held = True
        self.put(f"fix_modify      {mesh.wall}{which} body joint ball {' '.join(place)}")

    def age(self, line):
        """What a run does to meshes, which would begin anew in another wall: a known time at known speeds is a way."""
        w, time = line.words, None
        if w[0] == "run" and w[2:] in ([], ["upto"]) and not line.loops and not line.skips and self.timestep is not None:
            steps, begin = self.known(w[1], line), self.step if len(w) > 2 else 0
            time = (steps - begin) * self.timestep if None not in (steps, begin) else None
        for mesh in self.meshes.values():
            mesh.worn = mesh.worn or bool(mesh.wear and mesh.wall)
            if mesh.servo or mesh.body:
                mesh.way = None
            for _, words, _, style, where in (m for m in self.moves.values() if m[0] is mesh and mesh.way):
                speed = [self.known(x, where) for x in words.split()[1:]] if style == "linear" else [None]
                known = time is not None and None not in speed and not mesh.unsure and not where.skips and not where.loops
                mesh.way = [x + v * time for x, v in zip(mesh.way, speed)] if known else None
