# SPDX-License-Identifier: GPL-3.0-or-later
# Volume of the cavity against the volume that the plunger has pushed in, and the difference in time, with
# and without what control has put in.
# Variables: out; data, file of time, plunger volume, cavity's change and, sixth, control [m3]; stroke [m3]
width = 1200
height = 520
load common
set multiplot layout 1, 2
set size ratio 1
set xlabel "volume displaced by the plunger [ml]"
set ylabel "volume gained by the cavity [ml]"
set key top left
set xrange [0:*]
set yrange [0:*]
plot data using (1e6*$2):(1e6*$3) with lines linestyle 1 title "this run", \
     x with lines linestyle 9 title "equal"
set size noratio
set xrange [*:*]
set yrange [*:*]
set xlabel "time [s]"
set ylabel "cavity - plunger [% of the stroke]"
set key below  # the curves may be anywhere
stats data using 6 nooutput
if (STATS_min == 0 && STATS_max == 0) {
    plot data using 1:(100*($3 - $2)/stroke) with lines linestyle 2 title "nothing controlled", \
         0 with lines linestyle 9 notitle
} else {
    plot data using 1:(100*($3 - $2)/stroke) with lines linestyle 2 title "as measured", \
         data using 1:(100*($3 - $2 - $6)/stroke) with lines linestyle 1 title "less control", \
         0 with lines linestyle 9 notitle
}
unset multiplot
