#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What a case without a structure must not have, and what is refused or warned of, through the programs
set -uo pipefail
. "$(dirname "$0")/cases/functions"
control=system/controlDict; solution=system/sphSolution
says() { grep -qE -- "$1" log || fail "$PWD: '$1' is not said: $(tail -n 6 log)"; }
refused() { solve && fail "$PWD: not refused"; says "$1"; }

# ---- fluid only: no field, no line of a structure --------------------------------------------------
for coupling in projection monolithic; do
    newCase piston fluidOnly; place
    setEntry $control endTime 0.02; setEntry $control writeInterval 1
    setEntry $solution coupling $coupling
    solved
    h5dump -n 1 0.02/particles.hdf | grep -E "x0|surfaceSides|volumeLedger" && fail "$coupling: fields of a structure"
    about=$(sed '1,/^Create time/d' log | grep -iE "structure|wall |cavity|spring")
    [ "$about" = "structure: none" ] || fail "$coupling: $about"
done
echo "structureModel springNetwork;" > constant/structureProperties
refused "no particle is solid"

# ---- a blow-up names particle, time and what to do, and is never written ---------------------------
jump='sed -i "s/p 0;/p table ((0 0) (0.03 0) (0.031 1e300));/" constant/boundary'
for template in piston membrane; do
    newCase $template blowUp; eval "$jump"; place
    setEntry $control writeInterval 1
    refused "Time 0.0[34] s: .*particle [0-9]+ \(zone (water|bath)\) at \(.*whether a load or a motion jumps"
    [ "$(ls -d 0.*)" = $'0.01\n0.02\n0.03' ] || fail "$template: $(ls -d 0.*)"
    for t in 0.0*; do h5dump -d /VTKHDF/PointData/U "$t/particles.hdf" | grep -qi "nan\|inf" && fail "$template: $t"; done
done

# ---- a time step beyond a limit: the limit's name and the largest step, which is then accepted -------
limited() { # rule, expected step or nothing, deltaT asked
    setEntry $control deltaT "$3"; setEntry $control endTime 100; setEntry $control writeControl none
    refused "is beyond the $1 limit: the largest admissible value now is"
    local most
    most=$(awk '{ for (i = 1; i < NF; ++i) if ($i == "is" && $(i-1) == "now") print $(i+1) }' log)
    [ -z "$2" ] || awk -v a="$most" -v b="$2" 'BEGIN { exit !((a/b - 1)^2 < 1e-10) }' || fail "$1: $most, not $2"
    grep -q "^Time = " log && fail "$1: a step was taken"
    setEntry $control deltaT "$(awk -v a="$most" 'BEGIN { print a*(1 - 1e-5) }')"
    setEntry $control endTime "$(getEntry $control deltaT)"
    solved
}
newCase piston limits; place
sed -i 's/displacement { .* } }/displacement table ((0 0) (100 25)); }/' constant/boundary
limited CFL 0.0208 0.03                                        # 0.4 * 0.013 / 0.25
newCase piston limits; place
echo "projection { viscosity explicit; }" >> $solution
limited "explicit viscosity" 0.021125 0.03                      # 0.013^2 / 8 / 1e-3
newCase membrane limits; place
setEntry $solution coupling projection; setEntry constant/structureProperties E 30
echo "bodyForce { chamber (10 0 0); }" >> constant/physicalProperties
limited force 0.0127475 0.02       # sqrt(0.013 / 5) / 4: by 5 the two fluid zones differ from their mean
newCase membrane limits; place
setEntry $solution coupling projection
limited stiffness "" 0.1

# ---- densities, words, kernels -------------------------------------------------------------------------
newCase membrane words; place
setEntry $control endTime 0.01
echo "zoneDensities { wall 1100; }" >> constant/physicalProperties
refused "Zone wall has density 1100, the fluid 1000.*must be equal"
newCase membrane words; place
setEntry $control endTime 0.01
setEntry $solution coupling partitioned
refused "Valid .*s are: .*monolithic projection"
newCase membrane words; place
setEntry $control endTime 0.01
echo "kernel gauss;" > system/sphSchemes
refused "Valid .*s are: WendlandC2 WendlandC4 cubic quintic|Valid .*s are: cubic quintic WendlandC2 WendlandC4"
echo "kernel WendlandC2; hByDx 1;" > system/sphSchemes
solved
says "Warning : kernel WendlandC2 with hByDx 1: this pair is known to blow up"
echo "kernel cubic; hByDx 1;" > system/sphSchemes
solved
grep -q "Warning : kernel" log && fail "warns of a pair that is well"
[ $failures = 0 ]
