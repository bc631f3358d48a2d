# SPDX-License-Identifier: GPL-3.0-or-later
# Dimensions of the undeformed wall [mm] from its particles in the diametral slice.  A particle stands
# for a width dx, half of it beyond its centre.
# Variables: dx, cylinder, its length [m].  Input: diametral.slice.dat
function widen(name, r) {
    if (!(name in low) || r < low[name]) low[name] = r
    if (!(name in high) || r > high[name]) high[name] = r
}
function say(name, value) { printf "%s %.4g\n", name, 1e3*value }
/^#/ || $4 != "wall" { next }
{
    r = sqrt($1*$1 + $3*$3)
    if ($2 > 0.25*cylinder && $2 < 0.75*cylinder) widen("cylinderPart", r)
    if ($2 > cylinder - 1.5*dx && $2 < cylinder + 1.5*dx) widen("junction", r)
    if (r < 1.5*dx) widen("tip", $2)
    if ($2 > cylinder) widen("dome", sqrt(r*r + ($2 - cylinder)^2))
}
END {
    if (!("cylinderPart" in low)) exit
    say("innerDiameter", 2*(low["cylinderPart"] - dx/2))
    say("wallCylinder", high["cylinderPart"] - low["cylinderPart"] + dx)
    say("domeInnerDiameter", 2*(low["dome"] - dx/2))
    say("wallJunction", high["junction"] - low["junction"] + dx)
    say("wallTip", high["tip"] - low["tip"] + dx)
}
