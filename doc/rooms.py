#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draws which rooms of src and kokkos include which: doc/img/rooms.svg.

An arrow goes from a room to one that it includes. It is left out where a way along other arrows
leads there too. A room lies one row above the highest room that it includes.
"""
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PICTURE = os.path.join(ROOT, "doc", "img", "rooms.svg")
sys.path.insert(0, os.path.join(ROOT, "tests", "tool"))
sys.dont_write_bytecode = True
import check_includes

WIDTH, HEIGHT, ROW, GAP, LINE_GAP, MARGIN = 92, 30, 62, 22, 26, 16    # of boxes and between them, in pixels


def includes():
    """{room: the rooms that it includes}"""
    rooms = {}
    for path in sorted(check_includes.sources(ROOT)):
        room = check_includes.room_of(path)
        with open(os.path.join(ROOT, path), encoding="utf-8") as f:
            names = [m[1] for m in map(check_includes.INCLUDE.match, f) if m]
        rooms.setdefault(room, set()).update(name.split("/")[0] for name in names if "/" in name)
    return {room: sorted(others - {room}) for room, others in sorted(rooms.items())}


def below(rooms, room):
    return set(rooms[room]).union(*(below(rooms, other) for other in rooms[room]))


def direct(rooms):
    """Without what follows from others."""
    return {room: [o for o in others if not any(o in below(rooms, p) for p in others)]
            for room, others in rooms.items()}


def rows_of(rooms):
    """Rows from the lowest, and arrows from row to row. A bend, (from, to, row), stands in each row that
    an arrow passes."""
    def row(room):
        return 1 + max(map(row, rooms[room]), default=-1)
    rows = [[] for _ in range(1 + max(map(row, rooms)))]
    arrows = []
    for room, others in rooms.items():
        rows[row(room)].append(room)
        for other in others:
            way = [room] + [(room, other, k) for k in range(row(room) - 1, row(other), -1)] + [other]
            for bend in way[1:-1]:
                rows[bend[2]].append(bend)
            arrows.append(way)
    return rows, arrows


def half(node):
    return WIDTH / 2 if isinstance(node, str) else 0


def gap(a, b):
    return half(a) + half(b) + (GAP if half(a) + half(b) else LINE_GAP)


def places(rows, arrows):
    """{node: x}: each as near as may be to the mean of those that it is joined to."""
    joined = {node: [] for row in rows for node in row}
    for way in arrows:
        for a, b in zip(way, way[1:]):
            joined[a].append(b)
            joined[b].append(a)
    x = {}
    for row in rows:
        x.update((node, gap("", "") * (k - len(row) / 2)) for k, node in enumerate(row))
    for sweep in range(60):
        for row in rows if sweep % 2 else reversed(rows):
            wish = {n: sum(x[j] for j in joined[n]) / len(joined[n]) for n in row}
            if sweep < 40:
                row.sort(key=lambda n: wish[n])
            at = None
            for k, node in enumerate(row):
                at = wish[node] if k == 0 else max(wish[node], at + gap(row[k - 1], node))
                x[node] = at
            off = sum(x[n] - wish[n] for n in row) / len(row)
            for node in row:
                x[node] -= off
    left = min(x[n] - half(n) for n in x)
    return {n: x[n] - left + MARGIN for n in x}


def picture():
    rows, arrows = rows_of(direct(includes()))
    x = places(rows, arrows)
    y = {node: MARGIN + ROW * (len(rows) - 1 - k) for k, row in enumerate(rows) for node in row}
    width, height = max(x[n] + half(n) for n in x) + MARGIN, ROW * (len(rows) - 1) + HEIGHT + 2 * MARGIN
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height}" '
             'font-family="sans-serif" font-size="14">',
             '<!-- written by doc/rooms.py -->',
             '<marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
             '<path d="M0,0 L8,4 L0,8 z" fill="#557"/></marker>',
             '<rect width="100%" height="100%" fill="white"/>']
    for way in sorted(arrows, key=str):
        path = f"M{x[way[0]]:.0f},{y[way[0]] + HEIGHT}"
        for a, b in zip(way, way[1:]):
            start, end = y[a] + HEIGHT, y[b]
            middle = (start + end) / 2
            path += f" C{x[a]:.0f},{middle:.0f} {x[b]:.0f},{middle:.0f} {x[b]:.0f},{end}"
            if b != way[-1]:
                path += f" v{HEIGHT}"
        lines.append(f'<path d="{path}" fill="none" stroke="#557" marker-end="url(#head)"/>')
    for room in sorted(n for n in x if isinstance(n, str)):
        lines.append(f'<rect x="{x[room] - WIDTH / 2:.0f}" y="{y[room]}" width="{WIDTH}" height="{HEIGHT}" rx="4" '
                     'fill="#eef3fb" stroke="#557"/>')
        lines.append(f'<text x="{x[room]:.0f}" y="{y[room] + 20}" text-anchor="middle">{room}</text>')
    return "\n".join(lines + ["</svg>"]) + "\n"


def main():
    new = picture()
    with open(PICTURE, "w", encoding="utf-8") as f:
        f.write(new)


if __name__ == "__main__":
    main()
