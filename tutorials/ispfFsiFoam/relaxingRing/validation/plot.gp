# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/relaxingRing.png'
width = 1100; height = 480
load common
set multiplot layout 1,2
set xlabel 'time [s]'; set ylabel 'inner radius [mm]'
plot 'comparison/ring.dat' using 1:(1e3*$2) with lines linestyle 1 title 'least', \
     '' using 1:(1e3*$3) with lines linestyle 2 title 'largest', \
     '' using 1:(1e3*$4) with lines linestyle 9 title 'circle of that area'
set ylabel 'pressure jump [Pa]'
plot 'comparison/jump.dat' using 1:2 with lines linestyle 1 title 'particles', \
     '' using 1:3 with lines linestyle 9 title "springs' law at rest"
unset multiplot
