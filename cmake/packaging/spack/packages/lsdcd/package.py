# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Not tried.
from spack.package import *
from spack_repo.builtin.build_systems.cmake import CMakePackage


class Lsdcd(CMakePackage):
    """The library and the tool of LSDCD: distances to triangle meshes, and DEM walls made of them. For the styles in LAMMPS
    install lammps+lsdcd of this repository."""

    homepage = "https://www.lammps.org"
    # A tarball as `./run package` makes it, beside this file or on a mirror.
    url = "file:///lsdcd-0.10.0.tar.gz"

    version("0.10.0", sha256="<SHA256>")
    license("BSD-3-Clause")

    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("cli11")
    depends_on("nlohmann-json")
    depends_on("zstd")
    depends_on("xxhash")

    def cmake_args(self):
        return [self.define("LSDCD_TESTS", False), self.define("LSDCD_CUDA", False), self.define("LSDCD_LAMMPS", False)]
