// SPDX-License-Identifier: GPL-3.0-or-later
#include "bodySurface.H"

#include "facetCrossings.H"
#include "featureSize.H"
#include "shapes.H"
#include "surfaceCapping.H"
#include "surfaceRepair.H"
#include "surfaceTopology.H"
#include "zoneGeometry.H"
#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar mostAcross = 1e7, mostParticles = 5e8, fewestParticles = 5;

word inSpacings(scalar length, scalar dx)
{
    return str(length, 3) + " m = " + str(length / dx, 3) + " dx";
}

class bodyCheck
{
public:
    bodyCheck(triSurface& s, const word& zone, const bodySurfaceSettings& settings)
        : s_(s), settings_(settings), dx_(settings.dx), flat_(settings.nDims == 2)
    {
        name_ =
            "The surface of zone " + zone + ", " + settings.file + " (" + settings.origin + "),";
        info() << "Zone " << zone << ": " << settings.file << " (" << settings.origin << "), "
               << s.size() << " facets" << std::endl;
    }

    List<word> run()
    {
        if (s_.empty()) throw fatalError(name_ + " has no facet");
        checkExtent();
        const repairReport repaired = repair(s_, {settings_.weld, settings_.closeHoles});
        if (const word done = repaired.describe(); !done.empty())
            info() << "    repaired    " << done << std::endl;
        const List<word> caps = cap();
        checkClosed();
        checkCrossings();
        checkScale();
        if (!settings_.zone->found("thickness"))
            reportFeatures();  // else that of the lumen's zone tells
        return caps;
    }

private:
    void line(const char* what, const word& text) const
    {
        info() << "    " << what << word(12 - std::min<size_t>(11, word(what).size()), ' ') << text
               << std::endl;
    }

    void checkExtent() const
    {
        const boundBox box = s_.bounds();
        const vector size = box.max - box.min;
        line("box", place(box.min, tiny_) + " to " + place(box.max, tiny_) +
                        " m: " + str(size[0] / dx_, 3) + " x " + str(size[1] / dx_, 3) + " x " +
                        str(size[2] / dx_, 3) + " dx");
        if (!(size.maxCoeff() < mostAcross * dx_))
            throw fatalError(name_ + " measures " + inSpacings(size.maxCoeff(), dx_) +
                             " across. Are dx and the unit right?");
    }

    List<word> cap()
    {
        const dictionary& zone = *settings_.zone;
        const bool asked = zone.found("capping");
        if (!asked && !(zone.found("thickness") && !flat_ && !boundaryLoops(s_).empty())) return {};
        if (flat_) zone.fail("capping", "Bodies in two dimensions have no ends to cap");
        List<capRequest> requests;
        scalar tolerance = 0.5 * dx_;
        if (zone.isDict("capping"))
        {
            const dictionary& caps = zone.subDict("capping");
            tolerance = caps.getInRangeOrDefault("tolerance", 0, 1e3 * dx_, tolerance);
            for (const word& name : caps.dictKeys())
                requests.push_back({name, caps.subDict(name).get<vector>("near")});
            if (requests.empty())
                zone.fail("capping",
                          "Name the caps, each with a point near its end, as in 'inlet { "
                          "near (0 0 0); }', or say 'capping automatic;'");
        }
        else if (asked) zone.choose("capping", {"automatic"});
        List<word> names;
        for (const auto& [name, loop] : capEnds(s_, requests, tolerance, dx_))
        {
            names.push_back(name);
            line("capped", name + " " + loop.describe(dx_) + ", normal " +
                               place(loop.normal(), 1e-6) +
                               (loop.offPlane > settings_.weld
                                    ? ", rim moved by up to " + inSpacings(loop.offPlane, dx_)
                                    : word()));
        }
        orientOutward(s_);
        return names;
    }

    void checkClosed() const
    {
        const closednessReport report = ispf::checkClosed(s_);
        if (report.closed()) return;
        const List<boundaryLoop> holes = boundaryLoops(s_);
        word text = name_ + " is not closed: " + report.describe() + ".";
        for (size_t k = 0; k < holes.size() && k < 10; ++k)
            text += "\n    hole " + holes[k].describe(dx_);
        if (holes.size() > 10) text += "\n    and " + std::to_string(holes.size() - 10) + " more";
        throw fatalError(
            text +
            "\nClose it in the CAD program. Or raise weldTolerance if faces only fail to meet "
            "exactly, closeHoles if these holes are not meant, or ask for 'capping' if "
            "they are the open ends of a vessel");
    }

    scalar particles() const
    {
        const boundBox box = s_.bounds();
        const scalar measure = flat_ ? s_.volume() / (box.max[2] - box.min[2]) : s_.volume();
        return measure / std::pow(dx_, settings_.nDims);
    }

    // The size in other units, for messages
    word otherUnits(scalar n) const
    {
        word text;
        for (const auto& [name, factor] :
             {std::pair{"a thousand times as large", 1e3}, {"a thousandth as large", 1e-3}})
            if (const scalar other = n * std::pow(factor, settings_.nDims);
                other > 100 && other < 1e8)
                text += word(" Were it ") + name +
                        ", as where m are taken for mm or mm for m, it " + "would hold about " +
                        str(other, 3) + ".";
        return text;
    }

    void checkScale() const
    {
        const scalar n = particles(), volume = s_.volume();
        line("volume", flat_ ? str(volume / (s_.bounds().max[2] - s_.bounds().min[2])) +
                                   " m2, about " + str(std::round(n)) + " particles"
                             : str(volume) + " m3, about " + str(std::round(n)) + " particles");
        const word has =
            name_ + " has room for " + str(n, 3) + " particles of spacing dx = " + str(dx_) + " m";
        if (n < fewestParticles)
            throw fatalError(has +
                             ": it could not hold a particle. Are dx and the unit "
                             "of the file right?" +
                             otherUnits(n));
        line("surface", "closed, normals outwards, area " + str(s_.area()) + " m2, " +
                            std::to_string(nParts()) + " part(s)");
        if (n > mostParticles)
            throw fatalError(has + ", but a case can hold " + str(mostParticles) +
                             ". Are dx and the unit of the file right?" + otherUnits(n));
    }

    label nParts() const
    {
        const List<label> part = connectedComponents(s_);
        return 1 + *std::max_element(part.begin(), part.end());
    }

    void checkCrossings() const
    {
        const word advice = ". Unite the parts in the CAD program, or give each a zone of its own";
        const scalar depth = std::max(settings_.weld, 1e-6 * dx_);
        const auto crossings = facetCrossings(surfaceSearch(s_), depth, 100);
        if (!crossings.empty())
            throw fatalError(name_ + " passes through itself: two facets cross at " +
                             place(crossings[0].at) + " m" +
                             (crossings.size() > 1
                                  ? ", and " + std::to_string(crossings.size() - 1) +
                                        (crossings.size() == 100 ? " or more" : "") + " other pairs"
                                  : word()) +
                             advice);
        if (const label t = facetWithin(s_, depth); t >= 0)
            throw fatalError(name_ + " has parts within one another: the facet at " +
                             place(s_.centre(t)) + " m lies in another part" + advice);
    }

    void reportFeatures() const
    {
        const featureSizes sizes = smallestFeatures(s_, dx_, flat_);
        const auto say = [&](const char* what, const featureSize& f) {
            if (f.found()) line(what, inSpacings(f.size, dx_) + " at " + place(f.at, tiny_));
        };
        say("thinnest", sizes.thickness);
        say("gap", sizes.gap);
        const featureSize radius = smallestRadius(s_, dx_, flat_);
        if (radius.found())
            line("rounding",
                 "radius " + inSpacings(radius.size, dx_) + " at " + place(radius.at, tiny_));
        if (radius.size < 2 * dx_)
            warning(name_ + " is rounded with a radius of " + inSpacings(radius.size, dx_) +
                    " at " + place(radius.at, tiny_) +
                    ": particles follow no curve tighter than two spacings");
        if (sizes.thickness.size < 2 * dx_)
            warning(name_ + " encloses " + inSpacings(sizes.thickness.size, dx_) + " at " +
                    place(sizes.thickness.at, tiny_) +
                    ", its thinnest place: fewer than two particles across resolve nothing there");
        if (sizes.gap.size < dx_)
            warning(name_ + " leaves a gap of " + inSpacings(sizes.gap.size, dx_) + " at " +
                    place(sizes.gap.at, tiny_) +
                    ": particles on both sides will feel each other across it");
    }

    triSurface& s_;
    const bodySurfaceSettings& settings_;
    scalar dx_, tiny_ = 1e-6 * dx_;  // tiny: a coordinate that is told as 0
    bool flat_;
    word name_;
};

}  // namespace

List<word> prepareBodySurface(triSurface& surface, const word& zone,
                              const bodySurfaceSettings& settings)
{
    return bodyCheck(surface, zone, settings).run();
}

void stretchToPrism(triSurface& surface, const word& file, scalar dx)
{
    // a facet stands for the part of the outline below or above it, and is probed there
    const surfaceSearch search(surface);
    const scalar reach = zoneGeometry::probe * dx;
    for (label t = 0; t < surface.size(); ++t)
    {
        const vector centre = surface.centre(t), half(centre[0], centre[1], 0);
        if (zoneGeometry::isPrismEnd(surface, t) || search.within(half, reach)) continue;
        throw fatalError(file + " has another outline half-way up than at " + place(centre) +
                         " m. In two dimensions a file's bodies must be prisms along z: extrude "
                         "the outline along z to any height");
    }
    const boundBox box = surface.bounds();
    const scalar factor = 2 * prismHalfHeight * dx / (box.max[2] - box.min[2]);
    for (vector& x : surface.nodes) x[2] *= factor;
}

}  // namespace ispf
