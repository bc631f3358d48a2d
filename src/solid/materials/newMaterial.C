// SPDX-License-Identifier: GPL-3.0-or-later
// The materials that there are.  A new one adds its two lines here
#include "material.H"

#include <map>

namespace ispf
{

using madeMaterial = std::unique_ptr<material>;

using restPlaces = List<vector>;

madeMaterial newFung(const dictionary&, const restPlaces&);
madeMaterial newGuccione(const dictionary&, const restPlaces&);
madeMaterial newHolzapfelGasserOgden(const dictionary&, const restPlaces&);
madeMaterial newMooneyRivlin(const dictionary&, const restPlaces&);
madeMaterial newNeoHookean(const dictionary&, const restPlaces&);
madeMaterial newOgden(const dictionary&, const restPlaces&);
madeMaterial newYeoh(const dictionary&, const restPlaces&);

namespace
{

using maker = madeMaterial (*)(const dictionary&, const restPlaces&);
const std::map<word, maker>& table()
{
    static const std::map<word, maker> all = {{"Fung", newFung},
                                              {"Guccione", newGuccione},
                                              {"HolzapfelGasserOgden", newHolzapfelGasserOgden},
                                              {"MooneyRivlin", newMooneyRivlin},
                                              {"neoHookean", newNeoHookean},
                                              {"Ogden", newOgden},
                                              {"Yeoh", newYeoh}};
    return all;
}

}  // namespace

List<word> material::kinds()
{
    List<word> names;
    for (const auto& kind : table()) names.push_back(kind.first);
    return names;
}

std::unique_ptr<material> material::New(const dictionary& dict, const List<vector>& x0)
{
    return table().at(dict.choose("type", kinds()))(dict, x0);
}

}  // namespace ispf
