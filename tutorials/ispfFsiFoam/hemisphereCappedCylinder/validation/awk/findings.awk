# SPDX-License-Identifier: GPL-3.0-or-later
# Findings of the paper, and whether this run shows them; conditions that a trustworthy run must keep.
# All findings at a dead centre are judged at one instant of its rest, deadCentreInstant.
# Input: quantities.csv
BEGIN { FS = ","; nParts = split("+0.00 +0.20 +0.57 +1.15", part, " ") }
{ q[$1] = $2 }
function has(names,    k, n, name) {
    n = split(names, name, " ")
    for (k = 1; k <= n; ++k) if (!(name[k] in q)) return 0
    return 1
}
function abs(a) { return a < 0 ? -a : a }
function say(verdict, detail) { printf "  [%4s]  %s\n          %s\n", verdict, text, detail }
function finding(needed, statement) {
    text = statement
    if (has(needed)) return 1
    say("?", "not reached by this run")
    return 0
}
function verdict(yes, detail) { say(yes ? "yes" : "no", detail) }
function two(v,    s) { s = sprintf("%.2f", v); return s == "-0.00" ? "0.00" : s }
function percent(v,    s) { s = sprintf("%+.3f %%", v); return s == "-0.000 %" ? "+0.000 %" : s }
function judged(centre, name) { return centre q["deadCentreInstant"] "." name }
# "6.50 mm (stop +0.00 s: 1.00, ...)": the judged value and those of the other instants of the rest, with a star
# if they are as near to the wanted value as required
function dwell(centre, name, unit, wanted, within,    k, key, list) {
    for (k = 1; k <= nParts; ++k) {
        key = centre part[k] "." name
        if (key in q && part[k] != q["deadCentreInstant"])
            list = list (list == "" ? " (stop " : ", ") part[k] " s: " two(q[key]) \
                (abs(q[key] - wanted) <= within ? "*" : "")
    }
    return two(q[judged(centre, name)]) " " unit (list == "" ? "" : list ")")
}
function near(centre, name, wanted, within) { return abs(q[judged(centre, name)] - wanted) <= within }
# A controlled value proves nothing: the value without control is judged
function kept(name, within, injected, note) {
    verdict(abs(q["own." name]) <= within, (injected == 0 ? percent(q[name]) ", nothing controlled" : \
        "left to itself " percent(q["own." name]) "; with control " percent(q[name]) ", which has put in " percent(injected)) note)
}
function madeGood(what, value) { return "\n          " what ", made good by the scheme: " percent(value) }
END {
    print "\nTHE PAPER'S FINDINGS"
    print "Dead centres are judged at stop " q["deadCentreInstant"] " s" \
        (q["deadCentreInstant"] + 0 == 0 ? ", as the plunger does not rest" : ", the middle of the rest; a star: would do as well")
    if (finding(judged("TDC", "ringHeight"), "TDC: vortex ring centred 6 mm above the nozzle, within 1 mm"))
        verdict(near("TDC", "ringHeight", 6, 1), "height " dwell("TDC", "ringHeight", "mm", 6, 1))
    if (finding(judged("TDC", "peak"), "TDC: peak of 1.5 mm/s (within 20 %) towards the dome, nozzle mean nearly zero"))
        verdict(near("TDC", "peak", 1.5, 0.3) && near("TDC", "nozzleMean", 0, 0.15), \
            "peak " dwell("TDC", "peak", "mm/s", 1.5, 0.3) \
            "\n          nozzle mean " dwell("TDC", "nozzleMean", "mm/s", 0, 0.15))
    if (finding(judged("BDC", "fastestAboveNozzle"), "BDC: the largest velocity is at the nozzle exit, within 2 mm"))
        verdict(near("BDC", "fastestAboveNozzle", 0, 2), \
            "its height above the exit " dwell("BDC", "fastestAboveNozzle", "mm", 0, 2))
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
        kept("volumeDefectPeak", 1, q["peak.control"], madeGood("flux that the divergence misses", q["peak.defect"]))
    if (finding("volumeDefectEnd", "cavity against plunger volume: within 0.2 % of the stroke after the cycle"))
        kept("volumeDefectEnd", 0.2, q["end.control"], madeGood("flux that the divergence misses", q["end.defect"]))
    if (finding("wallVolumeChange", "volume of the wall: within 0.5 % at any time"))
        kept("wallVolumeChange", 0.5, q["wallFeedback"], madeGood("growth as it turns", q["wallDefect"]))
    if (finding("pressurePeak", "chamber pressure p/G at full stroke: within " 100*q["pressureTolerance"] " % of finite elements"))
        verdict(abs(q["pressurePeak"]/q["pressureReference"] - 1) <= q["pressureTolerance"], \
            sprintf("%.4f against %.3f", q["pressurePeak"], q["pressureReference"]))
    if (finding("throughWall", "no particle goes through the elastic wall or its flange, from inside or outside"))
        verdict(q["throughWall"] == 0, beyond("throughWall"))
    if (finding("throughRigid", "no particle goes through syringe, nozzle and base plate"))
        say(q["throughRigid"] > 0 ? "no" : q["putBack"] > 0 ? "held" : "yes", beyond("throughRigid") \
            (q["putBack"] > 0 ? "\n          a guard keeps it so: it has put particles back " q["putBack"] " times" : ""))
    if (finding("cycleDifference", (q["cycles"] > 2 ? "cycles 1 to " q["cycles"] " equal to each other" : \
                                    "second cycle equal to the first") ": within 2 % of the peak"))
        verdict(q["cycleDifference"] <= 2, sprintf("largest difference of dD/D %.2f %% of the peak", q["cycleDifference"]))
    print "\nThe agreement of dD/D follows from the imposed volume: it does not validate the stiffness; the\npressure does, as far as the assumed modulus goes."
}
function beyond(name) {
    return sprintf("at most %d at once beyond its surface by more than dx/2; the deepest by %.2f dx", \
        q[name], q[name "Deepest"])
}
