# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/boxes.png'
width = 1100; height = 440
load common
set multiplot layout 1, 2
set xlabel 'time [s]'; set ylabel 'energy, of that at the start'
set xrange [0:*]; set yrange [0:1.1]
set key center right
plot for [i=1:2] 'comparison/energy.dat' index i-1 using 1:2 with lines linestyle i title columnheader(1), \
     1 with lines linestyle 9 notitle
set ylabel 'closest pair [dx]'
set key bottom right
plot 'comparison/pairs.dat' using 1:2 with linespoints linestyle 3 pointtype 7 pointsize 0.5 title 'at the written instants', \
     0.3 with lines linestyle 9 title 'least that is asked for'
unset multiplot
