# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/tips.png'
width = 1100; height = 900
load common
tip = 'comparison/tip.dat'; curves = 'comparison/reference.dat'
set multiplot layout 2,2
set key above
set xlabel 't [s]'
do for [c=2:3] {
    set ylabel (c == 2 ? 'tip, along the channel [mm]' : 'tip, towards the wall [mm]')
    plot tip using 1:(1e3*column(c)) with lines linestyle 1 title columnheader(1), \
         for [i=0:1] curves index (2*(c-2)+i) using 1:(1e3*$2) with lines linestyle (i+3) title columnheader(1)
}
set origin 0, 0
set size 1, 0.5
set size ratio -1
set key off
set xlabel 'x [mm]'; set ylabel 'y [mm]'; set cblabel 'speed [m/s]'
set xrange [10:40]; set yrange [0:16.1]
set palette defined (0 '#f7fbff', 0.5 '#4292c6', 1 '#08306b')
mirrored(y, upper) = upper ? 16.1 - 1e3*y : 1e3*y
plot for [upper=0:1] 'comparison/flow.dat' using (1e3*$1):(mirrored($2, upper)):3 with image, \
     for [upper=0:1] 'comparison/leaflets.dat' using (1e3*$1):(mirrored($2, upper)) with points pointtype 7 pointsize 0.6 linecolor rgb '#c0392b'
unset multiplot
