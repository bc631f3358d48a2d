# SPDX-License-Identifier: GPL-3.0-or-later
# Quantities from the histories; "nan" for a value that is no number.  Variables: period, top (time of the full stroke in
# it) [s]; cycles, the requested number, 2 by default; stroke [m3]; rest, the cavity's volume, and wall, the solid's [m3].
# Input: diameter.dat (time, dD/D), volume.dat (time, swept, cavity, openNet, wall, control, wallFeedback, defect,
# wallDefect, fluidFeedback), pressure.dat (time, p/G)
function abs(a) { return a < 0 ? -a : a }
function say(name, value) { if (value == "nan") print name, value; else printf "%s %.6g\n", name, value }
function times(factor, value) { return value == "nan" ? value : factor*value }
FNR == 1 { file = FILENAME; sub(/.*\//, "", file); sub(/\.dat$/, "", file) }
{
    n[file] = FNR
    for (c = 1; c <= NF; ++c) {
        row[file, FNR, c] = $c
        if ($c !~ /^[-+]?[0-9.]/) broken[file, c] = 1
    }
}
# Row of the last time with this phase in a period; 0 if the history does not reach one
function rowAt(file, phase,    end, t, i, best) {
    if (!(file in n)) return 0
    end = row[file, n[file], 1]
    if (end < phase - 0.02) return 0
    t = phase + period*int((end - phase + 0.02)/period)
    best = 1
    for (i = 2; i <= n[file]; ++i) if (abs(row[file, i, 1] - t) < abs(row[file, best, 1] - t)) best = i
    return best
}
function largest(file, column,    i, most) {
    if ((file, column) in broken) return "nan"
    for (i = 1; i <= n[file]; ++i) if (abs(row[file, i, column]) > abs(most)) most = row[file, i, column]
    return most
}
# Largest value of one column less another
function largestLess(file, column, other,    i, v, most) {
    if ((file, column) in broken || (file, other) in broken) return "nan"
    for (i = 1; i <= n[file]; ++i) {
        v = row[file, i, column] - row[file, i, other]
        if (abs(v) > abs(most)) most = v
    }
    return most
}
# The ledger in row k and the cavity's defect [% of the stroke], with and without the volume that control has added
function ledger(when, name, k,    c, title) {
    split("time swept cavity openNet wall control wallFeedback defect wallDefect fluidFeedback", title, " ")
    for (c = 2; c <= 10; ++c) say(when "." title[c], 100*row["volume", k, c]/stroke)
    say(name, 100*(row["volume", k, 3] - row["volume", k, 2])/stroke)
    say("own." name, 100*(row["volume", k, 3] - row["volume", k, 2] - row["volume", k, 6])/stroke)
}
# Largest difference [%] at the same phase between any two cycles at the distance `apart`, linear between rows
function differenceOf(apart,    i, j, t, a, d, most) {
    j = 1
    for (i = 1; i <= n["diameter"]; ++i) {
        t = row["diameter", i, 1] - apart
        if (t < 0) continue
        while (j < n["diameter"] - 1 && row["diameter", j + 1, 1] < t) ++j
        a = (t - row["diameter", j, 1])/(row["diameter", j + 1, 1] - row["diameter", j, 1])
        d = row["diameter", i, 2] - (1 - a)*row["diameter", j, 2] - a*row["diameter", j + 1, 2]
        if (abs(d) > most) most = abs(d)
    }
    return most
}
function cycleDifference(    k, d, most) {
    if (("diameter", 1) in broken || ("diameter", 2) in broken) return "nan"
    for (k = 1; k < cycles; ++k) if ((d = differenceOf(k*period)) > most) most = d
    return 100*most/abs(largest("diameter", 2))
}
END {
    if (cycles < 2) cycles = 2
    if (rowAt("diameter", top)) say("dDPeak", times(100, largest("diameter", 2)))
    if (rowAt("diameter", cycles*period)) say("cycleDifference", cycleDifference())
    if (k = rowAt("volume", top)) {
        say("syringeDiameter", ("volume", 2) in broken ? "nan" : 16*sqrt(largest("volume", 2)/stroke))
        if (rest) say("volumeIncrease", times(100/rest, largest("volume", 3)))
        ledger("peak", "volumeDefectPeak", k)
        if (wall) {
            say("wallVolumeChange", times(100/wall, largest("volume", 5)))
            say("wallFeedback", times(100/wall, largest("volume", 7)))
            say("wallDefect", times(100/wall, largest("volume", 9)))
            say("own.wallVolumeChange", times(100/wall, largestLess("volume", 5, 7)))
        }
    }
    if (k = rowAt("volume", period)) ledger("end", "volumeDefectEnd", k)
    if (k = rowAt("pressure", top)) say("pressurePeak", row["pressure", k, 2])
}
