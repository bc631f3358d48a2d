# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/hydrostaticBox.png'
load common
set xlabel 'along the line [m]'; set ylabel 'p [kPa]'
plot 'comparison/depth.dat' using 1:(1e-3*$2) with points pointtype 7 linecolor rgb "#1f4e9c" title 'particles', \
     '' using 1:(1e-3*$3) with lines linestyle 9 title 'ρ g·x + constant'
