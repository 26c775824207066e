# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Numbers that a build must not exceed, kept in a CSV file beside the test, by compiler."""
import csv
import sys

SKIPPED = 77


def skip(why):
    print("skipped:", why)
    sys.exit(SKIPPED)


def compare(path, compiler, found, room, unit):
    """How many numbers of `found` are above the kept ones by more than `room`, or gone; new ones are
    only shown. With --keep the rows of this compiler are written again; without rows the test is
    skipped by name."""
    with open(path, newline="") as f:
        rows = list(csv.DictReader(f))
    if "--keep" in sys.argv:
        rows = [r for r in rows if r["compiler"] != compiler]
        rows += [{"compiler": compiler, "case": case, "number": f"{n:.6g}"} for case, n in found.items()]
        with open(path, "w", newline="") as f:
            writer = csv.DictWriter(f, ["compiler", "case", "number"], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        return 0
    kept = {r["case"]: float(r["number"]) for r in rows if r["compiler"] == compiler}
    if not kept:
        known = ", ".join(dict.fromkeys(r["compiler"] for r in rows)) or "none"
        skip(f"no numbers are kept for {compiler} (there are those of: {known}); --keep writes them")
    failed = 0
    for case in dict.fromkeys([*kept, *found]):
        have, was = found.get(case), kept.get(case)
        holds = have is not None and (was is None or have <= was * (1 + room))
        says = "not there any more" if have is None else f"{have:.4g} {unit}, " + \
            (f"kept {was:.4g}, {have / was - 1:+.1%}" if was else "none kept")
        print(f"{'PASS' if holds else 'FAIL'} {case}: {says}")
        failed += not holds
    if failed:
        print(f"at most {room:.0%} more is allowed; if it is meant: {sys.argv[0]} ... --keep")
    return failed
