// SPDX-License-Identifier: GPL-3.0-or-later
#include "springResponse.H"

#include "fileNames.H"
#include "homogeneousMotion.H"
#include "sampleBodies.H"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace ispf
{

namespace
{

struct request
{
    word lattice;
    List<label> layers;
    List<vector> directions;
    List<word> motions;
    List<scalar> stretches;
    scalar dx;
    int nDims;

    explicit request(const dictionary& dict)
        : lattice(dict.choose("lattice", {"cubic", "square", "triangular"})),
          layers(dict.get<List<label>>("layers")),
          directions(dict.get<List<vector>>("directions")),
          motions(dict.get<List<word>>("motions")),
          stretches(dict.get<List<scalar>>("stretches")),
          dx(dict.getInRangeOrDefault("dx", 1e-12, 1e12, 1e-3, dims::length)),
          nDims(lattice == "cubic" ? 3 : 2)
    {
        for (const label n : layers)
            if (n != 0 && (n < 2 || n > 100))
                dict.fail("layers", "Slabs have 2 to 100 layers, 0 is the endless lattice; not " +
                                        std::to_string(n));
        for (const vector& a : directions)
            if (a.norm() == 0 || (nDims == 2 && a[2] != 0))
                dict.fail("directions",
                          "(" + str(a[0]) + " " + str(a[1]) + " " + str(a[2]) +
                              ") is no direction of a " + lattice + " lattice" +
                              (nDims == 2 ? ", which lies in the plane of x and y" : ""));
        const List<word> valid = homogeneousMotions(nDims);
        for (const word& m : motions)
            if (std::find(valid.begin(), valid.end(), m) == valid.end())
                dict.fail("motions", "Unknown motion '" + m + "' of a " + lattice +
                                         " lattice; valid: " + join(valid, " "));
        for (const scalar lambda : stretches)
            if (!(lambda >= 0.2 && lambda <= 5))
                dict.fail("stretches", "Stretches are from 0.2 to 5, not " + str(lambda));
        dict.checkAllRead();
    }
};

struct body
{
    structureReference ref;
    // One particle of each layer, in the middle; of an endless lattice one alone
    List<char> inside;
};

// A body so wide that the measured particles have the links, and fitted stiffnesses, of an endless one
body bodyOf(const request& r, label layers, const dictionary& properties)
{
    const scalar reach =
        properties.get<word>("links") == "radius" ? properties.get<scalar>("radius") : 1.5;
    const int side = 1 + 2 * int(std::ceil(reach)) * (properties.found("k_e") ? 1 : 3);
    const int n = layers == 0 ? side : int(layers);
    body b{r.lattice == "triangular"
               ? triangularBlock(side + 1, n, r.dx)
               : latticeBlock(side, r.nDims == 3 ? side : n, r.nDims == 3 ? n : 0, r.dx),
           {}};
    vector low = b.ref.x0[0], high = low;
    for (const vector& x : b.ref.x0) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const vector middle = 0.5 * (low + high) / b.ref.dx;
    for (const vector& x : b.ref.x0)
    {
        const vector off = (x / b.ref.dx - middle).cwiseAbs();
        const int last = layers == 0 ? r.nDims : r.nDims - 1;
        b.inside.push_back(off.head(last).maxCoeff() < 0.5);
    }
    return b;
}

word named(const vector& v)
{
    return "(" + str(v[0]) + " " + str(v[1]) + " " + str(v[2]) + ")";
}

word padded(word text, size_t width)
{
    text.resize(std::max(text.size() + 1, width), ' ');
    return text;
}

struct tables
{
    word response = "layers,motion,direction,stretch,stress,neoHooke\n",
         moduli = "layers,motion,direction,modulus,neoHooke\n";
};

void measure(const request& r, label layers, const structureModel& model, const List<char>& inside,
             tables& out)
{
    const scalar G = model.shearModulus(), small = 1e-4;
    for (const word& name : r.motions)
        for (const vector& direction : r.directions)
        {
            const tensor frame = frameAlong(direction);
            const auto at = [&](scalar lambda) { return motionOf(name, frame, r.nDims, lambda); };
            const auto stress = [&](scalar lambda) {
                return nominalStress(model, at(lambda), inside);
            };
            const word row = std::to_string(layers) + "," + name + "," + named(direction) + ",";
            // the slope over the amount of shear, which is about twice the strain
            const scalar amount = (name == "shear" ? 4 : 2) * small;
            const auto slope = [&](scalar up, scalar down) { return (up - down) / amount; };
            const scalar modulus = slope(stress(1 + small), stress(1 - small)),
                         ofG = slope(G * at(1 + small).neoHooke, G * at(1 - small).neoHooke);
            out.moduli += row + str(modulus, 10) + "," + str(ofG, 10) + "\n";
            word line = padded(layers ? std::to_string(layers) + " layers" : "endless", 12) +
                        padded(name, 13) + padded(named(direction), 12) +
                        padded(str(modulus / ofG, 4), 9);
            for (const scalar lambda : r.stretches)
            {
                const scalar found = stress(lambda), known = G * at(lambda).neoHooke;
                out.response +=
                    row + str(lambda, 10) + "," + str(found, 10) + "," + str(known, 10) + "\n";
                line += padded(known == 0 ? "-" : str(found / known, 4), 8);
            }
            info() << line << "\n";
        }
}

}  // namespace

void springResponse(const word& caseFolder, const dictionary& properties, scalar hByDx)
{
    const request r(dictionary::fromFile(caseFolder + "/system/calibrateSpringsDict"));
    info() << "\nNominal stress in homogeneous motions, over that of neo-Hooke with the same G: at "
              "rest and at "
              "these stretches\n\n"
           << padded("lattice", 12) << padded("motion", 13) << padded("direction", 12)
           << padded("at rest", 9);
    for (const scalar lambda : r.stretches) info() << padded(str(lambda, 4), 8);
    info() << "\n";
    tables out;
    for (const label layers : r.layers)
    {
        body b = bodyOf(r, layers, properties);
        b.ref.h = hByDx * b.ref.dx;
        const auto model = structureModel::New(properties, b.ref);
        measure(r, layers, *model, b.inside, out);
        info() << "    " << model->description() << "\n";
    }
    const word folder = caseFolder + "/postProcessing/calibrateSprings/";
    writeText(folder + "response.csv", out.response);
    writeText(folder + "moduli.csv", out.moduli);
    info() << "\nWritten to " << folder << ": response.csv, moduli.csv\n\nEnd\n";
}

}  // namespace ispf
