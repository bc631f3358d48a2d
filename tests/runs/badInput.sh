#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Broken input, one case per line: each program refuses it with a message that names the place, ends with status
# 1, and leaves every file as it was
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
newCase membrane sound; place
setEntry system/controlDict endTime 0.02; setEntry system/controlDict writeInterval 1
echo "type planeMap; point (0 0 0); normal (0 0 1); xAxis (1 0 0); xRange (0 0.2); yRange (0 0.2); spacing 0.01;
    fields (U p); zones (bath);" > system/map
solved; rm log
setEntry system/controlDict endTime 0.04

sums() { find . -type f ! -name log -exec cksum {} + | sort -k 3; }
# refused 'what is said' 'how the case is broken' program [options]
refused() {
    rm -rf "$scratch/broken"; cp -r "$scratch/sound" "$scratch/broken"; cd "$scratch/broken" || exit 1
    eval "$2"
    local before status; before=$(sums)
    timeout 60 "${@:3}" > "$scratch/log" 2>&1; status=$?
    [ $status = 1 ] || fail "$2: ${*:3}: status $status: $(tail -n 4 "$scratch/log")"
    grep -q -- "--> FOAM FATAL" "$scratch/log" || fail "$2: ${*:3}: no FOAM FATAL"
    tr '\n' ' ' < "$scratch/log" | LC_ALL=C grep -qaE -- "$1" || fail "$2: ${*:3}: '$1' is not said: $(tail -n 8 "$scratch/log")"
    diff <(echo "$before") <(sums) | grep "^<" && fail "$2: ${*:3}: files have changed"
}
accepted() { # change of the case, program
    rm -rf "$scratch/broken"; cp -r "$scratch/sound" "$scratch/broken"; cd "$scratch/broken" || exit 1
    eval "$1"
    "${@:2}" > "$scratch/log" 2>&1 || fail "$1: ${*:2} refuses: $(tail -n 8 "$scratch/log")"
}
put() { printf '%b' "$2" > "$1"; }
nested() { awk -v n="$1" 'BEGIN { for (i = 0; i < n; ++i) printf "a { "; for (i = 0; i < n; ++i) printf "} " }'; }
control=system/controlDict

# ---- files that are missing, empty, or folders --------------------------------------------------------------
for program in ispfFsiFoam checkParticles ispfPostProcess generateParticles calibrateSprings; do
    refused "case folder .*nowhere" "true" $program -case nowhere
    refused "Unknown option '-foo'" "true" $program -foo
done
refused "Cannot read .*system/controlDict: No such file" "rm $control" ispfFsiFoam
refused "Cannot read .*system/sphSolution: No such file" "rm system/sphSolution" ispfFsiFoam
refused "Cannot read .*physicalProperties: it is a folder" "rm constant/physicalProperties; mkdir constant/physicalProperties" ispfFsiFoam
refused "Cannot read .*particleDict: No such file" "rm system/particleDict" generateParticles
refused "Cannot read .*structureProperties: No such file" "rm constant/structureProperties" calibrateSprings
refused "There is no function .map., nor .*system/map" "rm system/map" ispfPostProcess -func map
refused "0/particles.hdf|generateParticles" "rm -r 0 0.*; rm *.series" ispfFsiFoam
refused "particles.hdf|generateParticles" "rm -r 0 0.*; rm *.series" checkParticles
refused "'endTime' is missing" "put $control ''" ispfFsiFoam
refused "'dx' is missing" "put system/particleDict ''" generateParticles

# ---- values -------------------------------------------------------------------------------------------------
for value in 0 -1 1e400 nan inf one "(1 2)" ""; do
    refused "controlDict.deltaT at line [0-9]+|value of 'deltaT'|deltaT" "sed -i 's/^deltaT.*/deltaT $value;/' $control" ispfFsiFoam
    refused "particleDict.dx at line 1|'dx'" "sed -i 's/^dx.*/dx $value;/' system/particleDict" generateParticles
done
refused "deltaT at line" "sed -i 's/^deltaT.*/deltaT 1e308;/' $control" ispfFsiFoam
refused "finite number.*boundary.*at line 6" "sed -i 's/type sine; amp.*2;/type table; values ((0 0) (1 nan));/' constant/boundary" ispfFsiFoam
refused "finite number.*boundary.*at line 6" "sed -i 's/type sine; amp.*2;/type table; values ((0 0) (1 1e999));/' constant/boundary" ispfFsiFoam
refused "increase.*boundary.*at line 6" "sed -i 's/type sine; amp.*2;/type table; values ((1 0) (0 1));/' constant/boundary" ispfFsiFoam
csv="sed -i 's/type sine; amp.*2;/type csvFile; file \"a.csv\";/' constant/boundary"
refused "no file .*a.csv" "$csv" ispfFsiFoam
refused "finite number.*a.csv at line 2" "$csv; put a.csv '0,0\n1,nan\n'" ispfFsiFoam
refused "has 1 columns.*a.csv at line 2" "$csv; put a.csv '0,0\n1\n'" ispfFsiFoam
refused "finite number.*a.csv at line 1" "$csv; head -c 300 \"\$(command -v ispfFsiFoam)\" > a.csv" ispfFsiFoam
refused "a.csv|boundary" "$csv; put a.csv ''" ispfFsiFoam
refused "unit furlong is not known. Valid units are: .*mm.*particleDict.* at line" "sed -i 's/shape box; min (0 0 0).*/file \"a.stl\"; unit furlong; }/' system/particleDict; put a.stl 'solid a\nendsolid a\n'" generateParticles
refused "rho.*physicalProperties|'rho'" "put constant/physicalProperties 'rho -1; mu 1;'" ispfFsiFoam
refused "walls slides or turns in itself: what it clamps.*boundary.clamps|walls slides or turns in itself.*boundary" "sed -i 's/walls .*/walls { type wall; velocity (0 1 0); clamps (wall); }/' constant/boundary" ispfFsiFoam
refused "'pressureDrop'. Valid entries here are: backflow flowRate normal outlet p point surface type velocity" "sed -i 's/type open;/type open; pressureDrop 1;/' constant/boundary" ispfFsiFoam
refused "'m3'.*m\^3" "sed -i 's/^dx .*;/dx 0.01 [m3];/' system/particleDict" generateParticles
refused "Unknown type 'wal'.*Did you mean 'wall'.*boundary.*at line 1" "sed -i 's/type wall/type wal/' constant/boundary" ispfFsiFoam
refused "Unknown phase 'fluidd'" "sed -i '0,/phase fluid;/s//phase fluidd;/' system/particleDict" generateParticles
refused "Nothing reads the entry 'detlaT'" "echo 'detlaT 1;' >> $control" ispfFsiFoam

# ---- geometry -------------------------------------------------------------------------------------------------
refused "chamber" "sed -i 's/^\( *bath.*\)min.*/\1min (0 0 0); max (0.2 0.2 0); }/' system/particleDict" generateParticles  # all of it overlapped
refused "chamber|zone|particle" "sed -i 's/max (0.2 0.1 0)/max (1e-4 1e-4 0)/' system/particleDict" generateParticles  # no particle fits
refused "min|max|chamber" "sed -i 's/max (0.2 0.1 0)/max (-0.2 0.1 0)/' system/particleDict" generateParticles
refused "zones" "sed -i '/^zones/,\$d' system/particleDict" generateParticles
refused "solid zone wall touches no fluid.*Are the units" "sed -i 's/^\( *wall.*\)min.*/\1min (5 5 0); max (5.1 5.1 0); }/' system/particleDict" generateParticles  # solid outside

# ---- text -------------------------------------------------------------------------------------------------------
for file in $control system/sphSolution constant/boundary constant/physicalProperties; do
    name=$(basename $file)
    refused "include each other in a circle.*$name at line" "echo '#include \"$name\"' >> $file" ispfFsiFoam
    refused "$name.* at line" "echo 'a (' >> $file" ispfFsiFoam
    refused "$name.* at line" "echo 'a { b 1;' >> $file" ispfFsiFoam
    refused "string begun here|closing.*$name at line" "echo 'a \"b;' >> $file" ispfFsiFoam
    refused "deep|levels" "nested 100000 >> $file" ispfFsiFoam
    refused "zero byte.*$name at line|$name.* at line" "head -c 500 /dev/zero >> $file" ispfFsiFoam
    refused "no file .*absent" "echo '#include \"absent\"' >> $file" ispfFsiFoam
done
for entry in "$control deltaT" "system/sphSolution coupling" "constant/physicalProperties rho"; do
    set -- $entry
    refused "codeStream, which is refused.*$(basename "$1")" "echo '$2 #codeStream { code #{ #}; };' >> $1" ispfFsiFoam
done
accepted "sed -i 's/\$/\r/' $control system/* constant/boundary constant/*Properties" ispfFsiFoam  # CRLF
accepted "for f in $control system/sph* constant/boundary; do { printf '\xef\xbb\xbf'; cat \$f; } > x; mv x \$f; done" ispfFsiFoam
accepted "for f in $control constant/boundary constant/physicalProperties; do printf '%s' \"\$(cat \$f)\" > x; mv x \$f; done" ispfFsiFoam
accepted "sed -i 's/\$/\r/' system/particleDict constant/boundary" generateParticles

refused "constant/g: it is a named pipe" "rm -f constant/g; mkfifo constant/g" ispfFsiFoam
refused "constant/g: it is a folder" "rm -f constant/g; mkdir constant/g" ispfFsiFoam

# ---- HDF5 -------------------------------------------------------------------------------------------------------
foreign() { h5repack -l CHUNK=2 0.02/particles.hdf x > /dev/null 2>&1; printf 'not HDF5 at all' > "$1"; rm -f x; }
for broken in "truncate -s 3000" "truncate -s 100" "truncate -s 0" foreign; do
    for program in ispfFsiFoam checkParticles "ispfPostProcess -func map -latestTime"; do
        # shellcheck disable=SC2086
        refused "Cannot read '.*/0.02/particles.hdf'" "$broken 0.02/particles.hdf" $program
    done
    refused "wallParticles.hdf" "$broken constant/wallParticles.hdf" ispfFsiFoam
    refused "0/particles.hdf" "$broken 0/particles.hdf" calibrateSprings -bodyOnly
done
refused "checksum|damaged" "dd if=/dev/zero of=0.02/particles.hdf bs=1 count=20000 seek=60000 conv=notrunc 2> /dev/null" ispfFsiFoam

# ---- disks --------------------------------------------------------------------------------------------------------
# no file can grow beyond 40 kB: write() then fails as on a full disk
full="trap '' XFSZ; ulimit -f 40; exec"
refused "Cannot write.*0.03/particles.hdf" "true" bash -c "$full ispfFsiFoam"
refused "Cannot write.*particles.hdf" "rm -r 0 0.* constant/*.hdf *.series" bash -c "$full generateParticles"
# when a case is made anew, either all files are the old ones or all are new
finer="sed -i 's/^dx .*/dx 0.005;/' system/particleDict"
refused "Cannot write.*particles.hdf" "$finer" bash -c "$full generateParticles"
find . -name '*.tmp' | grep . && fail "temporary files are left by generateParticles"
refused "Cannot write '.*0/particles.hdf': replacing it: Is a directory" "$finer; rm 0/particles.hdf; mkdir 0/particles.hdf" generateParticles
find . -name '*.tmp' | grep . && fail "temporary files are left beside a folder in the place of a file"
made() { cksum 0/* constant/*.hdf constant/triSurface/* | sort -k 3; }
cd "$scratch/sound" || exit 1; old=$(made)
cp -r . ../finer; cd ../finer || exit 1; eval "$finer"; place; new=$(made)
for signal in TERM INT; do
    rm -rf ../stopped; cp -r ../sound ../stopped; cd ../stopped || exit 1; eval "$finer"
    # at the first sign of a write
    env --default-signal=INT generateParticles > log 2>&1 & run=$!
    until find . -name '*.tmp' | grep -q . || ! kill -0 $run 2> /dev/null; do :; done
    kill -$signal $run; wait $run
    [ "$(made)" = "$old" ] || [ "$(made)" = "$new" ] || fail "generateParticles, SIG$signal: $(made | diff <(echo "$old") - | head -n 4)"
    find . -name '*.tmp' | grep . && fail "temporary files are left by generateParticles, SIG$signal"
done
refused "0.03" "touch 0.03" ispfFsiFoam
# a file without permission for the user
if [ "$(id -u)" = 0 ] && runuser -u nobody -- test -x "$(command -v checkParticles)"; then
    chmod 755 "$scratch"
    refused "Cannot read '.*0.02/particles.hdf': Permission denied" "chmod 000 0.02/particles.hdf" \
        runuser -u nobody -- "$(command -v checkParticles)"
fi
# a log that cannot be written stops no run; the program reports it at the end
logless() { # way in which the log is lost, expected message
    rm -rf "$scratch/broken"; cp -r "$scratch/sound" "$scratch/broken"; cd "$scratch/broken" || exit 1
    bash -c "$1" 2> "$scratch/log" && fail "$1: the log is lost without a word"
    grep -q "could not be written to stdout: $2" "$scratch/log" || fail "$1: $(cat "$scratch/log")"
    [ -f 0.04/particles.hdf ] || fail "$1: stopped half way: $(ls)"
}
logless "ispfFsiFoam > /dev/full" "No space left on device"
logless "set -o pipefail; ispfFsiFoam | true" "Broken pipe"
logless "ispfFsiFoam >&-" "Bad file descriptor"
for program in checkParticles "ispfPostProcess -func map" generateParticles "calibrateSprings -help"; do
    # shellcheck disable=SC2086
    $program > /dev/full 2> "$scratch/log" && fail "$program: its output is lost without a word"
    grep -q "could not be written to stdout: No space" "$scratch/log" || fail "$program > /dev/full: $(cat "$scratch/log")"
done
refused "postProcessing" "touch postProcessing_; rm -rf postProcessing; mv postProcessing_ postProcessing" ispfPostProcess -func map
[ $failures = 0 ]
