// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjectList.H"

#include <cmath>
#include <ostream>

namespace ispf
{

functionObjectList::functionObjectList(const fsiCase& c) : case_(c)
{
    const dictionary all = c.time.controlDict().subOrEmptyDict("functions");
    for (const word& name : all.dictKeys())
    {
        const dictionary& dict = all.subDict(name);
        if (dict.getOrDefault<bool>("enabled", true)) add(name, dict);
        else dict.markAllRead();
    }
    c.time.controlDict().checkAllRead();
    info() << "function objects: " << (items_.empty() ? "none" : join(names())) << "\n";
}

void functionObjectList::add(const word& name, const dictionary& dict)
{
    item i;
    dict.found("libs");  // OpenFOAM loads libraries by name; ours are linked
    i.object = functionObject::New(name, dict, case_);
    i.control = dict.chooseOrDefault("writeControl", {"timeStep", "runTime", "writeTime", "none"},
                                     i.object->defaultWriteControl());
    const bool counts = i.control == "timeStep", hasInterval = counts || i.control == "runTime";
    i.interval = i.control == "runTime" ? dict.getInRange("writeInterval", 1e-30, 1e30, dims::time)
                 : counts               ? dict.getInRangeOrDefault("writeInterval", 1, 1e9, 1)
                                        : 1;
    if (counts && i.interval != std::floor(i.interval))
        dict.fail("writeInterval",
                  "With 'writeControl timeStep' this counts steps: a whole number.");
    if (!hasInterval && dict.found("writeInterval"))
        dict.fail("writeInterval", "'writeControl " + i.control + "' takes no writeInterval.");
    i.from = dict.getOrDefault<scalar>("timeStart", -1e30, dims::time);
    i.to = dict.getOrDefault<scalar>("timeEnd", 1e30, dims::time);
    i.passed = multiples(i);
    items_.push_back(std::move(i));
}

bool functionObjectList::within(const item& i) const
{
    const scalar slack = 1e-9 * case_.time.deltaT();
    return case_.time.value() >= i.from - slack && case_.time.value() <= i.to + slack;
}

scalar functionObjectList::multiples(const item& i) const
{
    return std::floor((case_.time.value() + 1e-9 * case_.time.deltaT()) / i.interval);
}

bool functionObjectList::due(item& i) const
{
    if (i.control == "none") return false;
    if (i.control == "writeTime") return case_.time.writeTime();
    if (i.control == "timeStep") return case_.time.timeIndex() % label(i.interval) == 0;
    const scalar before = i.passed;
    i.passed = multiples(i);
    return i.passed > before;
}

void functionObjectList::start()
{
    for (item& i : items_)
        if (i.control != "none" && within(i)) i.object->write();
}

void functionObjectList::execute()
{
    for (item& i : items_)
    {
        const bool now = due(i);
        if (!within(i)) continue;
        i.object->execute();
        if (now) i.object->write();
    }
}

void functionObjectList::end()
{
    for (item& i : items_) i.object->end();
}

List<word> functionObjectList::names() const
{
    List<word> all;
    for (const item& i : items_) all.push_back(i.object->name());
    return all;
}

}  // namespace ispf
