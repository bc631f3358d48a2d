// SPDX-License-Identifier: GPL-3.0-or-later
// Counts particles on the wrong side of a surface: fluid that has gone into or through a wall.
//
//     leaks { type surfaceLeaks; surface wall_to_chamber; zones (chamber); }   // moves with the solid
//     leaks { type surfaceLeaks; patches (walls); phase fluid; }               // walls at rest
//
// The right side is the side with most of the chosen particles near the surface at the start.
// Where the rim of the surface is nearest, sides are not defined and nothing is counted.
// Columns, of the modelled part where symmetry planes cut the body: wrongSide, their number; through, the number beyond by more than half
// a spacing, more than the size of a particle explains; deepest [m], the largest distance beyond;
// putBack, how often a particle has been put back off these patches since the case began.  Rigid walls
// are guarded, which keeps the first three small.
#include "functionObject.H"

#include "dataFile.H"
#include "particleFields.H"
#include "surfaceSearch.H"
#include "patchDictionary.H"
#include "trackedSurface.H"

#include <algorithm>

namespace ispf
{

namespace
{

class surfaceLeaks : public functionObject
{
public:
    surfaceLeaks(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          chosen_(c.cloud, dict, "fluid"),
          file_(table("surfaceLeaks.dat",
                      ofModelled({"Particles on the wrong side of " + readSurface(dict)}),
                      titles(dict.found("patches"))))
    {
        label balance = 0;
        forDistances(3 * c.cloud.dx, [&](scalar d) { balance += d > 0 ? 1 : -1; });
        if (balance == 0)
            dict.fail(carried_ ? "surface" : "patches",
                      "No side of this surface has more of the chosen particles than the other.");
        rightSide_ = balance > 0 ? 1 : -1;
    }

    void write() override
    {
        label wrong = 0, through = 0;
        scalar deepest = 0;
        forDistances(std::numeric_limits<scalar>::max(), [&](scalar d) {
            const scalar depth = -rightSide_ * d;
            wrong += depth > 0;
            through += depth > 0.5 * case_.cloud.dx;
            deepest = std::max(deepest, depth);
        });
        file_.begin(case_.time.value()) << wrong << through << deepest;
        if (!carried_) file_ << putBack();
        file_.endRow();
    }

    List<scalar> state() const override { return {scalar(rightSide_)}; }
    void restore(const List<scalar>& s) override
    {
        if (s.size() == 1) rightSide_ = s[0] > 0 ? 1 : -1;
    }

private:
    // Reads the name of the surface
    word readSurface(const dictionary& dict)
    {
        if (dict.found("surface") == dict.found("patches"))
            throw fatalError("surfaceLeaks wants either a surface or patches.", dict.where());
        if (dict.found("surface"))
        {
            carried_ = std::make_unique<trackedSurface>(dict.get<word>("surface"), case_,
                                                        dict.where("surface"));
            return carried_->name();
        }
        patches_ = dict.get<List<word>>("patches");
        triSurface all;
        for (const word& patch : patches_)
        {
            refuseOther(dict, patch);
            all.append(ispf::readSurface(patch, case_, dict.where("patches")));
        }
        all.weld(1e-3 * case_.cloud.dx);
        search_ = surfaceSearch(std::move(all));
        return join(patches_);
    }

    void refuseOther(const dictionary& dict, const word& patch) const
    {
        const dictionary all = readPatchDictionary(case_.caseFolder(), case_.cloud.zones);
        List<word> still;
        for (const word& name : all.dictKeys())
            if (const dictionary& d = all.subDict(name);
                d.get<word>("type") == "wall" && !d.found("motion"))
                still.push_back(name);
        if (std::find(still.begin(), still.end(), patch) == still.end())
            dict.fail("patches", "Patch " + patch + " is no wall that stands still. " +
                                     validWords("patch", still));
    }

    static List<word> titles(bool guarded)
    {
        List<word> all = {"wrongSide", "through", "deepest"};
        if (guarded) all.push_back("putBack");
        return all;
    }

    label putBack() const
    {
        label n = 0;
        for (const patchBalance& b : case_.walls->balance())
            if (std::find(patches_.begin(), patches_.end(), b.name) != patches_.end())
                n += b.pushed;
        return n;
    }

    // Calls visit with the signed distances of the chosen particles within `radius`
    template <class Visit>
    void forDistances(scalar radius, const Visit& visit)
    {
        if (carried_)
        {
            carried_->update(case_.cloud.x);
            search_ = surfaceSearch(carried_->now());
        }
        const label n = case_.cloud.n();
        List<surfacePoint> nearest(n);
        parallelFor(n, [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
                if (chosen_(case_.cloud, i))
                    nearest[i] = search_.nearest(case_.cloud.x[i].xyz(), radius);
        });
        for (label i = 0; i < n; ++i)
            if (nearest[i].found && !nearest[i].rim)
                visit(nearest[i].signedDistance(case_.cloud.x[i].xyz()));
    }

    std::unique_ptr<trackedSurface> carried_;
    List<word> patches_;  // empty if the surface moves with the solid
    surfaceSearch search_;
    particleSelection chosen_;
    dataFile file_;
    int rightSide_ = 1;
};

}  // namespace

std::unique_ptr<functionObject> newSurfaceLeaks(const word& name, const dictionary& dict,
                                                const fsiCase& c)
{
    return std::make_unique<surfaceLeaks>(name, dict, c);
}

}  // namespace ispf
