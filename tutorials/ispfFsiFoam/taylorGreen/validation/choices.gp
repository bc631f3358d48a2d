# SPDX-License-Identifier: GPL-3.0-or-later
width = 1100; height = 820
load common
set logscale x
set xrange [0.05:*]
set yrange [-1:*] reverse
set grid noytics
set xlabel 'error [%]'
set tmargin 3
set key outside top center horizontal
plot 'comparison/choices.dat' using (abs($2)):0:ytic(1) with points linestyle 3 pointtype 2 pointsize 1.3 title 'decay rate', \
     '' using 3:0 with points linestyle 1 pointtype 7 pointsize 1.4 title 'U, at the end', \
     '' using 4:0 with points linestyle 2 pointtype 5 pointsize 1.2 title 'p, mean'
