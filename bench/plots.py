# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The pictures of pages.py: plots of doc/data."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt    # noqa: E402

from pages import DEVICES, IMAGES, default_length, facts, find, noise, number, of_study, rows_of, stands_out, tradeoff    # noqa: E402

# By colour and by marker, so that a print in grey or a colour-blind reader tells them apart.
STYLES = {"cpu": dict(color="#0072B2", marker="o"), "cuda": dict(color="#D55E00", marker="^")}
FONT = 14


def write_image(figure, name, dpi=110):
    figure.savefig(IMAGES / name, dpi=dpi, metadata={"Software": None})
    print("drew", name)


def legible(axis):
    """Read at half the size, too."""
    axis.grid(True, which="major", alpha=0.3)
    axis.tick_params(labelsize=FONT - 1)
    for item in (axis.title, axis.xaxis.label, axis.yaxis.label):
        item.set_fontsize(FONT)


def label(rows):
    return rows[0]["device"].replace("CUDA, ", "")


def both(name):
    return {device: rows_of(f"{name}_{device}.csv") for device in DEVICES}


# ---- performance.md ------------------------------------------------------------------------

def draw_mesh_size(rows_by_device):
    panels = [("time per contact in a step, ns", lambda r: float(facts(r)["ns_per_contact"])),
              ("memory of the grid, MB", lambda r: float(facts(r)["grid_mb"]))]
    figure, all_axes = plt.subplots(1, 2, figsize=(11, 4.8))
    for axis, (name, value) in zip(all_axes, panels):
        for device, rows in rows_by_device.items():
            points = sorted((float(r["triangles"]), value(r)) for r in rows
                            if r["case"] == "hertz/history, kept" and r["order"] == "sorted")
            axis.plot(*zip(*points), **STYLES[device])
            axis.annotate(label(rows).split(",")[0], points[0], (4, 18), textcoords="offset points",
                          color=STYLES[device]["color"], fontsize=FONT + 2)
        axis.set(xscale="log", yscale="log", xlabel="number of triangles", ylabel=name)
        legible(axis)
    figure.tight_layout()
    write_image(figure, "performance_mesh_size.png")


# ---- effects.md ----------------------------------------------------------------------------

def draw_effects(cpu, cuda):
    """What each effect adds on the CPU, the largest first; and those that add most on the GPU, where it is no noise."""
    least = noise(cpu)
    rows = sorted((r for r in cpu if r["over"]), key=lambda r: float(r["over_ns"]))
    values = [float(r["over_ns"]) for r in rows]
    figure, axis = plt.subplots(figsize=(8, 9))
    axis.barh(range(len(rows)), values, color="#0072B2")
    axis.axvspan(-least, least, color="0.85", zorder=0)
    axis.axvline(0, color="black", linewidth=0.8)
    for at, value in enumerate(values):
        if value > least:
            axis.text(value + 0.8, at, f"{value:.0f}", va="center", fontsize=13)
    axis.text(least + 0.8, 0, "grey: noise", va="center", fontsize=13, color="0.35")
    axis.set_yticks(range(len(rows)), [r["name"] for r in rows], fontsize=13)
    axis.tick_params(axis="x", labelsize=13)
    axis.set_xlabel("added for each contact and step, ns", fontsize=14)
    axis.set_title("On a CPU core", fontsize=14)
    axis.set_xlim(right=1.08 * max(values))    # room for the number of the longest bar
    axis.grid(True, axis="x", alpha=0.3)
    seen = sorted((r for r in cuda if stands_out(cuda, r)), key=lambda r: -float(r["over_ns"]))
    named = [f"{r['name']} {number(r['over_ns'], 2)} ns" for r in seen[:4]]
    others = "are within the noise" if len(seen) == len(named) else "add less"
    axis.text(0.97, 0.06, "On the GPU: " + (";\n".join(named) or "none stands out") + f";\nall others {others}",
              transform=axis.transAxes, ha="right", fontsize=13)
    figure.tight_layout()
    write_image(figure, "effects.png", dpi=90)


# ---- accuracy.md ---------------------------------------------------------------------------

def break_between(high, low):
    """Draws the break between two axes over each other, of which the lower one has 0 alone."""
    low.set_yticks([0], ["0"])
    high.spines.bottom.set_visible(False)
    low.spines.top.set_visible(False)
    high.tick_params(bottom=False, which="both")
    broken = dict(marker=[(-1, -0.6), (1, 0.6)], markersize=11, linestyle="none", color="k", mec="k", clip_on=False)
    high.plot([0, 1], [0, 0], transform=high.transAxes, **broken)
    low.plot([0, 1], [1, 1], transform=low.transAxes, **broken)
    for axis in (high, low):
        axis.grid(True, alpha=0.3)
        axis.tick_params(labelsize=FONT - 1)


def broken_axes(grid, ratio=(6, 1)):
    """Two axes over each other, with a break between them: the lower one has what is 0 on the logarithmic upper one."""
    high, low = grid.subgridspec(2, 1, height_ratios=ratio, hspace=0.06).subplots(sharex=True)
    low.set(ylim=(-0.8, 0.8))
    break_between(high, low)
    return high, low


def draw_accuracy(rows_by_device):
    """Error of a force against the time of a search and of a step, with the same cells on each device. No claim stands in it."""
    grid_length = default_length(rows_by_device["cpu"])
    figure = plt.figure(figsize=(6 * len(rows_by_device) + 1, 5.8))
    grid = figure.add_gridspec(1, len(rows_by_device), left=0.55 / len(rows_by_device) / 3, right=0.99, top=0.92, bottom=0.13, wspace=0.12)
    ways = (("search", "a search that keeps nothing", "none", "--", (8, 6)), ("step", "a step with what is kept", "full", "-", (8, -16)))
    for column, (device, rows) in enumerate(rows_by_device.items()):
        high, low = broken_axes(grid[column])
        colour = STYLES[device]["color"]
        its = [r for r in rows if (r["grid"], r["corner"]) == (grid_length, "blend")]
        short = sorted((r for r in its if r["nearest"] != "all"), key=lambda r: int(r["nearest"]))
        exact = next(r for r in its if r["nearest"] == "all")
        for way, name, fill, line, away in ways:
            def bars(r):
                least, most = (float(r[f"{way}_{which}ns"]) for which in ("", "most_"))
                return least, [[0], [most - least]]
            high.plot([bars(r)[0] for r in short], [float(r["force_mean"]) for r in short], line, color=colour, linewidth=1, alpha=0.5)
            for r in short:
                x, spread = bars(r)
                high.errorbar(x, float(r["force_mean"]), xerr=spread, marker=STYLES[device]["marker"], color=colour, markersize=9, fillstyle=fill,
                              linewidth=1)
                high.annotate(f"{r['nearest']}", (x, float(r["force_mean"])), away, textcoords="offset points", fontsize=FONT - 1)
            high.plot([], [], line, marker=STYLES[device]["marker"], color=colour, markersize=9, fillstyle=fill, label=name)
            x, spread = bars(exact)
            low.errorbar(x, 0, xerr=spread, marker="*", color="black", markersize=19, fillstyle=fill, linewidth=1)
            # Between the two stars there is room for both names, one higher than the other, where they are far apart.
            other = float(exact[f"{'search' if way == 'step' else 'step'}_ns"])
            between = max(x, other) > 3 * min(x, other)
            side = 1 if (x < other) == between else -1
            low.annotate(f"default, {way}", (x, 0), (13 * side, 5 if between and way == "step" else -16), textcoords="offset points", fontsize=FONT - 1, ha="left" if side > 0 else "right")
        every = [float(r[f"{way}_{which}ns"]) for r in its for way in ("search", "step") for which in ("", "most_")]
        high.set(xscale="log", yscale="log", ylim=(1e-3, 1.5), xlim=(min(every) / 1.3, 2 * max(every)))
        high.legend(loc="lower left", fontsize=FONT - 2)
        high.set_title("one CPU core" if device == "cpu" else label(rows), fontsize=FONT)
        low.set_xlabel("time for each grain near the wall, ns", fontsize=FONT)
        ticks = [t * 10**e for e in range(-3, 4) for t in (1, 2, 5) if high.get_xlim()[0] <= t * 10**e <= high.get_xlim()[1]]
        low.set_xticks(ticks, [f"{t:g}" for t in ticks])
        low.minorticks_off()
        if column == 0:
            high.set_ylabel("mean error of a force / mean force", fontsize=FONT)
    write_image(figure, "accuracy_time.png", dpi=90)


# ---- hard_cases.md -------------------------------------------------------------------------

def draw_hard_curves(rows):
    """A fold and a bowl, beside LIGGGHTS."""
    colours = {"LSDCD": "#0072B2", "LIGGGHTS 3.8": "#D55E00"}

    def points(curve, wall):
        return list(zip(*((float(r["x"]), float(r["value"])) for r in rows if (r["curve"], r["wall"]) == (curve, wall))))

    figure, (fold, bowl) = plt.subplots(1, 2, figsize=(12, 5), layout="constrained")
    for wall, colour in colours.items():
        fold.plot(*points("fold", wall), "-", color=colour, linewidth=2.5)
        steps, apart = points("bowl", wall)
        bowl.plot(steps, [max(y, 1e-16) for y in apart], "-", color=colour, linewidth=2.5)
        steps, shifted = points("shift", wall)
        bowl.plot(steps, shifted, ":", color=colour, linewidth=1.5)
        end = f"{wall}: {apart[-1]:.2g} diameters" if apart[-1] > 0.01 else f"{wall}: {apart[-1]:.0e} diameters"
        bowl.annotate(end, (steps[-1], apart[-1]), (-6, 12 if apart[-1] > 0.01 else -22), textcoords="offset points", ha="right",
                      color=colour, fontsize=FONT, weight="bold")
    fold.annotate("LIGGGHTS 3.8", (0.03, 1.66), (10, 0), textcoords="offset points", color=colours["LIGGGHTS 3.8"], fontsize=FONT, weight="bold")
    fold.annotate("LSDCD", (0.15, 1.0), (0, 8), textcoords="offset points", color=colours["LSDCD"], fontsize=FONT, weight="bold")
    fold.set(ylim=(0.9, 2.1), xlabel="place over the fold, in radii", ylabel="force / force on a face", title="A sphere over a fold of 5 degrees")
    bowl.set(yscale="log", ylim=(1e-16, 300), xlabel="step", ylabel="largest distance, in diameters",
             title="The same bowl cut two ways: 144 grains, two runs")
    bowl.annotate("dotted: one mesh, start moved by 1e-12 m", (0.98, 0.03), xycoords="axes fraction", ha="right", fontsize=FONT - 1)
    for axis in (fold, bowl):
        legible(axis)
    write_image(figure, "hard_curves.png", dpi=90)


def draw_long_grain(rows):
    """A grain of 5:1:1 where one of its contacts ends at a fold, by our rule and by one that jumps."""
    figure, axis = plt.subplots(figsize=(8, 5), layout="constrained")
    for rule, colour, at, away in (("by impulses", "#D55E00", (-0.3, 1.54), (-95, 30)), ("LSDCD", "#0072B2", (-0.1, 1.37), (10, -14))):
        x, force = zip(*((-float(r["x"]), float(r["value"])) for r in rows if (r["curve"], r["wall"]) == ("grain", rule)))
        axis.plot(x, force, color=colour, linewidth=2.5)
        axis.annotate(rule, at, away, textcoords="offset points", color=colour, fontsize=FONT, weight="bold")
    axis.set(xlabel="way past the end of a contact, in rho", ylabel="force / force of one face", title="An ellipsoid of 5:1:1 upright in a fold")
    legible(axis)
    write_image(figure, "long_grain.png", dpi=90)


# ---- paper.md ------------------------------------------------------------------------------------

def draw_question(rows, steps):
    """Errors against the time of a query: those of the paper and ours, and what shorter lists miss. Below the break of an
    axis are the measurements without any error."""
    figure, axes = plt.subplots(2, 2, figsize=(12, 6.4), sharex="col", height_ratios=(5, 1), gridspec_kw={"hspace": 0.06})
    blue, red, green, black = "#0072B2", "#D55E00", "#009E73", "black"

    def point(column, x, y, look, words="", away=(8, 6), **more):
        at = axes[0 if y > 0 else 1][column]
        at.plot(x, y if y > 0 else 0, look, markersize=9, **more)
        if words:
            at.annotate(words, (x, y if y > 0 else 0), away, textcoords="offset points", fontsize=14, color=more["color"])

    for r in of_study(rows, "table2"):
        if r["length"] != "0.2":
            continue
        every = r["lists"] == "every triangle"
        words = {"every triangle": "every triangle", "complete": "all", "1": "N = 1"}.get(r["lists"], r["lists"])
        if r["lists"] != "complete":
            point(0, float(r["paper_query_ms"]), float(r["paper_error_percent"]), "s", words, (-106, 8) if every else (8, 6),
                  color=black, fillstyle="none")
        if r["lists"] in ("1", "complete"):
            point(0, float(r["query_ms"]), max(0.0, float(r["error_percent"])), "o", words, color=blue)
    axes[0][0].text(5e2, 12, "the paper, on a K40", fontsize=14, ha="center")
    axes[0][0].text(0.17, 8e-4, "LSDCD, on an H200", fontsize=14, color=blue)
    for triangles, look, colour in (("10000", "o", blue), ("100000", "s", red), ("1000000", "^", green)):
        its = [(r["lists"], float(r["query_ms"]), 100 * float(r["missed"]) / float(r["touching"]))
               for r in of_study(rows, "mesh") if r["triangles"] == triangles]
        above = [(x, y) for _, x, y in its if y > 0]
        axes[0][1].plot(*zip(*above), color=colour, linewidth=1)
        axes[0][1].plot([], [], look + "-", color=colour, label=f"{int(triangles):,} triangles".replace(",", " "))
        for lists, x, y in its:
            point(1, x, y, look, "all" if lists == "complete" else "" if y <= 0 else "N = 1" if lists == "1" and triangles == "10000"
                  else lists, (-9, 9) if y <= 0 else (8, 2), color=colour)
    for column, least, title, error in ((0, 3e-5, "The paper's cylinder of 156 triangles, cells of 0.2", "error, % (formula 7)"),
                                        (1, 1e-4, "Finer cylinders, cells of 0.4, on an H200", "missed contacts, %")):
        high, low = axes[0][column], axes[1][column]
        high.set(xscale="log", yscale="log", ylim=(least, 50))
        high.set_title(title, fontsize=14)
        high.set_ylabel(error, fontsize=14)
        low.set(ylim=(-0.5, 1.2), xscale="log")
        low.set_xlabel("time for 10 000 000 spheres, ms", fontsize=14)
        break_between(high, low)
    axes[0][0].set_xlim(0.1, 2e5)
    axes[0][1].set_xlim(0.1, 2.6)
    axes[0][1].legend(loc="upper right", fontsize=14)
    axes[1][1].set_xticks([0.1, 0.2, 0.5, 1, 2], ["0.1", "0.2", "0.5", "1", "2"])
    axes[1][1].minorticks_off()
    own = float(steps["median_ms"])
    for a in (axes[0][1], axes[1][1]):
        a.axvline(own, color=black, linewidth=1)
    axes[0][1].annotate("a step of the wall,\n10 000 triangles", (own, 2e-4), (-4, 0), textcoords="offset points", fontsize=13, ha="right",
                        rotation=90, va="bottom")
    figure.subplots_adjust(left=0.08, right=0.99, top=0.94, bottom=0.1, wspace=0.2)
    write_image(figure, "paper_question.png", dpi=90)


def draw_figures(rows_by_device):
    """The paper's figures 9 to 12: its numbers, as far as its text and its Table 2 have them, in black beside ours. Two triangles a cell."""
    figure, axes = plt.subplots(2, 2, figsize=(12, 7.6))
    paper = dict(color="black", marker="s", fillstyle="none", linestyle="none", markersize=9)
    table2 = [r for r in of_study(rows_by_device["cuda"], "table2") if r["lists"] == "2"]

    def curve(axis, name, x, y):
        for device, rows in rows_by_device.items():
            its = of_study(rows, name)
            axis.plot([float(r[x]) for r in its], [float(r[y]) for r in its], label="LSDCD, " + label(its).replace("NVIDIA ", ""), **STYLES[device])

    def theirs(axis, rows, x, y, name):
        points = [(float(r[x]), float(r[y])) for r in rows if r[y]]
        axis.plot(*zip(*points), label=name, **paper)

    spheres = of_study(rows_by_device["cuda"], "figure9")
    lengths = of_study(rows_by_device["cuda"], "figure10")
    curve(axes[0][0], "figure9", "spheres", "query_ms")
    theirs(axes[0][0], spheres, "spheres", "paper_query_ms", "the paper, Tesla K40")
    axes[0][0].set(xscale="log", yscale="log", xlabel="number of spheres", ylabel="time of a query, ms", title="Figure 9, cells of 0.2")
    axes[0][1].plot([float(r["length"]) for r in lengths], [float(r["accuracy"]) for r in lengths], label="LSDCD, any device", **STYLES["cuda"])
    theirs(axes[0][1], lengths, "length", "paper_accuracy", "the paper")
    for best, words, colour in ((lengths[0]["best"], "every triangle, LSDCD", STYLES["cuda"]["color"]), ("0.994025", "every triangle, the paper", "black")):
        axes[0][1].axhline(float(best), color=colour, linewidth=1, linestyle=":", label=words)
    axes[0][1].set(xlabel="length of a cell", ylabel="accuracy (formula 6)", title="Figure 10, left: accuracy")
    curve(axes[1][0], "figure10", "length", "build_s")
    theirs(axes[1][0], lengths, "length", "paper_build_s", "the paper, K40 and GTX480")
    axes[1][0].set(yscale="log", ylim=(1e-4, 30), xlabel="length of a cell", ylabel="time to build the grid, s", title="Figures 10, right, and 11: the grid")
    curve(axes[1][1], "figure10", "length", "query_ms")
    theirs(axes[1][1], table2, "length", "paper_query_ms", "the paper, Tesla K40")
    axes[1][1].set(yscale="log", ylim=(0.05, 3e4), xlabel="length of a cell", ylabel="time of a query, ms", title="Figure 12: 10 000 000 spheres")
    for axis in axes.flat:
        legible(axis)
        axis.legend(fontsize=12, loc="lower left" if axis is axes[1][0] else "best")
    figure.tight_layout()
    write_image(figure, "paper_figures.png", dpi=90)


# ---- validation.md -------------------------------------------------------------------------

MARKERS = {"Chung": dict(marker="s", color="#D55E00"), "experiment": dict(marker="D", color="#009E73"), "MFiX": dict(marker="x", color="#CC79A7"),
           "FEM": dict(marker="D", color="#009E73"), "Anand": dict(marker="s", color="#D55E00")}


def draw_validation(ours, published):
    """Our curves of impacts at an angle, and the points that others published."""
    panels = (("oblique, tangential restitution", "angle from the normal, degrees", "tangential restitution"), ("oblique, spin", "angle from the normal, degrees", "spin, rad/s"),
              ("oblique at a constant normal speed, R spin/(mu v_n)", "v_t/(mu v_n)", "R spin/(mu v_n)"))
    figure, all_axes = plt.subplots(1, 3, figsize=(16.5, 5.2))
    for axis, (curve, x, y), place in zip(all_axes, panels, ("lower right", "lower center", "upper right")):
        axis.plot(*zip(*((float(r["x"]), float(r["value"])) for r in ours if r["curve"] == curve)), color="#0072B2", label="LSDCD")
        its = [r for r in published if r["curve"] == curve]
        for source in dict.fromkeys(r["source"] for r in its):
            points = [(float(r["x"]), float(r["value"])) for r in its if r["source"] == source and float(r["x"]) < (8.1 if "v_t" in x else 90)]
            axis.plot(*zip(*points), linestyle="", fillstyle="none", markersize=8, label=source.partition(" (")[0], **MARKERS[source.split()[0].rstrip(":")])
        axis.set(xlabel=x, ylabel=y)
        low, high = axis.get_ylim()
        axis.set_ylim(low - (0.25 * (high - low) if place.startswith("lower") else 0), high)    # room for the names
        axis.legend(fontsize=FONT - 3, loc=place)
        legible(axis)
    figure.tight_layout()
    write_image(figure, "validation_oblique.png", 80)


def draw_beds(ours, published, plate):
    """Loads and flows of beds beside Janssen's and Beverloo's laws and published points; forces on a plate in five packings."""
    figure, ((janssen, beverloo), (flat, driven)) = plt.subplots(2, 2, figsize=(13, 10))

    def points(name, rows=ours):
        return list(zip(*((float(r["x"]), float(r["value"])) for r in rows if r["curve"] == name)))
    x = [0.02 * k for k in range(201)]
    janssen.plot(x, [1 - math.exp(-m) for m in x], color="#D55E00", label="Janssen's law")
    janssen.plot(*points("Janssen, load over M8"), linestyle="", marker="o", color="#0072B2", label="LSDCD, floor sinking")
    janssen.set(xlabel="mass in the tube, over M8", ylabel="load on the floor, over M8")
    roots = points("Beverloo, (flow/density)^(2/5)")
    beverloo.plot(*roots, linestyle="", marker="o", color="#0072B2", label="LSDCD")
    x = [1.4 + 0.1 * k for k in range(62)]
    beverloo.plot(x, [0.58 ** 0.4 * (outlet - 1.4) for outlet in x], color="#D55E00", label="Beverloo's law, C = 0.58, k = 1.4")
    beverloo.set(xlabel="outlet, in grains", ylabel="(flow/density)^(2/5)")
    name = "flat-bottomed hopper, mass that has left"
    for rows, words in ((ours, dict(color="#0072B2", label="LSDCD")), (published, dict(linestyle="", fillstyle="none", label="Anand et al. 2008", **MARKERS["Anand"]))):
        times, masses = points(name, rows)
        flat.plot(times, [1000 * m for m in masses], **words)
    begin, mass = next((float(r["x"]), 1000 * float(r["value"])) for r in ours if r["curve"] == name and float(r["x"]) > 0.142)
    flat.plot([begin, 0.6], [mass, mass + 91.73 * (0.6 - begin)], color="black", linestyle="--", label="91.73 g/s, lethe's flow")
    flat.set(xlabel="time since the gate opens, s", ylabel="mass that has left, g")
    for part, colour in (("tip", "#0072B2"), ("shaft", "#009E73")):
        for packing in dict.fromkeys(r["packing"] for r in plate):
            its = [r for r in plate if r["packing"] == packing and r["cut"] == plate[0]["cut"]]
            driven.plot([1000 * float(r["depth"]) for r in its], [float(r[part]) for r in its], color=colour, label=f"{part}, five packings" if packing == plate[0]["packing"] else None)
    driven.set(xlabel="depth of the tip, mm", ylabel="force on the plate, N")
    for axis in (janssen, beverloo, flat, driven):
        axis.legend(fontsize=FONT - 3)
        legible(axis)
    figure.tight_layout()
    write_image(figure, "validation_beds.png", 70)


def draw_all():
    draw_beds(rows_of("validation_minutes_curves_cpu.csv"), rows_of("validation_published.csv"), rows_of("validation_plate_cpu.csv"))
    draw_validation(rows_of("validation_curves_cpu.csv"), rows_of("validation_published.csv"))
    draw_mesh_size(both("mesh-size"))
    draw_effects(*(rows_of(f"effects_{device}.csv", ";") for device in DEVICES))
    # A step that reads lists of the wall, on the same spheres, nothing copied.
    step = find(rows_of("performance_cuda.csv"), case="hertz/history, in place", triangles=10000, spheres=10000000, order="random")
    draw_question(rows_of("accuracy_cuda.csv"), step)
    draw_figures(both("accuracy"))
    draw_accuracy(tradeoff("vessel"))
    draw_hard_curves(rows_of("hard_curves_cpu.csv"))
    draw_long_grain(rows_of("hard_curves_cpu.csv"))
