// SPDX-License-Identifier: GPL-3.0-or-later
// Values of entries: get<T>, choose, getInRange.
#include "dictionaryContent.H"
#include "valueReader.H"

#include <algorithm>

namespace ispf
{

template <class T>
T dictionary::get(const word& key, const dimensionSet& wanted) const
{
    return valueReader(valueEntry(key).value, key, where(key), wanted).template whole<T>();
}

template scalar dictionary::get<scalar>(const word&, const dimensionSet&) const;
template label dictionary::get<label>(const word&, const dimensionSet&) const;
template bool dictionary::get<bool>(const word&, const dimensionSet&) const;
template word dictionary::get<word>(const word&, const dimensionSet&) const;
template vector dictionary::get<vector>(const word&, const dimensionSet&) const;
template tensor dictionary::get<tensor>(const word&, const dimensionSet&) const;
template List<scalar> dictionary::get<List<scalar>>(const word&, const dimensionSet&) const;
template List<label> dictionary::get<List<label>>(const word&, const dimensionSet&) const;
template List<word> dictionary::get<List<word>>(const word&, const dimensionSet&) const;
template List<vector> dictionary::get<List<vector>>(const word&, const dimensionSet&) const;

scalar dictionary::getUnit(const word& key, const dimensionSet& wanted) const
{
    valueReader in(valueEntry(key).value, key, where(key), wanted);
    if (!in.at('[')) in.fail("a unit or a dimension set in brackets");
    const scalar factor = in.readUnit();
    in.expectEnd();
    return factor;
}

word dictionary::choose(const word& key, const List<word>& valid) const
{
    const word value = get<word>(key);
    if (std::find(valid.begin(), valid.end(), value) == valid.end())
        fail(key, "Unknown " + key + " '" + value + "'." + didYouMean(value, valid) + "\n" +
                      validWords(key, valid));
    return value;
}

word dictionary::chooseOrDefault(const word& key, const List<word>& valid, const word& value) const
{
    return found(key) ? choose(key, valid) : value;
}

template <class T>
T dictionary::getInRange(const word& key, scalar low, scalar high, const dimensionSet& wanted) const
{
    const T value = get<T>(key, wanted);
    if (value < low || value > high)
        fail(key, "'" + key + "' is " + str(value, 10) + ", but must lie between " + str(low, 10) +
                      " and " + str(high, 10) + ".");
    return value;
}

template scalar dictionary::getInRange<scalar>(const word&, scalar, scalar,
                                               const dimensionSet&) const;
template label dictionary::getInRange<label>(const word&, scalar, scalar,
                                             const dimensionSet&) const;

}  // namespace ispf
