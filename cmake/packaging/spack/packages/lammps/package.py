# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Not tried.
from spack.package import *
from spack_repo.builtin.packages.lammps.package import Lammps as BuiltinLammps


class Lammps(BuiltinLammps):
    """LAMMPS with LSDCD compiled in. It needs no package PLUGIN, which Spack leaves out unless it is asked for."""

    variant("lsdcd", default=True, description="DEM walls from triangle meshes")
    # A tarball as `./run package` makes it, on a mirror.
    resource(name="lsdcd", url="file:///lsdcd-0.10.0.tar.gz", sha256="<SHA256>", placement="lsdcd", when="+lsdcd")

    def cmake_args(self):
        args = super().cmake_args()
        if self.spec.satisfies("+lsdcd"):
            join = join_path(self.stage.source_path, "lsdcd", "cmake", "packaging", "lammps", "LSDCD.cmake")
            args += [self.define("CMAKE_PROJECT_lammps_INCLUDE", join), self.define("LSDCD_CUDA", False)]
        return args
