# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/springs.png'
width = 1500; height = 520
load common
set multiplot layout 1,3
set xlabel 'stretch'; set ylabel 'nominal stress [Pa]'
set key bottom right font ',9'
response = 'comparison/response.dat'
stats response using 1 nooutput
set title 'points: calibrateSprings, lines: sums over the links'
if (exists("STATS_blocks")) { plot for [i=1:(STATS_blocks < 9 ? STATS_blocks : 9)] response index i-1 using 1:2 with points linestyle 1+(i-1)%5 pointtype 5+i pointsize 0.8 title columnheader(1), \
     for [i=1:(STATS_blocks < 9 ? STATS_blocks : 9)] '' index i-1 using 1:3 with lines linestyle 1+(i-1)%5 linewidth 1 notitle }
set title 'free slabs'; set xlabel 'layers'; set ylabel 'E over that of the endless lattice'
set key bottom right
slabs = 'comparison/slabs.dat'
stats slabs using 1 nooutput
if (STATS_records > 0) { plot for [i=1:STATS_blocks] slabs index i-1 using 1:2 with points linestyle i pointtype 7 title columnheader(1), \
     for [i=1:STATS_blocks] '' index i-1 using 1:3 with lines linestyle i linewidth 1 notitle }
set title 'a shear wave'; set xlabel 'time [s]'; set ylabel 'energy, of that at the start'
set key top right; set yrange [0:1.2]
wave = 'comparison/wave.dat'
stats wave index 0 using 1 nooutput
some = STATS_records > 50 ? STATS_records/50 : 1
plot for [i=1:2] wave index i-1 using 1:2 every some with points linestyle i pointtype 7 pointsize 0.6 title columnheader(1), \
     for [i=1:2] '' index i-1 using 1:3 with lines linestyle i linewidth 1 title (i == 1 ? 'exact for these steps' : '')
unset multiplot
