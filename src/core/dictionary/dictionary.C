// SPDX-License-Identifier: GPL-3.0-or-later
#include "dictionaryParser.H"

#include "fileNames.H"
#include <algorithm>
#include <filesystem>

namespace ispf
{

dictionary::content::content(const content& other)
    : path(other.path),
      scope(other.scope),
      line(other.line),
      lineEnd(other.lineEnd),
      entries(other.entries),
      header(other.header),
      asked(other.asked)
{
    for (auto p = entries.begin(); p != entries.end(); ++p) enter(p);
}

void dictionary::content::enter(position p)
{
    positions_.emplace(p->key, p);
    if (p->pattern) patterns_.push_back(&*p);
}

dictionaryEntry* dictionary::content::exact(const word& key)
{
    const auto found = positions_.find(key);
    return found == positions_.end() ? nullptr : &*found->second;
}

dictionaryEntry* dictionary::content::find(const word& key)
{
    if (dictionaryEntry* e = exact(key); e && !e->pattern) return e;
    for (auto p = patterns_.rbegin(); p != patterns_.rend(); ++p)
        if ((*p)->pattern->matches(key)) return *p;
    return exact(key);
}

dictionaryEntry& dictionary::content::renewed(const token& key)
{
    auto pattern = keyPattern(key);
    dictionaryEntry* old = exact(key.text);
    if (old && !old->pattern && !pattern) *old = {};
    else
    {
        if (old) remove(*old);
        entries.emplace_back();
        entries.back().key = key.text, entries.back().pattern = pattern;
        enter(std::prev(entries.end()));
        old = &entries.back();
    }
    old->key = key.text;
    old->quoted = key.kind == token::quoted;
    old->file = key.file;
    old->line = key.line;
    return *old;
}

void dictionary::content::remove(const dictionaryEntry& e)
{
    const auto found = positions_.find(e.key);
    const auto p = found->second;
    positions_.erase(found);
    patterns_.erase(std::remove(patterns_.begin(), patterns_.end(), &*p), patterns_.end());
    entries.erase(p);
}

fileLocation dictionary::content::where(const dictionaryEntry& e) const
{
    return {e.file ? *e.file : path, scopeOf(e.key), e.line, e.lineEnd};
}

void markRead(const dictionaryEntry& e)
{
    *e.read = true;
    if (e.isDict()) e.dict->markAllRead();
}

std::optional<regularExpression> keyPattern(const token& key)
{
    if (key.kind != token::quoted || !regularExpression::isOne(key.text)) return std::nullopt;
    return regularExpression(key.text, key.where());
}

dictionary::dictionary() : content_(std::make_unique<content>()) {}
dictionary::~dictionary() = default;
dictionary::dictionary(const dictionary& other)
    : content_(std::make_unique<content>(*other.content_))
{
}
dictionary::dictionary(dictionary&& other) noexcept = default;
dictionary& dictionary::operator=(dictionary&& other) noexcept = default;
dictionary& dictionary::operator=(const dictionary& other)
{
    if (this != &other) content_ = std::make_unique<content>(*other.content_);
    return *this;
}

dictionary dictionary::fromFile(const word& path)
{
    dictionary d;
    dictionaryParser(*d.content_).parseFile(path);
    return d;
}

dictionary dictionary::fromFileIfPresent(const word& path)
{
    // whatever it is, even a link that leads nowhere: fromFile says why it cannot be read
    std::error_code ignored;
    if (std::filesystem::exists(std::filesystem::symlink_status(path, ignored)))
        return fromFile(path);
    dictionary d;
    d.content_->path = path;
    return d;
}

dictionary dictionary::fromPart(const word& text, const word& path)
{
    dictionary d;
    dictionaryParser(*d.content_, true).parseText(text, path);
    return d;
}

dictionary dictionary::fromString(const word& text, const word& name)
{
    dictionary d;
    dictionaryParser(*d.content_).parseText(text, name);
    return d;
}

const word& dictionary::path() const
{
    return content_->path;
}
const word& dictionary::scope() const
{
    return content_->scope;
}
const dictionary& dictionary::header() const
{
    static const dictionary none;
    return content_->header ? *content_->header : none;
}
bool dictionary::empty() const
{
    return content_->entries.empty();
}

const dictionaryEntry* dictionary::read(const word& key) const
{
    content_->asked->insert(key);
    const dictionaryEntry* e = content_->find(key);
    if (e) *e->read = true;
    return e;
}

bool dictionary::found(const word& key) const
{
    return read(key) != nullptr;
}

bool dictionary::isDict(const word& key) const
{
    const dictionaryEntry* e = read(key);
    return e && e->isDict();
}

const dictionary* dictionary::findDict(const word& key) const
{
    const dictionaryEntry* e = read(key);
    if (e && !e->isDict())
        fail(key, "'" + key + "' is a value here, but a dictionary " + key + " { ... } is wanted.");
    return e ? &*e->dict : nullptr;
}

const dictionary& dictionary::subDict(const word& key) const
{
    if (const dictionary* d = findDict(key)) return *d;
    throw fatalError("The dictionary '" + key + "' is missing." + didYouMean(key, keys()) +
                         "\nPresent: " + join(keys()),
                     where());
}

dictionary dictionary::subOrEmptyDict(const word& key) const
{
    if (const dictionary* d = findDict(key)) return *d;
    dictionary none;
    none.content_->path = path();
    none.content_->scope = content_->scopeOf(key);
    none.content_->line = content_->line;
    return none;
}

List<word> dictionary::keys() const
{
    List<word> all;
    for (const dictionaryEntry& e : content_->entries)
        if (!e.pattern) all.push_back(e.key);
    return all;
}

List<word> dictionary::allKeys() const
{
    List<word> all;
    for (const dictionaryEntry& e : content_->entries) all.push_back(e.key);
    return all;
}

List<word> dictionary::dictKeys() const
{
    List<word> all;
    for (const dictionaryEntry& e : content_->entries)
        if (!e.pattern && e.isDict()) all.push_back(e.key);
    return all;
}

const dictionaryEntry& dictionary::valueEntry(const word& key) const
{
    const dictionaryEntry* e = read(key);
    if (!e)
        throw fatalError("The entry '" + key + "' is missing." + didYouMean(key, keys()) +
                             "\nPresent: " + join(keys()),
                         where());
    if (e->isDict()) fail(key, "'" + key + "' is a dictionary here, but a value is wanted.");
    return *e;
}

const List<token>& dictionary::tokenList(const word& key) const
{
    return valueEntry(key).value;
}

List<word> dictionary::tokens(const word& key) const
{
    List<word> words;
    for (const token& t : tokenList(key)) words.push_back(t.text);
    return words;
}

void dictionary::set(const word& key, const word& value)
{
    dictionaryParser parser(*content_);
    List<token> tokens = parser.parseValue(value, "value of " + content_->scopeOf(key));
    token name;
    name.text = key;
    content_->renewed(name).value = std::move(tokens);
}

void dictionary::remove(const word& key)
{
    if (const dictionaryEntry* e = content_->exact(key)) content_->remove(*e);
}

dictionary& dictionary::subDictOrAdd(const word& key)
{
    dictionaryEntry* e = content_->exact(key);
    if (!e)
    {
        token name;
        name.text = key;
        e = &content_->renewed(name);
        e->dict.emplace();
        e->dict->content_->path = path();
        e->dict->content_->scope = content_->scopeOf(key);
    }
    if (!e->isDict()) fail(key, "'" + key + "' is a value here, but a dictionary is wanted.");
    return *e->dict;
}

fileLocation dictionary::where() const
{
    return content_->where();
}

fileLocation dictionary::where(const word& key) const
{
    if (const dictionaryEntry* e = content_->find(key))
    {
        fileLocation place = content_->where(*e);
        place.scope = content_->scopeOf(key);
        return place;
    }
    fileLocation place = content_->where();
    place.scope = content_->scopeOf(key);
    return place;
}

void dictionary::fail(const word& key, const word& message) const
{
    throw fatalError(message, where(key));
}

void dictionary::checkAllRead() const
{
    for (const dictionaryEntry& e : content_->entries)
    {
        if (*e.read)
        {
            if (e.isDict()) e.dict->checkAllRead();
            continue;
        }
        // an included file may have settings for others, or for macros only
        const fileLocation at = content_->where(e);
        if (at.file != path()) continue;
        const List<word> asked(content_->asked->begin(), content_->asked->end());
        const word kind = e.isDict() ? "dictionary" : "entry";
        throw fatalError("Nothing reads the " + kind + " '" + e.key + "'." +
                             didYouMean(e.key, asked) + "\nValid entries here are: " +
                             (asked.empty() ? "none" : join(asked)) + "\nCorrect or remove it.",
                         at);
    }
}

void dictionary::refuseOthers(const List<word>& known) const
{
    for (const word& key : keys())
        if (std::find(known.begin(), known.end(), key) == known.end())
            fail(key, "Nothing reads this entry. Valid are: " + join(known, " "));
}

void dictionary::markAllRead() const
{
    for (const dictionaryEntry& e : content_->entries) markRead(e);
}

}  // namespace ispf
