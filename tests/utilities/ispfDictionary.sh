#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# ispfDictionary reads and edits a file; its comments and layout must stay
set -uo pipefail
. "$(dirname "$0")/../cases/functions"
cd "$scratch" || exit 1
cat > original <<'END'
// a comment
FoamFile { version 2.0; format ascii; class dictionary; object original; }
endTime   1;   // [s] stays
solvers
{
    "p.*" { tolerance 1e-6; }   /* for all */
    U     { tolerance 1e-5; relTol 0.1; }
}
base { a 1; }
copy { $base; b 2; }
#if 1
mode on;
#else
mode off;
#endif
#include "more"
// the end
END
echo "fromFile 5;" > more
# gives what options...: the output must be `what`
gives() {
    local wanted=$1; shift
    local got; got=$(ispfDictionary original "$@" 2>&1) || fail "$*: $got"
    [ "$got" = "$wanted" ] || fail "$*: '$got', not '$wanted'"
}
# refuses text options...: an error with this text; the file stays
refuses() {
    local wanted=$1; shift
    cp original before
    if ispfDictionary original "$@" > log 2>&1; then fail "$* is not refused"; fi
    grep -q -- "$wanted" log || fail "$*: $(cat log)"
    cmp -s original before || fail "$* touched the file"
}
# edits lines options...: the file must differ from the original only in these lines (in the form of diff)
edits() {
    local wanted=$1; shift
    cp original before
    ispfDictionary original "$@" > log 2>&1 || fail "$*: $(cat log)"
    local got; got=$(diff before original | grep '^[<>]')
    [ "$got" = "$wanted" ] || fail "$*: '$got', not '$wanted'"
    cp before original
}
gives 1 -entry endTime -value
gives "endTime         1;" -entry endTime
gives "endTime   1;" -entry endTime -disableFunctionEntries
gives 1 -entry copy.a -value
gives on -entry mode -value
gives off -entry mode -value -disableFunctionEntries  # the last of the text
gives ' $base; b 2; ' -entry copy -value -disableFunctionEntries
gives 1e-6 -entry solvers.pFinal.tolerance -value
gives 0.1 -entry /solvers/U/relTol -value
gives 1 -expand -entry copy.a -value
gives on -expand -entry mode -value
gives 5 -expand -entry fromFile -value
gives more -includes
gives "$(printf 'tolerance\nrelTol')" -entry solvers.U -keywords
gives "$(cat original)"
edits "$(printf '< endTime   1;   // [s] stays\n> endTime   2;   // [s] stays')" -entry endTime -set 2
edits "$(printf '<     U     { tolerance 1e-5; relTol 0.1; }\n>     U     { tolerance 1e-5; relTol 0; }')" -entry solvers.U.relTol -set 0
edits "$(printf '< copy { $base; b 2; }\n> copy { $base; b 2;\n>     a               7;\n> }')" -entry copy.a -set 7
edits "> fromFile        6;" -entry fromFile -set 6
edits "> mode            slow;" -entry mode -set slow  # the #if decides which of the two counts
edits "< base { a 1; }" -entry base -remove
edits "$(printf '> new\n> {\n>     key             (1 2 3);\n> }')" -entry new.key -add "(1 2 3)"
refuses "already" -entry endTime -add 3
refuses "There is no entry 'endTim'. Did you mean 'endTime'" -entry endTim -value
refuses "would break" -entry endTime -set "(1 2"
refuses "Only one" -entry endTime -set 1 -remove
refuses "no entry" -entry nothing -remove
refuses "'endTime' is a value and no dictionary" -entry endTime.a -set 3
refuses "'base.a' is a value and no dictionary" -entry base.a.b.c -add 3
refuses "option -entry is needed" -set 1
cp original other && ispfDictionary other -entry solvers.U.relTol -set 0.2 > log
[ "$(ispfDictionary original -diff other | tr -s ' \n' ' ')" = "solvers { U { relTol 0.1; } } " ] || fail "-diff: $(ispfDictionary original -diff other)"
printf 'base { a 1; }\ncopy { $base; b 3; }\n' > one; printf 'base { a 2; }\n#include "two"\ncopy { $base; b 3; } // same\n' > other
[ "$(ispfDictionary one -diff other -disableFunctionEntries | tr -s ' \n' ' ')" = "base { a 1; } " ] || fail "raw -diff: $(ispfDictionary one -diff other -disableFunctionEntries)"
[ "$(ispfDictionary other -diff one -disableFunctionEntries | tr -s ' \n' ' ')" = '#include "two" base { a 2; } ' ] || fail "raw -diff of an include"
sed 's/1e-6/0.000001/; s/endTime *\([0-9.]*\)/endTime \1e0/' original > respelt; cmp -s original respelt && fail "nothing is spelt otherwise"
[ -z "$(ispfDictionary original -diff respelt)$(ispfDictionary original -diff respelt -disableFunctionEntries)" ] || fail "-diff of numbers spelt otherwise: $(ispfDictionary original -diff respelt)"
printf 'FoamFile { version 2.0; class dictionary; }\na 1;\n' > headed
sed 's/class dictionary/class other/' headed > other
for raw in "" -disableFunctionEntries; do
    # shellcheck disable=SC2086
    [ "$(ispfDictionary headed -diff other $raw | tr -s ' \n' ' ')" = "FoamFile { class dictionary; } " ] || fail "-diff of headers $raw: $(ispfDictionary headed -diff other $raw)"
done
printf 'a 2 [min];\nb $a;\nc (1 2);\n' > units
[ "$(ispfDictionary units -entry b -SI)" = 120 ] && [ "$(ispfDictionary units -entry b -value)" = "2 [min]" ] || fail "-SI: $(ispfDictionary units -entry b -SI 2>&1)"
ispfDictionary units -entry c -SI > log 2>&1 && fail "-SI of a list"
[ "$(ispfDictionary headed -entry FoamFile | tr -s ' \n' ' ')" = "FoamFile { version 2.0; class dictionary; } " ] || fail "the header: $(ispfDictionary headed -entry FoamFile 2>&1)"
[ "$(ispfDictionary headed -entry FoamFile.class -value)" = dictionary ] || fail "of the header: $(ispfDictionary headed -entry FoamFile.class -value 2>&1)"
# the header is edited like any dictionary; a new header goes to the front
header() { # what it then is, arguments
    local wanted=$1; shift
    ispfDictionary edited "$@" > log 2>&1 || fail "$*: $(cat log)"
    [ "$(tr -s ' \n' ' ' < edited)" = "$wanted " ] || fail "$*: $(cat edited)"
}
cp headed edited
header 'FoamFile { version 2.0; class other; } a 1;' -entry FoamFile.class -set other
header 'FoamFile { version 2.0; class other; object foo; } a 1;' -entry FoamFile.object -add foo
[ "$(ispfDictionary edited -entry FoamFile.object -value)" = foo ] || fail "header: $(cat edited)"
header 'FoamFile { class other; object foo; } a 1;' -entry FoamFile.version -remove
grep -qi warning log && fail "removed, yet: $(cat log)"
header 'FoamFile { version 2.0; } a 1;' -entry FoamFile -set '{ version 2.0; }'
header 'a 1;' -entry FoamFile -remove
printf '// remark\na 1;\n' > edited
header '// remark FoamFile { object foo; } a 1;' -entry FoamFile.object -set foo
ispfDictionary edited -entry FoamFile.format -set runes > log 2>&1 && fail "format runes is accepted"
grep -q "ascii binary" log || fail "no valid formats are listed: $(cat log)"
# lines that end with CR LF keep this end
printf 'FoamFile\r\n{\r\n    version 2.0;\r\n}\r\na { b 1; } // c\r\nd 2; // e\r\n' > dos
dos() {
    cp dos edited; ispfDictionary edited "$@" > log 2>&1 || fail "CR LF, $*: $(cat log)"
    [ "$(grep -c '' edited)" = "$(grep -c $'[^\r]\r$' edited)" ] && ! cmp -s dos edited || fail "CR LF, $*: $(cat -A edited)"
}
dos -entry a.c -add 5
dos -entry f -set 7
dos -entry g.h -set "(1 2)"
dos -entry d -remove
dos -entry FoamFile.object -set foo
dos -entry k -set $'{\n l 1;\n m 2;\n}'
[ -z "$(ispfDictionary original -diff original)" ] || fail "-diff of a file and itself"
# an edit changes its own entry, not a pattern that matches it, and all parts of a dictionary
cat > patterns <<'END'
solvers { "(U|p)" { tol 1; } p { $U; rel 2; } }
".*" { type none; }
walls { slip no; }
walls { friction 1; }
END
pattern() {
    local wanted=$1; shift; cp patterns edited
    ispfDictionary edited "$@" > log 2>&1 || fail "$*: $(cat log)"
    [ "$(tr -s ' \n' ' ' < edited)" = "$wanted " ] || fail "$*: $(cat edited)"
}
pattern 'solvers { "(U|p)" { tol 1; } } ".*" { type none; } walls { slip no; } walls { friction 1; }' -entry solvers.p -remove
grep -q "still is an entry 'solvers.p': a pattern" log || fail "what a pattern still gives: $(cat log)"
pattern 'solvers { "(U|p)" { tol 1; } p { $U; rel 2; tol 3; } } ".*" { type none; } walls { slip no; } walls { friction 1; }' -entry solvers.p.tol -set 3
pattern 'solvers { "(U|p)" { tol 1; } p { $U; rel 2; } } ".*" { type none; } walls { slip no; } walls { friction 1; velocity (1 0 0); }' -entry walls.velocity -add '(1 0 0)'
pattern 'solvers { "(U|p)" { tol 1; } p { $U; rel 2; } } ".*" { type none; } walls { slip no; } walls { friction 1; } other 4;' -entry other -set 4
pattern 'solvers { "(U|p)" { tol 1; } p { $U; rel 2; } } ".*" { type none; } walls {x 1;}' -entry walls -set '{x 1;}'
cp patterns edited; ispfDictionary edited -entry walls.velocity -remove > log 2>&1 && fail "removed what is not there"
cmp -s patterns edited || fail "removed what a pattern matches: $(cat edited)"
# no edit below a pattern, which would change all entries that it matches (foamDictionary refuses it too)
printf '"U.*" { tol 1; }\nUy { tol 7; }\n"k.*" 1;\n' > patterns
for wrong in "Ux.tol -set 5" "Ux.new -add 5" "Ux.tol -remove" "Ux.sub.tol -set 5"; do
    cp patterns edited
    # shellcheck disable=SC2086
    ispfDictionary edited -entry $wrong > log 2>&1 && fail "accepted: -entry $wrong"
    grep -q "There is no dictionary 'Ux': a pattern" log && cmp -s patterns edited || fail "-entry $wrong: $(cat log edited)"
done
pattern '"U.*" { tol 1; } Uy { tol 5; } "k.*" 1;' -entry Uy.tol -set 5
pattern '"U.*" { tol 5; } Uy { tol 7; } "k.*" 1;' -entry 'U.*.tol' -set 5
pattern '"U.*" { tol 1; } Uy { tol 7; } "k.*" 1; Ux {tol 5;}' -entry Ux -set '{tol 5;}'
pattern '"U.*" { tol 1; } Uy { tol 7; } "k.*" 1; k1 5;' -entry k1 -set 5
echo '"(a|b)" { t 1; }' > patterns
pattern '"(a|b)" { t 4; }' -entry '(a|b).t' -set 4
echo '".*" { a 1; }' > patterns
pattern 'FoamFile { object foo; } ".*" { a 1; }' -entry FoamFile.object -set foo
# an entry of an included file is set beside a pattern that matches it
echo 'solvers { p { tol 1; } }' > incf
through() {
    printf '#include "incf"\n"s.*" { any 1; }\n' > edited
    ispfDictionary edited "${@:2}" > log 2>&1 || fail "$*: $(cat log)"
    [ "$(tr -s ' \n' ' ' < edited)" = "#include \"incf\" \"s.*\" { any 1; } $1 " ] || fail "$*: $(cat edited)"
}
through 'solvers { p { tol 7; } }' -entry solvers.p.tol -set 7
[ "$(ispfDictionary edited -entry solvers.p.tol -value)" = 7 ] || fail "set beside a pattern: $(ispfDictionary edited -expand)"
through 'solvers { p {tol 7;} }' -entry solvers.p -set '{tol 7;}'
through 'solvers { U { tol 7; } }' -entry solvers.U.tol -add 7
gone() { ispfDictionary edited "$@" > log 2>&1 && fail "$*, which no program finds: $(cat log)"; }
gone -entry solvers.any; gone -entry solvers.V.any  # an exact key hides the pattern
# parts of dictionaries and files of other kinds are read as foamDictionary reads them
cat > boundary <<'END'
FoamFile { version 2.0; format ascii; class polyBoundaryMesh; object boundary; }
// patches
2
(
    inlet { type patch; nFaces 10; }   // in
    outlet { type patch; nFaces 20; }
)
END
[ "$(ispfDictionary boundary -entry entry0.outlet.nFaces -value)" = 20 ] || fail "a list of patches"
[ "$(ispfDictionary boundary -expand -entry entry0.outlet.nFaces -value)" = 20 ] || fail "a list of patches, expanded"
ispfDictionary boundary -entry entry0.inlet.type -set wall > log || fail "a list of patches: $(cat log)"
grep -q "^    inlet { type wall; nFaces 10; }   // in$" boundary && [ "$(wc -l < boundary)" = 7 ] || fail "a list of patches: $(cat boundary)"
ispfDictionary boundary -entry entry0.outlet -remove > log && [ "$(sed -n 3p boundary)" = 1 ] || fail "a list of patches without one: $(cat log boundary)"
printf '3((0 0 0)(1 0 0)\n(0 1 1e-3))\n' > points
[ "$(ispfDictionary points -expand)" = "3((0 0 0) (1 0 0) (0 1 1e-3))" ] || fail "a list of points: $(ispfDictionary points -expand)"
echo 'a { $_settings; b 1; }' > part
[ "$(ispfDictionary part -expand 2> log | tr -s ' \n' ' ')" = "a { b 1; } " ] && grep -q "_settings names no entry" log || fail "a part"
mkdir -p system
echo 'type probes; field p;' > system/watch
echo 'functions { #includeFunc watch
    # includeFunc "watch(U, p0, count=3)"
}' > part
[ "$(ispfDictionary part -expand -entry functions -keywords | tr '\n' ' ')" = "watch watch(U,p0,count=3) " ] || fail "#includeFunc"
[ "$(ispfDictionary part -expand | grep -c "fields          2(U p0);\|count           3;")" = 2 ] || fail "#includeFunc with arguments: $(ispfDictionary part -expand)"
echo 'functions { #includeFunc wacht
}' > part
ispfDictionary part -expand > log 2>&1 && fail "#includeFunc of nothing"
grep -q "no file system/wacht" log || fail "#includeFunc of nothing: $(cat log)"
ln -s original link && ispfDictionary link -entry endTime -set 3 > log
[ -L link ] && grep -q "endTime   3;" original || fail "an edit through a link"
# a device has no end
timeout 20 ispfDictionary /dev/zero -expand > log 2>&1 && fail "/dev/zero is read"
grep -q "Cannot read /dev/zero: it is a device" log || fail "/dev/zero: $(tail -n 5 log)"
[ "$(ispfDictionary <(echo 'a 1;') -entry a -value)" = 1 ] || fail "a pipe of the shell"
# the mode of a file is kept
echo 'endTime   1;' > modes
for mode in 600 640 444 755; do
    chmod $mode modes
    ispfDictionary modes -entry endTime -set $mode > log || fail "mode $mode: $(cat log)"
    [ "$(stat -c %a modes)" = $mode ] && grep -q "endTime   $mode;" modes || fail "mode $mode has become $(stat -c %a modes)"
done
(umask 027 && ispfDictionary modes -entry endTime -set 1 > log && [ "$(stat -c %a modes)" = 755 ]) || fail "mode under umask 027: $(stat -c %a modes)"
# a file that cannot be written is an error of its own and stops nothing else
for options in "original" "original -expand" "original -entry endTime" "original -keywords" "-help" "modes -entry endTime -set 9"; do
    # shellcheck disable=SC2086
    ispfDictionary $options > /dev/full 2> log && fail "$options: lost without a word"
    grep -q "could not be written to stdout: No space left on device" log || fail "$options: $(cat log)"
    # shellcheck disable=SC2086
    ispfDictionary $options >&- 2> log && fail "$options: lost without a word on a closed stdout"
done
grep -q "endTime   9;" modes || fail "an edit is left undone for what it says: $(grep endTime modes)"
[ $failures = 0 ]
