// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjectList.H"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace ispf
{

namespace
{

constexpr scalar absent = 0;
const List<word> controls = {
    "timeStep",   "writeTime", "outputTime", "runTime", "adjustableRunTime",
    "adjustable", "clockTime", "cpuTime",    "onEnd",   "none",
    "always"};

}  // namespace

namespace entries
{

static stateEntry<List<scalar>> stateOf(const functionObject& f)
{
    return {"functions." + f.name()};
}

// Present where a function object carries the field of this name
const word carriedField = "carriedField.";
static stateEntry<scalar> carried(const word& field)
{
    return {carriedField + field};
}

}  // namespace entries

functionObjectList::functionObjectList(fsiCase& c)
    : functionObjectList(c, c.time.controlDict().subOrEmptyDict("functions"))
{
    c.time.controlDict().checkAllRead();
    info() << "function objects: " << (items_.empty() ? "none" : join(names())) << "\n";
}

functionObjectList::functionObjectList(fsiCase& c, const dictionary& functions)
    : case_(c), readings_(c.time.controlReadings())
{
    adopt(read(functions));
    restore();
}

List<functionObjectList::item> functionObjectList::read(const dictionary& functions) const
{
    List<item> items;
    for (const word& name : functions.dictKeys())
    {
        const dictionary& dict = functions.subDict(name);
        const bool enabled = dict.getOrDefault<bool>("enabled", true);
        const auto same = std::find_if(items_.begin(), items_.end(), [&](const item& i) {
            return i.object->name() == name && i.text == functions.toString(name);
        });
        if (!enabled || same != items_.end()) dict.markAllRead();
        if (!enabled) continue;
        items.push_back(same != items_.end() ? *same : make(name, dict));
        // those named after it may ask for its fields
        if (mayCarry()) items.back().object->advance(case_.cloud, 0);
        items.back().text = functions.toString(name);
    }
    return items;
}

functionObjectList::item functionObjectList::make(const word& name, const dictionary& dict) const
{
    item i;
    dict.found("libs"), dict.found("log"), dict.found("region");  // entries of OpenFOAM
    i.object = functionObject::New(name, dict, case_);
    i.execute.control = dict.chooseOrDefault("executeControl", controls, "timeStep");
    i.execute.interval =
        dict.getInRangeOrDefault("executeInterval", 1e-30, 1e30, absent, dims::any);
    i.execute = checked(i.execute, dict, "execute");
    i.write.control =
        dict.chooseOrDefault("writeControl", controls, i.object->defaultWriteControl());
    i.write.interval = dict.getInRangeOrDefault("writeInterval", 1e-30, 1e30, absent, dims::any);
    i.write = checked(i.write, dict, "write");
    i.from = dict.getOrDefault<scalar>("timeStart", -1e30, dims::time);
    i.to = dict.getOrDefault<scalar>("timeEnd", 1e30, dims::time);
    if (i.to < i.from) dict.fail("timeEnd", "timeEnd lies before timeStart: nothing is ever done.");
    return i;
}

void functionObjectList::adopt(List<item> items)
{
    items_ = std::move(items);
    List<scalar> intervals;
    for (const item& i : items_)
        for (const trigger& t : {i.execute, i.write})
            if (t.control == "adjustableRunTime") intervals.push_back(t.interval);
    case_.time.alsoHit(intervals);
    carryFields();
}

// False if the state was written by an earlier run: nothing makes the past of a field that it does not have
bool functionObjectList::mayCarry() const
{
    return !case_.time.postProcessing() || case_.time.timeIndex() == 0;
}

// Removes the fields of function objects that are there no more
void functionObjectList::carryFields()
{
    if (!mayCarry()) return;
    particleCloud& cloud = case_.cloud;
    List<word> wanted;
    for (item& i : items_)
        for (const word& field : i.object->carriedFields())
        {
            if (std::find(wanted.begin(), wanted.end(), field) != wanted.end())
                throw fatalError("Function object " + i.object->name() + " in " +
                                 case_.time.systemFile("controlDict") + " carries the field " +
                                 field + ", which another one carries already. Keep one of them");
            wanted.push_back(field);
        }
    const stepState state = cloud.state;
    for (const auto& [name, values] : state.values())
    {
        if (name.rfind(entries::carriedField, 0) != 0) continue;
        const word field = name.substr(entries::carriedField.size());
        if (std::find(wanted.begin(), wanted.end(), field) != wanted.end()) continue;
        cloud.scalars.erase(field), cloud.vectors.erase(field);
        cloud.state.erase(entries::carried(field));
    }
    for (const word& field : wanted) cloud.state.set(entries::carried(field), 1);
}

void functionObjectList::renew()
{
    if (readings_ == case_.time.controlReadings()) return;
    readings_ = case_.time.controlReadings();
    const dictionary functions = case_.time.controlDict().subOrEmptyDict("functions");
    try
    {
        const auto forget = [&](const item& i) {
            case_.cloud.state.erase(entries::stateOf(*i.object));
        };
        const auto isIn = [](const List<item>& items, const item& one) {
            return std::any_of(items.begin(), items.end(),
                               [&](const item& i) { return i.object == one.object; });
        };
        List<item> next = read(functions);
        functions.checkAllRead();
        bool changed = false;
        for (item& i : items_)
            if (!isIn(next, i)) changed = true, finish(i), forget(i);
        for (const item& i : next)
            if (!isIn(items_, i)) changed = true, forget(i);
        adopt(std::move(next));
        if (changed) info() << "function objects from now on: " << join(names()) << "\n";
    }
    catch (const fatalError& e)
    {
        warning("The changed functions are not used, those of before go on:\n" + formatted(e));
    }
}

functionObjectList::trigger functionObjectList::checked(trigger t, const dictionary& dict,
                                                        const word& what) const
{
    static const std::map<word, word> aliases = {
        {"outputTime", "writeTime"}, {"adjustable", "adjustableRunTime"}, {"always", "timeStep"}};
    const word control = what + "Control", interval = what + "Interval";
    const bool given = t.interval != absent, counts = t.control == "timeStep";
    if (const auto alias = aliases.find(t.control); alias != aliases.end())
        t.control = alias->second;
    if (!given) t.interval = 1;
    const bool isInterval = multiples(t) >= 0;
    if (isInterval && !given)
        throw fatalError("'" + control + " " + t.control + "' wants " + interval + " [s].",
                         dict.where());
    if (given && !counts && !isInterval)
        dict.fail(interval, "'" + control + " " + t.control + "' takes no " + interval + ".");
    if (counts && t.interval != std::floor(t.interval))
        dict.fail(interval, "With '" + control + " timeStep' this counts steps: a whole number.");
    t.passed = multiples(t);
    return t;
}

bool functionObjectList::within(const item& i) const
{
    const scalar slack = 1e-9 * case_.time.deltaT();
    return case_.time.value() >= i.from - slack && case_.time.value() <= i.to + slack;
}

// Number of intervals that have passed; negative if the control has no interval
scalar functionObjectList::multiples(const trigger& t) const
{
    const Time& time = case_.time;
    if (t.control == "runTime") return std::floor(time.reach() / t.interval);
    if (t.control == "adjustableRunTime")
        return std::floor((time.value() + 1e-9 * time.deltaT()) / t.interval);
    if (t.control == "clockTime") return std::floor(time.elapsedClockTime() / t.interval);
    if (t.control == "cpuTime") return std::floor(time.elapsedCpuTime() / t.interval);
    return -1;
}

bool functionObjectList::due(trigger& t) const
{
    if (t.control == "writeTime") return case_.time.writeTime();
    if (t.control == "timeStep") return case_.time.timeIndex() % label(t.interval) == 0;
    const scalar before = t.passed;
    t.passed = multiples(t);
    return t.passed > before;
}

// Puts walls to their present places, to the last digit, with the motion of the last step: the same as after reading a state
void functionObjectList::placeWalls()
{
    // no function object needs walls, and tables need not cover the last step
    if (items_.empty()) return;
    const scalar now = case_.time.value();
    if (case_.time.timeIndex() == 0) case_.walls->setStep(now, case_.stepEnd());
    else case_.walls->setStepBehind(now - case_.time.deltaTBehind(), now);
}

// Sets what a file does not have: the place of the walls and, of p and U, where a face gives them
void functionObjectList::placeRead()
{
    placeWalls();
    if (items_.empty() || !case_.walls->hasOpen()) return;
    particleCloud& cloud = case_.cloud;
    const List<vec4> read = cloud.Up;
    cloud.clearGhosts();
    case_.walls->setFlags(cloud, case_.rho, case_.bodyForceAt(case_.time.value()));
    cloud.Up = read;
}

void functionObjectList::restore()
{
    for (item& i : items_)
        if (const auto kept = case_.cloud.state.find(entries::stateOf(*i.object)))
            i.object->restore(*kept);
}

template <class Work>
void functionObjectList::timed(const item& i, Work&& work)
{
    case_.time.stages.in("function object " + i.object->name(), work);
}

void functionObjectList::start()
{
    placeRead();
    for (item& i : items_)
        if (i.write.control != "none" && i.write.control != "onEnd" && within(i))
            timed(i, [&] { i.object->write(); });
}

void functionObjectList::execute()
{
    renew();
    placeWalls();
    const Time& time = case_.time;
    for (item& i : items_)
    {
        const bool now = due(i.execute), writes = due(i.write);
        if (!within(i)) continue;
        timed(i, [&] {
            // timeStart may lie within the step
            i.object->advance(case_.cloud, std::clamp(time.value() - i.from, 0., time.deltaT()));
            if (now) i.object->execute();
            if (writes) i.object->write();
        });
    }
    if (!case_.time.writeTime()) return;
    for (item& i : items_)
        if (const List<scalar> state = i.object->state(); !state.empty())
            case_.cloud.state.set(entries::stateOf(*i.object), state);
}

void functionObjectList::end()
{
    for (item& i : items_) finish(i);
}

void functionObjectList::finish(item& i)
{
    timed(i, [&] {
        if (i.write.control == "onEnd" && within(i)) i.object->write();
        i.object->end();
    });
}

void functionObjectList::writeNow()
{
    placeRead();
    restore();
    for (item& i : items_)
    {
        if (i.write.control == "onEnd" || !within(i)) continue;
        warnOfMissingPast(*i.object);
        i.object->write();
    }
}

void functionObjectList::warnOfMissingPast(const functionObject& f) const
{
    if (!f.sumsOverTime() || case_.time.timeIndex() == 0 ||
        case_.cloud.state.find(entries::stateOf(f)))
        return;
    warning("Function object " + f.name() +
                ": the run that wrote these times did not have it. Values of an instant are right, "
                "integrals over time are not those of the run: for these run with it in "
                "system/controlDict.",
            1);
}

List<word> functionObjectList::names() const
{
    List<word> all;
    for (const item& i : items_) all.push_back(i.object->name());
    return all;
}

}  // namespace ispf
