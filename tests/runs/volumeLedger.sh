#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A cavity whose surface consists of two triangles: without control it gains the volume that the piston pushes in, within 1 %
# of the stroke, and the wall keeps its volume, in twenty cycles as in half a cycle
set -uo pipefail
. "$(dirname "$0")/../cases/functions"

newCase membrane uncontrolled
setEntry system/sphSolution volumeLedger.relaxation 0
echo "monolithic { volumeFeedback 0; }" >> system/sphSolution
place
# keeps steps
keeps() {
    awk -v steps="$1" '
        !/^#/ { ++n; defect = $3 - $2; if (defect < 0) defect = -defect
                if (defect > worst) worst = defect
                if ($2 > stroke) stroke = $2
                if ($6 != 0 || $7 != 0) { print "    control in " $0; bad = 1 }
                change = $5 < 0 ? -$5 : $5
                if (change > wall) wall = change }
        END { if (n != steps || stroke < 9.9e-4) { print "    " n " rows, stroke " stroke; bad = 1 }
              if (worst > 0.01*stroke) { print "    cavity off by " worst/stroke " of the stroke"; bad = 1 }
              if (wall > 0.005*0.0048) { print "    wall changes by " wall; bad = 1 }
              exit bad }' postProcessing/volumeLedger/0/volumeLedger.dat || fail "the cavity against the piston, $1 steps"
}
solved
keeps 26
# with 50 steps per cycle each step turns the wall's ends by 2 degrees
rm -rf postProcessing 0.[1-9]*
setEntry system/controlDict endTime 10
setEntry system/controlDict writeInterval 500
solved
keeps 1000
[ $failures = 0 ]
