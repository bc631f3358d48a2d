# SPDX-License-Identifier: GPL-3.0-or-later
# The particles of the wall in the diametral plane, undeformed and deformed, as the paper's Fig. 8
# Variables: out; before, after, files of the slice; title, name of the deformed state
width = 560
height = 720
load common
set size ratio -1
set xrange [-16:16]
set yrange [-4:36]
set xlabel "x [mm]"
set ylabel "z [mm]"
set key at graph 0.5, 1.06 center horizontal
set tmargin 4
plot before using (1e3*$1):(1e3*$2) with points pointtype 7 pointsize 0.5 linecolor rgb "#9aa0a6" \
         notitle, \
     after using (1e3*$1):(1e3*$2) with points pointtype 7 pointsize 0.5 linecolor rgb "#c0392b" \
         notitle, \
     keyentry with points pointtype 7 pointsize 1 linecolor rgb "#9aa0a6" title "undeformed", \
     keyentry with points pointtype 7 pointsize 1 linecolor rgb "#c0392b" title title
