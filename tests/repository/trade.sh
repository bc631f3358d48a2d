#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The front of error against CPU time: bin/tools/trade.py on runs with invented numbers
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
run() { # name seconds error...
    mkdir -p "$scratch/$1/comparison"
    printf 'particles: 9 (9 owned)\nTime = 1\nTime = 2\nExecutionTime = %s s  ClockTime = 1 s\n' "$2" > "$scratch/$1/log.ispfFsiFoam"
    [ -z "${3:-}" ] || printf 'quantity,reference,value\nother,1,7\nerror,1,%s\n' "$3" > "$scratch/$1/comparison/summary.csv"
}
run cheap 1 0.1; run dear 9 -0.01; run behind 4 0.2; run same 9 0.02; run failed 2; run left 0.1 1e-9; run odd 3 nan
mkdir "$scratch/dear/interrupted" && printf 'Time = 1\nExecutionTime = 1 s\n' > "$scratch/dear/interrupted/log.ispfFsiFoam.0"
cat > "$scratch/study" << 'END'
from trade import Trade
trade = Trade("error")
trade.family("first", {"cheap": "1", "failed": "2", "left": "3"})
trade.family("second", {"behind": "a", "same": "b", "dear": "c", "odd": "d"})
trade.write()
print(trade.cheapest(0.1), trade.cheapest(0.05), trade.cheapest(0.001))
END
cd "$scratch" || exit 1
found=$(VARIANTS="cheap dear behind same failed odd" python3 study) || fail "the study"
[ "$found" = "('cheap', 1.0) ('same', 9.0) (None, nan)" ] || fail "cheapest: $found"
diff comparison/trade.csv - << 'END' || fail "trade.csv"
family,choice,variant,particles,steps,cpuSeconds,error,status
first,1,cheap,9,2,1,0.1,front
first,2,failed,9,2,2,,did not end
second,a,behind,9,2,4,0.2,behind
second,b,same,9,2,9,0.02,front
second,c,dear,9,3,10,0.01,front
second,d,odd,9,2,3,,did not end
END
[ -s comparison/trade.png ] || fail "no picture"
[ $failures = 0 ]
