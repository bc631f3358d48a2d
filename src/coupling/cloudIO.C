// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloudIO.H"

#include <algorithm>
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

namespace
{

void writeZones(const particleCloud& cloud, particleTable& table)
{
    List<word> names, phases;
    for (const zoneInfo& z : cloud.zones) names.push_back(z.name), phases.push_back(phaseWord(z));
    table.attributes["zones"] = join(names);
    table.attributes["phases"] = join(phases);
}

}  // namespace

void readCloud(Time& time, particleCloud& cloud)
{
    const word file = time.folder() + "/particles.hdf";
    const particleTable table = readParticles(file);
    if (table.size() == 0) throw fatalError(file + " holds no particle");
    cloud.nDims = int(table.scalarAttribute("nDims"));
    cloud.dx = table.scalarAttribute("dx");
    if (cloud.nDims != 2 && cloud.nDims != 3) throw fatalError(file + ": nDims must be 2 or 3");
    if (!(cloud.dx > 0)) throw fatalError(file + ": dx must be positive");
    cloud.zones = zonesOf(table, file);

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
    for (const auto& [name, values] : table.scalars)
        if (name != "p") cloud.scalars[name] = values;
    for (const auto& [name, values] : table.vectors)
        if (name != "U")
        {
            List<vec4>& field = cloud.vectors[name];
            for (const vector& v : values) field.push_back(vec4::from(v));
            // the fourth component of a registered field travels as a scalar of the same name
            if (const auto w = table.scalars.find(name + ":w"); w != table.scalars.end())
                for (size_t i = 0; i < field.size(); ++i) field[i][3] = w->second[i];
            cloud.scalars.erase(name + ":w");
        }
    if (cloud.nSolid() > 0 && !cloud.vectors.count("x0"))
    {
        List<vec4>& x0 = cloud.vectors["x0"];
        x0 = cloud.x;
        std::fill(x0.begin() + cloud.nSolid(), x0.end(), vec4{});
    }
    for (const auto& [name, values] : table.extra)
        if (name.rfind("history.", 0) == 0) cloud.history[name.substr(8)] = values;
    if (const auto next = table.attributes.find("nextId"); next != table.attributes.end())
        cloud.setNextId(std::stoll(next->second));
}

void restoreBalance(const Time& time, boundary& walls)
{
    const particleTable table = readParticles(time.folder() + "/particles.hdf");
    List<patchBalance> balance = walls.balance();
    for (patchBalance& b : balance)
        if (const auto it = table.extra.find("balance." + b.name); it != table.extra.end())
            b.swept = it->second.at(0), b.created = label(it->second.at(1)),
            b.deleted = label(it->second.at(2)), b.pushed = label(it->second.at(3));
    walls.restoreBalance(balance);
}

void writeCloud(Time& time, const particleCloud& cloud, const boundary& walls)
{
    cloud.checkFinite(time.value());
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
    for (const auto& [name, values] : cloud.vectors)
        for (label i = 0; i < cloud.n(); ++i)
        {
            table.vectors[name].push_back(values[i].xyz());
            if (name != "x0") table.scalars[name + ":w"].push_back(values[i][3]);
        }
    for (const patchBalance& b : walls.balance())
        table.extra["balance." + b.name] = {b.swept, scalar(b.created), scalar(b.deleted),
                                            scalar(b.pushed)};
    for (const auto& [name, values] : cloud.history) table.extra["history." + name] = values;
    table.setAttribute("nDims", cloud.nDims), table.setAttribute("dx", cloud.dx);
    table.setAttribute("time", time.value());
    table.attributes["nextId"] = std::to_string(cloud.nextId());
    writeZones(cloud, table);

    // particles.hdf last: it makes the folder one to continue from
    fs::create_directories(time.folder());
    time.writeState();
    writeParticles(table, time.folder() + "/particles.hdf");

    const List<word> purge = time.toPurge();
    List<seriesEntry> series;
    for (const auto& [t, folder] : time.folders())
        if (time.hasState(folder) && std::find(purge.begin(), purge.end(), folder) == purge.end())
            series.push_back({t, folder + "/particles.hdf"});
    writeSeries(time.caseFolder() + "/particles.hdf.series", series);
    for (const word& folder : purge) fs::remove_all(time.caseFolder() + "/" + folder);
}

}  // namespace ispf
