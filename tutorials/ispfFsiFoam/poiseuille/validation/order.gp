# SPDX-License-Identifier: GPL-3.0-or-later
load common
errors = 'comparison/order.dat'
stats errors using 1 nooutput
first = STATS_min
stats errors using 2 nooutput
set logscale xy
set key top left
set xlabel 'dx [m]'; set ylabel 'largest error of u over the peak'
plot for [i=1:STATS_blocks] errors index i-1 using 1:2 with linespoints linestyle i pointtype 7 title 'walls: '.columnheader(1), \
     STATS_min*(x/first)**2 with lines linestyle 9 title 'second order'
