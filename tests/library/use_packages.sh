#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Run by packages_on.sh as root of a Debian of its own: use_packages.sh same|newer
set -uo pipefail
status=0
fact() { if "${@:2}"; then echo "PASS $1"; else echo "FAIL $1"; status=1; fi; }
quiet() { "$@" >/tmp/apt 2>&1 || { tail -20 /tmp/apt; false; }; }
gives() { if grep -q -- "$2" <<<"$3"; then echo "PASS $1"; else echo "FAIL $1: $3"; status=1; fi; }
install() {
  apt-get -q -y --no-install-recommends -o Acquire::Check-Valid-Until=false -o DPkg::Options::=--force-unsafe-io \
    install "$@"
}
cd /packages
# Of the mirror alone: where that fails, nothing can be said of ours.
{ apt-get -q -o Acquire::Check-Valid-Until=false -o Acquire::Languages=none update && install g++ pkgconf; } >/tmp/apt 2>&1 ||
  { tail -5 /tmp/apt; echo "no packages from the mirror"; exit 1; }

of_library=(./liblsdcd0_* ./liblsdcd-dev_* ./python3-lsdcd_* ./lsdcd_* ./lsdcd-data_*)
ours=("${of_library[@]}")
if [ "$1" = same ]; then ours+=(./lammps-lsdcd_*); fi
# What ours depend on comes first and stays: it may leave traces of its own.
others=$(install --simulate "${ours[@]}" | sed -n 's/^Inst \([^ ]*\) .*/\1/p' | grep -v lsdcd)
install $others >/tmp/apt 2>&1 || { tail -5 /tmp/apt; echo "no packages from the mirror"; exit 1; }
# Every file, but for what apt and dpkg keep for themselves.
files() {
  find / -xdev \( -path /var/cache -o -path /var/log -o -path /var/lib/apt -o -path /var/lib/dpkg -o -path /tmp \
    -o -path /run -o -path /use \) -prune -o -print | sort
}
files >/tmp/before

fact "library, module and tool install" quiet install "${of_library[@]}"

mkdir /use
cd /use
gcc -Wall /examples/distance.c -o c $(pkgconf --cflags --libs lsdcd)
gives "the example in C runs" "^[0-9.inf]* [0-9.inf]*$" "$(./c /examples/die.stl 2>&1)"
g++ -std=c++17 -Wall /examples/distance.cpp -o cpp -llsdcd
fact "C++ gives what C gives" test "$(./cpp /examples/die.stl 2>&1)" = "$(./c /examples/die.stl 2>&1)"
fact "Python gives what C gives" test "$(python3 /examples/distance.py /examples/die.stl 2>&1)" = "$(./c /examples/die.stl 2>&1)"
gives "the tool finds its materials" "material glass" "$(lsdcd material glass.lsdcd 2>&1)"
gives "the tool reads a mesh" "facets" "$(lsdcd inspect /examples/die.stl 2>&1)"
lsdcd convert /examples/die.stl -o die.off && lsdcd convert die.off -o die.stl
gives "the tool reads a mesh of another format" "192 facets" "$(lsdcd convert die.off -o again.obj 2>&1)"
fact "the licences are there" test -s /usr/share/doc/lsdcd/LICENSE -a -s /usr/share/doc/lsdcd/LICENSES/BSD-3-Clause.txt
for package in liblsdcd0 liblsdcd-dev python3-lsdcd lsdcd lsdcd-data; do
  gives "$package tells its licences" "^License: BSD-3-clause" "$(cat /usr/share/doc/$package/copyright)"
done
gives "the tool has a manual page" "^.TH LSDCD 1" "$(zcat /usr/share/man/man1/lsdcd.1.gz)"
fact "the programs have the version of their packages" \
  test "$(lsdcd --version | cut -d' ' -f2)" = "$(dpkg-query -W -f '${Version}' lsdcd)"

if [ "$1" = newer ]; then
  why=$(install /packages/lammps-lsdcd_*.deb 2>&1) && why="it installs"
  gives "a plugin for another LAMMPS is refused" "Depends: liblammps0" "$why"
else
  fact "the plugin installs" quiet install /packages/lammps-lsdcd_*.deb
  cat >in.script <<'SCRIPT'
units si
atom_style sphere
region box block -3 3 -3 3 -3 3
create_box 1 box
create_atoms 1 single 0 0 0
set type 1 diameter 0.5 density 2500
pair_style zero 0.6
pair_coeff * *
comm_modify vel yes
fix w all wall/lsdcd granular material glass.lsdcd glass mesh /examples/die.stl
run 0
print "the wall is built"
SCRIPT
  export OMP_NUM_THREADS=1    # and no word for MPI: what its library needs to start comes with the package
  gives "lmp-lsdcd runs a script with a material" "the wall is built" "$(lmp-lsdcd -in in.script -log none 2>&1)"
  gives "lmp-lsdcd has a manual page" "^.TH LMP-LSDCD 1" "$(zcat /usr/share/man/man1/lmp-lsdcd.1.gz)"
fi

# lintian's limit.
gives "no line of a description has more than 80 characters" "^$" \
  "$(dpkg-query -W -f '${Description}\n' '*lsdcd*' | awk 'length > 80')"
installed=$(dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' | sed -n 's/^ii *\(.*lsdcd.*\)/\1/p')
fact "all are removed" quiet apt-get -q -y purge $installed
files >/tmp/after
fact "without a trace" diff /tmp/before /tmp/after
fact "and the linker has forgotten the library" test -z "$(ldconfig -p | grep lsdcd)"
exit $status
