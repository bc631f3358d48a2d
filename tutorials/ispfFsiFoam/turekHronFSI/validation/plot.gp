# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/tip.png'
width = 1100; height = 480
load common
stats 'comparison/reference.dat' using 1 name 'rise' nooutput
stats 'comparison/reference.dat' using 2 name 'swing' nooutput
stats 'comparison/reference.dat' using 3 name 'drag' nooutput
data = 'comparison/history.dat'
set multiplot layout 1,2
set key above
set xlabel 't [s]'
set ylabel 'tip [mm]'
plot data index 0 using 1:(1e3*$3) with lines linestyle 1 title 'across', \
     1e3*(rise_max + swing_max) with lines linestyle 9 title 'Turek and Hron', \
     1e3*(rise_max - swing_max) with lines linestyle 9 notitle
set ylabel 'drag [N/m]'
set yrange [0:1.75*drag_max]
plot data index 1 using 1:2 with lines linestyle 1 title 'particles', \
     drag_max with lines linestyle 9 title 'Turek and Hron'
unset multiplot
