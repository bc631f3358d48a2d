// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleTable.H"

#include <charconv>

namespace ispf
{

scalar particleTable::scalarAttribute(const word& name) const
{
    const auto found = attributes.find(name);
    if (found == attributes.end())
    {
        List<word> names;
        for (const auto& [key, text] : attributes) names.push_back(key);
        throw fatalError("The particles have no attribute '" + name + "'.\n" +
                         validWords("attribute", names));
    }
    const word& text = found->second;
    scalar value = 0;
    const auto end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end)
        throw fatalError("Attribute '" + name + "' of the particles is '" + text +
                         "', which is no number.");
    return value;
}

void particleTable::setAttribute(const word& name, scalar value)
{
    char text[32];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value);
    attributes[name] = word(text, end);  // the shortest text that reads back to the same bits
}

}  // namespace ispf
