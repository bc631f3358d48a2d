// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloudIO.H"

#include "particleState.H"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace ispf
{

namespace fs = std::filesystem;

namespace
{

const char* phaseWord(const zoneInfo& z)
{
    if (z.phase == phaseType::fluid) return "fluid";
    return z.fixed ? "clamped" : "solid";
}

}  // namespace

List<zoneInfo> zonesOf(const particleTable& table, const word& file)
{
    const auto listed = [&](const char* key) {
        const auto it = table.attributes.find(key);
        if (it == table.attributes.end())
            throw fatalError(file + " has no attribute '" + key +
                             "'. Make the particles with generateParticles");
        std::istringstream in(it->second);
        return List<word>(std::istream_iterator<word>(in), {});
    };
    const List<word> names = listed("zones"), phases = listed("phases");
    if (names.size() != phases.size() || names.empty())
        throw fatalError(file + ": attributes zones and phases must list as many words");
    List<zoneInfo> zones;
    for (size_t z = 0; z < names.size(); ++z)
    {
        if (phases[z] != "fluid" && phases[z] != "solid" && phases[z] != "clamped")
            throw fatalError(file + ": unknown phase '" + phases[z] + "'. " +
                             validWords("phase", {"fluid", "solid", "clamped"}));
        zones.push_back({names[z], phases[z] == "fluid" ? phaseType::fluid : phaseType::solid,
                         phases[z] == "clamped"});
    }
    return zones;
}

namespace entries
{

static stateEntry<List<scalar>> balanceOf(const patchBalance& b)
{
    return {"balance." + b.name};
}

}  // namespace entries

namespace
{

void writeZones(const particleCloud& cloud, particleTable& table)
{
    List<word> names, phases;
    for (const zoneInfo& z : cloud.zones) names.push_back(z.name), phases.push_back(phaseWord(z));
    table.attributes["zones"] = join(names);
    table.attributes["phases"] = join(phases);
}

// True for attributes that readCloud and tableOf handle
bool isKnown(const word& attribute)
{
    for (const char* known :
         {"nDims", "dx", "time", "timeIndex", "deltaT", "nextId", "zones", "phases"})
        if (attribute == known) return true;
    return false;
}

[[noreturn]] void failWithoutState(const Time& time)
{
    List<word> present;
    for (const Time::folderOfTime& f : time.folders())
        if (time.hasState(f.name)) present.push_back(f.name);
    const word missing =
        fs::exists(time.folder() + "/positions") ? "/uniform/particles" : "/particles.hdf";
    throw fatalError("There are no particles of time " + time.timeName() + ": " + time.folder() +
                     missing + " is missing.\n" +
                     (present.empty() ? "generateParticles makes those of time 0."
                                      : "Times with particles: " + join(present) +
                                            "; startFrom and startTime in system/controlDict "
                                            "choose one of them."));
}

// Reads the present state.  If the last state is damaged, the user has to choose an earlier one
particleTable readStateOf(const Time& time)
{
    if (!time.hasState(time.folderName(time.value()))) failWithoutState(time);
    try
    {
        return readState(time.folder());
    }
    catch (const fatalError& e)
    {
        word before;
        for (const Time::folderOfTime& f : time.folders())
            if (f.t < time.value() && f.name != time.folderName(time.value()) &&
                time.hasState(f.name))
                before = f.name;
        if (before.empty()) throw;
        const word advice = "\nTo continue from time " + before + ", move the folder " +
                            time.folder() + " away, or set startFrom startTime and startTime " +
                            before + " in system/controlDict.";
        if (e.hasLocation()) throw fatalError(e.what() + advice, e.location());
        throw fatalError(e.what() + advice);
    }
}

// Writes <file>.series for ParaView, with all times that have such a file; removes it if no time has one
void writeSeriesOf(const Time& time, const word& file, const List<word>& without)
{
    List<seriesEntry> series;
    for (const Time::folderOfTime& f : time.folders())
        if (std::find(without.begin(), without.end(), f.name) == without.end() &&
            fs::exists(time.caseFolder() + "/" + f.name + "/" + file))
            series.push_back({time.timeOf(f), f.name + "/" + file});
    const word path = time.caseFolder() + "/" + file + ".series";
    if (!series.empty()) writeSeries(path, series);
    else fs::remove(path);
}

void setClock(Time& time, const particleTable& table, const word& file)
{
    if (!table.attributes.count("timeIndex")) return;
    const scalar t = table.scalarAttribute("time"), deltaT = table.scalarAttribute("deltaT");
    const label index = label(table.scalarAttribute("timeIndex"));
    if (!time.hasClock())
        warning(time.folder() + "/uniform/time is missing: the clock is set from the particles");
    else if (std::abs(t - time.value()) > 1e-9 * std::abs(t))
        return warning("The particles in " + file + " were written at time " + str(t, 10) +
                       ": they are taken for those of time " + str(time.value(), 10) +
                       ", as their folder or uniform/time in it says");
    else if (index != time.timeIndex() || deltaT != time.deltaTBehind())
        warning(time.folder() + "/uniform/time is not of these particles: step " +
                std::to_string(time.timeIndex()) + " of " + str(time.deltaTBehind()) + " s, not " +
                std::to_string(index) + " of " + str(deltaT) +
                " s. The clock is set from the particles");
    else return;
    time.recall(t, index, deltaT, file);
}

void readParticlesOf(const particleTable& table, const word& file, particleCloud& cloud)
{
    const auto column = [&](const auto& columns, const char* name) -> const auto&
    {
        const auto it = columns.find(name);
        if (it == columns.end()) throw fatalError(file + " has no field '" + word(name) + "'");
        return it->second;
    };
    const auto& zone = column(table.integers, "zone");
    const auto& id = column(table.integers, "id");
    const auto& U = column(table.vectors, "U");
    const auto& p = column(table.scalars, "p");
    for (size_t i = 0; i < table.size(); ++i)
    {
        if (zone[i] < 0 || zone[i] >= globalId(cloud.zones.size()))
            throw fatalError(file + ": particle " + std::to_string(id[i]) + " has zone " +
                             std::to_string(zone[i]) + ", but there are " +
                             std::to_string(cloud.zones.size()));
        cloud.append(table.x[i], std::uint8_t(zone[i]), vec4::from(U[i], p[i]), id[i]);
    }
}

bool isZero(const List<scalar>& values)
{
    return std::all_of(values.begin(), values.end(), [](scalar v) { return v == 0; });
}

void readFields(const particleTable& table, particleCloud& cloud)
{
    for (const auto& [name, values] : table.scalars)
        if (name != "p") cloud.scalars[name] = values;
    for (const auto& [name, values] : table.integers)
        if (name != "zone" && name != "id") cloud.integers[name] = values;
    for (const auto& [name, values] : table.vectors)
        if (name != "U")
        {
            List<vec4>& field = cloud.vectors[name];
            for (const vector& v : values) field.push_back(vec4::from(v));
            // the fourth component of a registered field is stored as a scalar of the same name
            const auto w = table.scalars.find(name + ":w");
            if (w == table.scalars.end() || isZero(w->second)) continue;
            for (size_t i = 0; i < field.size(); ++i) field[i][3] = w->second[i];
            cloud.scalars.erase(name + ":w");
        }
    if (cloud.nSolid() > 0 && !cloud.vectors.count("x0"))
    {
        List<vec4>& x0 = cloud.vectors["x0"];
        x0 = cloud.x;
        std::fill(x0.begin() + cloud.nSolid(), x0.end(), vec4{});
    }
}

particleTable tableOf(const Time& time, const particleCloud& cloud, const boundary& walls)
{
    particleTable table;
    for (label i = 0; i < cloud.n(); ++i)
    {
        table.x.push_back(cloud.x[i].xyz());
        table.vectors["U"].push_back(cloud.Up[i].xyz());
        table.scalars["p"].push_back(cloud.Up[i][3]);
        table.integers["zone"].push_back(cloud.zone[i]);
        table.integers["id"].push_back(cloud.id[i]);
    }
    for (const auto& [name, values] : cloud.scalars) table.scalars[name] = values;
    for (const auto& [name, values] : cloud.integers) table.integers[name] = values;
    for (const auto& [name, values] : cloud.vectors)
    {
        List<scalar> w;
        for (label i = 0; i < cloud.n(); ++i)
            table.vectors[name].push_back(values[i].xyz()), w.push_back(values[i][3]);
        if (name != "x0" && !isZero(w)) table.scalars[name + ":w"] = std::move(w);
    }
    stepState state = cloud.state;
    for (const patchBalance& b : walls.balance()) state.set(entries::balanceOf(b), b.state());
    table.extra = state.values();
    table.attributes = cloud.notes;
    table.setAttribute("nDims", cloud.nDims), table.setAttribute("dx", cloud.dx);
    table.setAttribute("time", time.value()), table.setAttribute("timeIndex", time.timeIndex());
    table.setAttribute("deltaT", time.deltaT());
    table.attributes["nextId"] = std::to_string(cloud.nextId());
    writeZones(cloud, table);
    return table;
}

}  // namespace

void readCloud(Time& time, particleCloud& cloud)
{
    const word file = time.folder();
    const particleTable table = readStateOf(time);
    if (table.size() == 0) throw fatalError(file + " holds no particle");
    setClock(time, table, file);
    cloud.nDims = int(table.scalarAttribute("nDims"));
    cloud.dx = table.scalarAttribute("dx");
    if (cloud.nDims != 2 && cloud.nDims != 3) throw fatalError(file + ": nDims must be 2 or 3");
    if (!(cloud.dx > 0)) throw fatalError(file + ": dx must be positive");
    cloud.zones = zonesOf(table, file);
    readParticlesOf(table, file, cloud);
    readFields(table, cloud);
    for (const auto& [name, values] : table.extra)  // version 1: "history.<name>"
        cloud.state.set(
            stateEntry<List<scalar>>{name.rfind("history.", 0) == 0 ? name.substr(8) : name},
            values);
    for (const auto& [name, text] : table.attributes)
        if (!isKnown(name)) cloud.notes[name] = text;
    if (table.attributes.count("nextId") && table.scalarAttribute("nextId") > 0)
        cloud.setNextId(std::stoll(table.attributes.at("nextId")));
}

void restoreBalance(const particleCloud& cloud, boundary& walls)
{
    List<patchBalance> balance = walls.balance();
    for (patchBalance& b : balance) b.restore(cloud.state.get(entries::balanceOf(b), {}));
    walls.restoreBalance(balance);
}

void writeCloud(Time& time, const particleCloud& cloud, const boundary& walls)
{
    cloud.checkFinite(time.value());
    const particleTable table = tableOf(time, cloud, walls);

    writeState(table, time.folder(), time.writesAscii() ? stateFormat::ascii : stateFormat::hdf5,
               time.writePrecision() ? time.writePrecision() : 6);
    time.writeState();  // last: where this file is, the particles are complete, unless somebody has removed them

    const List<word> purge = time.toPurge();
    // first in the series, then the files
    for (const word file : {"particles.hdf", "particles.vtp"}) writeSeriesOf(time, file, purge);
    for (const word& folder : purge) fs::remove_all(time.caseFolder() + "/" + folder);
}

}  // namespace ispf
