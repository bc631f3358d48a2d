// SPDX-License-Identifier: GPL-3.0-or-later
// Prints and edits dictionaries, with the options of OpenFOAM's foamDictionary.  An edit changes only the text of
// its entry: comments and layout of the rest stay.  The file is replaced as a whole or not at all.
#include "argList.H"
#include "dictionary.H"
#include "dictionaryText.H"
#include "fileNames.H"
#include "token.H"

#include <algorithm>
#include <filesystem>
#include <ostream>

using namespace ispf;

namespace
{

// Turns :solvers.p and /solvers/p into solvers.p
word dotted(word name)
{
    const bool slashes = name.find('.') == word::npos;
    if (slashes) std::replace(name.begin(), name.end(), '/', '.');
    if (!name.empty() && (name[0] == ':' || name[0] == '.' || name[0] == '/')) name.erase(0, 1);
    return name;
}

// The dictionary that contains the entry of a dotted name, and its key there; null if there is none.  A key that itself
// has dots comes first, a pattern that would match the dots comes last
const dictionary* holderOf(const dictionary& d, const word& name, word& key)
{
    const List<word> exact = d.allKeys();
    const auto isExact = [&](const word& k) {
        return std::find(exact.begin(), exact.end(), k) != exact.end();
    };
    if (isExact(name)) return key = name, &d;
    bool entered = false;
    for (size_t dot = name.find('.'); dot != word::npos; dot = name.find('.', dot + 1))
    {
        const word first = name.substr(0, dot);
        if (!d.isDict(first) || (entered && !isExact(first))) continue;
        entered = true;
        if (const dictionary* found = holderOf(d.subDict(first), name.substr(dot + 1), key))
            return found;
    }
    if (!entered && d.found(name)) return key = name, &d;
    return nullptr;
}

const word header = "FoamFile";

// The same for a file: its header counts as a dictionary
const dictionary* holderInFile(const dictionary& d, const word& name, word& key)
{
    if (const dictionary* holder = holderOf(d, name, key)) return holder;
    if (name.rfind(header + ".", 0) != 0) return nullptr;
    return holderOf(d.header(), name.substr(header.size() + 1), key);
}

word indented(const word& lines)
{
    word text;
    for (size_t i = 0, e; i < lines.size(); i = e)
    {
        e = lines.find('\n', i) + 1;
        text += "    " + lines.substr(i, e - i);
    }
    return text;
}

List<word> wordsOf(const List<token>& tokens)
{
    List<word> words;
    for (const token& t : tokens)
        if (t.kind != token::end) words.push_back(t.text);
    return words;
}

// True if the values are equal; numbers are compared by value: 1.0 is 1
bool alike(const List<word>& a, const List<word>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const word& v, const word& w) {
        scalar x = 0, y = 0;
        return v == w || (readNumber(v, x) && readNumber(w, y) && x == y);
    });
}

// Entries of a that b lacks or has with another value
word differences(const dictionary& a, const dictionary& b)
{
    word text;
    for (const word& key : a.allKeys())
    {
        if (!b.found(key)) text += a.toString(key);
        else if (a.isDict(key) && b.isDict(key))
        {
            const word inner = differences(a.subDict(key), b.subDict(key));
            if (inner.empty()) continue;
            text += key + "\n{\n" + indented(inner) + "}\n";
        }
        else if (a.isDict(key) || b.isDict(key) ||
                 !alike(wordsOf(tokenize(a.valueText(key), "")),
                        wordsOf(tokenize(b.valueText(key), ""))))
            text += a.toString(key);
    }
    return text;
}

// The same for the text of files, with macros and directives as they are written
word textDifferences(const dictionaryText& a, const dictionaryText& b, const word& scope = "")
{
    word text;
    for (const word& key : a.keys(scope))
    {
        const word name = scope.empty() ? key : scope + "." + key;
        const auto words = [&](const dictionaryText& d) {
            return wordsOf(tokenize(d.entry(name), ""));
        };
        if (b.found(name) && a.isDict(name) && b.isDict(name))
        {
            const word inner = textDifferences(a, b, name);
            if (!inner.empty()) text += key + "\n{\n" + indented(inner) + "}\n";
        }
        else if (!b.found(name) || !alike(words(a), words(b))) text += a.entry(name) + "\n";
    }
    return text;
}

word differences(const argList& args, const word& path, const word& other)
{
    if (!args.found("disableFunctionEntries"))
    {
        const dictionary a = dictionary::fromPart(readText(path), path),
                         b = dictionary::fromPart(readText(other), other);
        const word inHeader = differences(a.header(), b.header());
        return (inHeader.empty() ? "" : header + "\n{\n" + indented(inHeader) + "}\n") +
               differences(a, b);
    }
    const dictionaryText a(readText(path), path), b(readText(other), other);
    word text;
    const List<word> there = b.includes();
    for (const word& file : a.includes())
        if (std::find(there.begin(), there.end(), file) == there.end())
            text += "#include " + inQuotes(file) + "\n";
    return text + textDifferences(a, b);
}

// True if the file, read as programs do, has the value; a macro, a file or a condition may change it
bool holds(const dictionaryText& text, const word& path, const word& name, const word& value)
{
    const bool toDict = !value.empty() && value[0] == '{';
    if (value.find_first_of(toDict ? "$#" : "$#{") != word::npos) return true;
    const dictionary d = dictionary::fromPart(text.text(), path);
    word key;
    const dictionary* holder = holderInFile(d, name, key);
    if (toDict)  // an included file may add entries to it
    {
        const dictionary wanted = dictionary::fromPart("a " + value, path).subDict("a");
        if (name == header) return differences(wanted, d.header()).empty();
        return holder && holder->isDict(key) && differences(wanted, holder->subDict(key)).empty();
    }
    return holder && !holder->isDict(key) &&
           wordsOf(holder->tokenList(key)) == wordsOf(tokenize(value, path));
}

// The part of a dotted name that is a value, although a dictionary is needed there
word valueAbove(const dictionaryText& text, const word& name)
{
    for (size_t dot = name.find('.'); dot != word::npos; dot = name.find('.', dot + 1))
        if (const word above = name.substr(0, dot); text.found(above) && !text.isDict(above))
            return above;
    return "";
}

// The part of a dotted name that is not a dictionary itself but gets its entries from a pattern
word patternAbove(const dictionaryText& text, const dictionary& d, const word& name,
                  const word& scope = "")
{
    const List<word> exact = d.keys();
    word matched;
    for (size_t dot = name.find('.'); dot != word::npos; dot = name.find('.', dot + 1))
    {
        const word first = name.substr(0, dot), above = scope + first;
        if (!d.isDict(first)) continue;
        if (text.holds(above) || std::find(exact.begin(), exact.end(), first) != exact.end())
            return patternAbove(text, d.subDict(first), name.substr(dot + 1), above + ".");
        if (matched.empty()) matched = above;
    }
    return matched;
}

void refusePatternAbove(const dictionaryText& text, const word& path, const word& name)
{
    if (text.holds(name) || text.holds(name.substr(0, name.rfind('.'))) ||
        name.starts_with(header + "."))
        return;
    const word above = patternAbove(text, dictionary::fromPart(text.text(), path), name);
    if (above.empty()) return;
    throw fatalError("There is no dictionary '" + above +
                         "': a pattern matches it, and stands for others as well. Edit the pattern "
                         "under its own name, or add '" +
                         above + "' with all its entries in braces.",
                     {path, above, 0, 0});
}

void edit(const argList& args, dictionaryText& text, const word& path)
{
    const word name = dotted(args.option("entry"));
    refusePatternAbove(text, path, name);
    if (const word above = valueAbove(text, name); !text.holds(name) && !above.empty())
        throw fatalError(
            "'" + above + "' is a value and no dictionary: there is no '" + name + "' in it.",
            {path, above, 0, 0});
    if (args.found("remove"))
    {
        text.remove(name);
        word key;
        if (holderInFile(dictionary::fromPart(text.text(), path), name, key))
            warning("There still is an entry '" + name +
                    "': a pattern matches it, or a macro or an included file brings it");
    }
    else
    {
        const word value = args.option(args.found("set") ? "set" : "add");
        if (args.found("add") && text.holds(name))
            throw fatalError(
                "There is an entry '" + name + "' already; -set changes it, -add does not.",
                {path, name, 0, 0});
        const dictionaryText before = text;
        text.set(name, value);
        for (int outwards = 0; !holds(text, path, name, value); ++outwards)
        {
            text = before;
            if (!text.append(name, value, outwards))
                throw fatalError("'" + name +
                                     "' cannot be set: something else in the file decides its "
                                     "value.",
                                 {path, name, 0, 0});
        }
        info() << "New entry " << text.entry(name) << "\n";
    }
    writeText(std::filesystem::canonical(path).string(), text.text());
}

void printExpanded(const argList& args, const word& path)
{
    const dictionary d = dictionary::fromPart(readText(path), path);
    if (!args.found("entry"))
    {
        if (args.found("keywords")) info() << join(d.allKeys(), "\n") << "\n";
        else info() << d.toString();
        return;
    }
    const word name = dotted(args.option("entry"));
    word key;
    const dictionary* holder = holderInFile(d, name, key);
    if (!holder && name == header && !d.header().keys().empty())
    {
        word lines;
        for (const word& k : d.header().keys()) lines += d.header().toString(k);
        info() << (args.found("keywords") ? join(d.header().keys(), "\n") + "\n"
                                          : header + "\n{\n" + indented(lines) + "}\n");
        return;
    }
    if (!holder)
        throw fatalError("There is no entry '" + name + "'." + didYouMean(name, d.allKeys()) +
                             "\nPresent: " + join(d.allKeys()),
                         {path, "", 0, 0});
    if (args.found("SI")) info() << str(holder->get<scalar>(key, dims::any), 15) << "\n";
    else if (args.found("keywords")) info() << join(holder->subDict(key).allKeys(), "\n") << "\n";
    else if (args.found("value")) info() << holder->valueText(key) << "\n";
    else info() << holder->toString(key);
}

void print(const argList& args, const dictionaryText& text)
{
    const word name = dotted(args.optionOr("entry", ""));
    if (args.found("keywords")) info() << join(text.keys(name), "\n") << "\n";
    else if (name.empty()) info() << text.text();
    else info() << (args.found("value") ? text.value(name) : text.entry(name)) << "\n";
}

int run(int argc, char** argv)
{
    argList args(
        "ispfDictionary",
        "Prints and edits a dictionary. Entries are printed as programs read them, with macros, "
        "#include and #if; the whole file as it is written, if not with -expand.");
    args.addArgument("dict", "the dictionary file, relative to the case");
    args.addOption("entry", "name", "the entry, with its dictionaries: solvers.p.tolerance");
    args.addSwitch("value", "print the value alone");
    args.addSwitch("SI", "print the value alone, a number, in SI units");
    args.addSwitch("keywords", "list the keywords");
    args.addSwitch("expand", "print the whole file with macros, #include, #calc and the like");
    args.addOption("set", "value", "change the entry, or add it");
    args.addOption("add", "value", "add the entry; an error if it is there");
    args.addSwitch("remove", "remove the entry");
    args.addSwitch("includes", "list the files that it includes");
    args.addOption("diff", "dict", "print the entries that differ from those of another file");
    args.addSwitch("disableFunctionEntries", "macros, #include and #if as they are written");
    if (!args.parse(argc, argv)) return 0;
    const word path = fromFolder(args.caseFolder(), args.argument(0));
    const int edits = args.found("set") + args.found("add") + args.found("remove");
    if (edits > 1) throw fatalError("Only one of -set, -add and -remove can be done at a time.");
    if (args.found("diff"))
    {
        const word other = fromFolder(args.caseFolder(), args.option("diff"));
        info() << differences(args, path, other);
        return 0;
    }
    const bool whole = !args.found("entry") && !args.found("keywords") && !args.found("includes");
    const bool read = args.found("expand") || !(whole || args.found("includes"));
    if (edits == 0 && read && !args.found("disableFunctionEntries"))
        return printExpanded(args, path), 0;
    dictionaryText text(readText(path), path);
    if (edits > 0) edit(args, text, path);
    else if (args.found("includes")) info() << join(text.includes(), "\n") << "\n";
    else print(args, text);
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    return runMain([&] { return run(argc, argv); });
}
