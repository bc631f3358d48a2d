# SPDX-License-Identifier: GPL-3.0-or-later
# Common settings of the curves.  Variable: out; optional width, height
if (!exists("width")) width = 900
if (!exists("height")) height = 560
set terminal pngcairo size width, height font "Sans,13" noenhanced
set encoding utf8
set output out
set style line 1 linecolor rgb "#1f4e9c" linewidth 2.5
set style line 2 linecolor rgb "#c0392b" linewidth 2.5
set style line 3 linecolor rgb "#27874b" linewidth 2.5
set style line 4 linecolor rgb "#d68910" linewidth 2.5
set style line 5 linecolor rgb "#7d3c98" linewidth 2.5
set style line 9 linecolor rgb "#707070" linewidth 1.5 dashtype 2
set border 3
set xtics nomirror out
set ytics nomirror out
set grid linecolor rgb "#dddddd" linewidth 0.5
set key samplen 2 spacing 1.2
