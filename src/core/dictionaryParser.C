// SPDX-License-Identifier: GPL-3.0-or-later
#include "dictionaryParser.H"

#include "fileNames.H"
#include <algorithm>
#include <cstdlib>

namespace ispf
{

namespace
{

constexpr size_t depthLimit = 200;       // of nested dictionaries; far beyond any sensible case
constexpr size_t lengthLimit = 2000000;  // of a value: macros of macros grow without bound

}  // namespace

void dictionaryParser::fail(const word& message, const token& at) const
{
    throw fatalError(message, at.where(scopes_.back()->scope));
}

void dictionaryParser::parseFile(const word& path)
{
    const word text = readText(path);
    if (files_.empty()) scopes_.front()->path = path;
    files_.push_back(path);
    const List<token> tokens = tokenize(text, path);
    source in{tokens};
    parseStatements(in, nullptr);
    files_.pop_back();
}

void dictionaryParser::parseText(const word& text, const word& name)
{
    scopes_.front()->path = name;
    const List<token> tokens = tokenize(text, name);
    source in{tokens};
    parseStatements(in, nullptr);
}

List<token> dictionaryParser::parseValue(const word& text, const word& name)
{
    const List<token> tokens = tokenize(text + ";", name);
    source in{tokens};
    List<token> value;
    parseValueTokens(in.peek(), in, value);
    if (in.peek().kind != token::end) fail("Unexpected " + in.peek().described() + ".", in.peek());
    return value;
}

void dictionaryParser::parseStatements(source& in, const token* opening)
{
    for (;;)
    {
        const token& t = in.take();
        switch (t.kind)
        {
            case token::end:
                if (opening)
                    fail("The brace { opened here is never closed; the file ends at line " +
                             std::to_string(t.line) + ".",
                         *opening);
                return;
            case token::directive:
                parseDirective(t, in);
                break;
            case token::variable:
                parseMacroStatement(t, in);
                break;
            case token::plain:
            case token::quoted:
                parseEntry(t, in);
                break;
            case token::punctuation:
                if (t.is(';')) break;  // a stray one does no harm
                if (t.is('}') && opening) return;
                if (t.is('}')) fail("A closing brace } without an opening one.", t);
                [[fallthrough]];
            default:
                fail("A keyword is wanted here, found " + t.described() + ".", t);
        }
    }
}

void dictionaryParser::parseEntry(const token& key, source& in)
{
    if (key.text.empty()) fail("A keyword is wanted here, found an empty string.", key);
    scalar number;
    if (key.kind == token::plain && readNumber(key.text, number))
        fail("A keyword is wanted here, found the number " + key.text +
                 ". Perhaps a ';' stands one value too early.",
             key);
    if (in.peek().is('{')) return parseSubDict(key, in);
    if (parseDictMacro(key, in)) return;
    List<token> value;
    parseValueTokens(key, in, value);
    dictionaryEntry* e = place(key, false);
    if (!e) return;
    e->lineEnd = value.empty() ? key.line : value.back().line;
    e->value = std::move(value);
}

void dictionaryParser::parseSubDict(const token& key, source& in)
{
    const token& opening = in.take();
    if (scopes_.size() > depthLimit)
        fail("Dictionaries are nested deeper than " + std::to_string(depthLimit) + " levels.", key);
    if (key.text == "FoamFile" && scopes_.size() == 1)
    {
        // The header describes the file and is no part of its contents
        dictionary header;
        scopes_.push_back(header.content_.get());
        parseStatements(in, &opening);
        scopes_.pop_back();
        if (header.getOrDefault<word>("format", "ascii") != "ascii")
            fail("The header says 'format " + header.get<word>("format") +
                     "', but only ascii can be read.",
                 key);
        return;
    }
    dictionaryEntry* e = place(key, true);
    dictionary ignored;
    dictionary::content& inner = e ? *e->dict.content_ : *ignored.content_;
    if (inner.path.empty()) inner.path = *key.file, inner.scope = here().scopeOf(key.text);
    inner.line = key.line;
    scopes_.push_back(&inner);
    parseStatements(in, &opening);
    scopes_.pop_back();
    inner.lineEnd = in.tokens[in.i - 1].line;
    if (e) e->lineEnd = inner.lineEnd;
}

void dictionaryParser::parseValueTokens(const token& key, source& in, List<token>& value)
{
    List<token> open;
    for (;;)
    {
        const token& t = in.take();
        if (t.is(';') && open.empty()) return;
        if (t.kind == token::end && !open.empty())
            fail("The bracket " + open.back().text + " opened here is never closed.", open.back());
        if (t.kind == token::end || (t.is('}') && open.empty()))
            fail("The ';' after the value of '" + key.text + "' is missing.", key);
        if (t.is(')') || t.is(']') || t.is('}'))
        {
            const char wanted = t.is(')') ? '(' : t.is(']') ? '[' : '{';
            if (open.empty() || !open.back().is(wanted))
                fail("Unbalanced brackets in the value of '" + key.text + "': unexpected '" +
                         t.text + "'.",
                     t);
            open.pop_back();
        }
        scalar count;
        const bool uniformList = !value.empty() && readNumber(value.back().text, count);
        if (t.is('{') && open.empty() && !uniformList)
            fail("Unexpected { in the value of '" + key.text + "'; the ';' after it is missing.",
                 key);
        if (t.is('(') || t.is('[') || t.is('{')) open.push_back(t);
        if (t.kind == token::variable) appendMacro(t, value);
        else if (t.kind == token::directive) refuseDirective(t, true);
        else value.push_back(t);
    }
}

void dictionaryParser::appendMacro(const token& name, List<token>& value)
{
    if (const dictionaryEntry* e = lookup(name))
    {
        if (e->isDict)
            fail("$" + name.text + " is a dictionary and cannot stand inside a value.", name);
        if (value.size() + e->value.size() > lengthLimit)
            fail("The value grows beyond " + std::to_string(lengthLimit) + " words.", name);
        markRead(*e);
        value.insert(value.end(), e->value.begin(), e->value.end());
    }
    else if (const char* variable = std::getenv(name.text.c_str()))
        value.push_back({token::quoted, variable, name.line, name.file});
    else fail("The macro $" + name.text + " names no entry above this line.", name);
}

bool dictionaryParser::parseDictMacro(const token& key, source& in)
{
    if (in.peek().kind != token::variable || !in.peek(1).is(';')) return false;
    const dictionaryEntry* from = lookup(in.peek());
    if (!from || !from->isDict) return false;
    markRead(*from);
    const dictionary copy = from->dict;  // place() may remove the original: a $a;
    in.take(), in.take();
    dictionaryEntry* e = place(key, true);
    if (!e) return true;
    dictionary::content& to = *e->dict.content_;
    if (to.path.empty()) to.path = *key.file, to.scope = here().scopeOf(key.text);
    to.line = e->lineEnd = key.line;
    merge(to, *copy.content_);
    return true;
}

void dictionaryParser::parseMacroStatement(const token& name, source& in)
{
    dictionaryEntry* e = lookup(name);
    if (!e) fail("The macro $" + name.text + " names no entry above this line.", name);
    markRead(*e);
    if (e->isDict)
    {
        const dictionary copy = e->dict;  // it may enclose the place of use
        merge(here(), *copy.content_);
        if (in.peek().is(';')) in.take();
        return;
    }
    // $name value;  the entry gives the keyword
    if (e->value.size() != 1)
        fail("$" + name.text + " is used as a keyword but holds more than one word.", name);
    token key = e->value.front();
    key.line = name.line, key.file = name.file;
    parseEntry(key, in);
}

dictionaryEntry* dictionaryParser::lookupIn(dictionary::content& from, const word& path)
{
    if (dictionaryEntry* e = from.find(path)) return e;
    for (size_t dot = path.find('.'); dot != word::npos; dot = path.find('.', dot + 1))
    {
        dictionaryEntry* e = from.find(path.substr(0, dot));
        if (!e || !e->isDict) continue;
        if (dictionaryEntry* inner = lookupIn(*e->dict.content_, path.substr(dot + 1)))
            return inner;
    }
    return nullptr;
}

dictionaryEntry* dictionaryParser::lookup(const token& name)
{
    const word& path = name.text;
    if (path.empty()) fail("A macro without a name.", name);
    if (path[0] == ':') return lookupIn(*scopes_.front(), path.substr(1));
    if (const size_t dots = path.find_first_not_of('.'); dots > 0)
    {
        if (dots == word::npos || dots > scopes_.size())
            fail("$" + path + " points outside the file: there are only " +
                     std::to_string(scopes_.size()) + " levels here.",
                 name);
        return lookupIn(*scopes_[scopes_.size() - dots], path.substr(dots));
    }
    for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
        if (dictionaryEntry* e = lookupIn(**scope, path)) return e;
    return nullptr;
}

dictionaryEntry* dictionaryParser::place(const token& key, bool isDict)
{
    auto& entries = here().entries;
    if (dictionaryEntry* old = here().exact(key.text))
    {
        const word twice = "The entry '" + key.text + "' stands twice, first at line " +
                           std::to_string(old->line) + ".";
        if (mode_ == inputMode::error) fail(twice, key);
        if (mode_ == inputMode::warn)
            warning(twice + " The later one, " + *key.file + " line " + std::to_string(key.line) +
                    ", is ignored.");
        const bool merges = isDict && old->isDict && mode_ == inputMode::merge;
        if (merges || mode_ == inputMode::protect || mode_ == inputMode::warn)
            return merges ? old : nullptr;
        entries.remove_if([&](const dictionaryEntry& e) { return &e == old; });
    }
    dictionaryEntry& e = entries.emplace_back();
    e.key = key.text;
    e.pattern = keyPattern(key);
    e.isDict = isDict;
    e.file = key.file;
    e.line = key.line;
    return &e;
}

void dictionaryParser::merge(dictionary::content& to, const dictionary::content& from)
{
    if (scopes_.size() > depthLimit)
        throw fatalError(
            "Macros nest dictionaries deeper than " + std::to_string(depthLimit) + " levels.",
            to.where());
    scopes_.push_back(&to);
    for (const dictionaryEntry& f : from.entries)
    {
        const token key{f.pattern ? token::quoted : token::plain, f.key, f.line, f.file};
        dictionaryEntry* e = place(key, f.isDict);
        if (!e) continue;
        e->lineEnd = f.lineEnd;
        e->value = f.value;
        if (!f.isDict) continue;
        dictionary::content& inner = *e->dict.content_;
        if (inner.path.empty()) inner.path = f.dict.path(), inner.scope = to.scopeOf(f.key);
        inner.line = f.dict.content_->line, inner.lineEnd = f.dict.content_->lineEnd;
        merge(inner, *f.dict.content_);
    }
    scopes_.pop_back();
}

}  // namespace ispf
