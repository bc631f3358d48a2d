# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/flexibleTube.png'
width = 1300; height = 420
load common
set multiplot layout 1,3
set xlabel 't [ms]'; set ylabel 'radial displacement half way along [mm]'
set key left top
stats 'comparison/wall.dat' index 0 using 1 name 'time' nooutput
set xrange [0:time_max]
set yrange [*:0.22]
plot 'comparison/wall.dat' index 0 using 1:2 with lines linestyle 1 title 'particles', \
     '' index 1 using 1:2 with lines linestyle 9 title 'linear', \
     '< grep ^published validation/published.csv | tr "," " "' using 3:2 with points linestyle 2 pointtype 7 pointsize 1.2 title 'published'
set xrange [0:32]; set yrange [0:*]
set xlabel 'z [mm]'; set ylabel 'front [ms]'
plot 'comparison/front.dat' index 0 using 1:2 with points linestyle 1 pointtype 7 title 'particles', \
     '' index 1 using 1:2 with linespoints linestyle 3 pointtype 6 title 'linear', \
     '' index 2 using 1:2 with lines linestyle 9 title 'long waves'
set xrange [0:time_max]; set yrange [*:*]
set xlabel 't [ms]'; set ylabel 'energy [µJ]'
set key outside top horizontal
plot for [k=0:4] 'comparison/energy.dat' index k using 1:2 with lines linestyle k+1 title word('given kinetic elastic viscosity lost', k+1)
unset multiplot
