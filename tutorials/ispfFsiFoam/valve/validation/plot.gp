# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/valve.png'
width = 1100; height = 900
load common
set multiplot
set key above
set origin 0, 0.45
set size 1, 0.55
set xlabel 't [s]'
set ylabel 'mean velocity [m/s]'
set y2label 'pressure held [kPa], tip from rest [mm]'
set y2tics
set y2range [-4:4]; set yrange [-1:1]
plot 'comparison/flow.dat' using 1:2 with lines linestyle 1 title 'mean velocity', \
     'comparison/pressure.dat' using 1:(1e-3*$2) axes x1y2 with lines linestyle 2 title 'pressure held', \
     'comparison/tip.dat' using 1:(1e3*$3) axes x1y2 with lines linestyle 3 title 'tip, towards the wall'
unset y2tics; unset y2label; unset key
set size ratio -1
set xlabel 'x [mm]'; set ylabel 'y [mm]'; set cblabel 'speed [m/s]'
set xrange [0:46]; set yrange [-10:10]; set cbrange [0:1.5]
set palette defined (0 '#f7fbff', 0.5 '#4292c6', 1 '#08306b')
do for [name in 'open closed'] {
    set origin (name eq 'open' ? 0 : 0.5), 0
    set size 0.5, 0.5
    set title name
    plot for [side in '1 -1'] 'comparison/'.name.'.dat' using (1e3*$1):(1e3*side*$2):3 with image, \
         for [side in '1 -1'] 'comparison/'.name.'.leaflet.dat' using (1e3*$1):(1e3*side*$2) with points pointtype 7 pointsize 0.5 linecolor rgb '#c0392b'
}
unset multiplot
