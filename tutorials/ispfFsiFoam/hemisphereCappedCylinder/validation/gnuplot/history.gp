# SPDX-License-Identifier: GPL-3.0-or-later
# One quantity over time with a published or computed level.
# Variables: out; data, file of time and value; label of the axis; level, its name levelTitle;
# factor to the axis' unit
load common
set xlabel "time [s]"
set ylabel label
set key bottom center
stats data using 1 nooutput
set xrange [0:STATS_max]
set yrange [*:*]
set offsets 0, 0, graph 0.05, 0
plot data using 1:(factor*$2) with lines linestyle 1 title "this run", \
     level with lines linestyle 9 title levelTitle
