# SPDX-License-Identifier: GPL-3.0-or-later
# Change of each quantity by each variant, relative to `base`.  Input: comparison/influence.csv
out = 'comparison/influence.png'
width = 1200; height = 640
load common
set datafile separator ','
data = 'comparison/influence.csv'
stats data using 0 skip 1 nooutput
set xlabel 'change from base [%] (beyond the frame: at its edge)'
set xrange [-110:110]
set yrange [STATS_records - 0.5:-0.5]
set key outside right
set arrow 1 from 0, graph 0 to 0, graph 1 nohead linestyle 9
held(x) = x > 105 ? 105 : x < -105 ? -105 : x
plot for [i=2:STATS_columns] data using (held(column(i))):0:ytic(1) with points pointtype (i % 15) pointsize 1.5 linecolor i title columnhead(i)
