# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""lsdcd convert: what it writes, read here; what it reads, written here."""
import numpy as np

import stl
from command import refused, run, told
from facts import fact
from triangles import sphere

DOUBLES = sphere(3) / 3 + 1e-3
FLOATS = DOUBLES.astype(np.float32).astype(float)


def read_obj(data):
    rows = [line.split() for line in data.decode().splitlines()]
    x = np.array([r[1:] for r in rows if r[0] == "v"], float)
    return x[np.array([r[1:] for r in rows if r[0] == "f"], int) - 1], len(x)


def read_off(data):
    words = data.decode().split()
    n, m = int(words[1]), int(words[2])
    assert words[0] == "OFF" and int(words[3]) == 0
    x = np.array(words[4:4 + 3 * n], float).reshape(n, 3)
    faces = np.array(words[4 + 3 * n:], int).reshape(m, 4)
    assert np.all(faces[:, 0] == 3)
    return x[faces[:, 1:]], n


def read_ply(data):
    head, body = data.split(b"end_header\n", 1)
    lines = head.decode().split("\n")
    n, m = (int(line.split()[2]) for line in lines if line.startswith("element"))
    kind = {"float": "<f4", "double": "<f8"}[lines[4].split()[1]]
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    assert [line.split()[-1] for line in lines if line.startswith("property")] == ["x", "y", "z", "vertex_indices"]
    x = np.frombuffer(body, kind, 3 * n).reshape(n, 3).astype(float)
    faces = np.frombuffer(body, [("n", "u1"), ("v", "<i4", 3)], m, x.size * int(kind[2]))
    assert np.all(faces["n"] == 3) and len(body) == x.size * int(kind[2]) + 13 * m
    return x[faces["v"]], n, kind


def rows_of_text(data, word):
    return np.array([line.split()[-3:] for line in data.decode().splitlines() if line.startswith(word)], float)


def read_stl_text(data):
    """Corners, normals."""
    return rows_of_text(data, "vertex").reshape(-1, 3, 3), rows_of_text(data, "facet normal")


def read_stl_binary(data):
    records = np.frombuffer(data, [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")], offset=84)
    assert len(records) == int.from_bytes(data[80:84], "little") and not records["attribute"].any()
    return records["corners"].astype(float), records["normal"].astype(float)


def test_written(folder):
    stl.write(folder / "doubles.stl", DOUBLES)
    stl.write(folder / "floats.stl", FLOATS)
    vertices = len(np.unique(DOUBLES.reshape(-1, 3), axis=0))
    for name, wanted in (("doubles", DOUBLES), ("floats", FLOATS)):
        for ending, read in (("obj", read_obj), ("off", read_off), ("ply", read_ply)):
            said = told(folder, "convert", f"{name}.stl", "-o", f"{name}.{ending}")
            got = read((folder / f"{name}.{ending}").read_bytes())
            fact(f"{name} in {ending} are the same bits", np.array_equal(got[0], wanted) and
                 said["facets"] == len(wanted))
            fact(f"{name} in {ending}: each vertex once", got[1] == vertices, (got[1], vertices))
        fact(f"{name} in ply", got[2] == ("<f8" if name == "doubles" else "<f4"), got[2])
        told(folder, "convert", f"{name}.stl", "-o", "out.STL")
        data = (folder / "out.STL").read_bytes()
        fact(f"{name} in STL are {'text' if name == 'doubles' else 'binary'}",
             data.startswith(b"solid") == (name == "doubles"))
        got, normals = (read_stl_text if name == "doubles" else read_stl_binary)(data)
        fact(f"{name} in STL are the same bits", np.array_equal(got, wanted))
        turned = np.cross(got[:, 1] - got[:, 0], got[:, 2] - got[:, 0])
        turned /= np.linalg.norm(turned, axis=1)[:, None]
        # Rounding of floats; of doubles, that of differences of 0.1 of numbers of size 1 too.
        fact(f"{name} in STL have the normals of their corners' order", np.abs(normals - turned).max() < (1e-14 if name == "doubles" else 1e-7))
    told(folder, "convert", "doubles.stl", "-o", "out.stl", "--float")
    fact("--float rounds them", np.array_equal(np.array(stl.read(folder / "out.stl")), FLOATS))

    for words, by in ((["--units", "m"], 1), (["--units", "cm"], 1e-2), (["--units", "mm"], 1e-3), (["--units", "um"], 1e-6),
                      (["--units", "in"], 0.0254), (["--units", "ft"], 12 * 0.0254), (["--scale", "2"], 2),
                      (["--scale", "2", "3", "4"], np.array([2, 3, 4])), ([], 1)):
        said = told(folder, "convert", "doubles.stl", "-o", "out.obj", *words)
        # A product is off by a bit.
        fact(f"{' '.join(words)} scales", np.abs(read_obj((folder / "out.obj").read_bytes())[0] - DOUBLES * by).max()
             <= 2e-16 and np.allclose(said["hi"], (DOUBLES * by).max(axis=(0, 1)), rtol=1e-15))
    told(folder, "convert", "doubles.stl", "-o", "mirror.obj", "--scale", -1, 1, 1)
    got = read_obj((folder / "mirror.obj").read_bytes())[0]
    normals = np.cross(got[:, 1] - got[:, 0], got[:, 2] - got[:, 0])
    fact("a mirror keeps normals out", np.all(np.einsum("ij,ij->i", normals, got.mean(axis=1)) > 0))

    told(folder, "convert", "doubles.stl", "-o", "placed.obj", "--scale", 2, "--matrix", 0, 1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7)
    got = read_obj((folder / "placed.obj").read_bytes())[0]
    wanted = (2 * DOUBLES)[..., [1, 0, 2]] + (5, 6, 7)    # a mirror, which swaps two corners
    fact("a matrix acts behind the scale", np.array_equal(got[:, [0, 2, 1]], wanted), got - wanted)

    done = run(folder, "convert", "floats.stl", "-o", "out.ply")
    fact("people get a line", done.returncode == 0 and f"out.ply: {len(FLOATS)} facets from (-0.3" in done.stdout,
         done.stdout)
    refused(folder, "convert floats.vtk -o out.stl".split(), "floats.vtk", ".stl, .obj, .ply, .off")
    refused(folder, "convert floats.stl -o no/out.stl".split(), "no/out.stl")
    refused(folder, "convert floats.stl -o out2.stl --units km".split(), "--units", "km", "mm", code=2)
    refused(folder, "convert floats.stl -o out2.stl --units mm --scale 2".split(), "--units", "--scale", code=2)
    # What no command would read again.
    refused(folder, "convert floats.stl -o out2.stl --scale 1e300".split(), "coordinate", "beyond 1e100", "smaller scale")
    refused(folder, "convert floats.stl -o out2.stl --scale 1e60 --float".split(), "inf, beyond 1e100", "smaller scale")
    refused(folder, "convert floats.stl -o out2.off --scale 1e-200".split(), "across", "larger scale")


# A roof over a square of one polygon with four corners.
ROOF = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 0.75)])
SIDES = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
FLOOR = (3, 2, 1, 0)


def check_roof(folder, name):
    told(folder, "convert", name, "-o", "roof.stl")
    got = stl.read(folder / "roof.stl")
    fact(f"{name}: sides as they are", {tuple(map(tuple, ROOF[list(s)])) for s in SIDES} <= set(got), got)
    seen = told(folder, "inspect", "roof.stl")
    fact(f"{name}: the floor in two, wound alike", len(got) == 6 and seen["closed"] and seen["clean"]
         and abs(seen["volume"] - 0.25) < 1e-15, seen)


def test_read(folder):
    v = "".join("v {} {} {}\n".format(*x) for x in ROOF)
    sides = "".join("f {}/1/1 {}/1/1 {}//1\n".format(*(k + 1 for k in s)) for s in SIDES[:2])
    (folder / "roof.obj").write_text("# roof\nmtllib none.mtl\no a\n" + v + "vt 0 0\nvn 0 0 1\n"
                                     + sides.replace("//", "/1/") + "g b\nf -3 -2 -1\nf 4 1 5\nusemtl c\nf 4 3 2 1\n")
    check_roof(folder, "roof.obj")
    faces = "".join(f"{len(f)} {' '.join(map(str, f))}\n" for f in [*SIDES, FLOOR])
    points = "".join("{} {} {}\n".format(*x) for x in ROOF)
    # 65536 bytes of a file are looked at first.
    for head in ("OFF\n# roof\n", f"OFF\n# {70000 * '-'}\n", f"# {70000 * '-'}\nOFF\n", f"# {65531 * '-'}\nOFF\n"):
        (folder / "roof.off").write_text(head + "5 5 0\n" + points + faces)
        check_roof(folder, "roof.off")
    (folder / "no.off").write_text("no\n" * 40000)
    refused(folder, "convert no.off -o none.stl".split(), "no.off, line 1: 'no' found where 'OFF' is expected")
    head = ("ply\nformat {} 1.0\nelement vertex 5\nproperty {t} x\nproperty {t} y\nproperty {t} z\n"
            "element face 5\nproperty list uchar int vertex_indices\nend_header\n")
    (folder / "text.ply").write_text(head.format("ascii", t="float") + points + faces)
    check_roof(folder, "text.ply")
    stl.write(folder / "doubles.stl", DOUBLES)
    for ending in ("ply", "obj", "off"):
        told(folder, "convert", "doubles.stl", "-o", f"there.{ending}")
        told(folder, "convert", f"there.{ending}", "-o", "back.stl")
        fact(f"there and back by {ending} are the same bits",
             np.array_equal(read_stl_text((folder / "back.stl").read_bytes())[0], DOUBLES))
        told(folder, "convert", f"there.{ending}", "-o", "again.stl", "--units", "cm")
        fact("and in centimetres", abs(told(folder, "inspect", "again.stl")["volume"] /
             told(folder, "inspect", "doubles.stl")["volume"] / 1e-6 - 1) < 1e-12)

    (folder / "lines.obj").write_text(v + "f 1 2 5\nl 1 2\np 3\n")
    said = told(folder, "convert", "lines.obj", "-o", "lines.stl")
    fact("points and lines are left out, and told", said["facets"] == 1 and said["left_out"] == 2, said)
    (folder / "empty.obj").write_text(v)
    (folder / "broken.ply").write_text("ply\nformat ascii 1.0\nelement vertex 9\nend_header\n1 2\n")
    (folder / "text.off").write_text("this is no mesh")
    (folder / "far.off").write_text("OFF\n3 1 0\n0 0 0\n1e400 0 0\n0 1 0\n3 0 1 2\n")
    (folder / "index.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
    (folder / "index.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
    (folder / "index.ply").write_text((folder / "text.ply").read_text().replace("3 0 1 4", "3 0 1 9"))
    for name in ("empty.obj", "index.obj", "index.ply", "broken.ply", "text.off", "far.off", "index.off",
                 "nowhere.obj"):
        refused(folder, f"convert {name} -o none.stl".split(), name)
