# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/hydrostaticBox.png'
load common
last = system('ls postProcessing/depth | sort -g | tail -n 1')
line = 'postProcessing/depth/'.last.'/line.dat'
stats line using 5 nooutput
set xlabel 'z [m]'; set ylabel 'p - mean [kPa]'
plot [0:1] line using 4:(1e-3*($5 - STATS_mean)) with points pointtype 7 linecolor rgb "#1f4e9c" title 'particles at '.last.' s', \
     9.81*(0.5 - x) linestyle 9 title 'ρ g (1/2 - z)'
