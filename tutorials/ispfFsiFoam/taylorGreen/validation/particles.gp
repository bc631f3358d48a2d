# SPDX-License-Identifier: GPL-3.0-or-later
width = 1200; height = 620
load common
set multiplot layout 1,2
set size ratio -1
set xrange [0:1]; set yrange [0:1]; set cbrange [0:*]
set xlabel 'x [m]'; set ylabel 'y [m]'; set cblabel 'speed [m/s]'
unset key; unset grid
set palette defined (0 '#1f4e9c', 0.5 '#27874b', 1 '#d68910')
data = 'comparison/particles.dat'
do for [i=0:1] {
    stats data index i every ::1 using 3 nooutput
    set title word('with without', i+1).' shifting'
    set cbrange [0:STATS_max]
    plot data index i using 1:2:3 every ::1 with points pointtype 7 pointsize 0.45 palette
}
unset multiplot
