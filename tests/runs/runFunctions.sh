#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bin/tools: RunFunctions and CleanFunctions
set -uo pipefail
tools=$(cd "$(dirname "$0")/../../bin/tools" && pwd)
failures=0
fail() { echo "  FAILED: $1"; failures=$((failures+1)); }
scratch=$(mktemp -d); trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/bin" "$scratch/case/system" "$scratch/case/0.orig"
ln -s "$(cd "${ISPF_BIN:-$tools/../../build/${OPT:-Release}/bin}" && pwd)/ispfDictionary" "$scratch/bin/"
cd "$scratch/case"
printf 'application     goodOne;   // a comment\nendTime         1;\n' > system/controlDict
echo U > 0.orig/U
printf '#!/bin/sh\necho "hello $*"; echo "to stderr" >&2; printf "deltaT = 1\\nTime = 1\\nEnd\\n"\n' > "$scratch/bin/goodOne"
printf '#!/bin/sh\nseq 50\nprintf "\\n--> FOAM FATAL ERROR: \\nno more ideas\\n" >&2; exit 3\n' > "$scratch/bin/badOne"
printf '#!/bin/sh\nseq 50; exit 1\n' > "$scratch/bin/muteOne"
printf '#!/bin/sh\necho End; exit 143\n' > "$scratch/bin/stoppedOne"
printf '#!/bin/sh\nkill -KILL $$\n' > "$scratch/bin/killedOne"
chmod +x "$scratch"/bin/*
run() { # text of a script; its output goes to $scratch/out
    printf '. %q/RunFunctions\n. %q/CleanFunctions\n%s\n' "$tools" "$tools" "$1" > "$scratch/Allrun"
    ISPF_BIN=$scratch/bin bash "$scratch/Allrun" > "$scratch/out" 2>&1
}
says() { grep -q -- "$1" "$scratch/out" || fail "'$1' is not said: $(cat "$scratch/out")"; }

run 'runApplication "$(getApplication)" -x "a b"; echo after' || fail "good program"
says after
[ "$(cat log.goodOne)" = $'hello -x a b\nto stderr\ndeltaT = 1\nTime = 1\nEnd' ] || fail "log: $(cat log.goodOne)"
run 'runApplication goodOne 2; echo after' || fail "second run"
says "has run already"; says after
grep -q "hello 2" log.goodOne && fail "an existing log was touched"
run 'runApplication -a goodOne 3; runApplication -s two goodOne 4' || fail "append and suffix"
[ "$(grep -c hello log.goodOne)" = 2 ] && grep -q "hello 4" log.goodOne.two || fail "append or suffix"
run 'runApplication -o goodOne 5' && [ "$(grep hello log.goodOne)" = "hello 5" ] || fail "overwrite"

# a program that has not ended runs again, and its log is kept; logs of other programs are left alone
sed -i 's/Time = 1/Time = 0.5/' log.goodOne
run 'runApplication goodOne 8; echo after' || fail "a run that has not ended"
says "goodOne goes on: log.goodOne reached 0.5 of 1 s"; says after
grep -q "hello 8" log.goodOne && grep -q "hello 5" interrupted/log.goodOne.0 || fail "a run that has not ended does not go on"
echo cut > log.goodOne; run 'runApplication goodOne 5' && says "log.goodOne has no End"
[ "$(ls interrupted)" = $'log.goodOne.0\nlog.goodOne.1' ] || fail "logs put aside: $(ls interrupted)"
echo other > log.true; run 'runApplication true' && says "true has run already"
rm -r interrupted log.true
run 'runApplication goodOne 5' && says "has run already"

# a log belongs to no run if the program has ended and would now read other entries; a later endTime continues the run
echo "rho 1;" > system/properties; run 'runApplication -o goodOne 5' || fail "overwrite"
run 'runApplication goodOne 9; echo after' && says after || fail "nothing has changed"
echo "rho 2;" > system/properties
run 'runApplication goodOne 9; echo after' && fail "an old run for other entries"
says "but with another system/properties: ./Allclean"; grep -q after "$scratch/out" && fail "went on with an old run"
run 'cleanCase; runApplication goodOne 10' && grep -q "hello 10" log.goodOne || fail "a clean case runs again"
sed -i 's/endTime  .*/endTime 2;/' system/controlDict
run 'runApplication goodOne 11' && says "goodOne goes on: log.goodOne reached 1 of 2 s"
sed -i 's/endTime .*/endTime         1;/' system/controlDict; rm -r interrupted system/properties
run 'runApplication -o goodOne 5; runApplication -s two goodOne 4' || fail "overwrite"

run 'runParallel -np 4 -s serial goodOne 6; echo after' || fail runParallel
says "No MPI: goodOne runs as one process"; says after; grep -qx "hello 6" log.goodOne.serial || fail "runParallel's log"
run 'runParallel goodOne 7' && says "has run already"
for wrong in "" "-x goodOne" "-s" "-o"; do
    run "runApplication $wrong; echo after" && fail "accepted: runApplication $wrong"
    grep -q after "$scratch/out" && fail "went on: runApplication $wrong"
done
run 'isTest -a -test && notTest -a && [ "$(getNumberOfProcessors)" = 1 ]' || fail isTest
echo "rho 1;" > 0.orig/../system/other
run 'cloneCase . ../clone' && diff -r system "$scratch/clone/system" && [ -e "$scratch/clone/0.orig/U" ] &&
    [ ! -e "$scratch/clone/log.goodOne" ] || fail cloneCase
run 'cloneCase . ../clone; echo after' && fail "cloned over a case"; says "exists already"
run 'cloneCase ../bin ../other; echo after' && fail "cloned what is no case"; says "is no case"
rm system/other log.goodOne.serial

run 'runApplication badOne; echo after' && fail "a failure does not stop the script"
says "badOne failed with status 3"; says "$scratch/case/log.badOne"; says "no more ideas"
grep -qx "after\|50" "$scratch/out" && fail "more than the error, or the script went on"
run 'runApplication muteOne' && fail "a silent failure does not stop the script"
says 50; grep -qx 30 "$scratch/out" && fail "more than the last 20 lines"
run 'runApplication stoppedOne; echo after' && fail "a run that was stopped does not stop the script"
says "stoppedOne was stopped by SIGTERM"; grep -qx after "$scratch/out" && fail "went on after a stopped run"
run 'runApplication killedOne; echo after' && fail "a run that was killed does not stop the script"
says "killedOne was stopped by SIGKILL"
rm log.stoppedOne log.killedOne
run 'runApplication noSuchProgram; echo after' && fail "a missing program does not stop the script"
says "noSuchProgram is not built"

# entries as programs read them: the last of several, none in comments, those of dictionaries and of included files
mkdir entries; cd entries
cat > dict <<'END'
/*
a 0;   never
*/
a 1;
// a 2;
b { a 3; c "x y"; }
a 4; // counts
#include "more"
END
echo "d 7;" > more
run 'getEntry dict a; getEntry dict b.a; getEntry dict b.c; getEntry dict d' || fail "getEntry: $(cat "$scratch/out")"
[ "$(cat "$scratch/out")" = $'4\n3\nx y\n7' ] || fail "getEntry: $(cat "$scratch/out")"
cp dict before
run 'setEntry dict a 5 && setEntry dict b.c "(1 2)" && getEntry dict a && getEntry dict b.c' || fail "setEntry: $(cat "$scratch/out")"
[ "$(cat "$scratch/out")" = $'5\n(1 2)' ] || fail "setEntry: $(cat "$scratch/out")"
[ "$(diff before dict | grep -c '^>')" = 2 ] && grep -q "^a 5; // counts" dict || fail "setEntry: $(diff before dict)"
for wrong in 'setEntry dict a ""' 'setEntry dict a "$unset"' 'setEntry dict a' 'setEntry dict a 1 2'; do
    cp dict before; run "$wrong; echo \$?" || fail "$wrong: $(cat "$scratch/out")"
    cmp -s before dict || fail "$wrong: $(cat dict)"
    says "setEntry: file, name and value are wanted"; says '^1$'
    cp before dict
done
echo "t 1.25 [ms];" > units
run 'getEntry units t -SI; getEntry units t' && [ "$(cat "$scratch/out")" = $'0.00125\n1.25 [ms]' ] || fail "getEntry -SI: $(cat "$scratch/out")"
for wrong in "setEntry dict n 1" "getEntry dict n" "getEntry nothing a" 'setEntry dict a "(1"'; do
    cp dict before; run "$wrong" && fail "accepted: $wrong"
    cmp -s before dict && grep -q "FATAL" "$scratch/out" || fail "$wrong: $(cat "$scratch/out")"
done
says "would break"
mv "$scratch/bin/ispfDictionary" "$scratch/kept"
PATH=$scratch/bin:/usr/bin:/bin run 'getEntry dict a' && fail "no ispfDictionary"; says "ispfDictionary is not built"
mv "$scratch/kept" "$scratch/bin/ispfDictionary"
cd ..; rm -r entries

run 'restore0Dir; touch 0/extra; restore0Dir' && [ "$(ls 0)" = U ] || fail "restore0Dir"
mkdir -p 0.5 1e-05 10 0.0 0.00e+00 0e0 0e-5 0.1e+00 constant 2D postProcessing/probes; touch dx.hdf.series particles.vtp.series
run cleanTimeDirectories || fail cleanTimeDirectories
[ "$(echo *)" = "0 0.0 0.00e+00 0.orig 0e-5 0e0 2D constant log.badOne log.goodOne log.goodOne.two log.muteOne postProcessing system" ] ||
    fail "cleanTimeDirectories left: $(echo *)"
rmdir 0.0 0.00e+00 0e-5 0e0
run cleanCase || fail cleanCase
[ "$(echo *)" = "0 0.orig 2D constant system" ] || fail "cleanCase left: $(echo *)"
run cleanCase0 && [ ! -e 0 ] || fail cleanCase0
mkdir "$scratch/elsewhere"; cd "$scratch/elsewhere"; mkdir 1; touch log.a
run cleanCase0 && fail "cleaned a folder that is no case"
[ "$(echo *)" = "1 log.a" ] || fail "removed from a folder that is no case"
[ $failures = 0 ]
