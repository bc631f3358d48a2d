# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/carotidWave.png'
width = 1300; height = 800
load common
set multiplot layout 2,2
set key above
stats 'comparison/p-inlet.dat' index 0 using 1 name 'time' nooutput
set xrange [0:time_max]
set xlabel 't / beat'
do for [name in "inlet outlet"] {
    set ylabel 'p at the '.name.' [kPa]'
    plot 'comparison/p-'.name.'.dat' index 0 using 1:2 with lines linestyle 1 title 'particles', \
         '' index 1 using 1:2 with lines linestyle 9 title 'published'
}
set ylabel 'flow out [mL/s]'
plot 'comparison/Q-outlet.dat' index 0 using 1:2 with lines linestyle 1 title 'particles', \
     '' index 1 using 1:2 with lines linestyle 9 title 'published'
set xrange [2.95:3.2]
set yrange [10:18]
set key inside top left vertical
set xlabel 'inner radius [mm]'; set ylabel 'p half way along [kPa]'
plot 'comparison/law.dat' index 0 using 1:2 with points linestyle 1 pointtype 7 pointsize 0.4 title 'particles', \
     '' index 1 using 1:2 with lines linestyle 3 title "the wall's law", \
     '' index 2 using 1:2 with lines linestyle 9 title 'benchmark'
unset multiplot
