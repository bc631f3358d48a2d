# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/timeStepLimits.png'
load common
energies = 'comparison/energies.dat'
stats energies using 1 nooutput
set xlabel 'time [s]'; set ylabel 'kinetic and elastic energy, of that at the start'
set yrange [0:2]
set key top right
plot for [i=1:STATS_blocks] energies index i-1 using 1:2 with linespoints linestyle i pointtype 7 pointsize 0.5 title columnheader(1)
