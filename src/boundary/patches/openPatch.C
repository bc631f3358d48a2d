// SPDX-License-Identifier: GPL-3.0-or-later
// type open: an open face between the other patches
#include "patch.H"

#include <cmath>
#include <filesystem>
#include <limits>

namespace ispf
{

namespace
{

bool isPlane(const dictionary& dict)
{
    return dict.found("surface") && dict.get<word>("surface") == "plane";
}

// The surface that generateParticles has written for the patch, empty if there is none or if it does not lie in the plane
triSurface inPlane(const word& caseFolder, const word& name, const dictionary& dict,
                   const vector& point, const vector& normal, scalar dx)
{
    if (!std::filesystem::exists(patchFile(caseFolder, name))) return {};
    triSurface s = readPatch(caseFolder, name, dict);
    for (const vector& x : s.nodes)
        if (std::abs((x - point).dot(normal)) > 1e-3 * dx) return {};
    return s;
}

class openPatch : public patch
{
public:
    explicit openPatch(const word& name) : patch(name) {}

    const openFace* face() const override { return face_.get(); }
    bool passesFlux() const override { return true; }

    void makeFace(const patchSetting& s) override;
    void fill(const patchSetting& s) override;

    void setStep(const stepTimes& times) override
    {
        face_->setStep(times.start, times.end, times.pressures);
    }
    scalar givenSpeed() const override { return face_->givenSpeed(); }
    void setFlags(particleCloud& cloud, scalar rho, const List<vector>& bodyForce) const override
    {
        const label number = label(cloud.entering.size());
        cloud.entering.push_back(std::numeric_limits<scalar>::quiet_NaN());
        face_->setFlags(cloud, rho, bodyForce, number);
    }
    void setStrip(particleCloud& cloud, const openFace::movingWalls& walls) const override
    {
        face_->setStrip(cloud, walls);
    }
    void addSwept(const particleCloud& cloud, sweptRates& r) const override;
    void addOutlet(const particleCloud& cloud, scalar rho, scalar dt,
                   List<outletPressure::solved>& all) const override
    {
        face_->addOutlet(cloud, rho, dt, all);
    }
    void addLink(List<outletLink>& all) const override { face_->addLink(all); }
    void follow(particleCloud& cloud, const List<vec4>& friction, scalar rho,
                scalar dt) const override
    {
        face_->followInside(cloud, friction, rho, dt);
    }
    bool near(label i) const override { return face_->near(i); }
    bool reachesBeyond(label i, scalar reach) const override
    {
        return face_->reachesBeyond(i, reach);
    }
    bool beyondStrip(const vector& x) const override { return face_->beyondStrip(x); }
    void keepAlongNormals(particleCloud& cloud) const override { face_->keepAlongNormals(cloud); }
    void exchange(particleCloud& cloud, const openFace::movingWalls& walls, scalar t0, scalar t1,
                  patchBalance& b) const override
    {
        const openFace::change change = face_->exchange(cloud, walls);
        b.created += change.created, b.deleted += change.deleted;
        b.flux = face_->flux(), b.volume += b.flux * (t1 - t0);
        face_->accept(cloud, t0, t1);
    }

private:
    faceMesh meshOf(const patchSetting& s) const;

    std::unique_ptr<openFace> face_;
};

// The mesh of the face.  A plane is the surface that generateParticles has written, where it lies in the plane.  Else it ends at
// walls, symmetry planes, cyclic sides and other open planes
faceMesh openPatch::meshOf(const patchSetting& s) const
{
    const auto placeOf = [](const dictionary& dict) {
        return std::make_pair(dict.get<vector>("point", dims::length),
                              vector(nonZero(dict, "normal").normalized()));
    };
    const dictionary& dict = s.patches.subDict(name());
    planeLattice::planes ends;
    for (const word& other : s.patches.dictKeys())
        if (const dictionary& d = s.patches.subDict(other);
            other != name() && d.get<word>("type") == "open" && isPlane(d))
            ends.push_back(placeOf(d));
    triSurface surface;
    if (isPlane(dict))
    {
        const auto [point, normal] = placeOf(dict);
        surface = inPlane(s.caseFolder, name(), dict, point, normal, s.cloud.dx);
        if (surface.empty()) surface = s.walls.rectangle(point, normal, ends);
    }
    else surface = readPatch(s.caseFolder, name(), dict);
    return surface.empty() ? faceMesh() : faceMesh(std::move(surface), s.group, s.cloud);
}

void openPatch::makeFace(const patchSetting& s)
{
    const auto isHeld = [&walls = s.walls](const vector& x) { return walls.holds(x); };
    face_ = std::make_unique<openFace>(
        name(), s.patches.subDict(name()), s.caseFolder,
        openFace::setting{s.group, s.cloud, s.sites().stripLayers(), meshOf(s), isHeld, s.nu});
}

void openPatch::fill(const patchSetting& s)
{
    const auto beside = [&](const vector& x, scalar distance) {
        for (const auto& [point, normal] : s.group.symmetryPlanes())
            if ((x - point).dot(normal) > -distance) return true;
        return !s.walls.clear(x, distance);
    };
    // applies to points in the strip of this face or before it, so the face itself is not asked
    const auto allowed = [&](const vector& x, scalar distance) {
        for (const auto& other : s.all)
            if (other.get() != this && other->beyondStrip(x)) return false;
        return s.group.beyond(x) <= -distance && s.walls.clear(x, distance);
    };
    const fileLocation where = s.patches.subDict(name()).where("type");
    face_->setSites(s.sites().positions(name(), where), s.cloud, allowed, beside);
}

void openPatch::addSwept(const particleCloud& cloud, sweptRates& r) const
{
    if (!face_->givesVelocity()) return;
    const List<scalar> q = face_->givenFlux(cloud);
    for (size_t z = 0; z < q.size(); ++z)
        r.net[z] += q[z], r.gross[z] += std::abs(q[z]), r.faces[z] += std::abs(q[z]);
}

}  // namespace

std::unique_ptr<patch> newOpenPatch(const word& name, const patchSetting&)
{
    return std::make_unique<openPatch>(name);
}

}  // namespace ispf
