#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# demo.sh LMP WORK OUT [--movie]: what ./run demo runs. Fills and drains the vessel in the folder WORK, and puts vessel.png and
# summary.txt into OUT, with --movie vessel.gif, too. LSDCD_QUICK: a few steps, to see that it runs.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
lmp=$(realpath "$1") work=$2 out=$3 steps=() draw=() files=(vessel.png summary.txt)
if [ "${4:-}" = --movie ]; then
  steps=(-var drain 25000 -var frame 500) draw=(--at 0.2 --movie vessel.gif) files+=(vessel.gif)    # 0.5 s in 51 pictures
fi
if [ -n "${LSDCD_QUICK:-}" ]; then steps=(-var fill 1000 -var quiet 100 -var measure 100 -var drain 300 -var frame 100); fi
ranks=$(nproc)
if [ "$ranks" -gt 4 ]; then ranks=4; fi

echo "examples/vessel on $ranks processes (a minute or two)"
rm -rf "$work"
mkdir -p "$work" "$out"
out=$(realpath "$out")
cd "$work"
OMP_NUM_THREADS=1 mpirun -np "$ranks" "$lmp" -in "$here/in.vessel" -var dir "$here" "${steps[@]}" </dev/null
/usr/bin/python3 "$here/section.py" section.dump "$here/vessel.stl" vessel.png "${draw[@]}"
/usr/bin/python3 "$here/summarise.py" log.lammps > summary.txt
for file in "${files[@]}"; do    # whole files or none
  cp "$file" "$out/.$file"
  mv "$out/.$file" "$out/$file"
done
cat summary.txt
