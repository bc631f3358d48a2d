# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/invariance.png'
load common
set xlabel 'steps since the transformation'; set ylabel 'difference from the run as it is'
set logscale y; set yrange [1e-18:*]; set format y '%.0e'
set key bottom right
shown(x) = x > 0 ? x : 1e-17
data = 'comparison/differences.dat'
plot data using 1:(shown($2)) with linespoints linestyle 1 pointtype 7 title 'positions, over dx', \
     data using 1:(shown($3)) with linespoints linestyle 2 pointtype 7 title 'velocities, over the largest', \
     data using 1:(shown($4)) with linespoints linestyle 3 pointtype 7 title 'pressures, over the largest'
