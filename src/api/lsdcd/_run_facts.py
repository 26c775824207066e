# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""What a run says: its numbers with their errors, series to plot, and what to look at first."""
from __future__ import annotations

import math
import pathlib
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _run_files as files
from ._run_files import Array, Column, InputError, Log, unit_text

BLOCKS = 10            # of which an error is made
FINE_OVERLAP, DEEP_OVERLAP = 5.0, 10.0    # per cent of a radius: doc/choosing.md says that it is fine up to the first, and the fix warns of the second
FINE_REMAINDER, LARGE_REMAINDER = 2e-3, 2e-2    # of the work: by doc/energy.md what contacts of 25 steps leave, and what half of a row that is missing does
STEP_COLUMNS = ("Step", "Time")


@dataclass
class Series:
    """A column with its numbers, and their times."""
    column: Column
    times: Array
    values: Array

    @property
    def title(self) -> str:
        return self.column.name


def half_of(values: Array) -> Array:
    """The second half of some rows, of which means are made."""
    return values[len(values) // 2:]


def error_of_mean(values: Array) -> float:
    """Two standard errors of the mean, from the means of ten blocks, which follow one another; nan for fewer than ten values."""
    if len(values) < BLOCKS:
        return math.nan
    means = np.array([block.mean() for block in np.array_split(values, BLOCKS)])
    return float(2 * means.std(ddof=1) / math.sqrt(BLOCKS))


def is_total(values: Array) -> bool:
    """Does a number only rise, or only fall, as a sum since the beginning does?"""
    steps = np.diff(values)
    return len(values) > 3 and values[0] != values[-1] and bool(np.all(steps >= 0) or np.all(steps <= 0))


def rate_of(times: Array, values: Array) -> tuple[float, float]:
    """How fast a sum rises over some rows, and two standard errors of that, from ten blocks."""
    span = times[-1] - times[0]
    if not span > 0:
        return math.nan, math.nan
    rate = float((values[-1] - values[0]) / span)
    if len(values) <= BLOCKS:
        return rate, math.nan
    at = np.round(np.linspace(0, len(values) - 1, BLOCKS + 1)).astype(int)
    rates = np.diff(values[at]) / np.diff(times[at])
    return rate, float(2 * rates.std(ddof=1) / math.sqrt(BLOCKS))


def finite(number: float) -> float | None:
    return float(number) if math.isfinite(number) else None


def series_of_log(log: Log) -> list[Series]:
    table = log.table()
    if "Step" not in table:
        return []
    times = log.times(table["Step"])
    return [Series(files.column_of(log, head), times, values) for head, values in table.items() if head not in STEP_COLUMNS]


def series_of_averages(folder: pathlib.Path, log: Log, notes: list[str]) -> list[Series]:
    """Columns of all files of fix ave/time in a folder."""
    found = []
    for path in files.files_in(folder):
        if not files.starts_with(path, "# Time-averaged data for fix "):
            continue
        try:
            heads, rows = files.read_averages(path)
        except InputError as error:
            notes.append(f"left out: {error}")
            continue
        for k, head in enumerate(heads[1:], 1):
            column = files.column_of(log, head)
            column.source = path.name
            found.append(Series(column, log.times(rows[:, 0]), rows[:, k]))
    return found


def series_of_passages(folder: pathlib.Path, notes: list[str]) -> list[Series]:
    """How many grains have passed, of each file of fix massflow/lsdcd with a row for each."""
    found = []
    for path in files.files_in(folder):
        if not files.starts_with(path, files.PASSAGES):
            continue
        try:
            rows = files.read_passages(path)
        except InputError as error:
            notes.append(f"left out: {error}")
            continue
        column = Column(path.name, "passages", path.name, "", "passages forward less those backward, by the rows of the file", path.name)
        if len(rows):
            found.append(Series(column, rows[:, 0], np.cumsum(rows[:, 1])))
    return found


def number_of(series: Series, log: Log) -> dict[str, Any] | None:
    """The row of the table of numbers. None: the column has no number."""
    known = np.isfinite(series.values)
    values, times = half_of(series.values[known]), half_of(series.times[known])
    if not len(values):
        return None
    column, unit = series.column, unit_text(series.column.kind, log.units)
    rate, rate_error = rate_of(times, values) if is_total(series.values[known]) else (math.nan, math.nan)
    time = log.time_unit if log.time_unit != "steps" else "step"
    rates = {"J/s": "W"}
    rate_unit = f"{unit or '1'}/{time}"
    owner = column.owner + ("" if column.source == "log" or column.source == column.owner else f"{', ' if column.owner else ''}{column.source}")
    return {"head": column.head, "name": column.name, "owner": owner, "kind": column.kind, "unit": unit, "meaning": column.meaning.replace("*", ""),
            "source": column.source, "rows": len(values), "mean": float(np.mean(values)), "error": finite(error_of_mean(values)),
            "least": float(values.min()), "most": float(values.max()), "last": float(values[-1]), "rate": finite(rate),
            "rate_error": finite(rate_error), "rate_unit": rates.get(rate_unit, rate_unit)}


def plot_key(column: Column) -> tuple[str, str]:
    """Series with one key share a plot: those of one unit whose names begin alike, and all of a number without a unit."""
    return column.kind.replace(" units", ""), column.name.split("_")[0] if column.is_of_lsdcd or column.kind else column.name


def plots_of(all_series: list[Series]) -> list[tuple[str, list[Series]]]:
    """Titles of plots, and what each has. A column that never changes is in the table alone."""
    groups: dict[tuple[str, str], list[Series]] = {}
    for series in all_series:
        known = series.values[np.isfinite(series.values)]
        if len(known) > 1 and np.any(known != known[0]):
            groups.setdefault(plot_key(series.column), []).append(series)
    found = []
    for (_, first), group in groups.items():
        names = list(dict.fromkeys(series.column.name for series in group))
        found.append((names[0].replace("_", " ") if len(names) == 1 else first, group))
    return found


def labels_of(group: list[Series]) -> list[str]:
    """What each series of a plot is called: its name, with its owner where two have one name."""
    names = [series.column.name for series in group]
    found = []
    for series in group:
        label = series.column.name.replace("_", " ")
        if names.count(series.column.name) > 1:
            label += f", {series.column.owner or series.column.source}"
            if series.column.source != "log" and series.column.owner:
                label += f" ({series.column.source})"
        found.append(label)
    return [f"{label} [{series.column.head}]" if found.count(label) > 1 else label for label, series in zip(found, group)]


# ---- checks ------------------------------------------------------------------------------


Check = tuple[str, str]    # "good", "warn", "bad" or "open", and what is said


def _last_by_owner(all_series: list[Series], name: str) -> dict[str, float]:
    """The last numbers of a name in the log, of whole fixes and computes."""
    found = {}
    for series in all_series:
        known = series.values[np.isfinite(series.values)]
        if series.column.name == name and series.column.source == "log" and re.match(r"(fix|compute) \S+$", series.column.owner) and len(known):
            found[series.column.owner] = float(known[-1])
    return found


def check_end(log: Log) -> Check | None:
    errors = [line for line in log.warnings if line.startswith("ERROR")]
    if errors:
        return "bad", f"The run has ended with an error: {errors[-1]}"
    return None


def check_overlap(log: Log, all_series: list[Series]) -> Check:
    deepest = [float(found[1]) for line in log.facts for found in [re.search(r"deepest overlap of this run is ([\d.e+-]+) ?%", line)] if found]
    sunk = [float(found[1]) for line in log.warnings for found in [re.search(r"sank into the wall by ([\d.e+-]+) ?%", line)] if found]
    columns = [100 * np.nanmax(series.values) for series in all_series
               if series.column.name == "overlap" and series.column.owner and np.isfinite(series.values).any()]
    if not deepest and not sunk and not columns:
        return "open", "Overlap: not known yet. The log has it at the end of a run, and thermo output as the number overlap"
    most = max([*deepest, *sunk, *columns])
    kind = "good" if most <= FINE_OVERLAP else "warn" if most <= DEEP_OVERLAP else "bad"
    remedy = "" if kind == "good" else ": a stiffer contact, a shorter timestep, or slower parts"
    return kind, f"Overlap: {most:.3g} % of a radius at the deepest; up to {FINE_OVERLAP:g} % is fine{remedy}"


def check_remainder(all_series: list[Series]) -> Check:
    remainders = _last_by_owner(all_series, "remainder")
    if not remainders:
        return "open", "Energy balance: not recorded, or not in thermo output. The keyword energy keeps it, and names remainder drive_work show it"
    works = _last_by_owner(all_series, "drive_work")
    of_compute = [value for owner, value in works.items() if owner.startswith("compute")]
    work = abs(of_compute[0]) if of_compute else sum(abs(value) for value in works.values())
    of, what = work, "of the work of the drive"
    if not of:
        of = max((abs(value) for name in ("all_lost", "contact_work") for value in _last_by_owner(all_series, name).values()), default=0.0)
        what = "of the work of contacts"
    if not of:
        return "open", "Energy balance: the remainder has nothing to be compared with; names drive_work contact_work show that"
    share = abs(sum(remainders.values())) / of
    kind = "good" if share <= FINE_REMAINDER else "warn" if share <= LARGE_REMAINDER else "bad"
    remedy = "" if kind == "good" else ": a shorter timestep makes it smaller"
    return kind, f"Energy balance: it misses {share:.2g} {what}; up to {FINE_REMAINDER:g} is fine{remedy}"


def check_timestep(log: Log) -> Check:
    warned = [found for line in log.warnings for found in
              [re.search(r"timestep ([\d.e+-]+) is more than a tenth of the shortest contact time ([\d.e+-]+)", line)] if found]
    if warned:
        dt, contact = float(warned[-1][1]), float(warned[-1][2])
        return "bad", f"Timestep: a contact takes {contact / dt:.2g} steps by its law, and needs ten and more: at most {contact / 10:.3g}"
    longest = [float(found[1]) for line in log.facts for found in [re.search(r"the timestep should be at most ([\d.e+-]+)", line)] if found]
    if longest and math.isfinite(log.dt):
        return "good", f"Timestep: a contact between grains takes {10 * min(longest) / log.dt:.3g} steps by its law; ten and more are fine"
    if any(re.match(r"Fix \S+ wall/lsdcd", line) for line in log.facts):
        return "good", "Timestep: a contact with the wall takes ten steps and more by its law"
    return "open", "Timestep: the log has no style of LSDCD that compares it with a contact"


def check_grains(log: Log, all_series: list[Series]) -> Check:
    lost = [(int(found[1]), int(found[2])) for line in log.warnings
            for found in [re.search(r"Lost atoms: original (\d+) current (\d+)", line)] if found]
    if lost:
        return "bad", f"Grains: {lost[-1][0] - lost[-1][1]} of {lost[-1][0]} were lost"
    wrong = [series for series in all_series if series.column.name == "uncertified" and np.nanmax(series.values, initial=0) > 0]
    if wrong:
        return "warn", f"Grains: contacts of up to {np.nanmax(wrong[0].values):g} in a step are not certified exact; leave nearest N out"
    return "good", "Grains: none was lost"


def check_lists(log: Log) -> Check | None:
    if log.dangerous:
        return "warn", f"Neighbor lists: {log.dangerous} dangerous builds; neigh_modify delay 0 every 1 check yes"
    return None


def check_warnings(log: Log) -> Check:
    n = sum(line.startswith("WARNING") for line in log.warnings)
    if not n:
        return "good", "Log: no warning"
    return "warn", f"Log: {n} warning{'s' if n > 1 else ''}, below"


def checks_of(log: Log, all_series: list[Series]) -> list[Check]:
    """What an engineer looks at first."""
    found = [check_end(log), check_overlap(log, all_series), check_remainder(all_series), check_timestep(log), check_grains(log, all_series),
             check_lists(log), check_warnings(log)]
    return [check for check in found if check]


# ---- spectra -----------------------------------------------------------------------------


def spectra_of(folder: pathlib.Path, log: Log, notes: list[str]) -> list[dict[str, Any]]:
    """The last spectrum of impacts of each mesh, and of grains of each pair of types, that has some."""
    latest: dict[str, tuple[float, pathlib.Path, str]] = {}
    names = {mesh.spectrum: mesh.title for mesh in log.meshes if mesh.spectrum}
    if between := files.spectrum_of_grains(log):
        names[between] = "grains"
    for path in files.files_in(folder):
        if path.suffix != ".csv" or not any(files.starts_with(path, head) for head in (files.SPECTRUM, files.BETWEEN_GRAINS)):
            continue
        pattern = next((p for p in names if re.fullmatch(re.escape(pathlib.Path(p).name).replace(r"\*", r"\d+"), path.name)), "")
        group = pattern or re.sub(r"\d+", "*", path.name)
        step = files.step_in(path.name, pattern)
        if group not in latest or step >= latest[group][0]:
            latest[group] = step, path, names.get(pattern, path.stem)
    found = []
    for step, path, name in latest.values():
        try:
            spectra = files.read_spectra(path)
        except InputError as error:
            notes.append(f"left out: {error}")
            continue
        for of, rows in spectra.items():
            whole = f"{name} of {of}" if of else name
            found.append({"name": f"{whole}, to step {step:g}" if "*" in str(path) or step else whole, "file": path.name, "rows": rows})
    return found
