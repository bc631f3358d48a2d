# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/hold.png'
width = 1100; height = 480
load common
set multiplot layout 1,2
set xlabel 't [s]'; set ylabel 'pressure [kPa]'
set key bottom right
plot 'comparison/pressure.dat' index 0 using 1:(1e-3*$2) with lines linestyle 1 title 'particles', \
     '' index 1 using 1:(1e-3*$2) with lines linestyle 9 title "the wall's law"
set ylabel 'largest speed [m/s]'; set logscale y; set format y '%.0e'
set key top right
plot 'comparison/speed.dat' index 0 using 1:2 with lines linestyle 1 title 'particles', \
     '' index 1 using 1:2 with lines linestyle 9 title '1e-3 of the filling'
unset multiplot
