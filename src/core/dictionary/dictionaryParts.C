// SPDX-License-Identifier: GPL-3.0-or-later
// Lists without a keyword, and #includeFunc
#include "dictionaryParser.H"

#include "fileNames.H"
#include <algorithm>

namespace ispf
{

namespace
{

token named(const token& at, const word& text)
{
    token t = at;
    t.kind = token::plain, t.text = text;
    return t;
}

// Splits a,b=(c,d),e at the commas outside of brackets: a  b=(c,d)  e
List<word> argumentsIn(const word& text)
{
    List<word> arguments(1);
    int depth = 0;
    for (const char c : text)
    {
        depth += (c == '(') - (c == ')');
        if (c == ',' && depth == 0) arguments.emplace_back();
        else if (c != ' ' || !arguments.back().empty()) arguments.back() += c;
    }
    return arguments;
}

// Sets the arguments of a function; a name without = is a field
void setArguments(dictionary& function, const List<word>& arguments)
{
    List<word> fields;
    for (const word& argument : arguments)
        if (const size_t equals = argument.find('='); equals == word::npos)
            fields.push_back(argument);
        else function.set(argument.substr(0, equals), argument.substr(equals + 1));
    if (fields.size() == 1) function.set("field", fields[0]);
    if (!fields.empty())
        function.set("fields", std::to_string(fields.size()) + "(" + join(fields) + ")");
}

}  // namespace

// True for 2(...) or (...) in a part of a dictionary
bool dictionaryParser::opensList(const token& t, source& in) const
{
    scalar count;
    return isPart_ &&
           (t.is('(') || (t.isPlain() && readNumber(t.text, count) && in.peek().is('(')));
}

// Reads a list of dictionaries, a { ... } b { ... }, or of other things
void dictionaryParser::parseList(const token& first, source& in)
{
    const token key = named(first, "entry" + std::to_string(here().entries.size()));
    const token opening = first.is('(') ? first : in.take();
    const bool ofDicts =
        in.peek().is(')') ||
        ((in.peek().isPlain() || in.peek().kind == token::quoted) && in.peek(1).is('{'));
    if (ofDicts)
    {
        dictionary inner = newDict(key);
        scopes_.push_back(inner.content_.get());
        parseStatements(in, &opening);
        scopes_.pop_back();
        place(key, std::move(inner), in.line);
    }
    else
    {
        List<token> value;
        if (!first.is('(')) value.push_back(first);
        value.push_back(opening);
        for (int depth = 1; depth > 0; depth += value.back().is('(') - value.back().is(')'))
        {
            if (!in.carriesOn()) fail("The bracket ( opened here is never closed.", opening);
            value.push_back(in.take());
        }
        place(key, std::move(value), in.line);
    }
    here().exact(key.text)->named = false;
}

// #includeFunc name, #includeFunc name(U, fields=(p U)): reads the dictionary in system/name or in
// etc/caseDicts/postProcessing; in this file the name may stand around it
void dictionaryParser::includeFunction(source& in)
{
    const token first = in.take();
    if (first.kind != token::quoted && first.kind != token::plain)
        fail("#includeFunc wants the name of a file in system, found " + first.described() + ".",
             first);
    const word call = first.text + functionArguments(first, in);
    const size_t open = std::min(call.find('('), call.size());
    const word name = call.substr(0, open);
    word path = expandPath("<system>/" + name);
    if (!isFile(path)) path = etcFileBelow("caseDicts/postProcessing", name);
    if (path.empty())
        fail("There is no file system/" + name +
                 ", and none of that name in OpenFOAM's "
                 "etc/caseDicts/postProcessing.",
             first);
    enterFile(path, first);

    word key = call;
    std::erase_if(key, [](char c) { return word(" \t\"'/;{}").find(c) != word::npos; });
    const token keyToken = named(first, key);
    dictionary read = newDict(keyToken);
    scopes_.push_back(read.content_.get());
    parseFile(path);
    scopes_.pop_back();
    const dictionaryEntry* inner = read.content_->exact(name);
    dictionary function = inner && inner->isDict() ? *inner->dict : read;
    if (open + 2 < call.size())
        setArguments(function, argumentsIn(call.substr(open + 1, call.size() - open - 2)));
    place(keyToken, std::move(function), first.line);
}

// Arguments with blanks: (U, fields=(p U))
word dictionaryParser::functionArguments(const token& name, source& in)
{
    if (!in.peek().is('(') || in.peek().line != name.line) return "";
    word text;
    int depth = 0;
    do {
        const token t = in.take();
        if (t.kind == token::end) fail("The bracket ( opened here is never closed.", name);
        depth += t.is('(') - t.is(')');
        text += (text.empty() ? "" : " ") + t.text;
    } while (depth > 0);
    return text;
}

}  // namespace ispf
