# SPDX-License-Identifier: GPL-3.0-or-later
# The table "published | ours | difference", and the volume ledger.
# Input: quantities.csv (quantity,value) and published.csv
BEGIN {
    FS = ","
    form = "%-34s %10s  %-7s %12s  %s\n"
    rule = "----------------------------------------------------------------------------------------"
}
FNR == NR { ours[$1] = $2; next }
/^#/ || NF < 6 { next }
$5 == "measuring" { ++measuring; next }
{ kind = $5; line[kind, ++n[kind]] = $0 }
function number(v) { return v + 0 == v ? sprintf("%.6g", v) : v }
function difference(published, value) {
    if (published + 0 == 0) return sprintf("%+.3g", value - published)
    return sprintf("%+.1f %%", 100*(value - published)/(published < 0 ? -published : published))
}
function row(name, f, key) {
    if (!(key in ours)) printf form, name, number(f[2]), f[3], "-", "not in this run"
    else printf form, name, number(f[2]), f[3], number(ours[key]), difference(f[2], ours[key])
}
# "TDC.peak" represents the instant at which dead centres are judged, and the others of the rest
function rows(f,    k, n, part, key, at) {
    if (f[6] !~ /^[TB]DC\./) { row(f[1], f, f[6]); return }
    at = ours["deadCentreInstant"]
    row(f[1], f, substr(f[6], 1, 3) at substr(f[6], 4))
    n = split("+0.00 +0.20 +0.57 +1.15", part, " ")
    for (k = 1; k <= n; ++k) {
        key = substr(f[6], 1, 3) part[k] substr(f[6], 4)
        if (part[k] != at && key in ours) row("    instead at stop " part[k] " s", f, key)
    }
}
function section(kind, heading,    k, f) {
    printf "\n" form rule "\n", heading, "published", "", "ours", "difference"
    for (k = 1; k <= n[kind]; ++k) {
        split(line[kind, k], f, ",")
        if (f[6] == "-") printf form, f[1], number(f[2]), f[3], "-", "not comparable: see README.md"
        else rows(f)
    }
}
function share(name) { return name in ours ? sprintf("%+.3f", ours[name]) : "-" }
function ledgerRow(name, quantity) {
    printf "%-50s %13s  %13s\n", name, share("peak." quantity), share("end." quantity)
}
function ledger() {
    if (!("peak.swept" in ours)) return
    printf "\n%-50s %13s  %13s\n%s\n", "VOLUME LEDGER [% of the stroke], since the start", "full stroke", "after a cycle", rule
    ledgerRow("pushed in by the plunger", "swept")
    ledgerRow("gained by the cavity", "cavity")
    ledgerRow("entered through open faces, whole particles", "openNet")
    ledgerRow("gained by the solid", "wall")
    ledgerRow("injected by the control term", "control")
    ledgerRow("injected by the wall's volume feedback", "wallFeedback")
    ledgerRow("made good of the divergence's defect", "defect")
    ledgerRow("made good of the wall's, as it turns", "wallDefect")
    ledgerRow("put into fluid that open faces drain", "fluidFeedback")
    printf "%-50s %13s  %13s\n", "cavity - plunger", share("volumeDefectPeak"), share("volumeDefectEnd")
    printf "%-50s %13s  %13s\n", "cavity - plunger - control: left to itself", share("own.volumeDefectPeak"), share("own.volumeDefectEnd")
}
END {
    print "Hemisphere-capped cylinder, " ours["run"]
    if (ours["reached"] < ours["endTime"] - 1e-3)
        printf "THE RUN HAS REACHED %g s OF %g s ONLY\n", ours["reached"], ours["endTime"]
    section("result", "RESULTS")
    print "Dead centres: at stop " ours["deadCentreInstant"] " s" \
        (ours["deadCentreInstant"] + 0 == 0 ? "." : ", the middle of the rest.")
    ledger()
    section("input", "INPUT, as the run had it")
    printf "\n%d more published numbers describe the measurement only.\n", measuring
}
