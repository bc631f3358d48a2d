# SPDX-License-Identifier: GPL-3.0-or-later
# The log of a run, of all its starts: time reached, steps, clock seconds a step, hours a period at the
# pace of the steps in the log, which need not begin at time 0
/^deltaT = / { step = $3 }
/^Time = / { time = $3 }
/^ExecutionTime = / {
    reached = time; covered += step; ++steps
    if ($3 + 0 < cpu) before += clock
    cpu = $3 + 0; clock = $7 + 0
}
END {
    if (!steps || !covered) exit
    print "reached " reached
    print "steps " steps
    print "timePerStep " (before + clock)/steps
    print "timePerPeriod " (before + clock)*period/covered/3600
}
