// SPDX-License-Identifier: GPL-3.0-or-later
#include "dictionaryText.H"

#include "regularExpression.H"
#include <algorithm>

namespace ispf
{

dictionaryText::dictionaryText(const word& text, const word& fileName)
    : text_(text), file_(fileName)
{
    parse();
}

void dictionaryText::parse()
{
    top_ = {};
    includes_.clear();
    const List<token> tokens = tokenize(text_, file_);
    firstToken_ = std::min<size_t>(tokens[0].first, text_.size());
    size_t i = 0;
    top_.isDict = true;
    top_.last = top_.valueLast = text_.size();
    parseItems(tokens, i, top_);
    if (tokens[i].kind != token::end)
        throw fatalError("A closing " + tokens[i].text + " without an opening one.",
                         tokens[i].where());
}

// Reads entries up to the bracket that closes their dictionary, or to the end
void dictionaryText::parseItems(const List<token>& tokens, size_t& i, item& into)
{
    if (into.depth > 200)
        throw fatalError("Dictionaries are nested deeper than 200 levels.", tokens[i].where());
    for (;;)
    {
        const token& t = tokens[i];
        if (t.kind == token::end || t.is('}') || t.is(')')) return;
        if (t.kind == token::directive)
        {
            const bool includes = t.text.find("nclude") != word::npos;
            if (includes && tokens[i + 1].kind != token::end)
                includes_.push_back(tokens[i + 1].text);
            // the words of the directive are on its line
            for (++i;
                 tokens[i].kind != token::end && tokens[i].line == t.line && !tokens[i].is('}');)
                ++i;
        }
        else if (t.is(';')) ++i;
        else if (!parseList(tokens, i, into)) parseItem(tokens, i, into);
    }
}

// Reads 2(a { ... } b { ... }), or a list of other things
bool dictionaryText::parseList(const List<token>& tokens, size_t& i, item& into)
{
    scalar count;
    const bool counted = tokens[i].isPlain() && readNumber(tokens[i].text, count);
    const size_t open = i + counted;
    if (!tokens[open].is('(')) return false;
    item e;
    const auto isHeader = [](const item& other) { return other.key == "FoamFile"; };
    e.key = "entry" + std::to_string(into.items.size() -
                                     std::count_if(into.items.begin(), into.items.end(), isHeader));
    e.depth = into.depth + 1;
    e.first = tokens[i].first, e.valueFirst = tokens[open].last;
    if (counted) e.countFirst = tokens[i].first, e.countLast = tokens[i].last;
    const token& next = tokens[open + 1];
    e.isDict = (next.isPlain() || next.kind == token::quoted) && tokens[open + 2].is('{');
    i = open + 1;
    if (e.isDict) parseItems(tokens, i, e);
    else
        for (int depth = 1; tokens[i].kind != token::end; ++i)
            if ((depth += tokens[i].is('(') - tokens[i].is(')')) == 0) break;
    if (!tokens[i].is(')'))
        throw fatalError("The bracket ( opened here is never closed.", tokens[open].where());
    e.valueLast = tokens[i].first, e.last = tokens[i].last;
    ++i;
    into.items.push_back(std::move(e));
    return true;
}

void dictionaryText::parseItem(const List<token>& tokens, size_t& i, item& into)
{
    const token& key = tokens[i];
    if (key.kind == token::punctuation || key.kind == token::verbatim)
        throw fatalError("A keyword is wanted here, found " + key.described() + ".", key.where());
    item e;
    e.key = key.kind == token::variable ? "$" + key.text : key.text;
    e.isPattern = key.kind == token::quoted && regularExpression::isOne(key.text);
    e.first = key.first, e.depth = into.depth + 1;
    const token& next = tokens[++i];
    e.isDict = next.is('{');
    if (e.isDict)
    {
        e.valueFirst = tokens[i++].last;
        parseItems(tokens, i, e);
        if (!tokens[i].is('}'))
            throw fatalError("The brace { opened here is never closed.", next.where());
        e.valueLast = tokens[i].first, e.last = tokens[i++].last;
    }
    else
    {
        e.valueFirst = e.valueLast = next.first;
        for (int depth = 0; !tokens[i].is(';') || depth > 0; ++i)
        {
            const token& t = tokens[i];
            depth += t.is('{') || t.is('(') || t.is('[');
            depth -= t.is('}') || t.is(')') || t.is(']');
            if (t.kind == token::end || depth < 0)
                throw fatalError("The ';' after the value of '" + e.key + "' is missing.",
                                 key.where());
            e.valueLast = t.last;
        }
        e.last = tokens[i++].last;
    }
    into.items.push_back(std::move(e));
}

// Finds all entries of that name, in order; a later dictionary merges into an earlier one
void dictionaryText::collect(const item& in, const word& name, List<const item*>& found) const
{
    for (const item& e : in.items)
    {
        if (e.key == name) found.push_back(&e);
        else if (e.isDict && name.starts_with(e.key + "."))
            collect(e, name.substr(e.key.size() + 1), found);
    }
    if (!found.empty()) return;
    for (const item& e : in.items)
    {
        if (!e.isPattern) continue;
        const regularExpression pattern(e.key, {file_, "", 0, 0});
        if (pattern.matches(name)) found.push_back(&e);
        for (size_t dot = name.find('.'); e.isDict && dot != word::npos;
             dot = name.find('.', dot + 1))
            if (pattern.matches(name.substr(0, dot))) collect(e, name.substr(dot + 1), found);
    }
}

// Finds the entries that an edit may change: those whose keys are written so.  A matching pattern also stands for other
// entries and is left alone
void dictionaryText::collectOwn(const item& in, const word& name, List<const item*>& found) const
{
    for (const item& e : in.items)
    {
        if (e.key == name) found.push_back(&e);
        else if (e.isDict && name.starts_with(e.key + "."))
            collectOwn(e, name.substr(e.key.size() + 1), found);
    }
}

List<const dictionaryText::item*> dictionaryText::own(const word& name) const
{
    List<const item*> all;
    collectOwn(top_, name, all);
    return all;
}

bool dictionaryText::holds(const word& name) const
{
    return !own(name).empty();
}

const dictionaryText::item* dictionaryText::find(const word& name) const
{
    if (name.empty()) return &top_;
    List<const item*> all;
    collect(top_, name, all);
    return all.empty() ? nullptr : all.back();
}

bool dictionaryText::found(const word& name) const
{
    return find(name) != nullptr;
}

bool dictionaryText::isDict(const word& name) const
{
    const item* e = find(name);
    return e && e->isDict;
}

void dictionaryText::failMissing(const word& name) const
{
    const size_t dot = name.rfind('.');
    const word parent = dot == word::npos ? "" : name.substr(0, dot);
    const List<word> present = keys(find(parent) ? parent : "");
    throw fatalError(
        "There is no entry '" + name + "'." + didYouMean(name.substr(dot + 1), present) +
            "\nPresent: " + join(present) +
            "\n(Entries that come from a macro or an included file are found with -expand.)",
        {file_, parent, 0, 0});
}

word dictionaryText::entry(const word& name) const
{
    const item* e = find(name);
    if (!e) failMissing(name);
    return text_.substr(e->first, e->last - e->first);
}

word dictionaryText::value(const word& name) const
{
    const item* e = find(name);
    if (!e) failMissing(name);
    return text_.substr(e->valueFirst, e->valueLast - e->valueFirst);
}

List<word> dictionaryText::keys(const word& name) const
{
    List<const item*> all;
    if (name.empty()) all.push_back(&top_);
    else collect(top_, name, all);
    if (all.empty()) failMissing(name);
    List<word> keys;
    for (const item* e : all)
        for (const item& inner : e->items)
            if (std::find(keys.begin(), keys.end(), inner.key) == keys.end())
                keys.push_back(inner.key);
    return keys;
}

List<word> dictionaryText::includes() const
{
    return includes_;
}

// A list whose number differs from the number of its entries
const dictionaryText::item* dictionaryText::miscounted(const item& in) const
{
    for (const item& e : in.items)
    {
        const word count = text_.substr(e.countFirst, e.countLast - e.countFirst);
        if (e.isDict && !count.empty() && count != std::to_string(e.items.size())) return &e;
        if (const item* inner = miscounted(e)) return inner;
    }
    return nullptr;
}

namespace
{

// The text with the line ends of the file's first line: CR LF or LF
word withLineEndsOf(const word& file, const word& text)
{
    const size_t end = file.find('\n');
    if (end == word::npos || end == 0 || file[end - 1] != '\r') return text;
    word lines;
    for (const char c : text) lines += c == '\n' && !lines.ends_with('\r') ? "\r\n" : word(1, c);
    return lines;
}

}  // namespace

void dictionaryText::replace(size_t first, size_t last, const word& by)
{
    const word before = text_;
    text_.replace(first, last - first, withLineEndsOf(text_, by));
    try
    {
        parse();
        while (const item* list = miscounted(top_))
        {
            text_.replace(list->countFirst, list->countLast - list->countFirst,
                          std::to_string(list->items.size()));
            parse();
        }
    }
    catch (const fatalError& e)
    {
        text_ = before;
        parse();
        throw fatalError(word("The new value would break the dictionary: ") + e.what());
    }
}

// The existing dictionaries of `name`, from the innermost outwards, each with the rest of the name inside it
List<std::pair<const dictionaryText::item*, word>> dictionaryText::parentsOf(const word& name) const
{
    List<std::pair<const item*, word>> parents;
    for (size_t dot = name.rfind('.'); dot != word::npos && dot > 0; dot = name.rfind('.', dot - 1))
    {
        const List<const item*> all = own(name.substr(0, dot));
        if (!all.empty() && all.back()->isDict)
            parents.emplace_back(all.back(), name.substr(dot + 1));
    }
    parents.emplace_back(&top_, name);
    return parents;
}

namespace
{

// key value;  or  key { ... }  with the dictionaries of a dotted key around it
word statement(const word& key, const word& value, const word& margin)
{
    if (const size_t dot = key.find('.'); dot != word::npos)
        return margin + key.substr(0, dot) + "\n" + margin + "{\n" +
               statement(key.substr(dot + 1), value, margin + "    ") + margin + "}\n";
    if (!value.empty() && value[0] == '{') return margin + key + " " + value + "\n";
    const word gap(key.size() < 16 ? 16 - key.size() : 1, ' ');
    return margin + key + (value.empty() ? "" : gap + value) + ";\n";
}

}  // namespace

void dictionaryText::set(const word& name, const word& value)
{
    const bool toDict = !value.empty() && value[0] == '{';
    // a dictionary in several parts is replaced as a whole
    while (toDict && own(name).size() > 1) erase(*own(name).front());
    const List<const item*> all = own(name);
    const item* e = all.empty() ? nullptr : all.back();
    if (e && !e->isDict && !toDict)
    {
        const bool empty = e->valueFirst == e->valueLast;
        return replace(e->valueFirst, e->valueLast, empty ? " " + value : value);
    }
    if (e)
    {
        const word key =
            text_.substr(e->first, text_.find_first_of(" \t\r\n{;", e->first) - e->first);
        return replace(e->first, e->last, key + " " + value + (toDict ? "" : ";"));
    }
    const auto [parent, key] = parentsOf(name).front();
    insert(*parent, key, value, false);
}

bool dictionaryText::append(const word& name, const word& value, int outwards)
{
    const auto parents = parentsOf(name);
    if (outwards >= int(parents.size())) return false;
    insert(*parents[outwards].first, parents[outwards].second, value, true);
    return true;
}

void dictionaryText::insert(const item& parent, const word& key, const word& value, bool atEnd)
{
    const bool top = &parent == &top_;
    if (top && (key == "FoamFile" || key.rfind("FoamFile.", 0) == 0))  // the header comes first
        return replace(firstToken_, firstToken_, statement(key, value, "") + "\n");
    size_t at = parent.items.empty() ? parent.valueFirst : parent.items.back().last;
    if (top && atEnd) at = text_.find_last_not_of(" \t\r\n") + 1;
    // after a comment that ends the line, but not beyond the closing brace
    size_t lineEnd = std::min(text_.find('\n', at), text_.size());
    if (lineEnd > at && text_[lineEnd - 1] == '\r') --lineEnd;
    const size_t next = std::min(text_.find_first_not_of(" \t\r", at), text_.size());
    if (next >= lineEnd || text_.compare(next, 2, "//") == 0) at = lineEnd;
    const word margin(4 * parent.depth, ' ');
    word addition = "\n" + statement(key, value, margin);
    addition.pop_back();
    // a brace in the same line gets its own line
    const bool closes = !top && at < parent.valueLast && lineEnd > parent.valueLast;
    if (closes) addition += "\n" + margin.substr(4);
    if (top && at == text_.size()) addition += "\n";
    if (at == 0) addition = addition.substr(1) + "\n";
    replace(at, closes ? std::min(next, parent.valueLast) : at, addition);
}

void dictionaryText::erase(const item& e)
{
    size_t first = e.first, last = e.last;
    // with its line, if nothing else is in it
    const size_t lineStart = first == 0 ? 0 : text_.rfind('\n', first - 1) + 1;
    const size_t lineEnd = std::min(text_.find('\n', last), text_.size());
    const bool alone = text_.find_first_not_of(" \t", lineStart) == first &&
                       text_.find_first_not_of(" \t\r", last) >= lineEnd;
    if (alone) first = lineStart, last = std::min(lineEnd + 1, text_.size());
    replace(first, last, "");
}

void dictionaryText::remove(const word& name)
{
    if (own(name).empty()) failMissing(name);
    while (!own(name).empty()) erase(*own(name).back());
}

}  // namespace ispf
