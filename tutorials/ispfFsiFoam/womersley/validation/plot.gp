# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/womersley.png'
width = 1300; height = 480
load common
set multiplot layout 1,3
set xlabel 't/T'; set ylabel 'flow'
set format y '%.1e'
flow = 'comparison/flow.dat'
set key outside top center horizontal
plot flow index 0 using 1:2 with lines linestyle 1 title columnheader(1), \
     '' index 1 using 1:2 with lines linecolor black dashtype 2 title columnheader(1)
set format y '%g'
profile = 'comparison/profile.dat'
set xrange [0:1]
set xlabel 'r/R'; set ylabel 'amplitude of u [mm/s]'
plot profile index 0 using 1:(1e3*$2) with points pointtype 6 linecolor black title 'particles', \
     '' index 1 using 1:(1e3*$2) with lines linestyle 1 title columnheader(1)
set ylabel 'phase against the pressure gradient [degrees]'
plot profile index 0 using 1:3 with points pointtype 6 linecolor black title 'particles', \
     '' index 1 using 1:3 with lines linestyle 1 title columnheader(1)
unset multiplot
