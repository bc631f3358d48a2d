#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# src/particles/forPairs.H has the one loop over neighbours.  At most 12 others may be in src, each with its reason in a
# comment, "by hand: ...", on its line or on the line before
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
root=$(cd "$(dirname "$0")/../.." && pwd)
most=12

# loops FOLDER: prints "file:line reason" of each loop that begins at the start, own, mid or wall of a row, or that reads the
# index of a list at its variable within three lines.  Rows of matrices in linearSolvers do not count
loops() {
    find "$1" -name '*.[HC]' ! -name forPairs.H ! -path '*/linearSolvers/*' | sort | while read -r file; do
        awk -v file="${file##*/}" '
            { line[NR] = $0; code[NR] = $0; sub(/\/\/.*/, "", code[NR]) }
            function reads(n, variable,    k) {
                for (k = n; k <= n + 3; ++k) if (code[k] ~ "[.>]index\\[" variable "\\]") return 1
                return 0
            }
            END {
                for (n = 1; n <= NR; ++n) {
                    if (code[n] !~ /for \(.* = /) continue
                    head = code[n]; sub(/.*for \(/, "", head)
                    variable = head; sub(/ = .*/, "", variable); sub(/.* /, "", variable)
                    if (head !~ /^[^;]*[^A-Za-z_](start|own|mid|wall)\[[A-Za-z]+\]/ && !reads(n, variable)) continue
                    reason = line[n] ~ /\/\/ by hand: ./ ? line[n] : line[n - 1] ~ /^ *\/\/ by hand: ./ ? line[n - 1] : ""
                    sub(/.*by hand: /, "", reason)
                    print file ":" n, reason
                }
            }' "$file"
    done
}
# wrong FOLDER: prints what breaks the rule there
wrong() {
    loops "$1" | awk -v most=$most 'NF == 1 { print "no reason at", $1 } END { if (NR > most) print NR, "loops by hand, more than", most }'
}

while read -r line; do fail "$line"; done < <(wrong "$root/src")

# the script finds such loops in every form, and nothing else
mkdir -p "$scratch/src/linearSolvers"
printf '%s\n' 'for (auto k = list->mid[i]; k < end; ++k)' 'for (std::int64_t k = from; k < to; ++k)' '{' '    f(list.index[k]);' \
    'for (label k = start[i]; k < end[i]; ++k)  // by hand: sorts' '// by hand: too' 'for (auto p = own[i]; p < mid[i]; ++p) f(p);' \
    'for (label k = start[line + x]; k < to; ++k) visit(point[k]);' 'for (label k = A.rowStart[i]; k < n; ++k) f(index[k]);' \
    '// for (auto k = list.mid[i]; k < end; ++k)' 'if (list.wall[i] < 0) f();' > "$scratch/src/a.C"
printf '%s\n' 'for (label k = A.start[i]; k < A.start[i + 1]; ++k)' | tee "$scratch/src/linearSolvers/a.C" > "$scratch/src/forPairs.H"
[ "$(loops "$scratch/src" | paste -sd ,)" = "a.C:1 ,a.C:2 ,a.C:5 sorts,a.C:7 too" ] || fail "finds $(loops "$scratch/src" | paste -sd ,)"
[ "$(wrong "$scratch/src" | paste -sd ,)" = "no reason at a.C:1,no reason at a.C:2" ] || fail "refuses $(wrong "$scratch/src" | paste -sd ,)"
for k in $(seq 13); do echo 'for (auto k = list.mid[i]; k < end; ++k)  // by hand: one more'; done > "$scratch/src/a.C"
[ "$(wrong "$scratch/src")" = "13 loops by hand, more than 12" ] || fail "refuses $(wrong "$scratch/src") of 13"
[ $failures = 0 ]
