# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""Numbers of the last step after fix_modify: asked before or not, of a sphere that is held at an overlap, in closed form."""

import re

import lmp
from facts import fact

SCRIPT = lmp.head("-3 3 -3 3 -3 3") + """\
create_atoms    1 single 0.3 0.2 0.19 units box
set             group all diameter 0.4 density 30
""" + lmp.pairs("zero 1.0") + """\
timestep        1e-3
fix             w all wall/lsdcd hooke/history 1e4 NULL 0 NULL 0.3 0 mesh floor.stl {words}
run             5
{asked}
{change}
print           "numbers $(f_w[3]) $(f_w[7]) $(f_w) $(f_w[11])"
"""
ASKS = 'print "$(f_w[3])"'
prepare = lmp.flat_floor


def numbers(text):
    return [float(w) for w in re.findall(r"^numbers (.*)$", text, re.M)[-1].split()]


def near(found, right):
    # Overlaps of 0.01 are differences of numbers of 0.2: 1e-15 of them, times kn.
    return all(abs(a - b) <= 1e-9 for a, b in zip(found, right))


def test_changes(folder):
    """Push on the mesh, contacts, energy, power. A mesh that goes up by 0.5 has come 0.0025 farther."""
    held, pushed = [-100, 1, 0.5, 0], [-125, 1, 0.78125, 62.5]
    up, servo = "motion linear 0 0 0.5", "servo force z 3 vmax 0.2"
    for words, change, right in (("", "fix_modify w motion linear 0 0 0.1", held), ("", f"fix_modify w {servo}", held),
                                 ("", "fix_modify w virial yes\nvelocity all set 0 0 0", held),
                                 ("", "fix_modify w motion rotate 0 0 0 1 0 0 2", held),
                                 (up, "fix_modify w motion none", pushed), (up, "fix_modify w motion linear 0 0 2", pushed)):
        for asked in ("", ASKS):
            found = numbers(lmp.run_well(SCRIPT.format(words=words, change=change, asked=asked), folder))
            fact(f"{change}{', asked before' if asked else ''}", near(found, right), str(found))


def test_restart_file(folder):
    """What is written after a change has the numbers of the last step."""
    lmp.run_well(SCRIPT.format(words="", asked="", change="fix_modify w motion linear 0 0 0.1\nwrite_restart r"), folder)
    again = "read_restart r\n" + lmp.pairs("zero 1.0") + \
        "fix w all wall/lsdcd hooke/history 1e4 NULL 0 NULL 0.3 0 mesh floor.stl motion linear 0 0 0.1\n" + \
        'print "numbers $(f_w[3]) $(f_w[7]) $(f_w) $(f_w[11])"\n'
    found = numbers(lmp.run_well("units lj\n" + again, folder))
    fact("of the restart file", near(found, [-100, 1, 0.5, 0]), str(found))


def test_servo_goes_on(folder):
    """A push of 100 where 3 is wanted: the mesh goes down at vmax in the step after, also without a setup."""
    for ranks in (1, 2):
        for asked in ("", ASKS):
            text = lmp.run_well(SCRIPT.format(words="", asked=asked, change="fix_modify w servo force z 3 vmax 0.2\nrun 1 pre no") +
                                'print "servo $(f_w[12]) $(f_w[13])"\n', folder, ranks)
            position, speed = map(float, re.findall(r"^servo (\S+) (\S+)$", text, re.M)[-1])
            fact(f"down at vmax, {ranks} processes{', asked' if asked else ''}",
                 abs(position + 2e-4) < 1e-15 and abs(speed + 0.2) < 1e-15, f"{position} {speed}")
