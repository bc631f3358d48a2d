# SPDX-License-Identifier: GPL-3.0-or-later
# Quantities from a velocity map: lines "<instant>.<quantity> value", in mm and mm/s.
# Variables: instant; nozzle [m], height of the nozzle's end; profile, file to write for the diameter line
# `above` [m] over the nozzle.
# Input: diametral.dat with columns x y U_x U_y U_n, y along the axis, rows of constant y.
/^#/ || NF < 5 { next }
{
    if (!($2 in row)) { row[$2] = ++nRows; y[nRows] = $2 }
    j = row[$2]; i = int($1/dxGrid + ($1 < 0 ? -0.5 : 0.5))
    if (i < first) first = i
    if (i > last) last = i
    if ($4 == "NaN") next
    w[i, j] = $4; known[i, j] = 1
    speed = sqrt($3*$3 + $4*$4 + $5*$5)
    if ($2 >= nozzle - 5e-3 && speed > fastest) { fastest = speed; fastestX = $1; fastestY = $2 }
    if ($2 >= nozzle && speed > fastestAbove) fastestAbove = speed
    if ($2 >= nozzle && abs($4) > abs(peak)) { peak = $4; peakY = $2 }
}
function abs(a) { return a < 0 ? -a : a }
function say(name, value) { printf "%s.%s %.6g\n", instant, name, value }
# Mean axial velocity over the bore around the axis in row j, with axisymmetric weights
function boreMean(j,    i, side, flux, area) {
    for (side = -1; side <= 1; side += 2)
        for (i = 0; (side*i, j) in known; ++i) { flux += w[side*i, j]*i; area += i }
    return area ? flux/area : 0
}
# Stream function of the axisymmetric flow, integral of w r dr, at column k of row j
function streamFunction(j, k,    i, side, sum) {
    for (side = -1; side <= 1; side += 2)
        for (i = 0; i <= k; ++i)
            if ((side*i, j) in known) sum += 0.5*w[side*i, j]*i*dxGrid*dxGrid*(i < k ? 1 : 0.5)
    return sum
}
END {
    say("fastest", 1e3*fastest)
    say("fastestX", 1e3*fastestX)
    say("fastestAboveNozzle", 1e3*(fastestY - nozzle))
    say("fastestInChamber", 1e3*fastestAbove)
    say("peak", 1e3*peak)
    say("peakHeight", 1e3*(peakY - nozzle))

    for (j = 1; j <= nRows; ++j) {
        if (y[j] >= nozzle - 4e-3 && y[j] <= nozzle - 1e-3) { mean += boreMean(j); ++nMean }
        if (y[j] < nozzle + 1e-3) continue
        for (k = 1; (k, j) in known || (-k, j) in known; ++k) {
            psi = streamFunction(j, k)
            if (abs(psi) > abs(strongest)) { strongest = psi; ringX = k*dxGrid; ringY = y[j] }
        }
    }
    say("nozzleMean", nMean ? 1e3*mean/nMean : 0)
    say("ringRadius", 1e3*ringX)
    say("ringHeight", 1e3*(ringY - nozzle))

    # The diameter line: velocity towards the dome; peak over mean of its central half
    line = 0
    for (j = 1; j <= nRows; ++j) if (abs(y[j] - nozzle - above) < abs(y[line] - nozzle - above) || !line) line = j
    print "# x [mm], axial velocity [mm/s], " instant > profile
    low = first; while (low < last && !((low, line) in known)) ++low
    high = last; while (high > first && !((high, line) in known)) --high
    for (i = low; i <= high; ++i) if ((i, line) in known) {
        printf "%.4f %.6g\n", 1e3*i*dxGrid, 1e3*w[i, line] > profile
        if (abs(w[i, line]) > top) top = abs(w[i, line])
        if (abs(i) <= 0.25*(high - low)) { sum += abs(w[i, line]); ++n }
    }
    say("lineTop", 1e3*top)
    say("linePeakOverMean", n && sum ? top*n/sum : 0)
}
