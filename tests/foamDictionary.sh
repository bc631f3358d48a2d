#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Dictionaries as OpenFOAM reads them, where it is installed (bin/installDependencies openfoam): ispfDictionary
# -expand and foamDictionary -expand give the same words, and what is written is read again as the same.
# TUTORIALS=1 takes all tutorials, not every hundredth.
set -uo pipefail
command -v foamDictionary > /dev/null || { echo "  OpenFOAM is not installed (bin/installDependencies openfoam)"; exit 77; }
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
bin=$(cd "${ISPF_BIN:-build/Release/bin}" && pwd)
cases=$(cd "$(dirname "$0")/cases/dictionaries" && pwd)
examples=/usr/share/doc/openfoam-examples/examples
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# One word a line, numbers to six digits
words() {
    sed '\|^//|d' "$1" | sed -E 's/([][(){};])/ \1 /g' | tr -s ' \t' '\n' |
        awk '/^[-+]?[0-9.]+([eE][-+]?[0-9]+)?$/ { printf "%.5g\n", $1; next } NF'
}

# $1 the file, $2 its name for messages
compare() {
    timeout 20 "$bin/ispfDictionary" "$1" -expand > ours 2> ours.err; local a=$?
    timeout 20 foamDictionary "$1" -expand -precision 9 2> theirs.err |
        sed '1,/^FoamFile/ { /^FoamFile/!d }' > theirs; local b=$?
    if [ $b != 0 ]; then refused=$((refused+1)); return; fi
    if [ $a != 0 ]; then echo "  $2: $(grep -A1 FATAL ours.err | tail -n 1)"; failures=$((failures+1)); return; fi
    compared=$((compared+1))
    if ! diff <(words ours) <(words theirs) > difference; then
        echo "  $2: ispfDictionary (<) and foamDictionary (>) differ"; head -n 6 difference; failures=$((failures+1))
    fi
    cp ours again
    if ! "$bin/ispfDictionary" again -expand 2>&1 | cmp -s - ours; then
        echo "  $2: what is written is read as something else"; failures=$((failures+1))
    fi
}

compared=0; refused=0
for f in "$cases"/*; do compare "$f" "$(basename "$f")"; done
[ $compared = "$(ls "$cases" | wc -l)" ] || { echo "  foamDictionary refuses a sample"; failures=$((failures+1)); }
if [ -d $examples ]; then
    every=100; [ -z "${TUTORIALS:-}" ] || every=1
    cp -rL "$examples/." tutorials && find tutorials -name '*.gz' -exec gunzip -f {} + 2> unpacked.err
    # dictionaries alone: no fields of faces, points or cells
    grep -rlE "^ *class +(dictionary|vol.*Field|surface.*Field|uniform.*Field|.*Dict);" tutorials | sort |
        awk -v n=$every 'NR % n == 1 || n == 1' > list
    while read -r f; do compare "$f" "${f#tutorials/}"; done < list
fi
echo "  $compared dictionaries compared, $refused that foamDictionary refuses, $failures differences"
[ $failures = 0 ] && [ $compared -gt 0 ]
