# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/forces.png'
width = 1100; height = 480
load common
stats 'comparison/reference.dat' using 1 name 'drag' nooutput
stats 'comparison/reference.dat' using 2 name 'lift' nooutput
stats 'comparison/reference.dat' using 3 name 'amplitude' nooutput
load = 'comparison/load.dat'
set multiplot layout 1,2
set key above
set xlabel 't [s]'
set ylabel 'drag [N/m]'
set yrange [0:1.5*drag_max]
plot load using 1:2 with lines linestyle 1 title 'particles', drag_max with lines linestyle 9 title 'Turek and Hron, mean'
set ylabel 'lift [N/m]'
room = 0.2*drag_max + 1.7*amplitude_max
set yrange [lift_max - room:lift_max + room]
plot load using 1:3 with lines linestyle 1 title 'particles', \
     lift_max + amplitude_max with lines linestyle 9 title 'Turek and Hron', \
     lift_max - amplitude_max with lines linestyle 9 notitle
unset multiplot
