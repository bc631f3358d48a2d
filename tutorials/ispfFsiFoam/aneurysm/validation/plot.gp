# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/vessel.png'
width = 1300; height = 900
load common
set multiplot layout 2,2
set size ratio -1
set xlabel 'x [mm]'; set ylabel 'z [mm]'
set palette defined (0 "#1f3864", 0.25 "#5b9bd5", 0.5 "#f2f2f2", 0.75 "#f4a259", 1 "#a4161a")
unset key
set autoscale fix
set title 'mean wall shear stress [Pa]'
set cbrange [0:*]
stats 'comparison/shear.dat' using 4 nooutput
set cbrange [0:STATS_up_quartile > 0 ? 1.8*STATS_up_quartile : 1]
plot 'comparison/shear.dat' using 1:3:4 with points pointtype 7 pointsize 0.5 linecolor palette
set title 'oscillatory shear index'
set cbrange [0:0.5]
plot 'comparison/shear.dat' using 1:3:5 with points pointtype 7 pointsize 0.5 linecolor palette
set title 'residence time [s]'
set cbrange [0:*]
plot 'comparison/age.dat' using 1:3:4 with points pointtype 7 pointsize 0.6 linecolor palette
set title 'flow [mL/s]'
set size noratio
set autoscale
set xlabel 't [s]'; set ylabel ''
set key outside top horizontal
plot 'comparison/flow.dat' index 0 using 1:2 with lines linestyle 1 title 'in', '' index 1 using 1:2 with lines linestyle 2 title 'out'
unset multiplot
