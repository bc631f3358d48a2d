// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the stiffness of constant/structureProperties: tension of slabs and cubes along several
// directions, on a lattice and on disordered particles, and of the case's own body.
//
// Each body is free and incompressible and carries a uniaxial stress (uniformStressTest).  Mean stress s and
// median strain e of its middle give E = s/e (in 2D the modulus of plane strain tension, 4 G).  The output is E over
// the modulus of the links.  With an entry E or G every body is judged, 5 % allowed.  With k_e none is: then
// the printed modulus is the one to quote.  For -response see springResponse.H
#include "argList.H"
#include "cloudIO.H"
#include "fileNames.H"
#include "particleTable.H"
#include "sampleBodies.H"
#include "springResponse.H"
#include "uniformStressTest.H"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <sstream>

namespace
{

using namespace ispf;

constexpr scalar least = 0.95, most = 1.05;  // range that counts as calibrated

struct direction
{
    word name;
    vector axis;
};

List<direction> inPlane()
{
    List<direction> directions;
    for (const scalar degrees : {0.0, 22.5, 45.0})
    {
        const scalar angle = degrees * M_PI / 180;
        directions.push_back({str(degrees) + " deg", vector(std::cos(angle), std::sin(angle), 0)});
    }
    return directions;
}

List<direction> crystal()
{
    return {{"[100]", vector(1, 0, 0)},
            {"[110]", vector(1, 1, 0).normalized()},
            {"[111]", vector(1, 1, 1).normalized()}};
}

struct sample
{
    word name;
    structureReference body;
    List<direction> directions;
    scalar margin = 0;           // particles nearer to the edges of the box are not measured, in dx
    bool alsoThickness = false;  // the margin also applies in the last direction
};

List<char> measuredPart(const sample& s)
{
    vector low = s.body.x0[0], high = low;
    for (const vector& x : s.body.x0) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const int nDims = s.alsoThickness ? s.body.nDims : s.body.nDims - 1;
    List<char> inside;
    for (const vector& x : s.body.x0)
    {
        const vector depth = (x - low).cwiseMin(high - x) / s.body.dx;
        inside.push_back(s.margin == 0 || depth.head(nDims).minCoeff() > s.margin);
    }
    return inside;
}

List<sample> blocks(int nDims, const List<int>& layers, bool disordered)
{
    const word kind = disordered ? "disordered " : "lattice ";
    const auto make = disordered ? [](int x, int y, int z) { return disorderedBlock(x, y, z); }
                                 : [](int x, int y, int z) { return latticeBlock(x, y, z); };
    List<sample> samples;
    for (const int n : layers)
    {
        const word name =
            kind + (nDims == 3 ? "slab, " : "strip, ") + std::to_string(n) + " layers";
        if (nDims == 3) samples.push_back({name, make(16, 16, n), inPlane(), 4, false});
        else samples.push_back({name, make(40, n, 0), {{"along", vector::UnitX()}}, 6, false});
    }
    if (nDims == 3)
        // in a smaller cube the core would show the uneven load of the end faces along their edges
        samples.push_back({kind + "cube, 16 layers", make(16, 16, 16), crystal(), 5, true});
    else samples.push_back({kind + "square, 24 layers", make(24, 24, 0), inPlane(), 5, true});
    return samples;
}

// The solid of <case>/0/particles.hdf at rest, without walls and symmetry planes
structureReference caseBody(const word& file)
{
    const particleTable table = readParticles(file);
    structureReference ref =
        emptyReference(int(table.scalarAttribute("nDims")), table.scalarAttribute("dx"));
    const List<zoneInfo> zones = zonesOf(table, file);
    const auto zone = table.integers.find("zone");
    if (zone == table.integers.end()) throw fatalError(file + " has no field 'zone'");
    const auto rest = table.vectors.find("x0");
    for (size_t i = 0; i < table.size(); ++i)
        if (zones.at(size_t(zone->second[i])).phase == phaseType::solid)
            ref.x0.push_back(rest == table.vectors.end() ? table.x[i] : rest->second[i]);
    ref.fixed.assign(ref.x0.size(), 0);
    return ref;
}

word padded(word text, size_t width)
{
    if (text.size() < width) text.insert(text.size(), width - text.size(), ' ');
    return text;
}

struct range
{
    scalar low = 1e30, high = 0;
};

void measure(const dictionary& properties, const sample& s, range& found)
{
    const auto model = structureModel::New(properties, s.body);
    const List<char> inside = measuredPart(s);
    word line = padded(s.name, 28) + padded(std::to_string(s.body.n()), 10);
    for (const direction& d : s.directions)
    {
        const scalar ratio = modulusRatio(*model, d.axis, inside);
        found.low = std::min(found.low, ratio), found.high = std::max(found.high, ratio);
        line += padded(d.name + " " + str(ratio, 3), 16);
    }
    info() << line << "\n    " << model->description() << "\n";
}

List<int> layersAsked(const argList& args)
{
    List<int> layers;
    std::istringstream stream(args.optionOr("layers", "3 4 5 8"));
    for (int n; stream >> n;) layers.push_back(n);
    const auto possible = [](int n) { return n >= 2 && n <= 100; };
    if (!stream.eof() || layers.empty() || !std::all_of(layers.begin(), layers.end(), possible))
        throw fatalError(
            "Option -layers needs numbers from 2 to 100 in quotes, e.g. -layers \"3 5\"");
    return layers;
}

int run(int argc, char** argv)
{
    argList args(
        "calibrateSprings",
        "Measures the stiffness of the links of constant/structureProperties on slabs, "
        "cubes and the case's body. Where these ask for a modulus by E or G, each measured "
        "one must be within 5 % of it, else the exit status is 1; with k_e none is judged.");
    args.addOption("layers", "list", "thickness of the slabs in particles (default \"3 4 5 8\")");
    args.addSwitch("bodyOnly", "only the case's own body");
    args.addSwitch(
        "response",
        "instead, stresses in the large homogeneous motions of system/calibrateSpringsDict");
    if (!args.parse(argc, argv)) return 0;
    args.printHeader();

    dictionary properties =
        dictionary::fromFile(args.caseFolder() + "/constant/structureProperties");
    const dictionary schemes =
        dictionary::fromFileIfPresent(args.caseFolder() + "/system/sphSchemes");
    const scalar hByDx = schemes.getInRangeOrDefault("hByDx", 0.5, 4, 1.3);
    if (args.found("response"))
    {
        springResponse(args.caseFolder(), properties, hByDx);
        return 0;
    }
    if (properties.found("links") && properties.found("fibres"))
    {
        info() << "\nE is the modulus of the links without the weights of their fibres: these are "
                  "measured\n";
        for (const word key : {"fibres", "fibreWeight", "fibrePower"}) properties.remove(key);
    }
    const word file = args.caseFolder() + "/0/particles.hdf";
    const bool hasBody = std::filesystem::exists(file);
    if (args.found("bodyOnly") && !hasBody)
        throw fatalError("There is no " + file +
                         ": run generateParticles first, or leave -bodyOnly out");

    List<sample> samples;
    int nDims = 3;
    if (hasBody)
    {
        const structureReference body = caseBody(file);
        nDims = body.nDims;
        if (body.n() > 0)
            samples.push_back(
                {"the case's body",
                 body,
                 {{"x", vector::UnitX()}, {"y", vector::UnitY()}, {"z", vector::UnitZ()}}});
        if (nDims == 2 && body.n() > 0) samples[0].directions.pop_back();
    }
    if (!args.found("bodyOnly"))
        for (const bool disordered : {false, true})
            if (!disordered || !properties.found("links") ||
                properties.get<word>("links") == "radius")
                for (const sample& s : blocks(nDims, layersAsked(args), disordered))
                    samples.push_back(s);

    info() << "\nE measured/E named, tension of the free body along each direction\n\n"
           << padded("body", 28) << padded("particles", 10) << "\n";
    range found;
    for (sample& s : samples)
    {
        s.body.h = hByDx * s.body.dx;
        measure(properties, s, found);
    }
    info() << "\nfrom " << str(found.low, 3) << " to " << str(found.high, 3) << ": ";
    if (properties.found("k_e"))
    {
        info() << "not judged, k_e asks for no modulus\n\nEnd\n";
        return 0;
    }
    const bool calibrated = found.low >= least && found.high <= most;
    info() << (calibrated ? "within " : "NOT within ") << least << " to " << most << "\n\nEnd\n";
    return calibrated ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv)
{
    return ispf::runMain([&] { return run(argc, argv); });
}
