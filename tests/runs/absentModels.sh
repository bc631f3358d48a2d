#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A model that no dictionary asks for leaves nothing in the files: a plain case has the fields and entries of the state listed
# here and no more.  Asked for, each model adds its own and nothing else; asked for no more, they vanish.  Words that stand
# for the absence of a model change no bit
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
mkdir plain plain/system plain/constant; cd plain || exit 1
echo "coupling projection;" > system/sphSolution
: > system/sphSchemes
echo "rho 1000; mu 4e-3;" > constant/physicalProperties
boundary() { # outlet
    echo "low { type symmetryPlane; point (0 0 0); normal (0 -1 0); } walls { type wall; }
        in { type open; p 0.1; } out { type open; p 0; $1 }" > constant/boundary
}
zones() { # zones, patches of walls
    echo "dx 1e-3; nDims 2; placement lattice; zones { water { phase fluid; shape box; min (0 0 0); max (20e-3 6e-3 0); } $1 }
        patches { in { box ((-1e-4 -1 -1) (1e-4 6.1e-3 1)); } out { box ((19.9e-3 -1 -1) (20.1e-3 6.1e-3 1)); } }" > system/particleDict
}
control() { # endTime functions
    echo "startFrom latestTime; startTime 0; endTime $1; deltaT 0.01; writeControl timeStep; writeInterval 3; functions { $2 }" > system/controlDict
}
# Names of the fields and of the entries of the state at a time, sorted
contents() {
    h5dump -n "$1/particles.hdf" | sed -nE 's/^ *dataset +//p' |
        sed -nE 's|^/VTKHDF/PointData/||p; s|^/ispf/extra/||p' | sort | paste -sd ,
}
numbers() { h5dump -H -d "/ispf/extra/$2" "$1/particles.hdf" | sed -nE 's/.*SIMPLE \{ \( ([0-9]+) \).*/\1/p' | head -n 1; }
# has time names what: the contents of a time are these names, separated by commas
has() { [ "$(contents "$1")" = "$(tr , '\n' <<< "$2" | sort | paste -sd ,)" ] || fail "$3: $(contents "$1")"; }
run() { # endTime functions
    rm -rf 0.* postProcessing; control "${1:-0.03}" "${2:-}"; solved
}

fluid=U,p,id,zone,closure,closure1,closure2,openSlope,xGuarded,continuityErrors,energyLedger,stepsSinceSort,balance.in,balance.low,balance.out,"outlet in","outlet out"
for coupling in projection monolithic; do
    echo "coupling $coupling;" > system/sphSolution
    plain=$fluid,balance.walls,$([ $coupling = projection ] && echo projectedStep || echo Up_0,Up_0:w,Up_0)
    boundary ""; zones ""; place; run
    has 0.03 "$plain" "$coupling, plain"
    [ "$(numbers 0.03 'outlet out')" = 1 ] || fail "an outlet of fixed pressure keeps $(numbers 0.03 'outlet out') numbers"
    cp -r . ../words; cd ../words || exit 1
    boundary "outlet fixedPressure;"; echo "viscosityModel Newtonian;" >> constant/physicalProperties
    run; same 0.03 ../plain/0.03 "$coupling: words for what is absent change the state"
    cd ../plain || exit 1; rm -rf ../words

    # each model adds its own
    echo "viscosityModel Casson; yieldStress 5e-3; muMax 0.1;" >> constant/physicalProperties
    run; has 0.03 "$plain,viscosityRatio" "$coupling, Casson"
    echo "rho 1000; mu 4e-3;" > constant/physicalProperties
    control 0.06 ""; solved; has 0.06 "$plain" "$coupling, Newtonian again"
    boundary "outlet Windkessel; distal 1e5; compliance 1e-7;"
    run; has 0.03 "$plain" "$coupling, Windkessel"
    # flow, number of values, p_C; projection also keeps dQ/dp
    [ "$(numbers 0.03 'outlet out')" = $([ "$coupling" = monolithic ] && echo 3 || echo 4) ] || fail "a Windkessel keeps $(numbers 0.03 'outlet out') numbers"
    boundary ""
    echo "plug { type DarcyForchheimer; d 1e6; shape box; min (5e-3 -1 0); max (10e-3 1 0); }" > constant/porosityProperties
    run; has 0.03 "$plain" "$coupling, Darcy"
    echo "clot { type thrombus; d 1e6; residenceTime 1; shearRate 1; growthTime 1; }" > constant/porosityProperties
    run 0.03 "age { type residenceTime; }"; has 0.03 "$plain,residenceTime,carriedField.residenceTime,thrombus" "$coupling, thrombus"
    rm constant/porosityProperties
    control 0.06 ""; solved; has 0.06 "$plain" "$coupling, no thrombus any more"
done

# a solid: its relaxation is a model, too
solid() { echo "structureModel totalLagrangian; material { type neoHookean; G 100; $1 } $2" > constant/structureProperties; }
zones "wall { phase solid; shape box; min (-3e-3 6e-3 0); max (23e-3 10e-3 0); }"; boundary ""; solid "" ""
sed -i 's/walls { type wall; }//' constant/boundary
plain=$(sed 's/xGuarded,//' <<< "$fluid"),Up_0,Up_0:w,Up_0,x0,missedJ,solidDefect,solidFeedback,volumeLedger,surfaceAreaA,surfaceAreaA:w,surfaceAreaB,surfaceAreaB:w,surfaceWayA,surfaceWayB
place; run; has 0.03 "$plain" "a plain solid"
solid "" "outside { stiffness 1e3; }"; run; has 0.03 "$plain" "a solid with tissue outside"
solid "viscosity 1;" ""; run; has 0.03 "$plain" "a viscous solid"
solid "relaxation { moduli (0.5); times (1); }" ""; run; has 0.03 "$plain,solidMemory" "a solid that relaxes"
solid "" ""; control 0.06 ""; solved; has 0.06 "$plain" "a solid that relaxes no more"
[ $failures = 0 ]
