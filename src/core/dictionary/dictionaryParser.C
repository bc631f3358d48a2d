// SPDX-License-Identifier: GPL-3.0-or-later
#include "dictionaryParser.H"

#include "fileNames.H"
#include <algorithm>

namespace ispf
{

namespace
{

constexpr size_t depthLimit = 200;         // of nested dictionaries; far beyond any sensible case
constexpr size_t spendingLimit = 2000000;  // words that macros and includes may add
constexpr size_t patternLimit = size_t(1) << 26;  // bytes of keys that are regular expressions

}  // namespace

const token& dictionaryParser::source::peek(size_t k)
{
    while (ahead.size() <= k) ahead.push_back(reader.next());
    return ahead[k];
}

token dictionaryParser::source::take()
{
    token t = peek();
    line = t.line;
    if (t.kind != token::end) ahead.pop_front();
    return t;
}

void dictionaryParser::fail(const word& message, const token& at) const
{
    throw fatalError(message, at.where(scopes_.back()->scope));
}

// Limits the words that macros of macros and files of files add
void dictionaryParser::spend(size_t weight, const token& at)
{
    spent_ += weight;
    if (spent_ > spendingLimit)
        fail("Macros and included files let this dictionary grow beyond " +
                 std::to_string(spendingLimit) + " words.",
             at);
}

// Limits the memory of regular expressions
void dictionaryParser::spendOn(const regularExpression& pattern, const token& key)
{
    patternBytes_ += pattern.bytes();
    if (patternBytes_ > patternLimit)
        fail("The keys of this dictionary that are regular expressions take more than " +
                 std::to_string(patternLimit >> 20) +
                 " MB. Simplify them, or write the keys themselves.",
             key);
}

void dictionaryParser::parseFile(const word& path)
{
    parseText(readText(path), path);
}

void dictionaryParser::parseText(const word& text, const word& name)
{
    if (files_.empty()) scopes_.front()->path = name;
    files_.push_back(name);
    source in(text, name);
    parseStatements(in, nullptr);
    files_.pop_back();
}

List<token> dictionaryParser::parseValue(const word& text, const word& name)
{
    const word statement = text + "\n;";
    source in(statement, name);
    List<token> value;
    parseValueTokens(in.peek(), in, value);
    if (in.carriesOn()) fail("Unexpected " + in.peek().described() + ".", in.peek());
    return value;
}

void dictionaryParser::parseStatements(source& in, const token* opening)
{
    const size_t conditions = in.conditions.size();
    for (;;)
    {
        const token t = in.take();
        const bool ends = t.kind == token::end || (opening && t.is(opening->is('(') ? ')' : '}'));
        if (ends && in.conditions.size() > conditions)
            fail("The #" + in.conditions.back().text + " here has no #endif.",
                 in.conditions.back());
        if (t.kind == token::end && opening)
            fail("The bracket " + opening->text +
                     " opened here is never closed; the file ends at line " +
                     std::to_string(t.line) + ".",
                 *opening);
        if (ends) return;
        if (t.kind == token::directive) parseDirective(t, in);
        else if (t.kind == token::variable) parseMacroStatement(t, in);
        else if (opensList(t, in)) parseList(t, in);
        else if (t.kind == token::plain || t.kind == token::quoted) parseEntry(t, in);
        else if (t.is('}')) fail("A closing brace } without an opening one.", t);
        else if (!t.is(';'))  // a stray ; does no harm
            fail("A keyword is wanted here, found " + t.described() + ".", t);
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
    const int lineEnd = value.empty() ? key.line : value.back().line;
    place(key, std::move(value), lineEnd);
}

dictionary dictionaryParser::newDict(const token& key)
{
    dictionary d;
    d.content_->path = *key.file;
    d.content_->scope = here().scopeOf(key.text);
    d.content_->line = key.line;
    return d;
}

// A dictionary is read by itself and then merged into an earlier one: its macros do not see the entries
// of that one
void dictionaryParser::parseSubDict(const token& key, source& in)
{
    const bool startsFile = scopes_.size() == 1 || files_.size() > 1;
    if (key.text == "FoamFile" && startsFile) return parseHeader(key, in);
    const token opening = in.take();
    if (scopes_.size() > depthLimit)
        fail("Dictionaries are nested deeper than " + std::to_string(depthLimit) + " levels.", key);
    dictionary inner = newDict(key);
    scopes_.push_back(inner.content_.get());
    parseStatements(in, &opening);
    scopes_.pop_back();
    inner.content_->lineEnd = in.line;
    place(key, std::move(inner), in.line);
}

// The header describes the file and is not a part of its contents
void dictionaryParser::parseHeader(const token& key, source& in)
{
    const token opening = in.take();
    const auto header = std::make_shared<dictionary>(newDict(key));
    scopes_.push_back(header->content_.get());
    parseStatements(in, &opening);
    scopes_.pop_back();
    header->content_->lineEnd = in.line;
    if (files_.size() < 2) here().header = header;
    if (header->chooseOrDefault("format", {"ascii", "binary"}, "ascii") == "ascii") return;
    binaryLayout layout;
    const word arch = header->getOrDefault<word>("arch", "LSB;label=32;scalar=64");
    const auto has = [&](const char* what) { return arch.find(what) != word::npos; };
    if (!(has("LSB") || has("MSB")) || !(has("label=32") || has("label=64")) ||
        !(has("scalar=32") || has("scalar=64")))
        header->fail("arch", "The arch \"" + arch +
                                 "\" is not understood; it reads like \"LSB;label=32;scalar=64\".");
    layout.bigEndian = has("MSB");
    layout.labelSize = has("label=64") ? 8 : 4;
    layout.scalarSize = has("scalar=64") ? 8 : 4;
    in.reader.setBinary(layout);
}

void dictionaryParser::parseValueTokens(const token& key, source& in, List<token>& value)
{
    List<token> open;
    // Gauss multivariateSelection { fu vanLeer; };  a value ends with its block
    bool inBlock = false;
    for (;;)
    {
        const token t = in.take();
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
            if (open.empty() && inBlock && !in.peek().is(';'))
                fail(
                    "Unexpected { in the value of '" + key.text + "'; the ';' after it is missing.",
                    key);
        }
        scalar count;
        const bool uniformList = !value.empty() && readNumber(value.back().text, count);
        if (open.empty()) inBlock = t.is('{') && !uniformList;
        if (t.is('(') || t.is('[') || t.is('{')) open.push_back(t);
        if (t.kind == token::variable) appendMacro(t, !open.empty() && open.back().is('{'), value);
        else if (t.kind == token::directive) appendValueDirective(key, t, in, value);
        else value.push_back(t);
    }
}

// Makes room for an entry; null if an earlier entry of that key has to stay
dictionaryEntry* dictionaryParser::free(const token& key, bool isDict)
{
    if (const auto pattern = keyPattern(key)) spendOn(*pattern, key);
    if (const dictionaryEntry* old = here().exact(key.text))
    {
        const word twice = "The entry '" + key.text + "' stands twice, first at line " +
                           std::to_string(old->line) + ".";
        if (mode_ == inputMode::error) fail(twice, key);
        if (mode_ == inputMode::warn)
            warning(twice + " The later one, " + *key.file + " line " + std::to_string(key.line) +
                    ", is ignored.");
        if (mode_ == inputMode::warn || mode_ == inputMode::protect) return nullptr;
        if (mode_ == inputMode::merge && isDict && old->isDict()) return here().exact(key.text);
    }
    return &here().renewed(key);
}

void dictionaryParser::place(const token& key, List<token>&& value, int lineEnd)
{
    dictionaryEntry* e = free(key, false);
    if (!e) return;
    e->value = std::move(value);
    e->lineEnd = lineEnd;
}

void dictionaryParser::place(const token& key, dictionary&& dict, int lineEnd)
{
    dictionaryEntry* e = free(key, true);
    if (!e) return;
    e->lineEnd = lineEnd;
    if (e->isDict()) merge(*e->dict->content_, *dict.content_, scopes_.size());
    else e->dict.emplace(std::move(dict));
    e->dict->content_->lineEnd = lineEnd;
}

void dictionaryParser::merge(dictionary::content& to, const dictionary::content& from, size_t depth)
{
    if (depth > depthLimit)
        throw fatalError(
            "Macros nest dictionaries deeper than " + std::to_string(depthLimit) + " levels.",
            to.where());
    for (const dictionaryEntry& f : from.entries)
    {
        token key;
        key.kind = f.quoted ? token::quoted : token::plain;
        key.text = f.key, key.line = f.line, key.file = f.file;
        spend(8 + f.value.size(), key);
        if (f.pattern) spendOn(*f.pattern, key);
        dictionaryEntry* e = to.exact(f.key);
        if (!e || !e->isDict() || !f.isDict()) e = &to.renewed(key);
        e->lineEnd = f.lineEnd;
        e->value = f.value;
        if (!f.isDict()) continue;
        if (!e->isDict())
        {
            dictionary::content& inner = *e->dict.emplace().content_;
            inner.path = f.dict->path(), inner.scope = to.scopeOf(f.key);
            inner.line = f.dict->content_->line, inner.lineEnd = f.dict->content_->lineEnd;
        }
        merge(*e->dict->content_, *f.dict->content_, depth + 1);
    }
}

}  // namespace ispf
