# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""The files for LAMMPS's own unit tests (its folder unittest/force-styles) hold: what its test_fix_timestep does with them, by scripts.

A file has commands and numbers: eight steps, and the last four again after a restart, give these positions, velocities, torques, this
virial and these outputs, as far as its epsilon. With files as arguments this program writes the numbers of this LAMMPS into them.
"""
import pathlib
import re
import sys
import tempfile

import lmp
from facts import at_most, fact

FOLDER = lmp.HERE.parent.parent / "cmake" / "packaging" / "lammps" / "force-styles"
VOLUME = 5.0**3    # of the box of the files, by which LAMMPS's pressure is a virial
LAST = "run             4 post no start 0 stop 8\n"
PER_ATOM = {"run_pos": slice(0, 3), "run_vel": slice(3, 6), "run_torque": slice(6, 9)}


def read(path):
    """What stands behind each key; of a block its lines."""
    found, key = {}, ""
    for line in path.read_text(encoding="utf-8").split("\n"):
        begin = re.match(r"(\w+): *(.*)", line)
        if begin:
            key, value = begin.groups()
            found[key] = [] if value.startswith("|") else value
        elif line.startswith(" "):
            found[key].append(line.strip())
    return found


def scripts(test, outputs):
    """The whole run, and the end of it after a restart."""
    pre, post = ("\n".join(test[key]) + "\n" for key in ("pre_commands", "post_commands"))
    post += f"timestep        {test['timestep']}\n"
    columns = [*(f"c_stress[{k}]" for k in range(1, 7)), "f_test", *(f"f_test[{k}]" for k in range(1, outputs + 1))]
    end = f"""\
compute         stress all pressure NULL fix
thermo_style    custom step {' '.join(columns)}
thermo_modify   format float %.17g
{LAST}write_dump      all custom end.dump id x y z vx vy vz tqx tqy tqz modify sort id format float %.17g
"""
    folder = f"variable        input_dir index {FOLDER}\n"
    return (folder + pre + post + "run             0 post no\n" + LAST + "write_restart   half.restart\n" + end,
            folder + "read_restart    half.restart\n" + post + end)


def results(script, folder):
    """Rows of the atoms, the virial, the scalar, the vector."""
    last = lmp.read_thermo(lmp.run_well(script, folder))[-1]
    rows, = lmp.read_dump(folder / "end.dump").values()
    return [rows[k] for k in sorted(rows)], [VOLUME * x for x in last[1:7]], last[7], last[8:]


def n_outputs(test, folder):
    """Of the fix: the last element that a script may name."""
    begin, low, high = scripts(test, 0)[0].split("run   ")[0], 1, 1000
    while high - low > 1:
        middle = (low + high) // 2
        done = lmp.run(f"{begin}thermo_style custom step f_test[{middle}]\nrun 0 post no\n", folder)
        low, high = (middle, high) if done.returncode == 0 else (low, middle)
    return low


def numbers(lines):
    return [float(word) for line in lines for word in line.split()]


def compare(name, found, test):
    """As far as epsilon: each number, of itself where it is above 1, as LAMMPS does."""
    rows, stress, scalar, vector = found
    pairs = [(key, [x for row in rows for x in row[part]], numbers(re.sub(r"^\S+", "", line) for line in test[key]))
             for key, part in PER_ATOM.items()]
    pairs += [("run_stress", stress, numbers(test["run_stress"])), ("global_scalar", [scalar], [float(test["global_scalar"])]),
              ("global_vector", vector, numbers(test["global_vector"])[1:])]
    for key, these, those in pairs:
        fact(f"{name}: {key} has as many numbers", len(these) == len(those), f"{len(these)}, {len(those)}")
        off = max((abs(a - b) / max(abs(b), 1) for a, b in zip(these, those)), default=0)
        at_most(f"{name}: {key}", off, float(test["epsilon"]))


def test_force_styles(folder):
    paths = sorted(FOLDER.glob("*.yaml"))
    fact("there are files", len(paths) >= 2, len(paths))
    for path in paths:
        test = read(path)
        for name, script in zip(("whole", "restart"), scripts(test, int(test["global_vector"][0].split()[0]))):
            compare(f"{path.name}, {name}", results(script, folder), test)


def write(path):
    """Puts the numbers of this LAMMPS into the file."""
    with tempfile.TemporaryDirectory() as name:
        folder, test = pathlib.Path(name), read(path)
        rows, stress, scalar, vector = results(scripts(test, n_outputs(test, folder))[0], folder)

    def line(values):
        return " ".join(f"{0 if abs(x) < 1e-13 else x:23.16e}" for x in values)

    text = path.read_text(encoding="utf-8").split("natoms:")[0].replace("\n...\n", "\n")
    text += f"natoms: {len(rows)}\nrun_stress: |2-\n  {line(stress)}\nglobal_scalar: {scalar!r}\n"
    text += f"global_vector: |-\n  {len(vector)} {line(vector)}\n"
    for key, part in PER_ATOM.items():
        text += f"{key}: |2\n" + "".join(f"  {k:3} {line(row[part])}\n" for k, row in enumerate(rows, 1))
    path.write_text(text + "...\n", encoding="utf-8")


if __name__ == "__main__":
    for argument in sys.argv[1:]:
        write(pathlib.Path(argument))
