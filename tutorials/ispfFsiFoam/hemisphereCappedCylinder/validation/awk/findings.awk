# SPDX-License-Identifier: GPL-3.0-or-later
# What the paper reports and whether this run shows it; and what the run must keep to be trusted.
# Input: summary.csv
BEGIN { FS = "," }
{ q[$1] = $2 }
function has(names,    k, n, name) {
    n = split(names, name, " ")
    for (k = 1; k <= n; ++k) if (!(name[k] in q)) return 0
    return 1
}
function abs(a) { return a < 0 ? -a : a }
function finding(needed, statement) {
    text = statement
    known = has(needed)
    if (!known) printf "  [ ? ]  %s\n         not reached by this run\n", text
    return known
}
function verdict(yes, detail) { printf "  [%s]  %s\n         %s\n", yes ? "yes" : " no", text, detail }
# "+0.00 a, +0.20 b, ...": a quantity at the instants of a dead centre
function dwell(centre, name,    k, n, part, list) {
    n = split("+0.00 +0.20 +0.57 +1.15", part, " ")
    for (k = 1; k <= n; ++k) if ((centre part[k] "." name) in q)
        list = list (list == "" ? "" : ", ") sprintf("stop %s s: %.2f", part[k], q[centre part[k] "." name])
    return list
}
# The instant of the dwell at which a quantity is nearest to a published value
function nearest(centre, name, value,    k, n, part, key, best) {
    n = split("+0.00 +0.20 +0.57 +1.15", part, " ")
    for (k = 1; k <= n; ++k) {
        key = centre part[k] "." name
        if (key in q && (best == "" || abs(q[key] - value) < abs(q[centre best "." name] - value))) best = part[k]
    }
    return best
}
END {
    print "\nTHE PAPER'S FINDINGS (the rest at a dead centre makes its instant ambiguous: all are given)"
    if (finding("TDC+0.00.ringHeight", "vortex ring centred 6 mm above the nozzle at TDC")) {
        at = nearest("TDC", "ringHeight", 6)
        verdict(abs(q["TDC" at ".ringHeight"] - 6) <= 1, "height [mm] " dwell("TDC", "ringHeight"))
    }
    if (finding("TDC+0.00.peak", "TDC: peak of about 1.5 mm/s towards the dome above the nozzle, nozzle mean nearly zero")) {
        at = nearest("TDC", "peak", 1.5)
        verdict(abs(q["TDC" at ".peak"] - 1.5) <= 0.3 && abs(q["TDC" at ".nozzleMean"]) < 0.15, \
            "peak [mm/s] " dwell("TDC", "peak") "\n         nozzle mean [mm/s] " dwell("TDC", "nozzleMean"))
    }
    if (finding("BDC+0.00.fastestAboveNozzle", "BDC: the largest velocity is at the nozzle exit")) {
        yes = 0
        split("+0.00 +0.20 +0.57 +1.15", part, " ")
        for (k = 1; k <= 4; ++k) yes += (("BDC" part[k] ".fastest") in q) && abs(q["BDC" part[k] ".fastestAboveNozzle"]) <= 2
        verdict(yes, "its height above the exit [mm] " dwell("BDC", "fastestAboveNozzle"))
    }
    if (finding("midForward.fastestInChamber midReturn.fastestInChamber", "at most 5 mm/s at half stroke"))
        verdict(q["midForward.fastestInChamber"] <= 5 && q["midReturn.fastestInChamber"] <= 5, \
            sprintf("in the chamber: forward %.2f, back %.2f mm/s; 6 mm above the nozzle: %.2f, %.2f mm/s", \
            q["midForward.fastestInChamber"], q["midReturn.fastestInChamber"], q["midForward.lineTop"], q["midReturn.lineTop"]))
    if (finding("midForward.linePeakOverMean midReturn.linePeakOverMean", "the return profile is flatter than the forward one"))
        verdict(q["midReturn.linePeakOverMean"] < q["midForward.linePeakOverMean"], \
            sprintf("peak over mean of the central half: forward %.3f, return %.3f", \
            q["midForward.linePeakOverMean"], q["midReturn.linePeakOverMean"]))

    print "\nWHAT THE RUN MUST KEEP"
    if (finding("dDPeak", "diameter: peak of dD/D between 12.5 and 15.5 %"))
        verdict(q["dDPeak"] >= 12.5 && q["dDPeak"] <= 15.5, sprintf("%.2f %%", q["dDPeak"]))
    if (finding("volumeDefectPeak", "cavity against plunger volume: within 1 % of the stroke at the peak"))
        verdict(abs(q["volumeDefectPeak"]) <= 1, sprintf("%+.3f %%; the control term has put in %+.2f %%", q["volumeDefectPeak"], q["controlPeak"]))
    if (finding("volumeDefectEnd", "cavity against plunger volume: within 0.2 % of the stroke after the cycle"))
        verdict(abs(q["volumeDefectEnd"]) <= 0.2, sprintf("%+.3f %%; the control term has put in %+.2f %%", q["volumeDefectEnd"], q["controlEnd"]))
    if (finding("wallVolumeChange", "volume of the wall: within 0.5 %"))
        verdict(abs(q["wallVolumeChange"]) <= 0.5, sprintf("largest change %+.3f %%", q["wallVolumeChange"]))
    if (finding("pressurePeak", "chamber pressure p/G at full stroke: within 20 % of finite elements"))
        verdict(abs(q["pressurePeak"]/q["pressureReference"] - 1) <= 0.2, \
            sprintf("%.4f against %.3f", q["pressurePeak"], q["pressureReference"]))
    if (finding("throughWall", "no particle goes through a wall"))
        verdict(q["throughWall"] == 0, sprintf("at most %d at once beyond its surface by more than dx/2; the deepest by %.2f dx", \
            q["throughWall"], q["throughWallDeepest"]))
    if (finding("cycleDifference", "second cycle equal to the first: within 2 % of the peak"))
        verdict(q["cycleDifference"] <= 2, sprintf("largest difference of dD/D %.2f %% of the peak", q["cycleDifference"]))
    print "\nThe agreement of dD/D follows from the imposed volume: it does not validate the stiffness; the\npressure does, as far as the assumed modulus goes."
}
