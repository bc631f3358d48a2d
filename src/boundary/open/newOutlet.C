// SPDX-License-Identifier: GPL-3.0-or-later
// The list of outlet kinds.  A new kind adds its two lines here
#include "outlet.H"

namespace ispf
{

using madeOutlet = std::unique_ptr<outlet>;

madeOutlet newNonReflecting(const dictionary&, const word&, const dimensionSet&);
madeOutlet newResistance(const dictionary&, const word&, const dimensionSet&);
madeOutlet newWindkessel(const dictionary&, const word&, const dimensionSet&);

namespace
{

class fixedPressure : public outlet
{
public:
    fixedPressure(const dictionary& dict, const word& caseFolder)
        : p_(Function1::New("p", dict, caseFolder, dims::pressure))
    {
    }
    scalar pressure(const step& s, scalar) const override { return p_->value(s.end); }

private:
    std::unique_ptr<Function1> p_;
};

madeOutlet newFixedPressure(const dictionary& dict, const word& caseFolder, const dimensionSet&)
{
    return std::make_unique<fixedPressure>(dict, caseFolder);
}

}  // namespace

std::unique_ptr<outlet> outlet::New(const dictionary& dict, const word& caseFolder,
                                    const dimensionSet& flow)
{
    using maker = madeOutlet (*)(const dictionary&, const word&, const dimensionSet&);
    static const std::map<word, maker> kinds = {{"fixedPressure", newFixedPressure},
                                                {"nonReflecting", newNonReflecting},
                                                {"resistance", newResistance},
                                                {"Windkessel", newWindkessel}};
    List<word> names;
    for (const auto& kind : kinds) names.push_back(kind.first);
    return kinds.at(dict.chooseOrDefault("outlet", names, "fixedPressure"))(dict, caseFolder, flow);
}

}  // namespace ispf
