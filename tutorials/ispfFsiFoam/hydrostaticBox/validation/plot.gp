# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/hydrostaticBox.png'
load common
line = 'postProcessing/depth/1/line.dat'
stats line using 5 nooutput
set xlabel 'z [m]'; set ylabel 'p - mean [kPa]'
plot [0:1] line using 4:(1e-3*($5 - STATS_mean)) with points pointtype 7 linecolor rgb "#1f4e9c" title 'particles at 1 s', \
     9.81*(0.5 - x) linestyle 9 title 'ρ g (1/2 - z)'
