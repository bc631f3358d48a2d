# SPDX-License-Identifier: GPL-3.0-or-later
# Joins the files that a function object wrote at each start of the run into one history and prints
# the time and the requested columns.  A restart replaces the rows that it repeats.
# Variable: want, the titles or numbers of columns separated by '|'.  Input: the files in the order of
# their starts.
BEGIN { nWant = split(want, title, "|") }
FNR == 1 { restarted = 1 }
/^#/ { header = $0; next }
restarted {
    restarted = 0
    while (n > 0 && time[n] >= $1 + 0) --n
    sub(/^#[ \t]*/, "", header)
    nTitles = split(header, found)
    for (k = 1; k <= nWant; ++k) {
        column[k] = title[k] + 0
        for (c = 1; c <= nTitles; ++c) if (found[c] == title[k]) column[k] = c
        if (!column[k]) {
            print FILENAME ": there is no column '" title[k] "'; there are: " header > "/dev/stderr"
            exit 1
        }
    }
}
{
    time[++n] = $1 + 0
    for (k = 1; k <= nWant; ++k) value[n, k] = $column[k]
}
END {
    for (i = 1; i <= n; ++i) {
        printf "%.10g", time[i]
        for (k = 1; k <= nWant; ++k) printf " %s", value[i, k]
        print ""
    }
}
