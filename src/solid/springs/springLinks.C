// SPDX-License-Identifier: GPL-3.0-or-later
#include "springLinks.H"
#include "fibreWeights.H"
#include "forPairs.H"
#include "springModuli.H"
#include "stiffnessFit.H"

#include <algorithm>

namespace ispf
{

namespace
{

// Allows for rounding and for a lattice known to few digits; the next shell is 20 % away
constexpr scalar latticeTolerance = 0.02;

scalar linkRadius(const dictionary& dict, const structureReference& ref)
{
    const word links = dict.choose("links", {"lattice8", "lattice18", "radius"});
    // includes a shell of lattice neighbours at exactly the radius
    if (links == "radius") return dict.getInRange("radius", 0.5, 10) * ref.dx * (1 + 1e-6);
    const int dims = links == "lattice8" ? 2 : 3;
    if (dims != ref.nDims)
        dict.fail("links", links + " is for " + std::to_string(dims) +
                               " dimensions, the case has " + std::to_string(ref.nDims) + ". Use " +
                               (ref.nDims == 2 ? "lattice8" : "lattice18") + " or radius");
    return std::sqrt(2.0) * ref.dx * (1 + latticeTolerance);
}

word modulusKey(const dictionary& dict)
{
    List<word> given;
    for (const word key : {"E", "G", "k_e"})
        if (dict.found(key)) given.push_back(key);
    if (given.size() == 1) return given[0];
    throw fatalError(
        "A spring network needs exactly one of E (Young's modulus, Pa), G (shear modulus, "
        "Pa) and k_e (spring constant over the smoothing length, Pa); " +
            (given.empty() ? "none is given" : "given are " + join(given, " and ")),
        {dict.path(), dict.scope(), 0});
}

// Mean over the particles with all their neighbours: at least 95 % of the largest number
modulusTensor fullestModulus(const structureReference& ref, const referenceNeighbours& pairs,
                             const List<scalar>& k)
{
    label most = 0, n = 0;
    for (label i = 0; i < pairs.n(); ++i) most = std::max(most, pairs.count(i));
    modulusTensor C = modulusTensor::Zero();
    for (label i = 0; i < pairs.n(); ++i)
        if (pairs.count(i) >= 0.95 * most) C += particleModulus(ref, pairs, k, i), ++n;
    return C / n;
}

}  // namespace

springLinks::springLinks(const dictionary& dict, const structureReference& ref)
    : rule(dict.choose("links", {"lattice8", "lattice18", "radius"})),
      pairs(ref, linkRadius(dict, ref))
{
    const word key = modulusKey(dict);
    d0.resize(size_t(pairs.nPairs())), k.assign(d0.size(), 1);
    forPairs<among::all>(pairs, 0, ref.n(), [&](label i, pairIndex p, label) {
        d0[p] = pairs.separation(ref, i, p).norm();
    });
    if (rule != "radius") checkLattice(dict, ref);
    if (rule == "lattice8")
        for (size_t p = 0; p < k.size(); ++p) k[p] = d0[p] < 1.2 * ref.dx ? 1 : 0.5;

    anisotropy = shearAnisotropy(fullestModulus(ref, pairs, k), ref.nDims);
    if (!(anisotropy < 20))
        dict.fail("links",
                  "these links hardly resist shear in some direction (largest over smallest "
                  "shear modulus " +
                      str(anisotropy, 3) +
                      "). Take lattice18 or lattice8 on a "
                      "lattice, radius 2.1 on relaxed particles");
    if (key == "k_e") setEqual(dict, ref);
    else setFitted(dict, ref);
    summary = "links " + rule + ", " + str(scalar(pairs.nPairs()) / ref.n(), 3) +
              " per particle, G " + str(G, 4) + " Pa, E = 3 G " + str(3 * G, 4) + " Pa, " + summary;
    if (const word weights = weighAlongFibres(dict, ref, pairs, k); !weights.empty())
        summary += ", " + weights;
}

void springLinks::checkLattice(const dictionary& dict, const structureReference& ref) const
{
    for (label i = 0; i < ref.n(); ++i)
        forNeighbours<among::all>(pairs, i, [&](pairIndex p, label j) {
            const scalar d = d0[p] / ref.dx;
            if (std::abs(d - 1) < latticeTolerance ||
                std::abs(d - std::sqrt(2.0)) < std::sqrt(2.0) * latticeTolerance)
                return;
            dict.fail("links", "solid particles " + std::to_string(i) + " and " +
                                   std::to_string(j) + " are " + str(d) +
                                   " dx apart, which no lattice has. On relaxed particles use "
                                   "'links radius; radius 2.1;'");
        });
}

void springLinks::setEqual(const dictionary& dict, const structureReference& ref)
{
    const scalar stiffness = dict.getInRange("k_e", 1e-12, 1e15, dims::pressure) * ref.h;
    for (scalar& s : k) s *= stiffness;
    G = isotropicShear(fullestModulus(ref, pairs, k), ref.nDims);
    summary = "equal stiffness " + str(stiffness, 4) + " N/m";
    if (anisotropy > 1.15)
        warning(
            "springNetwork: equal links of this radius are anisotropic, the largest shear modulus "
            "is " +
            str(anisotropy, 3) +
            " times the smallest (Zener's ratio on a lattice). lattice18 and "
            "lattice8 are isotropic, radius 2.6 nearly; with E or G the stiffnesses are fitted");
}

void springLinks::setFitted(const dictionary& dict, const structureReference& ref)
{
    G = dict.found("E") ? dict.getInRange("E", 1e-12, 1e15, dims::pressure) / 3
                        : dict.getInRange("G", 1e-12, 1e15, dims::pressure);
    if (rule == "radius")  // weights end smoothly at the radius: half the scatter of a sharp end
    {
        const scalar reach = dict.get<scalar>("radius") * ref.dx;
        for (size_t p = 0; p < k.size(); ++p)
            k[p] = std::pow(1 - 0.95 * std::pow(std::min(1.0, d0[p] / reach), 2), 2);
    }
    const stiffnessFitReport report = fitStiffness(ref, pairs, G, k);
    modulusTensor C = modulusTensor::Zero();
    for (label i = 0; i < ref.n(); ++i) C += particleModulus(ref, pairs, k, i) / ref.n();
    anisotropy = shearAnisotropy(C, ref.nDims);
    const scalar reached = isotropicShear(C, ref.nDims) / G;
    summary = "stiffness fitted by factors " + str(report.least, 2) + " to " + str(report.most, 3) +
              ", mean modulus " + str(reached, 4) + " of it, anisotropy " + str(anisotropy, 3);
    if (std::abs(reached - 1) > 0.12 || anisotropy > 1.3)
        warning(
            "springNetwork: these links do not give the modulus asked for everywhere: " + summary +
            ". Take radius 2.1 to 2.6, and if it is, more layers: shorter links are too few, "
            "longer ones end at the surfaces");
}

}  // namespace ispf
