# SPDX-License-Identifier: GPL-3.0-or-later
# A picture for each function object.  Variable: runs, the folder that `runs` has filled; writes to the current folder
set terminal pngcairo size 560, 260 font "Sans,11" noenhanced
set encoding utf8
set border 3; set xtics nomirror; set ytics nomirror
set grid linecolor rgb "#dddddd"
set style line 1 linecolor rgb "#1f4e9c" linewidth 2
set style line 2 linecolor rgb "#c0392b" linewidth 2
set style line 3 linecolor rgb "#27874b" linewidth 2
set style line 4 linecolor rgb "#d68910" linewidth 2
set key samplen 2
flap(file) = "< tr -d '()' < ".runs."/flap/postProcessing/".file
vessel = runs."/vessel/postProcessing/"
set xlabel "t [s]"

set output "probes.png"; set ylabel "p [Pa]"
plot flap("pressure/0/p") using 1:2 with lines linestyle 1 title "x = 10 mm", "" using 1:3 with lines linestyle 2 title "x = 40 mm"
set output "materialProbes.png"; set ylabel "tip [mm]"
plot flap("tip/0/displacement") using 1:(1e3*$2) with lines linestyle 1 title "x", "" using 1:(1e3*$3) with lines linestyle 2 title "y"
set output "minMax.png"; set ylabel "max |U| [m/s]"
plot flap("extremes/0/minMax.dat") using 1:6 with lines linestyle 1 notitle
set output "volFieldValue.png"; set ylabel "mean U of the flap [m/s]"
plot flap("flapMean/0/volFieldValue.dat") using 1:2 with lines linestyle 1 title "x", "" using 1:3 with lines linestyle 2 title "y"
set output "surfaceFieldValue.png"; set ylabel "mean p of the inlet [Pa]"
plot flap("entry/0/surfaceFieldValue.dat") using 1:2 with lines linestyle 1 notitle
set output "patchFlux.png"; set ylabel "flux [m2/s]"; set key bottom right
plot flap("outflow/0/patchFlux.dat") using 1:2 with lines linestyle 1 title "patch outlet", \
     flap("section/0/patchFlux.dat") using 1:2 every 10 with points pointtype 6 linecolor rgb "#c0392b" title "surface outlet"
set output "forces.png"; set ylabel "force [N/m]"; set key top right
plot flap("load/0/force.dat") using 1:2 with lines linestyle 1 title "x, total", "" using 1:8 with lines linestyle 2 title "x, viscous"
set output "surfaceLeaks.png"; set ylabel "particles"; set yrange [-0.2:*]; set key top left
plot flap("leaks/0/surfaceLeaks.dat") using 1:2 with steps linestyle 1 title "wrongSide", "" using 1:3 with steps linestyle 2 title "through"
set yrange [*:*]
set output "energy.png"; set ylabel "energy [J/m]"
plot flap("balance/0/energy.dat") using 1:2 with lines linestyle 1 title "kinetic", "" using 1:(10*$3) with lines linestyle 2 title "10 elastic", \
     "" using 1:7 with lines linestyle 3 title "dissipated", "" using 1:10 with lines linestyle 4 title "openWork"
set output "momentum.png"; set ylabel "momentum [kg/s]"; set key bottom right
plot flap("motion/0/momentum.dat") using 1:2 with lines linestyle 1 title "x", "" using 1:3 with lines linestyle 2 title "y"
set output "wallShearStress.png"; set ylabel "wall shear stress [Pa]"; set key top left
plot flap("skinShear/0/flap.dat") using 1:2 with lines linestyle 1 title "mean", "" using 1:4 with lines linestyle 2 title "mean of TAWSS"
set output "solidStress.png"; set ylabel "von Mises stress [Pa]"
plot flap("flapStress/0/solidStress.dat") using 1:3 with lines linestyle 1 title "largest", "" using 1:2 with lines linestyle 2 title "mean"
set output "residenceTime.png"; set ylabel "residence time [s]"
plot flap("age/0/residenceTime.dat") using 1:3 with lines linestyle 1 title "largest", "" using 1:2 with lines linestyle 2 title "mean"
set output "errorNorm.png"; set ylabel "over the exact field [%]"; set key top right
plot runs."/vortices/postProcessing/error/0/errorNorm.dat" using 1:(100*$2/$4) with lines linestyle 1 title "L2(U)", \
     "" using 1:(100*$5/$7) with lines linestyle 2 title "L2(p)"
set output "cavityVolume.png"; set ylabel "change over rest [%]"
plot vessel."lumen/0/cavityVolume.dat" using 1:(100*$4) with lines linestyle 1 notitle
set output "zoneDiameter.png"; set ylabel "dD/D [%]"
plot vessel."bore/0/zoneDiameter.dat" using 1:(100*$3) with lines linestyle 1 notitle

set output "lineProfile.png"; set xlabel "U_x [m/s]"; set ylabel "y [mm]"
plot flap("wake/0.3/line.dat") using 5:(1e3*$3) with linespoints linestyle 1 pointtype 7 pointsize 0.5 notitle
set output "surfaceSample.png"; set xlabel "p [Pa]"; set ylabel "y [mm]"
plot flap("skin/0.3/flap.raw") using 4:(1e3*$2) with points pointtype 7 pointsize 0.5 linecolor rgb "#1f4e9c" notitle

set output "planeMap.png"; set xlabel "x [mm]"; set ylabel "y [mm]"; set title "p [Pa]"
unset grid; set border 15; set size ratio -1
set xrange [0:50]; set yrange [0:20]
set palette defined (0 "#1f3864", 0.5 "#ffffff", 1 "#c0392b")
plot runs."/flap/postProcessing/map/0.3/map.dat" using (1e3*$1):(1e3*$2):6 with image notitle, \
     runs."/flap/postProcessing/map/0.3/map.slice.dat" using (1e3*$1):(1e3*$2) with points pointtype 7 pointsize 0.3 linecolor rgb "#000000" notitle
