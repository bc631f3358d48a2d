# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/collapsingTube.png'
width = 1100; height = 480
load common
set multiplot layout 1,2
set key bottom right
set xlabel 'lumen that has gone [mm²]'; set ylabel 'pressure across the wall [kPa]'
plot 'comparison/tube.dat' index 0 using (-1e6*$4):(1e-3*$1) with lines linestyle 1 title 'particles', \
     '' index 1 using (-1e6*$4):(1e-3*$1) with lines linestyle 9 title 'rod that buckles'
set xlabel 'half axes of the middle of the wall [mm]'
plot 'comparison/tube.dat' index 0 using (1e3*$2):(1e-3*$1) with lines linestyle 1 title 'longer', \
     '' index 0 using (1e3*$3):(1e-3*$1) with lines linestyle 2 title 'shorter', \
     '' index 1 using (1e3*$2):(1e-3*$1) with lines linestyle 9 title 'rod', \
     '' index 1 using (1e3*$3):(1e-3*$1) with lines linestyle 9 notitle
unset multiplot
