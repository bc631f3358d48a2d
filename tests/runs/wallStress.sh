#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Cauchy's stress of inflated neo-Hookean rings of 4 and 8 layers against the exact one: on the inner surface
# (surfaceSample), and of the particles of the first and the last layer (solidStress)
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
mkdir -p constant system
echo 'rho 1000; mu 1e-3;' > constant/physicalProperties
echo 'coupling monolithic;' > system/sphSolution
: > system/sphSchemes

# ring outerRadius [mm], pressure, largest errors: sigma_rr and its scatter over p, hoop and von Mises stress over the exact one,
# sigma_rr of the first and the last layer over p; pressure outside, which comes to the pressure inside
ring() {
    local out=${8:-0}
    rm -rf 0* 1 postProcessing
    cat > system/particleDict <<END2
dx 0.5e-3; nDims 2;
zones
{
    wall { phase solid; shape annulus; point1 (0 0 0); innerRadius 10e-3; outerRadius $1e-3; }
    lumen { phase fluid; shape annulus; point1 (0 0 0); innerRadius 5e-3; outerRadius 10e-3; }
}
patches { inlet { box ((-5.1e-3 -5.1e-3 -1) (5.1e-3 5.1e-3 1)); } }
END2
    cat > constant/boundary <<END2
left { type symmetryPlane; point (0 0 0); normal (-1 0 0); } below { type symmetryPlane; point (0 0 0); normal (0 -1 0); }
inlet { type open; p table ((0 0) (0.5 $(($2 + out)))); }
END2
    echo "structureModel totalLagrangian; material { type neoHookean; E 150e3; } $([ "$out" = 0 ] || echo "outside { pressure table ((0 0) (0.5 $out)); }")" > constant/structureProperties
    cat > system/controlDict <<END2
startTime 0; endTime 1; deltaT 0.01; writeControl runTime; writeInterval 1;
functions
{
    lumen  { type cavityVolume; surface wall_to_lumen; }
    inner  { type surfaceSample; zones (wall); fields (vonMises sigma_x sigma_y); surfaceFormat raw; writeControl writeTime; }
    stress { type solidStress; }
}
END2
    place; solved
    for d in Points PointData/sigma_x PointData/sigma_y; do
        h5dump -d "/VTKHDF/$d" -y -w 1 -m %.9g postProcessing/stress/1/solid.hdf |
            awk '/DATA \{/ { on = 1; next } /\}/ { on = 0 } on { gsub(/[(),]/, " "); for (i = 1; i <= NF; i++) print $i }' | paste - - - > "$(basename "$d").txt"
    done
    # a particle at r was at R^2 = r^2 - K; K from the volume of a quarter of the lumen
    paste Points.txt sigma_x.txt sigma_y.txt > particles.txt
    awk -v b="$1" -v p="$2" -v out="$out" -v limits="$3 $4 $5 $6 $7" -v last="$(awk 'END { print $NF }' postProcessing/lumen/0/cavityVolume.dat)" '
        function stretch(R) { return sqrt(1 + K/(R*R)) }
        function rr(R,   l, o) { l = stretch(R); o = stretch(b); return -G*(log(l/o) + 0.5*(1/(o*o) - 1/(l*l))) - out }
        function hoop(R,   l) { l = stretch(R); return rr(R) + G*(l*l - 1/(l*l)) }
        # radial and hoop stress of sigma at the place x y
        function turn(x, y, xx, xy, yy,   r) { r = sqrt(x*x + y*y); x /= r; y /= r; srr = xx*x*x + 2*xy*x*y + yy*y*y; stt = xx + yy - srr; return r }
        function abs(v) { return v < 0 ? -v : v }
        BEGIN { G = 5e4; a = 10; K = 100*last }  # [mm]
        FNR == NR { if (/^#/) next
            turn($1, $2, $12, $13, $16); n++; s += srr; ss += srr*srr; t += stt; m += $11; next }
        NF == 9 { r = 1e3*turn($1, $2, $4, $5, $8); R = sqrt(r*r - K)
          k = R < a + 0.5 ? 1 : R > b - 0.5 ? 2 : 0
          layer = int((R - a)/0.5); cl[layer]++; el[layer] += (srr - rr(R))/p
          if (k) { c[k]++; e[k] += (srr - rr(R))/p } }
        END { for (l in cl) if (abs(el[l]/cl[l]) > worst) worst = abs(el[l]/cl[l])
              s /= n; t /= n; m /= n; scatter = sqrt(ss/n - s*s)/p
              vm = sqrt(0.75)*(hoop(a) - rr(a))
              printf "    %g layers, %g Pa outside: sigma_rr on the surface %.0f +- %.0f Pa (exact %.0f), hoop %.0f (%.0f), von Mises %.0f (%.0f); sigma_rr of the first and the last layer off by %.3f and %.3f p, of the worst layer by %.3f p\n", 2*(b - a), out, s, scatter*p, rr(a), t, hoop(a), m, vm, e[1]/c[1], e[2]/c[2], worst
              split(limits, L)
              exit !(n > 10 && abs(s - rr(a)) < L[1]*p && scatter < L[2] && abs(t/hoop(a) - 1) < L[3] && abs(m/vm - 1) < L[4] && abs(e[1]/c[1]) < L[5] && abs(e[2]/c[2]) < L[5]) }' \
        postProcessing/inner/1/wall.raw particles.txt || fail "stress of the ring to $1 mm"
}
ring 12 3000 0.08 0.05 0.04 0.03 0.15
ring 14 6000 0.05 0.05 0.03 0.03 0.08
ring 14 6000 0.05 0.05 0.03 0.03 0.08 5000
[ $failures = 0 ]
