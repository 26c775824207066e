#!/usr/bin/env python3
"""fix wall/lsdcd ... tune E: the log shows the table, the run is the one that the chosen
words give, and every process has the choice of the first."""

import re

import deck
import scene

LAW = "hooke/history 1e4 NULL 120 NULL 0.4 1"
TOTALS = "thermo_style custom step f_wall f_wall[7] f_wall[9]\nthermo_modify format float %.15g\nthermo 100\n"


def go(folder, ranks, more):
    text = deck.run_well(scene.SETTINGS + "read_data start.data\n" +
                         scene.forces(LAW, mesh=f"mesh floor.stl {more}") + TOTALS +
                         scene.dump("moves", 100) + "run 500\n", folder, ranks)
    return text, deck.read_dump(folder / "moves")


def tried(text):
    """Settings and errors of every row; times, and what depends on them, left out."""
    return [re.split(r"\s{2,}", line.strip())[:7]
            for line in text.split("\n") if re.match(r"^ +[\d.]+ +(all|\d).* (double|mixed|single) ", line)]


def taken(text):
    return re.search(r"^  taken: (.*)$", text, re.M).group(1)


def main():
    checks, folder = deck.Checks(), deck.scratch()
    scene.write_floor(folder / "floor.stl")
    deck.run_well(scene.CREATE + "write_data start.data\n", folder)
    one, moves = go(folder, 1, "tune 1e-3")
    checks.fact("the table is in the log", len(tried(one)) >= 48, f"{len(tried(one))} rows")
    checks.fact("one row is taken", one.count("<- taken") == 1 and one.count("taken: grid") == 1)
    checks.fact("spheres of the scene are tried", re.search(r"tune 0.001: [1-9]\d* spheres", one))

    same, again = go(folder, 1, taken(one))
    checks.at_most("the words that were taken give the same run", deck.largest_difference(moves, again), 0)

    two, moves_two = go(folder, 2, "tune 1e-3")
    checks.fact("2 ranks measure the same errors", tried(two) == tried(one))
    checks.fact("2 ranks take one row", two.count("taken: grid") == 1)
    if taken(one) == taken(two):
        checks.at_most("2 ranks go the same way", deck.largest_difference(moves, moves_two), 0)
    _, chosen = go(folder, 2, taken(two))
    checks.at_most("both ranks have the choice of the first", deck.largest_difference(moves_two, chosen), 0)

    kept, _ = go(folder, 2, "tune 1e-3 grid 0.3 nearest 2 exact")
    checks.fact("what is given is kept", taken(kept).startswith("grid 0.3 nearest 2 exact"), taken(kept))
    exact, _ = go(folder, 1, "tune 0")
    checks.fact("0 takes double", taken(exact).endswith("precision double"), taken(exact))
    checks.done(folder)


if __name__ == "__main__":
    main()
