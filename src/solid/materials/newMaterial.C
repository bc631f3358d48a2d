// SPDX-License-Identifier: GPL-3.0-or-later
// The materials that there are.  A new one adds its two lines here
#include "material.H"

#include <map>

namespace ispf
{

using madeMaterial = std::unique_ptr<material>;

madeMaterial newNeoHookean(const dictionary&);
madeMaterial newYeoh(const dictionary&);

namespace
{

using maker = madeMaterial (*)(const dictionary&);
const std::map<word, maker>& table()
{
    static const std::map<word, maker> all = {{"neoHookean", newNeoHookean}, {"Yeoh", newYeoh}};
    return all;
}

}  // namespace

List<word> material::kinds()
{
    List<word> names;
    for (const auto& kind : table()) names.push_back(kind.first);
    return names;
}

std::unique_ptr<material> material::New(const dictionary& dict)
{
    return table().at(dict.choose("type", kinds()))(dict);
}

}  // namespace ispf
