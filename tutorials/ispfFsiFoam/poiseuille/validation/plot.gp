# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/poiseuille.png'
load common
profiles = 'comparison/profiles.dat'
stats profiles using 1 nooutput
set key outside right
set xlabel 'y [mm]'; set ylabel 'u [µm/s]'
plot for [i=1:STATS_blocks] profiles index i-1 using (1e3*$1):(1e6*$2) with points linestyle i pointtype 7 pointsize 0.7 title columnheader(1), \
     for [i=1:STATS_blocks] '' index i-1 using (1e3*$1):(1e6*$3) with lines linestyle 9 title (i == 1 ? 'Morris et al.' : '')
