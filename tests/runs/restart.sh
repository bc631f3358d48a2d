#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The state is complete: 200 steps from a state in the middle of the plunger's reversal, with particles entering and leaving
# through the open face, equal the uninterrupted run bit for bit; so do runs that signals have stopped anywhere
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
control=system/controlDict

# 250 steps of the membrane; its piston turns back at steps 50, 150 and 250
reversal() { # name coupling adjust
    newCase membrane "$1"
    sed -i 's/amplitude 0.005; frequency 2;/amplitude 0.012; frequency 2;/' constant/boundary
    setEntry $control deltaT 0.0025; setEntry $control endTime 0.625
    setEntry $control writeControl runTime; setEntry $control writeInterval 0.125
    if [ "$2" = projection ]; then
        setEntry system/sphSolution coupling projection
        setEntry constant/structureProperties E 1000
    fi
    [ "$3" = no ] || setEntry $control writeControl adjustableRunTime
    [ "$3" = no ] || sed -i 's/deltaT  .*/deltaT 0.0025; adjustTimeStep yes; maxDeltaT 0.0035;/' $control
    echo 'functions { through { type patchFlux; patch top; writeInterval 7; } u { type minMax; writeControl runTime;
        writeInterval 0.1; } }' >> $control
    place
}
# Numbers of an array of the state
state() { h5dump -y -w 1 -m %.17g -d "/ispf/extra/$2" "$1/particles.hdf" | awk '/DATA {/ { on = 1; next } /}/ { on = 0 } on { gsub(",", ""); printf "%s ", $1 }'; }
lastRow() { tail -qn 1 postProcessing/"$1"/*/"$2" | sort -g | tail -n 1; }

for coupling in monolithic projection; do
    for adjust in no yes; do
        name=$coupling.$adjust
        reversal "$name" $coupling $adjust
        solved
        read -r _ created deleted _ <<< "$(state 0.625 balance.top)"
        read -r _ created0 deleted0 _ <<< "$(state 0.125 balance.top)"
        [ "${created:-0}" -gt "${created0:-0}" ] && [ "${deleted:-0}" -gt "${deleted0:-0}" ] ||
            fail "$name: created $created0 to $created, deleted $deleted0 to $deleted: nothing enters or leaves"
        for clock in kept lost; do
            cp -r . "../$name.$clock"; cd "../$name.$clock" || exit 1
            rm -r 0.25 0.375 0.5 0.625; [ $clock = kept ] || rm 0.125/uniform/time
            solved
            [ $clock = kept ] || grep -q "uniform/time is missing: the clock is set from the particles" log || fail "$name: no word of the clock"
            same 0.625 "../$name/0.625" "$name: 200 steps from the middle of the reversal, clock $clock"
            for file in through/patchFlux.dat u/minMax.dat; do
                [ "$(lastRow ${file/\// })" = "$(cd "../$name" && lastRow ${file/\// })" ] || fail "$name: another last row in $file"
            done
            seriesComplete "$name.$clock"
            cd "../$name" || exit 1
        done
    done
done

# Writing changes nothing
cp -r ../monolithic.no ../seldom && cd ../seldom || exit 1
rm -r 0.* postProcessing; setEntry $control writeInterval 0.625
solved
same 0.625 ../monolithic.no/0.625 "written once and three times"

# A table that begins where the run continues: the step before is not asked for
newCase piston covered; place
moves() { sed -i "s/displacement .*/displacement { type table; values ($1); outOfBounds error; } }/" constant/boundary; }
moves "(0 0) (0.02 1e-4) (0.04 2e-4)"; setEntry $control endTime 0.02; setEntry $control writeInterval 2; solved
moves "(0.02 1e-4) (0.04 2e-4)"; setEntry $control endTime 0.04; solved

# A run that ends between two steps, then continues: endTime changes no step
cp -r ../monolithic.no ../prolonged && cd ../prolonged || exit 1
rm -r 0.* postProcessing; setEntry $control endTime 0.1289
solved
grep -qx "endTime 0.1289 s lies between two steps of deltaT 0.0025 s: the run ends at 0.13 s, and tables over time are asked up to there" log || fail "prolonged: no word of the end"
[ "$(grep '^Time = ' log | tail -n 1)" = "Time = 0.13" ] || fail "prolonged: $(grep '^Time = ' log | tail -n 1)"
same 0.125 ../monolithic.no/0.125 "to 0.1289 and to 0.625"
setEntry $control endTime 0.25
solved
same 0.25 ../monolithic.no/0.25 "to 0.1289, then to 0.25, and to 0.625"

# Unknown fields stay with their particles; new particles take them from the nearest
cp -r ../monolithic.no ../unknown && cd ../unknown || exit 1
rm -r 0.* postProcessing; echo "writeFormat ascii;" >> $control; setEntry $control endTime 0.125
solved
numbers() { awk '/^\)/ { on = 0 } on; /^\($/ { on = 1 }' "$1"; }
sed 's/object      id/object      tag/' 0.125/id > 0.125/tag
{ echo "internalField nonuniform List<scalar>"; numbers 0.125/id | awk '{ t[NR] = $1/7 } END { print NR "("; for (i = 1; i <= NR; ++i) print t[i]; print ");" }'; } > 0.125/seventh
{ echo "internalField nonuniform List<tensor>"; numbers 0.125/id | awk '{ t[NR] = "(" $1 " 0 0 0 0 0 0 0 " 2*$1 ")" } END { print NR "("; for (i = 1; i <= NR; ++i) print t[i]; print ");" }'; } > 0.125/nine
echo 'no field: "' > 0.125/notes.txt
setEntry $control endTime 0.625
solved
grep -q "0.125/tag has no checksum" log || fail "nothing is said of the field 'tag'"
grep -q "0.125/notes.txt is no field: later times are without it" log || fail "nothing is said of notes.txt"
grep -q "List<tensor>" 0.625/nine || fail "a field of tensors has become another"
paste <(numbers 0.625/id) <(numbers 0.625/tag) <(numbers 0.625/seventh) <(numbers 0.625/nine | tr -d '()') | awk -v next0="$(awk -F'"' '$2 == "nextId" { print $4 }' 0.125/uniform/particles)" '
    $1 < next0 { ++old; wrong += $1 != $2 || ($3 - $1/7)^2 > 1e-8 || $4 != $1 || $8 != 0 || $12 != 2*$1 }
    $1 >= next0 { ++new; wrong += $2 >= next0 || $3 <= 0 }
    END { if (wrong || !old || !new) print "of " old " old and " new " new particles " wrong " have lost it" }' > lost
[ -s lost ] && fail "unknown fields: $(cat lost)"

# A vector field of another program stays a vector field and gets no companion
newCase membrane foreign
setEntry $control deltaT 0.0025; setEntry $control endTime 0.005
setEntry $control writeControl timeStep; setEntry $control writeInterval 2
echo 'writeFormat ascii;' >> $control
place; solved
n=$(ispfDictionary 0.005/uniform/particles -entry nParticles -value)
{ echo "internalField nonuniform List<vector> $n("; seq "$n" | sed 's/.*/(& 0 -&)/'; echo ");"; } > 0.005/flow
sorted() { ispfDictionary "$1/flow" -entry internalField -value | tr ')' '\n' | sort; }
echo 'endTime 0.01;' >> $control; solved
[ ! -e 0.01/flow:w ] && [ "$(sorted 0.01)" = "$(sorted 0.005)" ] || fail "a vector of others, ascii: $(ls 0.01)"
echo 'endTime 0.015; writeFormat hdf5;' >> $control; solved
h5dump -n 1 0.015/particles.hdf > out
grep -q "PointData/flow$" out && ! grep -q "PointData/flow:w" out || fail "a vector of others, hdf5: $(grep PointData out)"
# the fourth component of our own fields is kept
grep -q "PointData/Up_0:w" out || fail "the pressure of the step before: $(grep PointData out)"

# Signals stop runs at any moment, mostly within a write; the last state of each is sound and continues in the same way
cp -r ../seldom ../signals && cd ../signals || exit 1
rm -r 0.* postProcessing; setEntry $control writeControl timeStep; setEntry $control writeInterval 1
echo 'purgeWrite 2;' >> $control
RANDOM=7
for signal in TERM INT TERM TERM INT; do
    ispfFsiFoam > log 2>&1 & run=$!
    until grep -qs '^Time = ' log || ! kill -0 $run 2> /dev/null; do sleep 0.02; done
    sleep "0.$((RANDOM % 4))$((RANDOM % 10))$((RANDOM % 10))"
    kill -$signal $run; wait $run; status=$?
    [ $status = $((128 + $(kill -l $signal))) ] || fail "SIG$signal: status $status: $(tail -n 3 log)"
    [ "$(tail -n 1 log)" = End ] || fail "SIG$signal: the log does not end with End"
    [ -e 0.625 ] && fail "signalled too late for a test"
    last=$(grep '^Time = ' log | tail -n 1)
    [ -e "${last#Time = }/particles.hdf" ] || fail "SIG$signal: $last is not written"
    seriesComplete "SIG$signal"
done
solved
same 0.625 ../monolithic.no/0.625 "continued after five signals"
[ $failures = 0 ]
