// SPDX-License-Identifier: GPL-3.0-or-later
// The statements that begin with #.
#include "dictionaryParser.H"

#include "fileNames.H"
#include <algorithm>
#include <filesystem>

namespace ispf
{

namespace
{

word canonical(const word& path)
{
    std::error_code error;
    const auto p = std::filesystem::weakly_canonical(path, error);
    return error ? path : p.string();
}

bool isOneOf(const List<word>& words, const word& w)
{
    return std::find(words.begin(), words.end(), w) != words.end();
}

const List<word> includes = {"include", "includeEtc", "includeIfPresent", "sinclude"};

}  // namespace

void dictionaryParser::parseDirective(const token& name, source& in)
{
    if (isOneOf(includes, name.text))
    {
        const token file = in.take();
        if (file.kind != token::quoted && file.kind != token::plain)
            fail("#" + name.text + " wants a file name in quotes, found " + file.described() + ".",
                 file);
        return include(name, file);
    }
    if (name.text == "remove") return removeEntries(in);
    if (name.text == "inputMode") return setInputMode(in);
    refuseDirective(name, false);
}

void dictionaryParser::refuseDirective(const token& name, bool insideValue) const
{
    static const List<word> planned = {"calc", "eval",  "if",         "ifeq",
                                       "else", "endif", "includeFunc"};
    if (name.text == "codeStream")
        fail(
            "#codeStream is refused: a case file must not run compiled code. "
            "Write the value itself.",
            name);
    List<word> valid = includes;
    valid.insert(valid.end(), {"remove", "inputMode"});
    if (isOneOf(planned, name.text) || (insideValue && isOneOf(valid, name.text)))
        fail("#" + name.text + (insideValue ? " inside a value" : "") +
                 " is not supported yet. Write the value itself.",
             name);
    fail("Unknown directive #" + name.text + ". " + validWords("directive", valid), name);
}

word dictionaryParser::includedPath(const token& directive, const token& name) const
{
    const word wanted = expandPath(name.text);
    if (directive.text != "includeEtc") return fromFolder(folderOf(*directive.file), wanted);
    const word path = etcFile(wanted);
    if (path.empty())
        fail("No file '" + wanted +
                 "' in the project's etc folder (sought upwards from the program).",
             name);
    return path;
}

void dictionaryParser::include(const token& directive, const token& name)
{
    const word path = includedPath(directive, name);
    const bool optional = directive.text == "includeIfPresent" || directive.text == "sinclude";
    if (!isFile(path))
    {
        if (optional) return;
        fail("There is no file " + path + " to include.", name);
    }
    List<word> chain;
    for (const word& f : files_) chain.push_back(canonical(f));
    const auto begin = std::find(chain.begin(), chain.end(), canonical(path));
    if (begin != chain.end())
    {
        const List<word> cycle(files_.begin() + (begin - chain.begin()), files_.end());
        fail("Files include each other in a circle: " + join(cycle, " -> ") + " -> " + path + ".",
             name);
    }
    parseFile(path);
}

void dictionaryParser::removeEntries(source& in)
{
    List<token> names;
    const token first = in.take();
    if (first.is('('))
        while (!in.peek().is(')'))
        {
            if (in.peek().kind == token::end) fail("The list ( begun here is never closed.", first);
            names.push_back(in.take());
        }
    else names.push_back(first);
    if (first.is('(')) in.take();
    for (const token& name : names)
    {
        if (name.kind != token::plain && name.kind != token::quoted)
            fail("#remove wants a keyword or a list of keywords, found " + name.described() + ".",
                 name);
        const auto pattern = keyPattern(name);
        here().entries.remove_if([&](const dictionaryEntry& e) {
            return e.key == name.text || (pattern && std::regex_match(e.key, *pattern));
        });
    }
}

void dictionaryParser::setInputMode(source& in)
{
    const token mode = in.take();
    static const std::map<word, inputMode> modes = {
        {"default", inputMode::merge},       {"merge", inputMode::merge},
        {"overwrite", inputMode::overwrite}, {"protect", inputMode::protect},
        {"warn", inputMode::warn},           {"error", inputMode::error}};
    const auto found = modes.find(mode.text);
    if (found == modes.end())
        fail("Unknown #inputMode '" + mode.text + "'. " +
                 validWords("mode", {"default", "merge", "overwrite", "protect", "warn", "error"}),
             mode);
    mode_ = found->second;
}

}  // namespace ispf
