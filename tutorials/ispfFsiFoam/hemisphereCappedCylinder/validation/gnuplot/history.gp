# SPDX-License-Identifier: GPL-3.0-or-later
# One quantity over time with a published or computed level.
# Variables: out; data, file of time and value; label of the axis; level, its name levelTitle;
# factor to the axis' unit; period [s]
load common
set xlabel "time [s]"
set ylabel label
set key bottom center
stats data using 1 nooutput
set xrange [0:STATS_max]
set yrange [*:*]
# the dead centres of the period, as thin lines
do for [k=1:ceil(STATS_max/period*2) - 1] {
    set arrow from 0.5*k*period, graph 0 to 0.5*k*period, graph 1 nohead linecolor rgb "#bbbbbb"
}
plot data using 1:(factor*$2) with lines linestyle 1 title "this run", \
     level with lines linestyle 9 title levelTitle
