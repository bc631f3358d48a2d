# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/taylorGreen.png'
width = 1100; height = 480
load common
set multiplot layout 1,2
set xlabel 'time [s]'; set ylabel 'largest speed [m/s]'
set key top right
times = system('ls postProcessing/middle | sort -g')   # of the written profiles
last = word(times, words(times)) + 0.0
plot 'comparison/decay.dat' using 1:2 with lines linestyle 1 title 'particles', \
     [0:last] exp(-8*pi**2*0.01*x) linestyle 9 title 'exact'
set xlabel 'x [m]'; set ylabel 'v at y = 0.5 [m/s]'
set key top left
plot for [i=1:words(times)] 'postProcessing/middle/'.word(times, i).'/line.dat' using 2:6 every 2 with points linestyle i pointtype 7 pointsize 0.6 title word(times, i).' s', \
     for [t in times] [0:1] -sin(2*pi*x)*exp(-8*pi**2*0.01*(t + 0.0)) linestyle 9 notitle
unset multiplot
