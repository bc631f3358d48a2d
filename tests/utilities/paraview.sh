#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# If ParaView is installed, it opens particles.hdf.series: every time, every particle, its pressure
set -uo pipefail
command -v pvpython > /dev/null || { echo "  ParaView is not installed (bin/installDependencies docs)"; exit 77; }
. "$(dirname "$0")/../cases/functions"

newCase membrane opened
echo "functions { age { type residenceTime; } }" >> system/controlDict
place
solved
cat > look.py <<'END'
from paraview.simple import OpenDataFile, servermanager
series = OpenDataFile("particles.hdf.series")
for time in series.TimestepValues:
    series.UpdatePipeline(time)
    data = servermanager.Fetch(series)
    p = data.GetPointData().GetArray("p")
    u = data.GetPointData().GetArray("U")
    print("%.6g %d %d %.6g %.6g" % (time, data.GetNumberOfPoints(), u.GetNumberOfComponents(), *p.GetRange()))
# a field that the run carries and the start has not is offered as well
if not data.GetPointData().GetArray("residenceTime"):
    raise SystemExit("there is no residenceTime: " + str(list(series.PointArrayStatus)))
END
timeout 300 pvpython look.py > seen 2> log.paraview || fail "pvpython: $(tail -n 3 log.paraview)"
for file in $(ls -d */particles.hdf | sort -g); do
    echo "${file%%/*}"
    h5dump -y -w 1 -m %.9g -d /VTKHDF/PointData/p "$file"
done | awk '
    function put() { if (n) printf "%.6g %d 3 %.6g %.6g\n", time, n, low, high }
    NF == 1 && !/[{}]/ && !inData { put(); time = $1; n = 0 }
    /DATA {/ { inData = !n; next }  # not that of the attributes behind
    inData && /}/ { inData = 0; next }
    inData { v = $1 + 0; if (!n++ || v < low) low = v; if (n == 1 || v > high) high = v }
    END { put() }' > written
[ "$(wc -l < seen)" -gt 1 ] || fail "ParaView sees $(wc -l < seen) times"
diff written seen || fail "ParaView (right) sees other particles than were written (left)"
[ $failures = 0 ]
