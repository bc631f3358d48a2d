# SPDX-License-Identifier: GPL-3.0-or-later
# What the histories say.  Variables: period, top (time of the full stroke within it) [s]; stroke [m3];
# rest, the cavity's volume, and wall, the solid's [m3].
# Input: diameter.dat (time, dD/D), volume.dat (time, swept, cavity, openNet, wall, control, wallFeedback, defect,
# wallDefect, fluidFeedback), pressure.dat (time, p/G)
function abs(a) { return a < 0 ? -a : a }
function say(name, value) { printf "%s %.6g\n", name, value }
FNR == 1 { file = FILENAME; sub(/.*\//, "", file); sub(/\.dat$/, "", file) }
{
    n[file] = FNR
    for (c = 1; c <= NF; ++c) row[file, FNR, c] = $c
}
# Row of the last time that is `phase` within a period; 0 if the history does not reach one
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
    for (i = 1; i <= n[file]; ++i) if (abs(row[file, i, column]) > abs(most)) most = row[file, i, column]
    return most
}
# Column less another where it is largest
function largestLess(file, column, other,    i, v, most) {
    for (i = 1; i <= n[file]; ++i) {
        v = row[file, i, column] - row[file, i, other]
        if (abs(v) > abs(most)) most = v
    }
    return most
}
# The ledger in row k and the cavity's defect [% of the stroke], as it is and less what control has put in
function ledger(when, name, k,    c, title) {
    split("time swept cavity openNet wall control wallFeedback defect wallDefect fluidFeedback", title, " ")
    for (c = 2; c <= 10; ++c) say(when "." title[c], 100*row["volume", k, c]/stroke)
    say(name, 100*(row["volume", k, 3] - row["volume", k, 2])/stroke)
    say("own." name, 100*(row["volume", k, 3] - row["volume", k, 2] - row["volume", k, 6])/stroke)
}
# Largest difference [%] between the second cycle and the first at the same phase, linear between rows
function cycleDifference(    i, j, t, a, d, most) {
    j = 1
    for (i = 1; i <= n["diameter"]; ++i) {
        t = row["diameter", i, 1] - period
        if (t < 0 || t > period) continue
        while (j < n["diameter"] - 1 && row["diameter", j + 1, 1] < t) ++j
        a = (t - row["diameter", j, 1])/(row["diameter", j + 1, 1] - row["diameter", j, 1])
        d = row["diameter", i, 2] - (1 - a)*row["diameter", j, 2] - a*row["diameter", j + 1, 2]
        if (abs(d) > most) most = abs(d)
    }
    return 100*most/largest("diameter", 2)
}
END {
    if (rowAt("diameter", top)) say("dDPeak", 100*largest("diameter", 2))
    if (rowAt("diameter", 2*period)) say("cycleDifference", cycleDifference())
    if (k = rowAt("volume", top)) {
        say("syringeDiameter", 16*sqrt(largest("volume", 2)/stroke))
        if (rest) say("volumeIncrease", 100*largest("volume", 3)/rest)
        ledger("peak", "volumeDefectPeak", k)
        if (wall) {
            say("wallVolumeChange", 100*largest("volume", 5)/wall)
            say("wallFeedback", 100*largest("volume", 7)/wall)
            say("wallDefect", 100*largest("volume", 9)/wall)
            say("own.wallVolumeChange", 100*largestLess("volume", 5, 7)/wall)
        }
    }
    if (k = rowAt("volume", period)) ledger("end", "volumeDefectEnd", k)
    if (k = rowAt("pressure", top)) say("pressurePeak", row["pressure", k, 2])
}
