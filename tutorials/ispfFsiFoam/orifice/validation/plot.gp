# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/orifice.png'
load common
set multiplot layout 2, 1
set xlabel 't [ms]'; set ylabel 'flow [mm²/s]'
set key outside right
plot for [i=1:2] 'comparison/flux.dat' index i-1 using (1e3*$1):(1e6*$2) with lines linestyle i title columnheader(1)
set ylabel 'energy [mJ/m]'
plot for [i=1:2] 'comparison/energy.dat' index i-1 using (1e3*$1):(1e3*$2) with lines linestyle i title columnheader(1)
unset multiplot
