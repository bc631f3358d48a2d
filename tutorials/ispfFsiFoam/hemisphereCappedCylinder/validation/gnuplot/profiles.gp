# SPDX-License-Identifier: GPL-3.0-or-later
# Axial velocity along the diameter 6 mm above the nozzle, one panel an instant, as the paper's Fig. 7
# Variables: out; folder: an instant's curves are the files profile-<instant>*.dat in it; other: folder
# of a run with another spacing, drawn dotted, or empty
width = 1100
height = 820
load common
set xrange [-12:12]
set xlabel "x [mm]"
set ylabel "axial velocity [mm/s]"
set key below center maxrows 1 samplen 1.5
headings = "'minimum stroke (BDC)' 'half stroke forward' 'maximum stroke (TDC)' 'half stroke back'"
set multiplot layout 2, 2
do for [k=1:4] {
    name = word("BDC midForward TDC midReturn", k)
    files = system("cd '".folder."' && ls profile-".name."*.dat 2> /dev/null | sort | tr '\\n' ' '")
    set title word(headings, k)
    if (words(files) == 0) {
        set label 1 "not reached" at graph 0.5, 0.5 center
        plot [][0:1] NaN notitle
        unset label 1
    } else {
        label(f) = system("echo ".f."| sed 's/profile-//; s/.dat$//; s/.DC./stop + /; s/mid.*/ /; s/[0-9]$/& s/'")
        # if the other run lacks a curve, the curve is drawn over itself
        dotted(f) = (other ne "" && system("test -e '".other."/".f."' && echo y") eq "y" ? other : folder)."/".f
        plot for [i=1:words(files)] dotted(word(files, i)) using 1:2 with lines linestyle i \
                dashtype 3 notitle, \
            for [i=1:words(files)] folder."/".word(files, i) using 1:2 with lines linestyle i \
            title words(files) > 1 ? label(word(files, i)) : "", \
            0 with lines linestyle 9 notitle
    }
}
unset multiplot
