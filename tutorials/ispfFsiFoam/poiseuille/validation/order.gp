# SPDX-License-Identifier: GPL-3.0-or-later
load common
errors = 'comparison/order.dat'
stats errors using 1 nooutput
first = STATS_min; last = STATS_max
stats errors using 2 nooutput
set logscale xy
set format '%g'
set xrange [0.8*1e3*first:1.2*1e3*last]
do for [m=-4:4] { do for [k in '1 2 5'] { set xtics add (sprintf('%g', k*10.0**m) k*10.0**m) } }
set key top left
set xlabel 'dx [mm]'; set ylabel 'largest error of u over the peak'
plot for [i=1:STATS_blocks] errors index i-1 using (1e3*$1):2 with linespoints linestyle i pointtype 7 title 'walls: '.columnheader(1), \
     STATS_min*(1e-3*x/first)**2 with lines linestyle 9 title 'second order'
