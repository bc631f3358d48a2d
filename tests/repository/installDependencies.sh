#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bin/installDependencies, and `make demo` and `make test` through it: with a terminal they ask, without one they
# install.  Only programs in $scratch/bin can be found; the apt-get there only notes what it is asked for.
set -uo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
script=$(command -v script) || { echo "  script is not installed (Debian's bsdutils)"; exit 77; }
make=$(command -v make); timeout=$(command -v timeout)
failures=0
fail() { echo "  FAILED: $1"; failures=$((failures+1)); }
scratch=$(mktemp -d); trap 'rm -rf "$scratch"' EXIT
unset CI CXX OPT MAKEFLAGS MAKELEVEL MAKEOVERRIDES
export scratch uid=0 SHELL=/bin/sh

# ---- a tree with one test, and programs for it ----------------------------------------------------------
tree="$scratch/a tree"
mkdir -p "$scratch/bin" "$tree/bin" "$tree/tests/one" "$tree/tutorials/ispfFsiFoam/hemisphereCappedCylinder"
cp "$root/bin/installDependencies" "$root/bin/demo" "$tree/bin/"
cp "$root/Makefile" "$tree/"
touch "$tree/tests/one/main.C"
program() { { echo "#!/bin/sh"; cat; } > "$1"; chmod +x "$1"; }
program "$tree/tutorials/ispfFsiFoam/hemisphereCappedCylinder/Allrun" <<< 'echo Allrun $* >> "$scratch/did"'
program "$tree/bin/runTests" <<< 'echo runTests >> "$scratch/did"'
program "$scratch/bin/make" <<< 'echo build >> "$scratch/did"'
program "$scratch/bin/g++" << 'END'
[ -e "$scratch/installed" ] || exit 1
while [ $# -gt 0 ]; do [ "$1" != -o ] || touch "$2"; shift; done
END
for p in h5dump gmsh; do program "$scratch/bin/$p" <<< ''; done
program "$scratch/bin/id" <<< 'echo $uid'
program "$scratch/bin/dpkg-query" << 'END'
case $3 in libre2-dev|doctest-dev) [ -e "$scratch/installed" ] || exit 1 ;; esac
echo install ok installed
END
program "$scratch/bin/apt-get" << 'END'
[ ! -t 0 ] || exit 2
echo "$DEBIAN_FRONTEND $*" >> "$scratch/did"
case $* in *$(cat "$scratch/fails")*) echo "E: no network" >&2; exit 100 ;; *install*) touch "$scratch/installed" ;; esac
END
withSudo() { program "$scratch/bin/sudo" <<< 'echo sudo >> "$scratch/did"; exec env -i PATH="$PATH" scratch="$scratch" "$@"'; }
for p in ar bash cat date dirname env expand grep mkdir nproc realpath rm sed sh touch; do
    ln -s "$(command -v $p)" "$scratch/bin/$p"
done

# ---- how a command is run, and its result ---------------------------------------------------------------
# fresh: two packages are missing, and nothing has been built
fresh() {
    rm -rf "$scratch/did" "$scratch/installed" "$scratch/piped" "$tree/build"
    touch "$scratch/did"; echo "${1:-nothing}" > "$scratch/fails"
    cd "$tree" || exit 1
}
# without command: its standard input is the caller's, no terminal; typing keys command: at a terminal
without() { PATH=$scratch/bin "$timeout" 20 sh -c "$1" > "$scratch/out" 2>&1; status=$?; }
typing() {
    printf "$1" | PATH=$scratch/bin "$timeout" 20 "$script" -qec "$2" /dev/null 2>&1 | tr -d '\r' > "$scratch/out"
    status=${PIPESTATUS[1]}
}
said() { grep -qE -- "$2" "$scratch/out" || fail "$1: '$2' is not said: $(cat "$scratch/out")"; }
packages="libre2-dev doctest-dev" before=""  # packages that are missing in the groups asked for; text before apt-get
listed() { said "$1" "^Debian packages to install: $packages$"; }
did() { # what expected: words of what was done, in this order
    grep -qxE -- "$2" <<< "$(tr '\n' ' ' < "$scratch/did")" || fail "$1: done was '$(cat "$scratch/did")', not '$2': $(cat "$scratch/out")"
}
apt() { echo "${before}noninteractive update [^ ]* ?${before}noninteractive .*install .*$packages "; }
installed() { # what [what else was done]
    [ "$status" = 0 ] || fail "$1: status $status: $(cat "$scratch/out")"
    did "$1" "$(apt)${2:-}"
}
asked() { said "$1" "Install them now\? \[Y/n\]"; }
notAsked() { grep -q "\[Y/n\]" "$scratch/out" && fail "$1: asked: $(cat "$scratch/out")"; }
# the command in the last line installs the packages, from any folder
refused() { # what [status]
    [ "$status" = "${2:-1}" ] || fail "$1: status $status, not ${2:-1}"
    did "$1" ""
    said "$1" "othing installed.*: /[^ ]*/a.* tree/bin/installDependencies -y run test$"
    local named; named=$(sed -n 's/.*: \(\/.* -y .*\)/\1/p' "$scratch/out")
    cd /; typing "" "$named"
    notAsked "$1: $named"; installed "$1: $named"
}
install="bin/installDependencies run test"

# ---- no terminal: it installs and does not ask ----------------------------------------------------------
mkfifo "$scratch/silent"; exec 9<> "$scratch/silent"  # a pipe to which nobody writes
for input in "< /dev/null" "<&-" "<&9" "< Makefile"; do
    fresh; without "$install $input"; listed "$input"; notAsked "$input"; installed "$input"
    fresh; typing "n\n" "$install $input"; notAsked "terminal, $input"; installed "terminal, $input"
done
fresh; without "bin/installDependencies test < /dev/null"; said "one group" "to install: doctest-dev$"
without "$install < /dev/null"; [ "$status" = 0 ] && [ ! -s "$scratch/out" ] || fail "nothing is missing: $(cat "$scratch/out")"

# ---- a terminal: it asks, and Enter means yes ---------------------------------------------------------
for keys in "\n" "y\n" "Y\n" "yes\n"; do
    fresh; typing "$keys" "$install"; listed "keys $keys"; asked "keys $keys"; installed "keys $keys"
done
for keys in "n\n" "N\n" "no\n" "what\n" ""; do
    fresh; typing "$keys" "$install"; listed "keys $keys"; asked "keys $keys"; refused "keys $keys"
done
for option in "$install -y" "env CI=true $install"; do
    fresh; typing "n\n" "$option"; listed "$option"; notAsked "$option"; installed "$option"
done
# the question is visible if the output goes elsewhere, and if the terminal was opened for reading only
fresh; typing "\n" "$install 2>&1 | cat > '$scratch/piped'"; asked piped; installed piped
grep -q "to install: libre2-dev doctest-dev$" "$scratch/piped" || fail "piped: no list: $(cat "$scratch/piped")"
fresh; typing "n\n" "$install > '$scratch/piped' 2>&1"; asked "to a file"; did "to a file" ""; [ "$status" = 1 ] || fail "to a file: status $status"
fresh; typing "n\n" "$install < /dev/tty"; asked "read only"; refused "read only"

# ---- what cannot be installed ---------------------------------------------------------------------------
for step in update "install "; do
    fresh "$step"; without "$install < /dev/null"
    [ "$status" = 1 ] || fail "$step fails: status $status"
    listed "$step fails"; said "$step fails" "E: no network"; said "$step fails" "installation failed.* -y run test$"
    fresh "$step"; typing "\n" "$install"; [ "$status" = 1 ] || fail "$step fails at a terminal: status $status"
done
uid=1000
for how in "without '$install < /dev/null'" "typing '\n' '$install'"; do
    fresh; eval "$how"; listed "no sudo"; notAsked "no sudo"; said "no sudo" "as root"
    uid=0; refused "no sudo"; uid=1000
done
withSudo; before="sudo "
fresh; without "$install < /dev/null"; installed sudo
fresh; typing "\n" "$install"; installed "sudo at a terminal"
uid=0 before=""

# ---- the two commands -------------------------------------------------------------------------------------
demo="$make demo" packages=libre2-dev
fresh; without "$demo < /dev/null"; installed "$demo" "build Allrun "
fresh; typing "\n" "$demo"; listed "$demo, Enter"; asked "$demo, Enter"; installed "$demo, Enter" "build Allrun "
fresh; typing "n\n" "$demo"; did "$demo, n" ""; said "$demo, n" "/bin/installDependencies -y run$"; [ "$status" = 2 ] || fail "$demo, n: status $status"
fresh "install "; without "$demo < /dev/null"; did "$demo, failing" "$(apt)"; [ "$status" = 2 ] || fail "$demo, failing: status $status"
fresh; typing "n\n" "bin/demo -y -2D"; notAsked "demo -y"; installed "demo -y" "build Allrun -2D "
packages="libre2-dev doctest-dev"
for tests in "$make test" "$make -j2 test"; do
    fresh; without "$tests < /dev/null"; listed "$tests"; installed "$tests" "runTests "
    fresh; typing "\n" "$tests"; listed "$tests, Enter"; asked "$tests, Enter"; installed "$tests, Enter" "runTests "
    # with all packages it does not ask, whoever installed them (no dpkg-query: not Debian)
    : > "$scratch/did"; mv "$scratch/bin/dpkg-query" "$scratch/"
    typing "" "$tests"; notAsked "$tests again"; did "$tests again" "runTests "
    mv "$scratch/dpkg-query" "$scratch/bin/"
    fresh; typing "n\n" "$tests"; asked "$tests, n"
    grep -q "^CXX" "$scratch/out" && fail "$tests, n: it compiles all the same"
    refused "$tests, n" 2
    fresh "install "; without "$tests < /dev/null"; did "$tests, failing" "$(apt)"; [ "$status" = 2 ] || fail "$tests, failing: status $status"
done
[ $failures = 0 ]
