// SPDX-License-Identifier: GPL-3.0-or-later
// Fields on a regular grid of a plane, for maps, and the particles within a slice.  Files
// postProcessing/<name>/<time>/<name>.dat and <name>.slice.dat:
//
//     diametral { type planeMap; point (0 0 0); normal (0 1 0); xAxis (1 0 0); ... }  // samplePlane.H
//
// By default it writes when particles are written.
#include "functionObject.H"

#include "fileNames.H"
#include "samplePlane.H"

namespace ispf
{

namespace
{

class planeMap : public functionObject
{
public:
    planeMap(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c), plane_(name, dict, c.cloud)
    {
    }

    word defaultWriteControl() const override { return "writeTime"; }

    void write() override
    {
        const word path = folder(case_.time.timeName()) + "/" + name_;
        writeText(path + ".dat", plane_.grid(case_.cloud));
        if (plane_.hasSlice()) writeText(path + ".slice.dat", plane_.slice(case_.cloud));
    }

private:
    samplePlane plane_;
};

}  // namespace

std::unique_ptr<functionObject> newPlaneMap(const word& name, const dictionary& dict,
                                            const fsiCase& c)
{
    return std::make_unique<planeMap>(name, dict, c);
}

}  // namespace ispf
