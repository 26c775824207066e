# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Reads the files of ParaView that LSDCD writes, by an XML parser."""
import base64
import struct
import xml.etree.ElementTree as ElementTree

FORMATS = {"Float64": "d", "Int64": "q", "Int32": "i"}


def read(path):
    """{name: [numbers]} of the arrays of a .vtp file."""
    found = {}
    for a in ElementTree.parse(path).getroot().iter("DataArray"):
        data = base64.b64decode(a.text)
        assert struct.unpack("<Q", data[:8])[0] == len(data) - 8
        found[a.get("Name")] = [v[0] for v in struct.iter_unpack("<" + FORMATS[a.get("type")], data[8:])]
    return found


def listed(path):
    """[(time, file)] of a .pvd file."""
    root = ElementTree.parse(path).getroot()
    assert root.tag == "VTKFile" and root.get("type") == "Collection"
    return [(float(d.get("timestep")), d.get("file")) for d in root.find("Collection").findall("DataSet")]
