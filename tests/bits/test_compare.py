# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

"""What compare.py says of two made-up programs."""
import re
import stat

import compare
import pytest
from facts import fact

PROGRAM = r"""#!/bin/sh
echo 'Loop time of 0.1 on 1 procs'
echo 'energy {energy}'
grep -q BAD in.script && echo 'ERROR: {error}' && exit 1
printf '1 {place}\n2 5\n' > moves.dump
printf 'a\000{place}' > end.restart
"""


@pytest.fixture
def found(tmp_path):
    (tmp_path / "files").mkdir()

    def of(parts, **other):
        commands = []
        for name, words in (("a", {}), ("b", other)):
            path = tmp_path / name
            path.write_text(PROGRAM.format(**{"energy": 1, "place": 3, "error": "no", **words}))
            path.chmod(path.stat().st_mode | stat.S_IXUSR)
            commands.append(lambda script, path=path: [path, "-in", script])
        return compare.compare(compare.Script("laws", parts), 1, commands, tmp_path / "job", tmp_path / "files", None)
    return of


def test_differences(found):
    good = [("one", "run 1\n")]
    fact("two programs that do the same", found(good) == [])
    told = found(good, place=4)
    fact("a value of a dump, with its size", any("moves.dump: 1 lines, largest relative difference 0.25" in line for line in told), told)
    fact("bytes of a restart file", any("end.restart: 1 bytes" in line for line in told), told)
    fact("a line of the log, and no times", any(re.search("log: 1 lines.*'energy 1' is now 'energy 2'", line) for line in found(good, energy=2)))


def test_stops(found):
    parts = [("one", "run 1\n"), ("two", "BAD\n")]
    fact("where both stop alike nothing is told", found(parts) == [])
    fact("another reason is", any("two on 1: stops with 'ERROR: no', now with 'ERROR: yes'" in line for line in found(parts, error="yes")))
    fact("and the rest of the batch is compared", any("one on 1: moves.dump" in line for line in found(parts, place=4)))


def test_masks():
    log = compare.masked("Per MPI rank memory 1\nx in /tmp/a/b CPU = 1.5\n  version     1.2\nTotal wall time: 0:00:01\nkept 12", "/tmp/a")
    fact("times, places and versions are left out of a log", log == "x in FOLDER/b CPU\nkept 12", log)
