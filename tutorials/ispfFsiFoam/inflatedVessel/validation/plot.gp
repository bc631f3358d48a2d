# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/inflatedVessel.png'
width = 1100; height = 480
load common
set multiplot layout 1,2
set xlabel 'growth of the lumen [%]'; set ylabel 'pressure [kPa]'
set key left top
plot 'comparison/pressure.dat' using (100*$1):(1e-3*$2) with points linestyle 1 pointtype 7 pointsize 0.5 title 'particles', \
     '' using (100*$1):(1e-3*$3) with lines linestyle 9 title "the wall's law", \
     '' using (100*$1):(1e-3*$4) with lines linestyle 3 dashtype 2 title 'neo-Hooke'
set xlabel 'radius at rest / A'; set ylabel 'radius / A'
plot 'comparison/wall.dat' index 1 using 1:2 with lines linestyle 4 linewidth 6 title 'incompressible', \
     '' index 0 using 1:2 with points linestyle 1 pointtype 7 pointsize 0.3 title 'wall particles'
unset multiplot
