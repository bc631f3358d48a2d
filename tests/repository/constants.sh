#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every number that src declares as `constexpr scalar|int|label|double|float NAME = ` must be in doc/constants.md: a row
# has its name, file and value; the table of numbers left out has name and file
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
root=$(cd "$(dirname "$0")/../.." && pwd)

# declared FOLDER: prints "file name number" of each, also for several in one declaration
declared() {
    find "$1" -name '*.[HC]' | sort | while read -r file; do
        sed 's|//.*||' "$file" | tr '\n' ' ' | grep -oE 'constexpr +(scalar|int|label|double|float) +[A-Za-z_0-9]+ *=[^;]*;' |
            sed -E 's/^constexpr +[a-z]+ +//; s/;$//' | tr ',' '\n' |
            sed -nE "s|^ *([A-Za-z_0-9]+) *= *(-?[0-9][0-9.]*(e[-+]?[0-9]+)?).*|${file##*/} \1 \2|p"
    done
}
# missing FOLDER FILE: prints the numbers of FOLDER without a row in FILE.  A row counts for one declaration, so that two of
# the same name in a file need two rows
missing() {
    awk -F' *[|] *' '
        function has(text, word,    n, parts, k) {
            n = split(text, parts, /[^A-Za-z0-9_.+-]+/)
            for (k = 1; k <= n; ++k) { sub(/\.$/, "", parts[k]); if (parts[k] == word) return 1 }
            return 0
        }
        NR == FNR { if (/^[|] /) { ++n; names[n] = $2; files[n] = $3; values[n] = NF > 5 ? $5 : "any" } next }
        {
            split($0, d, " ")
            for (k = 1; k <= n; ++k)
                if (!((k, d[2]) in told) && has(names[k], d[2]) && has(files[k], d[1]) &&
                    (values[k] == "any" || has(values[k], d[3]))) { told[k, d[2]] = 1; next }
            print
        }' "$2" <(declared "$1")
}

[ "$(declared "$root/src" | wc -l)" -gt 100 ] || fail "src declares no numbers"
while read -r line; do fail "not in doc/constants.md: $line"; done < <(missing "$root/src" "$root/doc/constants.md")

# gone TREE FILE: prints sources and tests that FILE names and TREE does not have
gone() {
    grep -E '^[|] ' "$2" | grep -oE '[A-Za-z_0-9/.]+\.([CH]|sh)\b' | sort -u | while read -r file; do
        [ -n "$(find "$1"/{src,applications,tests} -path "*/$file" -print -quit)" ] || echo "$file"
    done
}
while read -r file; do fail "doc/constants.md names $file, which does not exist"; done < <(gone "$root" "$root/doc/constants.md")

# the script finds missing rows, other values and names in other files, and nothing else
mkdir "$scratch/src"
printf '%s\n' 'constexpr scalar told = 0.5, other =' '    -1e-3;  // [dx]' 'static constexpr int most = 3;' 'constexpr label none = n;' \
    '{ constexpr int most = 3; }' > "$scratch/src/a.C"
printf '%s\n' 'constexpr scalar told = 0.5, least = 2;' > "$scratch/src/b.H"
printf '%s\n' '| told, other | a.C, (1.1) | - | 0.5, -1e-3 of dx | - | - | - |' '| most | a.C | - | 3 | - | - | - |' \
    '| least | b.H | - | 4 | - | - | - |' > "$scratch/table"
[ "$(missing "$scratch/src" "$scratch/table" | paste -sd ,)" = "a.C most 3,b.H told 0.5,b.H least 2" ] ||
    fail "found in a table that lacks three: $(missing "$scratch/src" "$scratch/table")"
mkdir "$scratch/applications" "$scratch/tests"
[ "$(gone "$scratch" <(cat "$scratch/table" <(echo '| x | c.C | 1 | - | - | - | tests/d.sh |')) | paste -sd ,)" = "c.C,tests/d.sh" ] ||
    fail "found of two files that are gone: $(gone "$scratch" "$scratch/table")"
[ $failures = 0 ]
