// SPDX-License-Identifier: GPL-3.0-or-later
// From E, G or k_e to the stiffness of every link.
#include "springLinks.H"
#include "springModuli.H"
#include "parallel.H"

#include <algorithm>

namespace ispf
{

namespace
{

word modulusKey(const dictionary& dict)
{
    List<word> given;
    for (const word key : {"E", "G", "k_e"})
        if (dict.found(key)) given.push_back(key);
    if (given.size() == 1) return given[0];
    const word what = given.empty() ? "none is there" : "given are " + join(given, ", ");
    throw fatalError(
        "springNetwork needs exactly one of E (Young's modulus, Pa), G (shear modulus, Pa) "
        "and k_e (spring constant over the smoothing length, Pa); " +
            what,
        {dict.path(), dict.scope(), 0});
}

// Particles with all their neighbours: at least 95 % of the most that any has
List<label> interior(const referenceNeighbours& pairs)
{
    label most = 0;
    for (label i = 0; i < pairs.n(); ++i) most = std::max(most, pairs.count(i));
    List<label> inside;
    for (label i = 0; i < pairs.n(); ++i)
        if (pairs.count(i) >= 0.95 * most) inside.push_back(i);
    return inside;
}

}  // namespace

void springLinks::setStiffness(const dictionary& dict, const structureReference& ref)
{
    const word key = modulusKey(dict);
    const scalar value = dict.getInRange(key, 1e-12, 1e15);
    if (rule == "lattice8")
        for (size_t p = 0; p < k.size(); ++p) k[p] = d0[p] < 1.2 * ref.dx ? 1 : 0.5;

    // moduli of unit springs inside, then the scale
    modulusTensor C = modulusTensor::Zero();
    const List<label> inside = interior(pairs);
    for (const label i : inside) C += particleModulus(ref, pairs, k, i) / scalar(inside.size());
    anisotropy = shearAnisotropy(C, ref.nDims);
    if (!(anisotropy < 20))
        dict.fail("links",
                  "these links resist no shear in some direction (largest over smallest shear "
                  "modulus " +
                      str(anisotropy) +
                      "). Take a larger radius: 1.5 on a lattice, "
                      "2.6 on relaxed particles");
    if (anisotropy > 1.15)
        warning("springNetwork: these links are anisotropic, the largest shear modulus is " +
                str(anisotropy, 3) +
                " times the smallest (Zener's ratio on a lattice). Isotropic are "
                "lattice18, lattice8 and, nearly, radius 2.6");
    const scalar unit = isotropicShear(C, ref.nDims);
    G = key == "k_e" ? value * ref.h * unit : key == "E" ? value / 3 : value;
    const scalar scale = G / unit;
    for (scalar& s : k) s *= scale;
}

}  // namespace ispf
