# SPDX-License-Identifier: GPL-3.0-or-later
load common
errors = 'comparison/order.dat'
stats errors using 1 nooutput
first = STATS_min
stats errors using 2 nooutput
set logscale xy
set xrange [0.8*first:*]
set key top left
set xlabel 'dx/L'; set ylabel 'error/U'
plot for [i=1:STATS_blocks] errors index i-1 using 1:2 with linespoints linestyle i pointtype 7 title columnheader(1), \
     STATS_min*x/first with lines linestyle 9 title 'first order'
