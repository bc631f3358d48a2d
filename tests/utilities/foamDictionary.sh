#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Compares with OpenFOAM's reader if it is installed (bin/installDependencies openfoam): ispfDictionary
# -expand and foamDictionary -expand give the same words, and the written text reads back as the same.
# TUTORIALS=1 takes all files of OpenFOAM's tutorials instead of every thirtieth.
set -uo pipefail
command -v foamDictionary > /dev/null || { echo "  OpenFOAM is not installed (bin/installDependencies openfoam)"; exit 77; }
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
bin=$(cd "${ISPF_BIN:-build/Release/bin}" && pwd)
cases=$(cd "$(dirname "$0")/../cases/dictionaries" && pwd)
examples=/usr/share/doc/openfoam-examples/examples
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# One word per line, numbers to nine digits; OpenFOAM's remark on a list without a keyword is removed
words() {
    sed -E '\|^//|d; s|// entry[0-9]+$||' "$1" | sed -E 's/([][(){};/])/ \1 /g' | tr -s ' \t' '\n' |
        awk '/^[-+]?[0-9.]+([eE][-+]?[0-9]+)?$/ { printf "%.9g\n", $1; next } NF'
}

# $1 the file, $2 its name for messages; from the folder of its case, for #include "<case>/..."
compare() {
    local case; case=$(dirname "$1")
    while [ ! -d "$case/system" ] && [ "$case" != . ] && [ "$case" != / ]; do case=$(dirname "$case"); done
    [ -d "$case/system" ] || case=.
    timeout 20 "$bin/ispfDictionary" -case "$case" "$PWD/$1" -expand > ours 2> ours.err; local a=$?
    (cd "$case" && timeout 20 foamDictionary "$work/$1" -expand -precision 15 2> /dev/null) |
        sed '1,/^\\\*/d' > theirs; local b=${PIPESTATUS[0]}
    if [ $a = 0 ]; then
        cp ours again
        if ! "$bin/ispfDictionary" again -expand 2> /dev/null | cmp -s - ours; then
            echo "  $2: what is written is read as something else"; failures=$((failures+1))
        fi
    fi
    if [ $b != 0 ]; then refused=$((refused+1)); return; fi
    if [ $a != 0 ]; then echo "  $2: $(grep -A1 FATAL ours.err | tail -n 1)"; failures=$((failures+1)); return; fi
    compared=$((compared+1))
    if ! diff <(words ours) <(words theirs) > difference; then
        echo "  $2: ispfDictionary (<) and foamDictionary (>) differ"; head -n 6 difference; failures=$((failures+1))
    fi
}

compared=0; refused=0
cp "$cases"/* .
for f in "$cases"/*; do compare "$(basename "$f")" "$(basename "$f")"; done
# #ifeq of all operands with all.  Here 5.0 is 5 on both sides, and ${x} is the same as $x; in OpenFOAM not always
operands=(5 '"5"' abc '"abc"' '$x' '"$x"' '$y' '"$y"' '"${y}"' '$z' '"$z"' '"$s.t"' on true '""' '"$none"')
{
    echo 'FoamFile { version 2.0; format ascii; class dictionary; object conditions; } x 5; y abc; z "abc"; s { t 1; }'
    for i in "${!operands[@]}"; do
        for k in "${!operands[@]}"; do printf '#ifeq %s %s\nsame%s_%s yes;\n#endif\n' "${operands[i]}" "${operands[k]}" "$i" "$k"; done
    done
} > conditions
compare conditions conditions
[ $compared = $(($(ls "$cases" | wc -l) + 1)) ] || { echo "  foamDictionary refuses a sample"; failures=$((failures+1)); }
if [ -d $examples ]; then
    every=30; [ -z "${TUTORIALS:-}" ] || every=1
    cp -rL "$examples/." tutorials && find tutorials -name '*.gz' -exec gunzip -f {} + 2> unpacked.err
    # missed-ending: broken on purpose; OpenFOAM reads what it can
    grep -rlI '^ *FoamFile' tutorials | grep -v '/missed-ending' | sort | awk -v n=$every 'NR % n == 1 || n == 1' > list
    while read -r f; do compare "$f" "${f#tutorials/}"; done < list
fi
echo "  $compared files compared, $refused that foamDictionary refuses, $failures differences"
[ $failures = 0 ] && [ $compared -gt 0 ]
