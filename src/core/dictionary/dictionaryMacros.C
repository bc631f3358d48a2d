// SPDX-License-Identifier: GPL-3.0-or-later
// The values of $name and ${name}.
#include "dictionaryParser.H"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace ispf
{

namespace
{

token punctuation(char c, const token& at)
{
    token t = at;
    t.kind = token::punctuation, t.text = word(1, c);
    return t;
}

size_t weightOf(const List<token>& words)
{
    size_t weight = words.size();
    for (const token& t : words) weight += t.text.size() / 32;
    return weight;
}

bool isNameCharacter(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
}

// Place in `text` of the brace that closes the one at i
size_t closingBrace(const word& text, size_t i)
{
    int depth = 0;
    for (; i < text.size(); ++i)
    {
        depth += (text[i] == '{') - (text[i] == '}');
        if (depth == 0) return i;
    }
    return word::npos;
}

// name:-default and name:+alternative
struct parameter
{
    word name, alternative;
    char mode = ' ';

    explicit parameter(const word& text) : name(text)
    {
        int depth = 0;
        for (size_t i = 0; i + 1 < text.size(); ++i)
        {
            depth += (text[i] == '{') - (text[i] == '}');
            if (depth > 0 || text[i] != ':' || (text[i + 1] != '-' && text[i + 1] != '+')) continue;
            name = text.substr(0, i), alternative = text.substr(i + 2), mode = text[i + 1];
            return;
        }
    }
};

}  // namespace

List<token> dictionaryParser::wordsOf(const word& text, const token& at)
{
    List<token> words;
    try
    {
        words = tokenize(text, *at.file);
    }
    catch (const fatalError&)
    {
    }
    const auto isWord = [](const token& t) {
        return t.isPlain() || t.kind == token::punctuation || t.kind == token::quoted;
    };
    if (!words.empty()) words.pop_back();
    if (words.empty() || !std::all_of(words.begin(), words.end(), isWord))
    {
        words.assign(1, at);
        words[0].kind = token::quoted, words[0].text = text;
    }
    for (token& t : words) t.line = at.line;
    return words;
}

dictionaryParser::macro dictionaryParser::resolved(const token& name)
{
    const parameter p(name.text);
    macro m;
    if (++lookups_ > 20) fail("Macros in names of macros, more than 20 deep.", name);
    const word key = expanded(p.name, name, false);
    m.entry = lookup(key, name);
    const char* outside = m.entry ? nullptr : std::getenv(key.c_str());
    const bool set = m.entry || (outside && *outside);
    if (p.mode == '+' || (p.mode == '-' && !set))
        m.entry = nullptr,
        m.words = wordsOf(set || p.mode == '-' ? expanded(p.alternative, name, false) : "", name);
    else if (outside) m.words = wordsOf(outside, name);
    else if (!m.entry) fail("The macro $" + name.text + " names no entry above this line.", name);
    --lookups_;
    if (m.entry) markRead(*m.entry);
    return m;
}

void dictionaryParser::appendMacro(const token& name, bool insideBraces, List<token>& value)
{
    const macro m = resolved(name);
    if (m.entry && m.entry->isDict())
    {
        if (!insideBraces)
            fail("$" + name.text + " is a dictionary and cannot stand inside a value.", name);
        return appendDict(*m.entry->dict->content_, name, value);
    }
    const List<token>& words = m.entry ? m.entry->value : m.words;
    spend(weightOf(words), name);
    value.insert(value.end(), words.begin(), words.end());
}

// Appends a dictionary to a list of dictionaries: ( { $base a 2; } )
void dictionaryParser::appendDict(const dictionary::content& from, const token& at,
                                  List<token>& value)
{
    for (const dictionaryEntry& e : from.entries)
    {
        token key = at;
        key.kind = e.quoted ? token::quoted : token::plain, key.text = e.key;
        value.push_back(key);
        spend(4 + weightOf(e.value), at);
        if (e.isDict()) value.push_back(punctuation('{', at));
        if (e.isDict()) appendDict(*e.dict->content_, at, value);
        value.insert(value.end(), e.value.begin(), e.value.end());
        value.push_back(punctuation(e.isDict() ? '}' : ';', at));
    }
}

// key $dict;  copies a dictionary
bool dictionaryParser::parseDictMacro(const token& key, source& in)
{
    if (in.peek().kind != token::variable || !in.peek(1).is(';')) return false;
    const token name = in.peek();
    const macro m = resolved(name);
    if (!m.entry || !m.entry->isDict()) return false;
    in.take(), in.take();
    dictionary copy = newDict(key);
    merge(*copy.content_, *m.entry->dict->content_, scopes_.size());
    place(key, std::move(copy), key.line);
    return true;
}

void dictionaryParser::parseMacroStatement(const token& name, source& in)
{
    macro m;
    m.entry = lookup(expanded(name.text, name, false), name, true);
    if (m.entry) markRead(*m.entry);
    else if (isPart_ && !in.peek().is('{') && !std::getenv(name.text.c_str()))
    {
        warning("$" + name.text + " names no entry above line " + std::to_string(name.line) +
                " of " + *name.file + ": it is left out.");
        return;
    }
    else m = resolved(name);
    if (m.entry && m.entry->isDict())
    {
        const dictionary copy = *m.entry->dict;  // the dictionary may enclose this place
        merge(here(), *copy.content_, scopes_.size());
        if (in.peek().is(';')) in.take();
        return;
    }
    // $name value;  the value of $name is the keyword
    const List<token>& words = m.entry ? m.entry->value : m.words;
    if (words.size() != 1)
        fail("$" + name.text + " is used as a keyword but holds more than one word.", name);
    token key = words.front();
    key.line = name.line, key.file = name.file;
    parseEntry(key, in);
}

// The text of $name in a formula or in the name of another macro
word dictionaryParser::macroText(const token& name, bool forFormula)
{
    const macro m = resolved(name);
    if (m.entry && m.entry->isDict())
        fail("$" + name.text + " is a dictionary; a value is wanted here.", name);
    const List<token>& words = m.entry ? m.entry->value : m.words;
    word text;
    scalar number;
    for (const token& t : words)
        text += (text.empty() ? "" : " ") + (t.kind == token::numbers ? written(t, 1) : t.text);
    spend(text.size() / 8, name);
    if (!forFormula) return text;
    if (words.size() == 1 && readNumber(text, number) && text[0] == '-') return "(" + text + ")";
    // in a formula (1 2 3) becomes vector(1,2,3)
    if (words.size() == 5 && words.front().is('(') && words.back().is(')'))
        return "vector(" + words[1].text + "," + words[2].text + "," + words[3].text + ")";
    return text;
}

word dictionaryParser::expanded(const word& text, const token& at, bool forFormula)
{
    word out;
    for (size_t i = 0; i < text.size();)
    {
        if (text[i] != '$' || i + 1 == text.size())
        {
            out += text[i++];
            continue;
        }
        token name = at;
        const bool braces = text[i + 1] == '{';
        size_t e = i + 1;
        if (braces) e = closingBrace(text, e);
        else
            for (e += text[e] == ':'; e < text.size() && isNameCharacter(text[e]);) ++e;
        if (e == word::npos) fail("A macro ${ that is never closed: " + text, at);
        while (!braces && text[e - 1] == '.') --e;
        name.text = braces ? text.substr(i + 2, e - i - 2) : text.substr(i + 1, e - i - 1);
        out += macroText(name, forFormula);
        i = e + braces;
    }
    return out;
}

dictionaryEntry* dictionaryParser::lookupIn(dictionary::content& from, const word& path,
                                            bool patternsToo)
{
    const auto find = [&](const word& key) {
        dictionaryEntry* e = patternsToo ? from.find(key) : from.exact(key);
        return e;
    };
    if (dictionaryEntry* e = from.exact(path)) return e;  // a key may contain dots
    if (path.find_first_of("./") == word::npos) return find(path);
    for (size_t dot = path.find_first_of("./"); dot != word::npos;
         dot = path.find_first_of("./", dot + 1))
    {
        const dictionaryEntry* e = find(path.substr(0, dot));
        if (!e || !e->isDict()) continue;
        if (dictionaryEntry* inner =
                lookupIn(*e->dict->content_, path.substr(dot + 1), patternsToo))
            return inner;
    }
    return nullptr;
}

// Finds a.b and a/b here, then outwards; :a, /a and !a from the top; .a only here; ..a and ../a
// one dictionary further out, and so on.  Keys that are patterns count only for statements.
dictionaryEntry* dictionaryParser::lookup(const word& name, const token& at, bool patternsToo)
{
    if (name.empty()) fail("A macro without a name.", at);
    if (name.size() > 1024) fail("The name of a macro has more than 1024 characters.", at);
    if (word(":/!").find(name[0]) != word::npos)
        return lookupIn(*scopes_.front(), name.substr(1), patternsToo);
    size_t out = 0, i = 0;  // number of dictionaries outwards
    for (; name.compare(i, 3, "../") == 0; i += 3) ++out;
    bool fixed = out > 0;
    if (!fixed && name[0] == '.')
    {
        fixed = true;
        i = std::min(name.find_first_not_of('.'), name.size());
        out = i - 1;
    }
    if (i == name.size() || out >= scopes_.size())
        fail("$" + name + " points outside the file: there are only " +
                 std::to_string(scopes_.size()) + " levels here.",
             at);
    if (fixed) return lookupIn(*scopes_[scopes_.size() - 1 - out], name.substr(i), patternsToo);
    for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
        if (dictionaryEntry* e = lookupIn(**scope, name, patternsToo)) return e;
    return nullptr;
}

}  // namespace ispf
