#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Adds the mesh format .tri, nine numbers a line, as doc/design.md tells: a reader, and its row in a copy.

usage: mesh_format.py SRC OUT     the sources, and where the two files go
"""
import sys

from edit_copy import edit_copy, write

READER = """\
// Triangles as text: nine numbers a line, x y z of each corner.
#include "base/input_error.h"
#include "mesh/io/read_mesh.h"

#include <fstream>
#include <sstream>

namespace lsdcd {

ReadMesh read_tri(const std::string &path)
{
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot read the mesh; give the path of a file");
  ReadMesh read;
  read.soup.source = path;
  std::string line;
  for (int number = 1; std::getline(file, line); number++) {
    std::istringstream words(line);
    for (int corner = 0; corner < 3; corner++) {
      Vec3 x;
      if (!(words >> x.x >> x.y >> x.z))
        throw InputError(path + ", line " + std::to_string(number) + ": '" + line +
                         "' is not nine numbers; give x y z of three corners");
      read.soup.corners.push_back(x);
    }
  }
  return read;
}

}    // namespace lsdcd
"""
EDITS = [("ReadMesh read_off(const std::string &path);",
          "ReadMesh read_off(const std::string &path);\nReadMesh read_tri(const std::string &path);"),
         ('    {".off", read_off},\n', '    {".off", read_off},\n    {".tri", read_tri},\n')]


def main():
    src, out = sys.argv[1:]
    write(out, "mesh/io/read_tri.cpp", READER)
    edit_copy(src, out, "mesh/io/read_mesh.cpp", EDITS)


if __name__ == "__main__":
    main()
