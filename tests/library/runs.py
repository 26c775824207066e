# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Folders of runs, as LAMMPS and LSDCD write them, for tests of the page of a run; and what a page says."""
import base64
import json
import re
import struct
import zlib

import numpy as np

from lsdcd import report

HEAD = """LAMMPS (29 Sep 2021 - Update 2)
units           si
timestep        1e-4
fix             w all wall/lsdcd hertz/history 1e5 NULL 50 NULL 0.5 1 mesh drum.stl scale 0.001 motion rotate 0 0 0 0 1 0 2 energy mesh lid.stl name lid
Fix w wall/lsdcd: mesh drum.stl
fix_modify      w names drum all
fix_modify      w mesh lid names lid all
fix             out all massflow/lsdcd mesh out.stl
fix_modify      out names out all
fix             feed all insert/lsdcd mesh in.stl massrate 1
fix_modify      feed names feed all
compute         balls all lsdcd/energy names balls all
compute         hits all lsdcd/impacts 0.05 impact_spectrum between_*.csv every 100 names hits all
compute         hit all lsdcd/collide mesh body.stl names hit all
dump            d all custom 100 grains.dump id type x y z vx vy vz radius
run             100000
"""


def log_text(heads, rows, more="", end=True):
    text = HEAD + "Step " + " ".join(heads) + "\n" + more
    text += "".join(f"{100 * k} " + " ".join(repr(float(value)) for value in row) + "\n" for k, row in enumerate(rows))
    return text + ("Loop time of 1 on 1 procs\nTotal wall time: 0:00:01\n" if end else "")


def packed_array(kind, name, values, components=1):
    data = np.ascontiguousarray(values).tobytes()
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="binary">'
            f'{base64.b64encode(struct.pack("<Q", len(data)) + data).decode()}</DataArray>\n')


def vtp_text(points, triangles, fields):
    n = len(triangles)
    return ('<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<PolyData>\n'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfPolys="{n}">\n<CellData>\n'
            + "".join(packed_array("Float64", name, np.asarray(values, float)) for name, values in fields.items())
            + "</CellData>\n<Points>\n" + packed_array("Float64", "points", np.asarray(points, float), 3) + "</Points>\n<Polys>\n"
            + packed_array("Int32", "connectivity", np.asarray(triangles, np.int32))
            + packed_array("Int32", "offsets", 3 * np.arange(1, n + 1, dtype=np.int32)) + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n")


def dump_text(frames, columns="id type x y z vx vy vz radius"):
    """`frames`: {step: rows}."""
    text = ""
    for step, rows in frames.items():
        text += (f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ATOMS {columns}\n"
                 + "".join(" ".join(f"{value:.9g}" for value in row) + "\n" for row in rows))
    return text


def binary_dump(frames, processes=1, columns="id type x y z vx vy vz radius"):
    """The same as the binary dump of LAMMPS, whose processes write their rows one after another."""
    def words(text):
        return struct.pack("<i", len(text)) + text.encode()

    data = b""
    for step, rows in frames.items():
        magic = b"DUMPCUSTOM"
        data += struct.pack("<q", -len(magic)) + magic + struct.pack("<2i2q", 1, 2, step, len(rows)) + struct.pack("<7i6d", 0, *[1] * 6, *(0, 1) * 3)
        data += struct.pack("<i", len(columns.split())) + words("") + b"\1" + struct.pack("<d", 1e-5 * step) + words(columns) + struct.pack("<i", processes)
        for part in np.array_split(np.asarray(rows, float), processes):
            data += struct.pack("<i", part.size) + part.astype("<f8").tobytes()
    return data


def grains(n, seed=1):
    """Rows of a dump, not in the order of their ids."""
    random = np.random.default_rng(seed)
    rows = np.column_stack([np.arange(1, n + 1), random.integers(1, 3, n), random.random((n, 3)), random.normal(size=(n, 3)), random.uniform(0.01, 0.02, n)])
    return rows[random.permutation(n)]


TRIANGLE = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 2, 3]])


def write_run(folder, n=200):
    """A small run with a file of each kind."""
    rows = np.random.default_rng(3).normal(size=(40, 3))
    (folder / "log.lammps").write_text(log_text(["v_drum_power", "v_drum_overlap", "KinEng"], np.abs(rows)), encoding="utf-8")
    (folder / "grains.dump").write_text(dump_text({100 * k: grains(n, k) for k in range(6)}))
    for k in range(1, 5):
        (folder / f"wall_{100 * k}.vtp").write_text(vtp_text(*TRIANGLE, {"normal_stress": [k, 0.0], "contacts": [1, 2]}))
    (folder / "wall_series.pvd").write_text('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n' + "".join(
        f'<DataSet timestep="{0.01 * k}" part="0" file="wall_{100 * k}.vtp"/>\n' for k in range(1, 5)) + "</Collection>\n</VTKFile>\n")
    (folder / "spectrum_4000.csv").write_text("energy_from,energy_to,impacts,energy\n1,1.25,3,3.3\n1.25,1.6,1,1.3\n")
    (folder / "mean.txt").write_text("# Time-averaged data for fix mean\n# TimeStep v_drum_power f_w[2][3]\n100 1 2\n200 3 4\n300 5 6.5\n")
    (folder / "out.txt").write_text("# step time id type diameter x y z vx vy vz direction\n10 0.001 1 1 0.01 0 0 0 0 0 -1 1\n20 0.002 2 1 0.01 0 0 0 0 0 -1 -1\n")


def said_by(page):
    """The data of a page."""
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)[1])


def data_of(folder, **more):
    return said_by(report.report(folder, **more))


def unpacked(text, kind):
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), kind)
