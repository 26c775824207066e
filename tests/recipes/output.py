#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Adds two outputs to copies of the files that doc/design.md names, as it tells.

usage: output.py SRC OUT     the sources, and where the copies go

A number for each triangle in mesh_fields: normal_rms, the root mean square of the normal force over time. And
a file that a run writes every so many steps: `mesh_off FILE every N`, the mesh where it is, in the format OFF.
"""
import sys

from edit_copy import edit_copy, write

HEADER = """\
// The mesh where it is, as an OFF file.
#pragma once

#include "mesh/welded_mesh.h"
#include "motion/pose.h"

#include <string>

namespace lsdcd {

// The file appears whole or not at all; throws InputError that names it.
void write_mesh_off(const std::string &path, const WeldedMesh &mesh, const Pose &pose = {});

}    // namespace lsdcd
"""
WRITER = """\
#include "output/mesh_off.h"

#include "base/atomic_file.h"

#include <sstream>

namespace lsdcd {

void write_mesh_off(const std::string &path, const WeldedMesh &mesh, const Pose &pose)
{
  std::ostringstream text;
  text.precision(17);
  text << "OFF\\n" << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\\n";
  for (const Vec3 &vertex : mesh.vertices) {
    const Vec3 x = pose.to_box(vertex);
    text << x.x << ' ' << x.y << ' ' << x.z << '\\n';
  }
  for (const auto &f : mesh.faces) text << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\\n';
  write_whole_file(path, text.str());
}

}    // namespace lsdcd
"""
NUMBER_OF_A_TRIANGLE = {
    "output/mesh_loads.h": [
        ("  Real contacts = 0;         // time; of the number of contacts\n",
         "  Real contacts = 0;         // time; of the number of contacts\n"
         "  Real square = 0;           // force^2 time; of the normal forces\n"),
        ("kPackedLoad = 8;", "kPackedLoad = 9;")],
    "output/mesh_loads.cpp": [
        ("    to.contacts += dt;\n", "    to.contacts += dt;\n    to.square += r.normal * r.normal * dt;\n"),
        ("l.force.z});", "l.force.z, l.square});"),
        ("    to.force += {r[5], r[6], r[7]};\n", "    to.force += {r[5], r[6], r[7]};\n    to.square += r[8];\n"),
        ("      faces[f].force += part * Vec3{r[5], r[6], r[7]};\n",
         "      faces[f].force += part * Vec3{r[5], r[6], r[7]};\n      faces[f].square += part * r[8];\n")],
    "output/mesh_fields.cpp": [
        ('{"contacts", {}}};', '{"contacts", {}}, {"normal_rms", {}}};'),
        ("per_time * l.contacts, l.worn,", "per_time * l.contacts, std::sqrt(per_time * l.square), l.worn,")],
}
FILE_OF_A_RUN = {
    "output/CMakeLists.txt": [("mesh_stl.cpp", "mesh_off.cpp mesh_stl.cpp")],
    "wall/wall_spec.h": [("  FileEvery stl; ", "  FileEvery off;\n  FileEvery stl; ")],
    "input/keywords.cpp": [
        ('    {"mesh_stl", "FILE every N",',
         '    {"mesh_off", "FILE every N", "", "*.off, N >= 1", "none",\n'
         '     "the mesh where it is, in the format OFF, every N steps; * is the step", nullptr,\n'
         '     [](Tokens &w, MeshSpec &s, InputNames &) { s.off = read_file_every(w, ".off"); }},\n'
         '    {"mesh_stl", "FILE every N",')],
    "input/script_files.cpp": [
        ("    if (m.stl.every > 0) ",
         '    if (m.off.every > 0) files.push_back({"mesh_off", m.off.name, m.off.every, true});\n'
         "    if (m.stl.every > 0) ")],
    "wall/spec_check.cpp": [
        ("{kStl, one.stl.name, other.stl.name}}",
         '{{"off", "mesh_off"}, one.off.name, other.off.name}, {kStl, one.stl.name, other.stl.name}}')],
    "wall/wall_files.cpp": [
        ('#include "output/mesh_stl.h"\n', '#include "output/mesh_off.h"\n#include "output/mesh_stl.h"\n'),
        ("std::gcd(m.fields.every, m.stl.every)", "std::gcd(m.off.every, std::gcd(m.fields.every, m.stl.every))"),
        ('"mesh_stl", settings_.meshes[k].stl, step);\n',
         '"mesh_stl", settings_.meshes[k].stl, step);\n'
         '    check(static_cast<int>(k), "mesh_off", settings_.meshes[k].off, step);\n'),
        ("    if (is_due(m.stl))\n",
         '    if (is_due(m.off))\n      try_to_write("there is no mesh_off of this step", [&] {\n'
         "        write_mesh_off(file_of_step(m.off.name, step), *meshes[k].mesh, meshes[k].pose);\n      });\n"
         "    if (is_due(m.stl))\n")],
}


def main():
    src, out = sys.argv[1:]
    write(out, "output/mesh_off.h", HEADER)
    write(out, "output/mesh_off.cpp", WRITER)
    for path, edits in {**NUMBER_OF_A_TRIANGLE, **FILE_OF_A_RUN}.items():
        edit_copy(src, out, path, edits)


if __name__ == "__main__":
    main()
