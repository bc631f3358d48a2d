#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every equation number that a comment of src cites, "(2.3)", must be at the end of one indented line of its chapter in
# doc/theory, and every cited chapter must exist
set -uo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
failures=0
fail() { echo "  FAILED: $1"; failures=$((failures+1)); }
scratch=$(mktemp -d); trap 'rm -rf "$scratch"' EXIT

cat "$root"/doc/theory/[0-9]-*.md | sed -nE 's/^    .*\(([0-9]+\.[0-9]+)\)$/\1/p' | sort > "$scratch/defined"
[ -s "$scratch/defined" ] || fail "doc/theory has no equations"
for n in $(uniq -d "$scratch/defined"); do fail "doc/theory: equation ($n) stands twice"; done
for f in "$root"/doc/theory/[0-9]-*.md; do
    chapter=$(basename "$f"); chapter=${chapter%%-*}
    sed -nE 's/^    .*\(([0-9]+\.[0-9]+)\)$/\1/p' "$f" | grep -v "^$chapter\." && fail "$f: numbers of another chapter"
done

# comments FOLDER: prints file:text of the comments of its sources
comments() { grep -rhoHE --include='*.[HC]' '(^|[^:])//.*' "$1" | sed -E 's|^([^:]*):[^/]?//|\1:|'; }
# missing FOLDER: prints what its comments cite and doc/theory does not have
missing() {
    comments "$1" | grep -oE '^[^:]*:|\([1-9]\.[0-9]+\)|doc/theory/[A-Za-z0-9.-]*\.md' | awk '/:$/ { file = $0; next } { print file, $0 }' |
        sort -u | while read -r file what; do
            case $what in
                doc/*) [ -e "$root/$what" ] || echo "$file $what" ;;
                *) grep -qxF "$(tr -d '()' <<< "$what")" "$scratch/defined" || echo "$file $what" ;;
            esac
        done
}
[ "$(comments "$root/src" | grep -cE '\([1-9]\.[0-9]+\)')" -gt 10 ] || fail "src cites no equations"
while read -r line; do fail "not in doc/theory: $line"; done < <(missing "$root/src")

# the script finds what is missing, and nothing else
mkdir "$scratch/src"
printf '%s\n' '// (2.3) of doc/theory/2-operators.md, and (9.99)' 'f(2.5); // (2.98)' 'g(7.99);' '// doc/theory/0-none.md' > "$scratch/src/wrong.H"
[ "$(missing "$scratch/src" | awk '{ print $2 }' | paste -sd ' ')" = "(2.98) (9.99) doc/theory/0-none.md" ] ||
    fail "found in wrong.H: $(missing "$scratch/src")"
[ $failures = 0 ]
