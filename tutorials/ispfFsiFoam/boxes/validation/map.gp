# SPDX-License-Identifier: GPL-3.0-or-later
# Cells of Re_c by CFL, one panel per scene and coupling.  Variables, set by validation/study: common, out, title0..,
# word0.., colour0.., words
width = 1300; height = 1050
load common
data = 'comparison/map.dat'
cell(k) = sprintf("'%s' index %d using 1:2:(0.48):(0.48):3 every ::1 with boxxyerror fillcolor rgb variable fillstyle solid noborder notitle, '' index %d using 1:2:4 every ::1 with labels font ',10' notitle", data, k, k)
set multiplot
unset key
set border 0; unset grid
set tics scale 0
set xrange [-0.5:2.5]; set yrange [-0.5:3.5]
set xtics ('0.1' 0, '0.2' 1, '0.4' 2); set ytics ('10' 0, '50' 1, '200' 2, '1000' 3)
set xlabel 'CFL' offset 0, 0.5; 
do for [k=0:7] {
    column = k % 4; row = k / 4
    set lmargin at screen 0.08 + 0.235*column; set rmargin at screen 0.27 + 0.235*column
    set tmargin at screen 0.95 - 0.37*row; set bmargin at screen 0.68 - 0.37*row
    if (column == 0) { set ylabel 'Re_c' } else { unset ylabel }
    eval sprintf("set title title%d offset 0, -0.6 font ',12'", k)
    eval 'plot ' . cell(k)
}
set lmargin at screen 0.12; set rmargin at screen 0.55; set tmargin at screen 0.2; set bmargin at screen 0.06
set xrange [-0.5:3.5]; set yrange [-0.5:1.5]
set xtics ('periodic3D' 0, 'walled3D' 1, 'ball' 2, 'walledBall' 3); set ytics ('projection' 0, 'monolithic' 1)
unset xlabel; unset ylabel
set title title8
eval 'plot ' . cell(8)
# what the colours and figures mean
unset title; unset xtics; unset ytics
set lmargin at screen 0.6; set rmargin at screen 0.99; set tmargin at screen 0.22; set bmargin at screen 0.04
set xrange [0:10]; set yrange [0:words + 2]
do for [k=0:words-1] {
    eval sprintf("set object %d rectangle from 0, %g to 0.8, %g fillcolor rgb colour%d fillstyle solid noborder", k + 1, words + 1.1 - k, words + 1.9 - k, k)
    eval sprintf("set label %d word%d at 1.1, %g", k + 1, k, words + 1.5 - k)
}
set label 90 "closest pair [dx], 0.3 at least; below it what\nenergy was gained, of that at the start, if more than 1e-6" at 0, 0.9
plot NaN notitle
unset multiplot
