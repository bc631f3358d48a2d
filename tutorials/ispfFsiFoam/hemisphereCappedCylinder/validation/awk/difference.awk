# SPDX-License-Identifier: GPL-3.0-or-later
# Mean absolute relative error [%] of the second profile with respect to the first over the central half
# of the first, as the paper measures it.  Variable: name
/^#/ { next }
FNR == NR { reference[$1] = $2; if ($1 > most) most = $1; next }
$1 in reference && $1 >= -most/2 && $1 <= most/2 && reference[$1] != 0 {
    e = ($2 - reference[$1])/reference[$1]
    sum += e < 0 ? -e : e
    ++n
}
END { if (n) { sub(/^profile-/, "", name); printf "%s.difference %.4g\n", name, 100*sum/n } }
