# SPDX-License-Identifier: GPL-3.0-or-later
width = 1100; height = 480
load common
set multiplot layout 1,2
set logscale xy
set key top left
set ylabel 'L2 error over L2'
data = 'comparison/order.dat'
# columns: 0 and 1 over dx, 2 over deltaT
do for [part in '0,1 2,2'] {
    first = int(part[1:1]); last = int(part[3:3])
    set xrange [*:*]; set yrange [*:*]
    stats data index first:last using 1:2 nooutput
    set xrange [0.7*STATS_min_x:1.4*STATS_max_x]; set yrange [0.4*STATS_min_y:4*STATS_max_y]
    set xlabel (first == 0 ? 'dx [m], deltaT 0.25 ms' : 'deltaT [s], 50 across')
    plot for [i=first:last] data index i using 1:2 with linespoints linestyle i+1 pointtype 7 title columnheader(1), \
         STATS_max_y*(x/STATS_max_x) with lines linestyle 9 title 'order 1', \
         STATS_max_y*(x/STATS_max_x)**2 with lines linestyle 9 dashtype 3 title 'order 2'
}
unset multiplot
