// SPDX-License-Identifier: GPL-3.0-or-later
// type symmetryPlane, type cyclic: planes of the imageGroup, which makes the images beyond them
#include "patch.H"

namespace ispf
{

namespace
{

class symmetryPatch : public patch
{
public:
    symmetryPatch(const word& name, const patchSetting& s) : patch(name)
    {
        const dictionary& dict = s.patches.subDict(name);
        s.group.addSymmetryPlane(name, dict.get<vector>("point", dims::length),
                                 nonZero(dict, "normal"));
    }
};

class cyclicPatch : public patch
{
public:
    cyclicPatch(const word& name, const patchSetting& s)
        : patch(name),
          pair_{name, s.patches.subDict(name).get<vector>("point", dims::length),
                nonZero(s.patches.subDict(name), "separation", dims::length)},
          support_(s.support)
    {
        const dictionary& dict = s.patches.subDict(name);
        hasDrop_ = dict.found("pressureDrop");
        s.group.addCyclic(name, pair_.point, pair_.separation,
                          hasDrop_
                              ? Function1::New("pressureDrop", dict, s.caseFolder, dims::pressure)
                              : nullptr);
    }

    const cyclicPair* pair() const override { return &pair_; }
    void checkPlanes(const patchSetting& s) const override;
    void measure(const particleCloud& cloud, scalar dt, patchBalance& b) const override
    {
        b.flux = pair_.flux(cloud, support_), b.volume += b.flux * dt;
    }

private:
    cyclicPair pair_;
    scalar support_;
    bool hasDrop_;
};

// fatalError if a solid reaches over a pair with a pressure drop: its rows allow no difference of p between the sides
void cyclicPatch::checkPlanes(const patchSetting& s) const
{
    if (!hasDrop_) return;
    for (label i = 0; i < s.cloud.nSolid(); ++i)
    {
        const vector L = pair_.separation;
        const scalar along = (s.cloud.x[i].xyz() - pair_.point).dot(L.normalized());
        if (along > support_ && along < L.norm() - support_) continue;
        s.patches.subDict(name()).fail(
            "pressureDrop",
            "A solid reaches over the cyclic patch " + name() + " (" + s.cloud.describe(i) +
                "): its load would not know of the pressure drop. Drive the fluid's zone "
                "with bodyForce in constant/physicalProperties instead: pressureDrop over "
                "rho times the length");
    }
}

}  // namespace

std::unique_ptr<patch> newSymmetryPatch(const word& name, const patchSetting& s)
{
    return std::make_unique<symmetryPatch>(name, s);
}

std::unique_ptr<patch> newCyclicPatch(const word& name, const patchSetting& s)
{
    return std::make_unique<cyclicPatch>(name, s);
}

}  // namespace ispf
