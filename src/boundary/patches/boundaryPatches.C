// SPDX-License-Identifier: GPL-3.0-or-later
// Reading constant/boundary and the files that its patches need
#include "boundaryContent.H"

#include "fileNames.H"

namespace ispf
{

boundary::boundary(const word& caseFolder, const dictionary& patches, const particleCloud& cloud,
                   scalar support, scalar t0, scalar nu)
    : content_(std::make_unique<content>())
{
    content& c = *content_;
    const patchSetting s{caseFolder, patches, cloud, support, nu, c.group, c.walls, c.patches};
    for (const word& name : patches.dictKeys())
    {
        c.patches.push_back(patch::New(name, s));
        c.balance.push_back({name});
    }
    c.group.close(cloud, support);
    for (const auto& p : c.patches) p->checkPlanes(s);
    c.walls.read(caseFolder, patches, c.group, cloud, support, t0);
    c.leaving.find(s);
    c.leaving.check(t0, cloud.dx);
    c.wetted.find(c.walls, c.group, cloud);
    c.visibility.find(c.walls, support);
    c.mirror.find(c.walls, support);
    for (const auto& p : c.patches) p->makeFace(s);
    for (const auto& p : c.patches) p->fill(s);
    c.rims.find(s);
    c.setStep({t0, t0, t0, t0});
    for (const char* file : {"/constant/wallParticles.hdf", "/constant/openSites.hdf"})
        if (isFile(caseFolder + file)) siteFile(caseFolder + file).checkPatches(patches);
    patches.checkAllRead();
}

void boundary::clampSolids(particleCloud& cloud, const List<vec4>& x0, const dictionary& patches)
{
    for (const auto& p : content_->patches) p->clamp(cloud, x0, patches.subDict(p->name()));
}

}  // namespace ispf
