# SPDX-License-Identifier: GPL-3.0-or-later
# Error against CPU time, one curve per family of runs, and their front.  Variables: common, data (of bin/tools/trade.py),
# out, quantity, xLow, xHigh, yLow, yHigh, crowd (points without labels)
width = 1100; height = 700
load common
stats data using 1:2 nooutput
last = STATS_blocks - 1
set logscale xy
set xrange [xLow:xHigh]
set yrange [yLow:yHigh]
set lmargin at screen 0.1; set rmargin at screen 0.66; set tmargin at screen 0.96; set bmargin at screen 0.1
set mytics 10; set format y '%g'
do for [e=-8:6] { do for [m=2:5:3] {
    at = m*10.0**e
    set xtics add (sprintf('%g', at) at); set ytics add (sprintf('%g', at) at) } }
set xlabel 'CPU time [s]'; set ylabel quantity
set key at screen 0.99, screen 0.96 right top
if (strlen(crowd)) set label 1 crowd at screen 0.68, screen 0.3 left font ",9" textcolor rgb "#404040"
plot data index last using 1:2 with linespoints linecolor rgb "#bbbbbb" linewidth 7 pointtype 7 pointsize 2.5 title 'front', \
     for [i=1:last] data index i-1 using 1:2 with linespoints linestyle i pointtype 4+i pointsize 1.3 title columnheader(1), \
     for [i=1:last] '' index i-1 using 4:5:3 every ::1 with labels left font ",9" textcolor linestyle i notitle
