// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleTable.H"

#include "fileNames.H"

#include <algorithm>
#include <charconv>

namespace ispf
{

namespace
{

word quoted(const word& text)
{
    word result = "\"";
    for (const char c : text)
    {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

word shortest(scalar value)
{
    char text[32];
    return word(text, std::to_chars(text, text + sizeof text, value).ptr);
}

}  // namespace

void writeSeries(const word& path, List<seriesEntry> entries)
{
    std::stable_sort(entries.begin(), entries.end(),
                     [](const seriesEntry& a, const seriesEntry& b) { return a.time > b.time; });
    word json = "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [";
    const char* separator = "\n";
    for (const seriesEntry& entry : entries)
    {
        if (!std::isfinite(entry.time))
            throw fatalError("Cannot write '" + path + "': the time of '" + entry.file +
                             "' is not a finite number.");
        json += separator;
        json += "    { \"name\" : " + quoted(entry.file) + ", \"time\" : " + shortest(entry.time) +
                " }";
        separator = ",\n";
    }
    writeText(path, json + "\n  ]\n}\n");
}

}  // namespace ispf
