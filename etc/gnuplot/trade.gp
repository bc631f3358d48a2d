# SPDX-License-Identifier: GPL-3.0-or-later
# Error against CPU time, one curve per family of runs, and their front.  Variables: common, data (of bin/tools/trade.py),
# out, quantity
width = 1100; height = 700
load common
stats data using 1:2 nooutput
last = STATS_blocks - 1
set logscale xy
set xrange [0.8*STATS_min_x:1.3*STATS_max_x]
set yrange [0.8*STATS_min_y:1.3*STATS_max_y]
set mytics 10; set format y '%g'
do for [e=-8:6] { do for [m=2:5:3] {
    at = m*10.0**e
    set xtics add (sprintf('%g', at) at); set ytics add (sprintf('%g', at) at) } }
set xlabel 'CPU time [s]'; set ylabel quantity
set key outside right
plot data index last using 1:2 with lines linecolor rgb "#bbbbbb" linewidth 7 title 'front', \
     for [i=1:last] data index i-1 using 1:2 with linespoints linestyle i pointtype 4+i pointsize 1.3 title columnheader(1), \
     for [i=1:last] '' index i-1 using 1:2:3 every ::1 with labels offset 0.6,0.6 left font ",9" textcolor linestyle i notitle
