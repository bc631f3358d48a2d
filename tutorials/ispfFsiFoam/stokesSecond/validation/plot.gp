# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/stokesSecond.png'
width = 1300; height = 480
load common
set multiplot layout 1,3
set xlabel 'y/δ'
set samples 200
set xrange [0:5.5]
set ylabel 'u/U in the last period'
instants = 'comparison/instants.dat'
stats instants using 1 nooutput
half = STATS_blocks/2
plot for [i=1:half] instants index half+i-1 using 1:2 with lines linestyle 9 notitle, \
     for [i=1:half] instants index i-1 using 1:2 with points pointtype 7 pointsize 0.7 linecolor i notitle
set ylabel 'amplitude/U'
plot 'comparison/profile.dat' index 0 using 1:2 with points pointtype 6 linecolor black title 'particles', exp(-x) with lines linestyle 1 title 'Stokes'
set ylabel 'phase [rad]'
set xrange [0:4]
plot 'comparison/profile.dat' index 0 using 1:3 with points pointtype 6 linecolor black title 'particles', -x with lines linestyle 1 title 'Stokes'
unset multiplot
