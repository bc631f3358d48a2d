# SPDX-License-Identifier: GPL-3.0-or-later
# Prints "time name" of each entry of a ParaView series file.  For JSON of another form: a line that names the place.
function skip() { sub(/^[ \t\n]+/, "", text) }
function starts(c) { skip(); return substr(text, 1, 1) == c }
function want(c) {
    if (!starts(c)) { print "no " c " before: " text; exit }
    text = substr(text, 2)
}
function pattern(p,   found) {
    if (!match(text, p)) { print "no value: " text; exit }
    found = substr(text, 1, RLENGTH)
    text = substr(text, RLENGTH + 1)
    return found
}
function string(   found) {
    want("\"")
    found = pattern("^[^\"\\\\]*")
    want("\"")
    return found
}
function members(path,   key) {
    key = string()
    want(":")
    value(path "." key)
}
function value(path) {
    if (starts("{")) {
        want("{")
        members(path)
        while (starts(",")) { want(","); members(path) }
        want("}")
    } else if (starts("[")) {
        want("[")
        value(path "[]")
        while (starts(",")) { want(","); value(path "[]") }
        want("]")
    } else if (starts("\"")) leaf[path] = string()
    else leaf[path] = pattern("^-?(0|[1-9][0-9]*)([.][0-9]+)?([eE][-+]?[0-9]+)?")
    if (path == ".files[]") print leaf[path ".time"], leaf[path ".name"]
}
{ text = text $0 "\n" }
END {
    if (text == "") exit
    value("")
    skip()
    if (text != "") print "left over: " text
}
