#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# doc/guide/first-case.md is true: its bash blocks run in their order in an empty folder.  They print each line of the text
# block after them (except lines of dots) with the same words, and numbers within 3 %.  The function
# objects of doc/guide/functionObjects.md run in that case and in inflatedVessel, and write the columns that the page shows
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
guide=$ispfRoot/doc/guide

# blocks page: writes block.<n>.sh for each bash block, and block.<n>.text for the text block after it
blocks() {
    awk '/^```/ { if (on) { on = 0; close(file); next }
                  kind = substr($0, 4); on = 1; file = "/dev/null"
                  if (kind == "bash") file = sprintf("block.%02d.sh", ++n)
                  if (kind == "text" && n) file = sprintf("block.%02d.text", n)
                  next }
         on { print > file }' "$1"
}
# printed text output: prints lines of the text that the output lacks.  "..." alone skips lines, at the end the rest of a
# line
printed() {
    awk 'function near(a, b) { return (a - b)^2 <= (0.03*b)^2 + 1e-24 }
         # words of a line: numbers become #, and are kept in v
         function split1(line, v,   n, out) {
             out = ""; n = 0
             gsub(/[ \t]+/, " ", line); sub(/^ /, "", line); sub(/ $/, "", line)
             while (match(line, /[-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?/)) {
                 out = out substr(line, 1, RSTART - 1) "#"; v[++n] = substr(line, RSTART, RLENGTH) + 0
                 line = substr(line, RSTART + RLENGTH)
             }
             v[0] = n
             return out line
         }
         FNR == NR { text[++nText] = $0; next }
         { lines[++nLines] = $0 }
         END { for (k = 1; k <= nText; ++k) {
                   if (text[k] ~ /^ *(\.\.\.)?$/) continue
                   open = sub(/ *\.\.\.$/, "", text[k])
                   delete a; delete b
                   want = split1(text[k], a); found = 0
                   timing = text[k] ~ /ExecutionTime|take [0-9.]+ min/
                   for (l = 1; l <= nLines && !found; ++l) {
                       have = split1(lines[l], b)
                       if (open ? index(have, want) != 1 : have != want) continue
                       found = 1
                       # residuals and values near zero are not compared
                       for (i = 1; i <= a[0]; ++i)
                           if (!timing && a[i]^2 > 1e-10 && want !~ /residual/ && !near(b[i], a[i])) found = 0
                   }
                   if (!found) print "    " text[k]
               } }' "$1" "$2"
}

cd "$scratch" || exit 1
blocks "$guide/first-case.md"
[ "$(ls block.*.sh | wc -l)" -gt 8 ] || fail "first-case.md has $(ls block.*.sh | wc -l) blocks"
mkdir reader
# all blocks run in one shell, as for a reader
for b in block.*.sh; do
    echo "exec > $scratch/${b%.sh}.out"; cat "$b"
    echo "[ \$? = 0 ] || { echo '$b' >> $scratch/failed; exit 1; }"
done > all.sh
(cd reader && bash ../all.sh 2> ../err) || fail "first-case.md, $(cat failed 2> /dev/null): $(cat "$(tail -n 1 failed)"; tail -n 8 err)"
[ $failures = 0 ] || exit 1
for t in block.*.text; do
    missing=$(printed "$t" "${t%.text}.out")
    [ -z "$missing" ] || fail "first-case.md shows, and $(head -n 1 "${t%.text}.sh") does not print:
$missing"
done
[ -s reader/flap/flap.png ] || fail "no picture"

# every type has a heading, an example and a picture
page=$guide/functionObjects.md
types=$(grep -oE '\{"[A-Za-z]+", new' "$ispfRoot/src/functionObjects/list/newFunctionObject.C" | grep -oE '[A-Za-z]{4,}')
for type in $types; do
    grep -qx "## $type" "$page" || fail "functionObjects.md has no heading $type"
    grep -qE "^ +type +$type;" "$page" || fail "functionObjects.md has no example of $type"
    grep -q "(pictures/$type.png)" "$page" || fail "functionObjects.md has no picture of $type"
done
for picture in $(grep -ohE '\(pictures/[^)]*' "$guide"/*.md | tr -d '('); do
    [ -s "$guide/$picture" ] || fail "$picture is not there"
done
# the examples run, and their files begin as the page shows
"$guide/pictures/runs" "$scratch/measured" shortened > runs.log 2>&1 || fail "doc/guide/pictures/runs: $(tail -n 5 runs.log)"
shown=0
while read -r file; do
    shown=$((shown+1))
    awk -v begin="\`\`\`text $file" '/^```/ { on = $0 == begin; next } on && /^#/' "$page" > expected
    f=measured/$(sed 's,/0\.3/,/0/,' <<< "$file")
    grep '^#' "$f" > found; [ -s expected ] || fail "$file: the page shows no heads"
    diff -b <(tr -s ' \t' ' ' < expected) <(tr -s ' \t' ' ' < found) > differ || fail "$file: shown (left), written (right)
$(cat differ)"
done < <(awk '/^```text / { print $2 }' "$page")
[ "$shown" -gt 14 ] || fail "functionObjects.md shows $shown files"
[ $failures = 0 ]
