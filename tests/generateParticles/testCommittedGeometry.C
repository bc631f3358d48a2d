// SPDX-License-Identifier: GPL-3.0-or-later
// The IGES files of the hemisphere-capped cylinder have the volumes that follow from their dimensions, and
// so the published numbers of particles
#include "fileFormats/scratchFolder.H"
#include "particleDict.H"
#include "relative.H"
#include "surfaceTopology.H"

#include <cmath>
#include <filesystem>

using namespace ispf;

namespace
{

struct outline  // [mm]; see etc/geometry/hemisphereCappedCylinder/writeIges.C
{
    word file;
    scalar length, nozzleTip, bore, syringe, flangeRadius, bufferHeight;
    bool ellipse;
};

const List<outline> files = {{"hccB", 20, 7.5, 5, 17.4, 14.3, 35, false},
                             {"hccBellipse", 20, 7.5, 5, 17.4, 14.3, 35, true},
                             {"hccA", 17.3, 0, 6, 19.5, 16.2, 33.2, false}};

const List<word> zones = {"wall", "flange", "chamber", "buffer"};
const List<std::array<int, 3>> colours = {
    {204, 0, 0}, {102, 102, 102}, {0, 102, 204}, {153, 204, 255}};

// [mm3], in the order of `zones`
List<scalar> exactVolumes(const outline& o)
{
    const scalar R = 10, wall = 2, tip = 13, L = o.length, outer = R + wall;
    const auto cylinder = [](scalar r, scalar h) { return M_PI * r * r * h; };
    const scalar inside = 2 * M_PI / 3 * R * R * R;
    // half an ellipsoid, or the cap of a sphere, over the circle of the outer radius
    const scalar dome = o.ellipse ? 2 * M_PI / 3 * outer * outer * tip
                                  : M_PI * tip * (3 * outer * outer + tip * tip) / 6;
    const scalar nozzle = o.nozzleTip > 0 ? cylinder(6, o.nozzleTip) : 0;
    return {cylinder(outer, L) + dome - cylinder(R, L) - inside,
            cylinder(o.flangeRadius, 2) - cylinder(R, 2),
            cylinder(8, o.syringe) + cylinder(o.bore, 5 + o.nozzleTip) + cylinder(R, L) + inside -
                nozzle,
            cylinder(15, o.bufferHeight) - cylinder(outer, L) - dome};
}

word pathOf(const outline& o)
{
    return std::filesystem::absolute(
        "tutorials/ispfFsiFoam/hemisphereCappedCylinder/constant/geometry/" + o.file + ".igs");
}

bool hasColour(const cadFace& face, const std::array<int, 3>& colour)
{
    for (int k = 0; k < 3; ++k)
        if (std::abs(face.colour[k] - colour[k]) > 6) return false;
    return face.coloured;
}

// Volume that owns a face of that colour, from its mesh [mm3]; known: the same from the CAD kernel [mm3]
scalar meshedVolume(const cadModel& cad, const std::array<int, 3>& colour, scalar& known)
{
    for (const cadVolume& v : cad.volumes)
    {
        triSurface s;
        bool own = false;
        for (const label f : v.faces)
        {
            s.append(cad.face(f).surface);
            own = own || hasColour(cad.face(f), colour);
        }
        if (!own) continue;
        s.weld(1e-6);
        CHECK(checkClosed(s).openEdges == 0);
        orientOutward(s);
        known = v.volume * 1e9;
        return s.volume() * 1e9;
    }
    return 0;
}

cadModel meshed(const outline& o, scalar size)
{
    cadSettings settings;
    settings.meshSize = size;
    return readCad(pathOf(o), settings);
}

}  // namespace

TEST_CASE("each solid has the volume of its dimensions")
{
    for (const outline& o : files)
    {
        CAPTURE(o.file);
        const List<scalar> exact = exactVolumes(o);
        const cadModel cad = meshed(o, 1.6e-3);
        CHECK(cad.volumes.size() == zones.size());
        for (size_t z = 0; z < zones.size(); ++z)
        {
            CAPTURE(zones[z]);
            scalar known = 0;
            CHECK(meshedVolume(cad, colours[z], known) == relative(exact[z], 0.005));
            CHECK(known == relative(exact[z], 1e-7));
        }
    }
}

TEST_CASE("facets converge to the volume with their area")
{
    const List<scalar> exact = exactVolumes(files[0]);
    const cadModel coarse = meshed(files[0], 1.6e-3), fine = meshed(files[0], 0.8e-3);
    for (size_t z = 0; z < zones.size(); ++z)
    {
        CAPTURE(zones[z]);
        scalar known = 0;
        const scalar v1 = meshedVolume(coarse, colours[z], known);
        const scalar v2 = meshedVolume(fine, colours[z], known);
        CHECK(std::abs(v1 - exact[z]) > 3 * std::abs(v2 - exact[z]));
        CHECK((4 * v2 - v1) / 3 == relative(exact[z], 5e-4));
    }
}

TEST_CASE("zones by colour from a quarter: volumes, and the published numbers of particles")
{
    for (const outline& o : files)
    {
        CAPTURE(o.file);
        const scratchFolder folder("quarterOf" + o.file);
        for (const char* sub : {"system", "constant"})
            std::filesystem::create_directories(folder / sub);
        setContent(folder / "constant/boundary",
                   "plunger { type wall; } walls { type wall; } outside { type open; }"
                   "x { type symmetryPlane; point (0 0 0); normal (-1 0 0); }"
                   "y { type symmetryPlane; point (0 0 0); normal (0 -1 0); }");
        setContent(folder / "system/particleDict",
                   "dx 1e-3; placement bodyFitted; geometry \"" + pathOf(o) +
                       "\";"
                       "zones { wall { phase solid; file $geometry; colour (204 0 0); }"
                       "flange { phase clamped; file $geometry; colour (102 102 102); }"
                       "chamber { phase fluid; file $geometry; colour (0 102 204); }"
                       "buffer { phase fluid; file $geometry; colour (153 204 255); } }"
                       "patches { plunger { colour (255 153 0); } outside { colour (0 153 51); } }"
                       "defaultPatch walls;");
        particleDict dict(folder / ".");
        const zoneGeometry geometry = dict.geometry();
        const List<scalar> exact = exactVolumes(o);
        List<scalar> particles;
        for (size_t z = 0; z < zones.size(); ++z)
        {
            CAPTURE(zones[z]);
            CHECK(geometry.zones()[z].name == zones[z]);
            CHECK(4 * geometry.volume(label(z)) * 1e9 == relative(exact[z], 1e-3));
            particles.push_back(4 * geometry.volume(label(z)) / std::pow(0.4e-3, 3));
        }
        if (o.ellipse)
            continue;  // its wall is 170 mm3 smaller, which the flange does not make up for
        CHECK(particles[2] == relative(187793, 0.03));
        CHECK(particles[0] + particles[1] == relative(84616, 0.03));
        CHECK(particles[3] == relative(180805, 0.03));
    }
}
