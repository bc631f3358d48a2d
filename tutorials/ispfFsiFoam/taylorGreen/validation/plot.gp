# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/taylorGreen.png'
width = 1400; height = 440
load common
set multiplot layout 1,3
set xlabel 'time [s]'; set ylabel 'speed, of that at the start'
set key top right
plot 'comparison/decay.dat' using 1:2 every ::1 with lines linestyle 1 title 'particles', \
     '' using 1:3 every ::1 with lines linestyle 9 title 'exact'
set xlabel 'x [m]'; set ylabel 'v at y = 0.5 [m/s]'
set key top left
profiles = 'comparison/profiles.dat'
stats profiles using 1 nooutput
plot for [i=1:STATS_blocks] profiles index i-1 using 1:2 every 2 with points linestyle i pointtype 7 pointsize 0.6 title columnheader(1), \
     for [i=1:STATS_blocks] '' index i-1 using 1:3 with lines linestyle 9 notitle
set xlabel 'time [s]'; set ylabel 'L2 error over L2 [%]'
set xrange [0:*]; set yrange [0:*]
set key center right
plot 'comparison/errors.dat' using 1:(100*$2) every ::1 with lines linestyle 1 title 'U', \
     '' using 1:(100*$3) every ::1 with lines linestyle 2 title 'p'
unset multiplot
