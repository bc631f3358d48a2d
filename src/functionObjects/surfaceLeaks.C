// SPDX-License-Identifier: GPL-3.0-or-later
// Particles that are on the wrong side of a surface that the solid carries along: fluid that has gone
// into or through the wall.
//
//     leaks { type surfaceLeaks; surface wall_to_chamber; zones (chamber); }
//
// The right side is the one on which most of the chosen particles near the surface are at the start.
// Where the surface's rim is nearest there are no sides, and nothing is counted.
// Columns, of the model, not the whole body: wrongSide, their number; through, those by more than half
// a spacing, which cannot be the particle size's doing; deepest [m], how far the worst is beyond.
#include "functionObject.H"

#include "dataFile.H"
#include "particleFields.H"
#include "surfaceSearch.H"
#include "trackedSurface.H"

namespace ispf
{

namespace
{

class surfaceLeaks : public functionObject
{
public:
    surfaceLeaks(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, c),
          surface_(dict.get<word>("surface"), c),
          chosen_(c.cloud, dict, "fluid"),
          file_(startFolder() + "/surfaceLeaks.dat",
                {"Particles on the wrong side of " + surface_.name()},
                {"wrongSide", "through", "deepest"})
    {
        label balance = 0;
        forDistances(3 * c.cloud.dx, [&](scalar d) { balance += d > 0 ? 1 : -1; });
        if (balance == 0)
            dict.fail("zones", "No side of the surface " + surface_.name() +
                                   " has more particles of these zones than the other.");
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
        file_.endRow();
    }

private:
    // Signed distances of the chosen particles no further than `radius`
    template <class Visit>
    void forDistances(scalar radius, const Visit& visit)
    {
        surface_.update(case_.cloud.x);
        const surfaceSearch search(surface_.now());
        const label n = case_.cloud.n();
        List<surfacePoint> nearest(n);
        parallelFor(n, [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
                if (chosen_(case_.cloud, i))
                    nearest[i] = search.nearest(case_.cloud.x[i].xyz(), radius);
        });
        for (label i = 0; i < n; ++i)
            if (nearest[i].found && !nearest[i].rim)
                visit(nearest[i].signedDistance(case_.cloud.x[i].xyz()));
    }

    trackedSurface surface_;
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
