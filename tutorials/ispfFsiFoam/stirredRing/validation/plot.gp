# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/stirredRing.png'
load common
set xlabel 'time [s]'; set ylabel 'change of the area inside [%]'
set yrange [-0.6:0.6]
set key above
plot 'comparison/area.dat' using 1:2 with lines linestyle 1 title 'inner wall particles', \
     0.5 with lines linestyle 9 title 'tolerance', -0.5 with lines linestyle 9 notitle
