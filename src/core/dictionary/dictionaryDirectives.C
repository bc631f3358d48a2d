// SPDX-License-Identifier: GPL-3.0-or-later
// The statements that begin with #.
#include "dictionaryParser.H"

#include "fileNames.H"
#include <algorithm>
#include <filesystem>
#include <map>

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

const List<word> includes = {"include", "includeEtc", "includeIfPresent", "sinclude",
                             "sincludeEtc"};
const List<word> conditions = {"if", "ifeq", "else", "endif"};

}  // namespace

void dictionaryParser::parseDirective(const token& name, source& in)
{
    if (isOneOf(includes, name.text)) return include(name, in);
    if (isOneOf(conditions, name.text)) return parseCondition(name, in);
    if (name.text == "includeFunc") return includeFunction(in);
    if (name.text == "remove") return removeEntries(in);
    if (name.text == "inputMode") return setInputMode(in);
    refuseDirective(name);
}

void dictionaryParser::refuseDirective(const token& name) const
{
    if (name.text == "codeStream")
        fail(
            "#codeStream is refused: a case file must not run compiled code. "
            "Write the value itself.",
            name);
    if (name.text == "calc" || name.text == "eval" || name.text == "neg")
        fail("#" + name.text + " gives a value; a keyword must stand before it.", name);
    List<word> valid = includes;
    valid.insert(valid.end(), conditions.begin(), conditions.end());
    valid.insert(valid.end(), {"includeFunc", "remove", "inputMode", "calc", "eval", "neg"});
    fail("Unknown directive #" + name.text + "." + didYouMean(name.text, valid) + "\n" +
             validWords("directive", valid),
         name);
}

word dictionaryParser::includedPath(const token& directive, const token& name)
{
    word wanted = name.text;
    // $name of an entry above, else of the environment
    if (wanted.find('$') != word::npos)
    {
        word folded;
        try
        {
            folded = expanded(wanted, name, false);
        }
        catch (const fatalError&)
        {
            folded = wanted;
        }
        wanted = folded;
    }
    wanted = expandPath(wanted);
    if (directive.text.find("Etc") == word::npos)
        return fromFolder(folderOf(*directive.file), wanted);
    const word path = etcFile(wanted);
    if (path.empty() && directive.text == "includeEtc")
        fail("No file '" + wanted +
                 "' in the project's etc folder (sought upwards from the program), nor in that of "
                 "OpenFOAM ($WM_PROJECT_DIR/etc).",
             name);
    return path;
}

void dictionaryParser::enterFile(const word& path, const token& name)
{
    if (!isFile(path)) fail("There is no file " + path + " to include.", name);
    List<word> chain;
    for (const word& f : files_) chain.push_back(canonical(f));
    const auto begin = std::find(chain.begin(), chain.end(), canonical(path));
    if (begin != chain.end())
    {
        const List<word> cycle(files_.begin() + (begin - chain.begin()), files_.end());
        fail("Files include each other in a circle: " + join(cycle, " -> ") + " -> " + path + ".",
             name);
    }
    if (files_.size() > 100) fail("Files include each other more than 100 deep.", name);
    spend(500 + std::filesystem::file_size(path) / 16, name);
}

// Path of the file to read now; empty if it is absent and may be absent
word dictionaryParser::enterInclude(const token& directive, source& in)
{
    const token name = in.take();
    if (name.kind != token::quoted && name.kind != token::plain)
        fail("#" + directive.text + " wants a file name in quotes, found " + name.described() + ".",
             name);
    const word path = includedPath(directive, name);
    const bool optional = directive.text != "include" && directive.text != "includeEtc";
    if (optional && !isFile(path)) return "";
    enterFile(path, name);
    return path;
}

void dictionaryParser::include(const token& directive, source& in)
{
    if (const word path = enterInclude(directive, in); !path.empty()) parseFile(path);
}

// key #include "file";  the file has the value.  Also #calc, #eval and #neg.  #codeStream { ... } is
// kept unread.
void dictionaryParser::appendValueDirective(const token& key, const token& name, source& in,
                                            List<token>& value)
{
    if (name.text == "calc" || name.text == "eval")
    {
        const List<token> result = calculated(name, in);
        value.insert(value.end(), result.begin(), result.end());
    }
    else if (name.text == "neg")
    {
        const List<token> result = negated(name, in);
        value.insert(value.end(), result.begin(), result.end());
    }
    else if (isOneOf(includes, name.text)) includeValue(key, name, in, value);
    else if (name.text == "codeStream" && in.peek().is('{')) carryCode(name, in, value);
    else refuseDirective(name);
}

void dictionaryParser::includeValue(const token& key, const token& directive, source& in,
                                    List<token>& value)
{
    const word path = enterInclude(directive, in);
    if (path.empty()) return;
    files_.push_back(path);
    const word text = readText(path) + "\n;";
    source file(text, path);
    parseValueTokens(key, file, value);
    if (file.carriesOn()) fail("A value is wanted in this file, without any ';'.", file.peek());
    files_.pop_back();
}

void dictionaryParser::carryCode(const token& name, source& in, List<token>& value)
{
    value.push_back(name);
    int depth = 0;
    do {
        const token t = in.take();
        if (t.kind == token::end) fail("The code { begun here is never closed.", name);
        depth += t.is('{') - t.is('}');
        value.push_back(t);
    } while (depth > 0);
}

void dictionaryParser::removeEntries(source& in)
{
    List<token> names;
    const token first = in.take();
    if (first.is('('))
        while (!in.peek().is(')'))
        {
            if (!in.carriesOn()) fail("The list ( begun here is never closed.", first);
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
        List<const dictionaryEntry*> doomed;
        for (const dictionaryEntry& e : here().entries)
            if (e.key == name.text || (pattern && pattern->matches(e.key))) doomed.push_back(&e);
        for (const dictionaryEntry* e : doomed) here().remove(*e);
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
