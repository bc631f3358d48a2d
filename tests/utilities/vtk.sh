#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# If VTK is installed, its own reader opens the particles of writeFormat ascii: every time, every particle, its
# pressure
set -uo pipefail
python=""
for p in python3 /usr/bin/python3 pvpython; do
    "$p" -c "import vtkmodules.vtkIOXML" 2> /dev/null && { python=$p; break; }
done
[ -n "$python" ] || { echo "  VTK is not installed (bin/installDependencies docs, or Debian's python3-vtk9)"; exit 77; }
. "$(dirname "$0")/../cases/functions"

newCase membrane opened
echo "writeFormat ascii;" >> system/controlDict
place
solved
cat > look.py <<'END_OF_SCRIPT'
import json
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
for file in reversed(json.load(open("particles.vtp.series"))["files"]):  # the newest is first
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file["name"])
    reader.Update()
    data = reader.GetOutput()
    fields = data.GetPointData()
    print("%.6g %d %d %.9g %.9g" % (file["time"], data.GetNumberOfVerts(), fields.GetArray("U").GetNumberOfComponents(),
          *fields.GetArray("p").GetRange()))
END_OF_SCRIPT
timeout 120 "$python" look.py > seen 2> log.vtk || fail "$python: $(tail -n 3 log.vtk)"
for time in $(ls -d 0.* | sort -g); do
    awk -v time="$time" '/^\)/ { on = 0 } on { if (!n++ || $1 < low) low = $1; if (n == 1 || $1 > high) high = $1 } /^\($/ { on = 1 }
        END { printf "%.6g %d 3 %.9g %.9g\n", time, n, low, high }' "$time/p"
done > written
[ "$(wc -l < seen)" -gt 1 ] || fail "VTK sees $(wc -l < seen) times"
# pressures have six digits in this file
paste written seen | awk 'function near(a, b) { return (a - b)^2 <= (5e-6*a)^2 }
    NF != 10 || $1 != $6 || $2 != $7 || $3 != $8 || !near($4, $9) || !near($5, $10) { bad = 1; print } END { exit bad }' ||
    fail "VTK (right) sees other particles than were written (left)"
[ $failures = 0 ]
