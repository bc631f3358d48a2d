# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/flow.png'
load common
stats 'comparison/flux.dat' using 1 name 'flux' nooutput
stats 'comparison/law.dat' using 1 name 'law' nooutput
set key outside right top
set xlabel 't [s]'; set ylabel 'flow [mm³/s]'
set yrange [*<0:0<*]
plot for [i=1:flux_blocks] 'comparison/flux.dat' index i-1 using 1:(1e9*$2) with lines linestyle i title columnheader(1), \
     for [i=1:law_blocks] 'comparison/law.dat' index i-1 using 1:(1e9*$2) with lines linestyle 9 title (i == 1 ? 'law' : '')
