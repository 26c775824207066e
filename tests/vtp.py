# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Reads the files of ParaView that LSDCD writes, by an XML parser."""
import base64
import struct
import xml.etree.ElementTree as ElementTree

FORMATS = {"Float64": "d", "Int64": "q", "Int32": "i"}


ORDERS = {"LittleEndian": "<", "BigEndian": ">"}
LENGTHS = {"UInt32": "I", "UInt64": "Q"}


def read(path):
    """{name: [numbers]} of the arrays of a .vtp file. Its numbers of points and cells must be those that the arrays have."""
    found = {}
    root = ElementTree.parse(path).getroot()
    order, length = ORDERS[root.get("byte_order")], LENGTHS[root.get("header_type")]
    head = struct.calcsize(order + length)
    piece = root.find("PolyData/Piece")
    n_cells = sum(int(piece.get(name, 0)) for name in ("NumberOfPolys", "NumberOfLines"))
    tuples = {id(a): n for where, n in (("CellData", n_cells), ("Points", int(piece.get("NumberOfPoints"))))
              for a in piece.iterfind(f"{where}/DataArray")}
    for a in root.iter("DataArray"):
        data = base64.b64decode(a.text)
        assert struct.unpack(order + length, data[:head])[0] == len(data) - head
        numbers = [v[0] for v in struct.iter_unpack(order + FORMATS[a.get("type")], data[head:])]
        assert len(numbers) == int(a.get("NumberOfComponents", 1)) * tuples.get(id(a), len(numbers)), a.get("Name")
        found[a.get("Name")] = numbers
    assert len(found["offsets"]) == n_cells
    return found


def listed(path):
    """[(time, file)] of a .pvd file."""
    root = ElementTree.parse(path).getroot()
    assert root.tag == "VTKFile" and root.get("type") == "Collection"
    return [(float(d.get("timestep")), d.get("file")) for d in root.find("Collection").findall("DataSet")]
