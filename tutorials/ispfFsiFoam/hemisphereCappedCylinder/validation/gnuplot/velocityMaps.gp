# SPDX-License-Identifier: GPL-3.0-or-later
# Velocity maps of the diametral plane, one panel an instant, in the manner of the paper's Fig. 6:
# colour is the magnitude, the arrows show the direction with constant length.
# Variables: out; folders, titles (as many words each, a title's blanks as '~'); top [mm/s] of the scale
n = words(folders)
set terminal pngcairo size 175 + 360*n, 610 font "Sans,13" noenhanced
set output out
set palette defined (0 "#440154", 1 "#414487", 2 "#2a788e", 3 "#22a884", 4 "#7ad151", 5 "#fde725")
set cbrange [0:top]
set xrange [-15:15]
set yrange [-10:36]
set size ratio -1
set xtics -10, 5, 10 out nomirror
set ytics 5 out nomirror
set xlabel "x [mm]" offset 0, 0.5
unset key
set style arrow 1 head filled size 0.35, 25, 60 linecolor rgb "white" linewidth 1
length = 1.2    # [mm] of an arrow
every = 6       # grid points between arrows

speed(u, v, w) = 1e3*sqrt(u**2 + v**2 + w**2)
# no direction where the fluid is at rest
part(a, u, v) = sqrt(u**2 + v**2) > 1e-7 ? length*a/sqrt(u**2 + v**2) : NaN
blanks(s) = system(sprintf("printf '%%s' '%s' | tr '~' ' '", s))

set multiplot
left = 70.0/(175 + 360*n)
width = 360.0/(175 + 360*n)
set tmargin at screen 0.93
set bmargin at screen 0.10
do for [k=1:n] {
    grid = word(folders, k)."/diametral.dat"
    slice = word(folders, k)."/diametral.slice.dat"
    set lmargin at screen left + (k - 1)*width
    set rmargin at screen left + (k - 0.1)*width
    set title blanks(word(titles, k)) offset 0, -0.5
    if (k == 1) { set ylabel "z [mm]" offset 1, 0 } else { unset ylabel; set ytics format "" }
    if (k == n) {
        set colorbox user origin left + n*width - 0.02*width, 0.2 size 0.05*width, 0.6
        set cblabel "velocity magnitude [mm/s]" offset 1, 0
    } else { unset colorbox }
    plot grid using (1e3*$1):(1e3*$2):(speed($3, $4, $5)) with image, \
        slice using (1e3*$1):(1e3*$2) with points pointtype 7 pointsize 0.35 linecolor rgb "#b03a2e", \
        grid every every:every using (1e3*$1 - part($3, $3, $4)/2):(1e3*$2 - part($4, $3, $4)/2): \
            (part($3, $3, $4)):(part($4, $3, $4)) with vectors arrowstyle 1
}
unset multiplot
