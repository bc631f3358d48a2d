// SPDX-License-Identifier: GPL-3.0-or-later
// controlDict, the time folders and uniform/time.
#include "Time.H"

#include "checksum.H"
#include "fileNames.H"
#include "token.H"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <ostream>

namespace ispf
{

namespace
{

constexpr int byKind = 0;  // writePrecision
constexpr scalar never = std::numeric_limits<scalar>::infinity();

word formattedTime(const char* form, int precision, scalar t)
{
    char text[64];
    std::snprintf(text, sizeof text, form, precision, t);
    return text;
}

// True if `name` is a way of writing t with some timeFormat and timePrecision.  A name that growPrecision accepts
// is one at every precision
bool isNameOf(const word& name, scalar t, scalar deltaT)
{
    if (scalar number; readNumber(name, number) &&
                       std::abs(number - t) <= std::max(0.1 * deltaT, 1e-12 * std::abs(t)))
        return true;
    for (int precision = 3; precision <= 17; ++precision)
        for (const char* form : {"%.*g", "%.*f", "%.*e"})
            if (formattedTime(form, precision, t) == name) return true;
    return false;
}

// Checksum in uniform/time
globalId clockChecksum(scalar value, label index, scalar deltaT)
{
    checksum sum;
    sum.add(List<scalar>{value, scalar(index), deltaT});
    return sum.value();
}

struct clock
{
    scalar value;
    label index;
    scalar deltaT;
};

// Reads the clock.  Without the checksum an error in index or deltaT would not be noticed.  Files of earlier versions have
// none
clock clockOf(const dictionary& d)
{
    const clock c = {d.get<scalar>("value"), d.get<label>("index"), d.get<scalar>("deltaT")};
    if (d.found("checksum") &&
        d.get<word>("checksum") != std::to_string(clockChecksum(c.value, c.index, c.deltaT)))
        d.fail("checksum", "It does not fit value, index and deltaT: " + d.path() +
                               " was damaged, or edited. If you have edited it, take the entry "
                               "'checksum' out of it; without the file the clock is set from the "
                               "particles.");
    return c;
}

// The files of a time folder without a state
struct leftOver
{
    List<word> state, foreign;  // files that only a state has, and other files
    bool interrupted = false;   // the program was ended while it wrote a file

    explicit leftOver(const word& folder)
    {
        for (const word& sub : {word(), word("uniform/")})
        {
            std::error_code error;
            for (const auto& item : std::filesystem::directory_iterator(folder + "/" + sub, error))
            {
                const word name = sub + item.path().filename().string();
                const bool ofState =
                    name == "uniform/time" || name == "positions" || name == "particles.vtp";
                if (item.path().extension() == ".tmp") interrupted = true;
                else if (name != "uniform") (ofState ? state : foreign).push_back(name);
            }
        }
        std::sort(state.begin(), state.end()), std::sort(foreign.begin(), foreign.end());
    }
};

// Warns of a newer folder without a state, or refuses it: the run would overwrite the folder
void passOver(const word& folder)
{
    const leftOver left(folder);
    if (left.interrupted)
        return warning(folder +
                       " was being written when its run was ended: an earlier time is "
                       "taken");
    if (!left.state.empty())
        throw fatalError("The state in " + folder + " is incomplete: " + left.state.front() +
                         " is there, but neither particles.hdf nor uniform/particles. Put it back; "
                         "or remove the folder to continue from an earlier time, or choose one by "
                         "'startFrom startTime' and 'startTime' in system/controlDict");
    if (!left.foreign.empty())
        warning(folder + " holds no particles (but " + left.foreign.front() +
                "): it is passed over");
}

}  // namespace

void Time::readControls(const dictionary& d)
{
    stopAt_ =
        d.chooseOrDefault("stopAt", {"endTime", "writeNow", "noWriteNow", "nextWrite"}, "endTime");
    endTime_ =
        stopAt_ == "endTime" || d.found("endTime") ? d.get<scalar>("endTime", dims::time) : never;
    const scalar dt = d.getInRange("deltaT", 1e-30, 1e30, dims::time);
    maxDeltaT_ = d.getInRangeOrDefault("maxDeltaT", 1e-30, 1e30, 1e30, dims::time);
    if (dt != askedDeltaT_) deltaT_ = std::min(dt, maxDeltaT_);
    askedDeltaT_ = dt;
    adjust_ = d.getOrDefault<bool>("adjustTimeStep", false);
    modifiable_ = d.getOrDefault<bool>("runTimeModifiable", false);
    readWriteControls(d);
    if (stopAt_ == "nextWrite" && writeControl_ == "none" && writeTimes_.empty())
        d.fail("stopAt",
               "There is no next write: writeControl is 'none' and writeTimes are not given");
    for (const char* key : {"startFrom", "startTime"}) d.found(key);
    // entries of OpenFOAM users that have no effect here
    for (const char* key : {"application", "graphFormat", "libs", "writeCompression"}) d.found(key);
}

int Time::askedPrecision(const dictionary& d)
{
    return int(d.getInRangeOrDefault<label>("timePrecision", 1, 17, 6));
}

void Time::readWriteControls(const dictionary& d)
{
    const List<word> controls = {
        "timeStep", "runTime", "adjustableRunTime", "adjustable", "clockTime", "cpuTime", "none"};
    writeControl_ = d.chooseOrDefault("writeControl", controls, "timeStep");
    if (writeControl_ == "adjustable") writeControl_ = "adjustableRunTime";
    if (writeControl_ == "none") d.found("writeInterval");
    else
    {
        const bool counts = writeControl_ == "timeStep";
        writeInterval_ =
            d.getInRange("writeInterval", 1e-30, 1e30, counts ? dims::none : dims::time);
        if (counts && d.get<label>("writeInterval") < 1)
            d.fail("writeInterval", "With 'writeControl timeStep' this counts steps: 1 or more.");
    }
    writeTimes_ = d.getOrDefault<List<scalar>>("writeTimes", {}, dims::time);
    std::sort(writeTimes_.begin(), writeTimes_.end());
    ascii_ = d.chooseOrDefault("writeFormat", {"ascii", "hdf5", "binary"}, "hdf5") == "ascii";
    writePrecision_ = d.getInRangeOrDefault<label>("writePrecision", 1, 17, byKind);
    purge_ = d.getInRangeOrDefault<label>("purgeWrite", 0, 1e9, 0);
    format_ = d.chooseOrDefault("timeFormat", {"general", "fixed", "scientific"}, "general");
    precision_ = std::max(grownPrecision_, askedPrecision(d));
}

void Time::rereadIfModified()
{
    if (!modifiable_) return;
    const std::int64_t stamp = modificationStamp(controlFile());
    if (stamp == controlStamp_ || stamp == 0) return;
    controlStamp_ = stamp;
    try
    {
        Time changed = *this;  // all changes or none
        changed.control_ = dictionary::fromFile(controlFile());
        changed.readControls(changed.control_);
        dictionary others = changed.control_;
        others.remove("functions");  // their readers check them
        others.checkAllRead();
        ++changed.readings_;
        *this = changed;
        info() << "Read the changed " << controlFile() << "\n";
    }
    catch (const fatalError& e)  // an editor may have saved a half-finished file
    {
        warning("The changed controlDict is not used:\n" + formatted(e));
    }
}

scalar Time::chosenStart() const
{
    const List<word> valid = {"startTime", "firstTime", "latestTime"};
    const word from = control_.chooseOrDefault("startFrom", valid, "latestTime");
    const bool given = control_.found("startTime");
    if (from == "startTime") return namedTime(control_.get<scalar>("startTime", dims::time));
    const scalar otherwise = given ? control_.get<scalar>("startTime", dims::time) : 0;
    List<folderOfTime> candidates = folders();
    if (from == "firstTime") return candidates.empty() ? otherwise : candidates.front().t;
    for (; !candidates.empty() && !hasState(candidates.back().name); candidates.pop_back())
        passOver(case_ + "/" + candidates.back().name);
    return candidates.empty() ? otherwise : candidates.back().t;
}

// The time in the name of the folder whose state has the time t to the last digit
scalar Time::namedTime(scalar t) const
{
    const auto isNear = [t](scalar other) { return std::abs(other - t) <= 1e-12 * std::abs(t); };
    const List<folderOfTime> all = folders();
    if (std::any_of(all.begin(), all.end(), [&](const auto& f) { return isNear(f.t); })) return t;
    for (const folderOfTime& f : all)
        if (isNear(timeOf(f))) return f.t;
    return t;
}

List<Time::folderOfTime> Time::folders() const
{
    List<folderOfTime> all;
    for (const word& name : folderNames(case_))
        if (scalar t; readNumber(name, t)) all.push_back({t, name});
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.t < b.t; });
    const auto same = [](const auto& a, const auto& b) { return a.t == b.t; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    return all;
}

word Time::folderName(scalar t) const
{
    if (!stateFolder_.empty() && t == value_) return stateFolder_;
    for (const folderOfTime& f : folders())
        if (std::abs(f.t - t) <= 1e-12 * std::abs(t)) return f.name;
    return timeName(t);
}

bool Time::hasState(const word& name) const
{
    const word folder = case_ + "/" + name;
    return isFile(folder + "/particles.hdf") || isFile(folder + "/uniform/particles");
}

// The folder name has few digits; uniform/time has all of them
void Time::readState()
{
    const dictionary d = dictionary::fromFileIfPresent(folder() + "/uniform/time");
    hasClock_ = !d.empty();
    const scalar named = value_;
    if (hasClock_)
    {
        const auto [value, index, deltaT] = clockOf(d);
        recall(value, index, deltaT, d.path());
    }
    // as many digits as the folder's name has, so that this time keeps the name
    const word name = folderName(named);
    if (scalar number; isFolder(case_ + "/" + name) && readNumber(name, number))
    {
        growPrecision(std::abs(value_ - number) + 1e-12 * std::abs(value_));
        stateFolder_ = name;
    }
}

scalar Time::timeOf(const folderOfTime& f) const
{
    const auto known = timeOf_.find(f.name);
    if (known != timeOf_.end()) return known->second;
    scalar t = f.t;
    try
    {
        const dictionary d = dictionary::fromFileIfPresent(case_ + "/" + f.name + "/uniform/time");
        const clock c = d.empty() ? clock{t, 0, 0} : clockOf(d);
        if (isNameOf(f.name, c.value, c.deltaT)) t = c.value;
    }
    catch (const fatalError&)  // a run that starts there gets the error
    {
    }
    return timeOf_[f.name] = t;
}

void Time::recall(scalar value, label index, scalar deltaT, const word& source)
{
    const word name = folderName(value_);
    if (name != timeName(value) && !isNameOf(name, value, deltaT))
    {
        warning(source + " states time " + str(value, 10) +
                ", but the name of its folder another time: the name of the folder is used.");
        value = value_;
    }
    startTime_ = value_ = previous_ = value;
    index_ = index, deltaTBehind_ = deltaT;
    if (adjust_ || postProcessing_) deltaT_ = std::min(deltaT, maxDeltaT_);
}

void Time::writeState() const
{
    const word name = timeName();
    timeOf_[name] = value_;
    writeText(folder() + "/uniform/time",
              "FoamFile\n{\n    version     2.0;\n    format      ascii;\n"
              "    class       dictionary;\n    location    \"" +
                  name + "/uniform\";\n    object      time;\n}\n\nvalue       " + str(value_, 17) +
                  ";\nname        \"" + name + "\";\nindex       " + std::to_string(index_) +
                  ";\ndeltaT      " + str(deltaT_, 17) + ";\nchecksum    " +
                  std::to_string(clockChecksum(value_, index_, deltaT_)) + ";\n");
}

word Time::timeName(scalar t) const
{
    if (t == 0) t = 0;  // no "-0"
    const char* form = format_ == "fixed" ? "%.*f" : format_ == "scientific" ? "%.*e" : "%.*g";
    return formattedTime(form, precision_, t);
}

}  // namespace ispf
