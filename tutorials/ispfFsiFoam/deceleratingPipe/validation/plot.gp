# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/deceleratingPipe.png'
width = 1500; height = 480
load common
set multiplot layout 1,3
flow = 'comparison/flow.dat'
set xlabel 't [ms]'; set ylabel 'mean speed [m/s]'
plot for [i=1:2] flow index i-1 using (1e3*$1):2 with lines linestyle i dashtype i title columnheader(1)
set ylabel 'out less in [%]'
set key above
plot for [i=3:2:-1] flow index i using (1e3*$1):(100*$2) with lines linestyle i title columnheader(1), \
     0.5 with lines linestyle 9 title 'asked for', -0.5 with lines linestyle 9 notitle
set xlabel 'r [mm]'; set ylabel 'u [m/s]'
set key outside right top vertical
unset colorbox; set palette defined (0 '#1f4e9c', 1 '#27874b', 2 '#d68910', 3 '#c0392b', 4 '#7d3c98')
profiles = 'comparison/profiles.dat'
stats profiles using 1 nooutput
plot for [i=1:STATS_blocks] profiles index i-1 using (1e3*$1):2 with points linecolor palette frac ((i-1)/(STATS_blocks-0.999)) pointtype 7 pointsize 0.7 title columnheader(1), \
     for [i=1:STATS_blocks] '' index i-1 using (1e3*$1):3 with lines linecolor palette frac ((i-1)/(STATS_blocks-0.999)) linewidth 1.5 title (i == 1 ? 'exact' : '')
unset multiplot
