# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/lidDrivenCavity.png'
width = 1100; height = 480
load common
set multiplot layout 1,2
do for [name in 'u v'] {
    if (name eq 'u') { set key top left; set xlabel 'y/L on x = L/2' } else { set key top right; set xlabel 'x/L on y = L/2' }
    set ylabel name.'/U'
    plot 'comparison/'.name.'.dat' index 0 using 1:2 with lines linestyle 1 title columnheader(1), \
         '' index 1 using 1:2 with points pointtype 6 linecolor black title columnheader(1)
}
unset multiplot
