// SPDX-License-Identifier: GPL-3.0-or-later
#include "argList.H"

#include "fileNames.H"
#include "execution.H"
#include "token.H"
#include <unistd.h>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <ostream>

namespace ispf
{

namespace
{

word padded(const word& text, size_t width)
{
    return text + word(text.size() < width ? width - text.size() : 1, ' ');
}

word clockText(const char* format)
{
    const std::time_t now = std::time(nullptr);
    char text[64];
    std::strftime(text, sizeof text, format, std::localtime(&now));
    return text;
}

word hostName()
{
    char name[256] = "";
    ::gethostname(name, sizeof name - 1);
    return name;
}

const char* buildKind()
{
#if defined(__SANITIZE_ADDRESS__)
    return "Sanitize";
#elif defined(__OPTIMIZE__)
    return "Release";
#else
    return "Debug";
#endif
}

}  // namespace

word version()
{
    return "0.1";
}

argList::argList(const word& program, const word& purpose)
    : program_(program),
      purpose_(purpose),
      options_{{"case", "dir", "the case to work on (default: the current folder)"},
               {"threads", "n", "threads to use (default: all processors)"},
               {"help", "", "print this text"},
               {"version", "", "print the version"}}
{
}

void argList::addSwitch(const word& name, const word& help)
{
    options_.push_back({name, "", help});
}

void argList::addOption(const word& name, const word& valueName, const word& help)
{
    options_.push_back({name, valueName, help});
}

void argList::addArgument(const word& name, const word& help)
{
    wanted_.push_back({name, "", help});
}

const argList::declared* argList::find(const word& name) const
{
    for (const declared& d : options_)
        if (d.name == name) return &d;
    return nullptr;
}

bool argList::parse(int argc, const char* const* argv)
{
    return parse(List<word>(argv + 1, argv + argc));
}

bool argList::parse(const List<word>& words)
{
    command_ = join(words);
    for (size_t i = 0; i < words.size(); ++i) take(words, i);
    if (found("help")) info() << help();
    if (found("version")) info() << program_ << " " << version() << "\n";
    if (found("help") || found("version")) return false;
    if (arguments_.size() < wanted_.size())
        throw fatalError("The argument <" + wanted_[arguments_.size()].name +
                         "> is missing: " + wanted_[arguments_.size()].help + ".\n" + program_ +
                         " -help explains the usage.");
    setCase();
    if (found("threads"))
    {
        const double n = number("threads");
        if (n < 1 || n != int(n)) throw fatalError("-threads wants a whole number from 1 on.");
        setThreads(int(n));
    }
    return true;
}

void argList::take(const List<word>& words, size_t& i)
{
    const word& w = words[i];
    scalar ignored;
    if (w.size() < 2 || w[0] != '-' || readNumber(w, ignored))
    {
        if (arguments_.size() == wanted_.size())
            throw fatalError("Unexpected argument '" + w + "'.\n" + program_ +
                             " -help explains the usage.");
        arguments_.push_back(w);
        return;
    }
    const word name = w.substr(w[1] == '-' ? 2 : 1);
    const declared* d = find(name);
    if (!d)
    {
        List<word> valid;
        for (const declared& o : options_) valid.push_back(o.name);
        throw fatalError("Unknown option '" + w + "'." + didYouMean(name, valid) + "\n" +
                         validWords("option", valid) + "\n" + program_ + " -help explains them.");
    }
    if (!d->valueName.empty() && i + 1 == words.size())
        throw fatalError("The option -" + name + " wants a value <" + d->valueName + ">.");
    given_[name] = d->valueName.empty() ? "" : words[++i];
}

void argList::setCase()
{
    const word dir = optionOr("case", ".");
    if (!isFolder(dir)) throw fatalError("The case folder '" + dir + "' does not exist.");
    case_ = std::filesystem::canonical(dir).string();
    const word name = std::filesystem::path(case_).filename().string();
    // for macros, as in OpenFOAM's programs
    for (const auto& [variable, value] : {std::pair<const char*, const word&>{"FOAM_CASE", case_},
                                          {"FOAM_CASENAME", name},
                                          {"FOAM_EXECUTABLE", program_},
                                          {"FOAM_APPLICATION", program_}})
        ::setenv(variable, value.c_str(), 1);
    ::setenv("FOAM_API", "1912", 0);  // version of the dictionary language
}

const word& argList::option(const word& name) const
{
    const auto o = given_.find(name);
    if (o == given_.end()) throw fatalError("The option -" + name + " is needed.");
    return o->second;
}

word argList::optionOr(const word& name, const word& value) const
{
    return found(name) ? option(name) : value;
}

double argList::number(const word& name) const
{
    scalar value;
    if (!readNumber(option(name), value))
        throw fatalError("The option -" + name + " wants a number, found '" + option(name) + "'.");
    return value;
}

double argList::numberOr(const word& name, double value) const
{
    return found(name) ? number(name) : value;
}

word argList::help() const
{
    word text = "\nUsage: " + program_ + " [OPTIONS]";
    for (const declared& a : wanted_) text += " <" + a.name + ">";
    text += "\n" + purpose_ + "\n";
    if (!wanted_.empty()) text += "\nArguments:\n";
    for (const declared& a : wanted_) text += "  " + padded("<" + a.name + ">", 22) + a.help + "\n";
    text += "\nOptions:\n";
    for (const declared& o : options_)
    {
        const word value = o.valueName.empty() ? "" : " <" + o.valueName + ">";
        text += "  " + padded("-" + o.name + value, 22) + o.help + "\n";
    }
    return text + "\n";
}

void argList::printHeader() const
{
    const word rule(75, '-'), thin = "// *" + [] {
        word stars;
        for (int k = 0; k < 36; ++k) stars += " *";
        return stars;
    }() + " //";
    info() << "/*" << rule << "*\\\n"
           << "  ispfFsiFoam: incompressible SPH for fluid-structure interaction\n"
           << "  Version " << version() << ", GPL-3.0-or-later\n"
           << "\\*" << rule << "*/\n"
           << "Build  : " << version() << " " << buildKind() << " (g++ " << __VERSION__ << ")\n"
           << "Exec   : " << program_ << (command_.empty() ? "" : " ") << command_ << "\n"
           << "Date   : " << clockText("%b %d %Y") << "\n"
           << "Time   : " << clockText("%H:%M:%S") << "\n"
           << "Host   : " << hostName() << "\n"
           << "PID    : " << ::getpid() << "\n"
           << "Case   : " << case_ << "\n"
           << "nProcs : 1\n"
           << "nThreads : " << nThreads() << "\n\n"
           << thin << "\n";
}

}  // namespace ispf
