// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObject.H"

#include "fileNames.H"
#include "particleTable.H"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace ispf
{

functionObject::functionObject(const word& name, const dictionary& dict, const fsiCase& c)
    : name_(name), case_(c), begin_(c.time.value())
{
    precision_ = dict.getInRangeOrDefault<label>("writePrecision", 1, 17, c.time.writePrecision());
}

word functionObject::folder(const word& time) const
{
    return case_.caseFolder() + "/postProcessing/" + name_ + "/" + time;
}

word functionObject::startFolder() const
{
    return folder(case_.time.timeName(begin_));
}

word functionObject::tablePath(const word& file) const
{
    const word path = startFolder() + "/" + file;
    if (!case_.time.postProcessing() || !isFile(path)) return path;
    const size_t dot = std::min(path.find('.', startFolder().size()), path.size());
    return path.substr(0, dot) + "_" + case_.time.timeName(begin_) + path.substr(dot);
}

dataFile functionObject::table(const word& file, const List<word>& remarks,
                               const List<word>& titles, int digits) const
{
    return dataFile(tablePath(file), remarks, titles, precision(digits));
}

// "quarter": what symmetry planes leave of the body; "" without them
word functionObject::modelled() const
{
    const scalar copies = case_.walls->symmetryFactor();
    if (copies == 1) return "";
    return copies == 2 ? "half" : copies == 4 ? "quarter" : "1/" + str(copies);
}

List<word> functionObject::ofWhole(List<word> remarks, const word& values) const
{
    if (const word part = modelled(); !part.empty())
        remarks.push_back("Symmetry planes: " + values + "of the whole body, not of the modelled " +
                          part);
    return remarks;
}

List<word> functionObject::ofModelled(List<word> remarks, const word& values) const
{
    if (const word part = modelled(); !part.empty())
        remarks.push_back("Symmetry planes: " + values + "of the modelled " + part +
                          ", not of the whole body");
    return remarks;
}

void functionObject::listTimes(const word& file) const
{
    List<seriesEntry> series;
    for (const auto& item : std::filesystem::directory_iterator(folder("")))
    {
        const word time = item.path().filename().string();
        char* end = nullptr;
        const scalar t = std::strtod(time.c_str(), &end);
        if (end != time.c_str() && !*end && std::filesystem::exists(item.path() / file))
            series.push_back({t, time + "/" + file});
    }
    writeSeries(folder(file + ".series"), std::move(series));
}

}  // namespace ispf
