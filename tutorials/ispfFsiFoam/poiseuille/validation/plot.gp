# SPDX-License-Identifier: GPL-3.0-or-later
out = 'comparison/poiseuille.png'
load common
H = 1e-3; nu = 1e-6; F = 1e-4
term(y, t, m) = 4*F*H**2/(nu*(m*pi)**3)*sin(m*pi*y/H)*exp(-(m*pi/H)**2*nu*t)
exact(y, t) = F*y*(H - y)/(2*nu) - (sum [k=0:40] term(y, t, 2*k + 1))
times = system('ls postProcessing/across | sort -g')   # of the written profiles
set key outside right
set samples 200
set xrange [0:1]; set yrange [0:*]
set xlabel 'y [mm]'; set ylabel 'u [µm/s]'
plot for [i=1:words(times)] 'postProcessing/across/'.word(times, i).'/line.dat' using (1e3*$3):(1e6*$5) with points linestyle i pointtype 7 pointsize 0.7 title word(times, i).' s', \
     for [t in times] 1e6*exact(1e-3*x, t + 0.0) with lines linestyle 9 notitle
