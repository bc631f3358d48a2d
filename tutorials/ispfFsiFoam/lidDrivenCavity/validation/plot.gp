# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/lidDrivenCavity.png'
width = 1100; height = 480
load common
set datafile commentschars '#'
last = system('ls postProcessing/vertical | sort -g | tail -n 1')
set multiplot layout 1,2
set key top left
set xlabel 'y [m]'; set ylabel 'u on x = 0.5 [m/s]'
plot 'postProcessing/vertical/'.last.'/line.dat' using 3:5 with lines linestyle 1 title 'particles at '.last.' s', \
     '< tr , " " < validation/ghia.csv' using 1:2 with points pointtype 6 linecolor black title 'Ghia et al. 1982'
set key top right
set xlabel 'x [m]'; set ylabel 'v on y = 0.5 [m/s]'
plot 'postProcessing/horizontal/'.last.'/line.dat' using 2:6 with lines linestyle 1 title 'particles at '.last.' s', \
     '< tr , " " < validation/ghia.csv' using 3:4 with points pointtype 6 linecolor black title 'Ghia et al. 1982'
unset multiplot
