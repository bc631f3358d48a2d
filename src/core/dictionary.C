// SPDX-License-Identifier: GPL-3.0-or-later
#include "dictionaryParser.H"

#include "fileNames.H"
#include <algorithm>

namespace ispf
{

dictionaryEntry* dictionary::content::exact(const word& key)
{
    for (dictionaryEntry& e : entries)
        if (e.key == key) return &e;
    return nullptr;
}

dictionaryEntry* dictionary::content::find(const word& key)
{
    dictionaryEntry* match = nullptr;
    for (dictionaryEntry& e : entries)
    {
        if (!e.pattern && e.key == key) return &e;
        if (e.pattern && std::regex_match(key, *e.pattern)) match = &e;
    }
    return match;
}

fileLocation dictionary::content::where(const dictionaryEntry& e) const
{
    return {e.file ? *e.file : path, scopeOf(e.key), e.line, e.lineEnd};
}

void markRead(const dictionaryEntry& e)
{
    *e.read = true;
    if (e.isDict)
        for (const dictionaryEntry& below : e.dict.content_->entries) markRead(below);
}

std::shared_ptr<const std::regex> keyPattern(const token& key)
{
    if (key.kind != token::quoted || key.text.find_first_of(".*+?()[]{}|^$\\") == word::npos)
        return nullptr;
    const bool anyCase = key.text.compare(0, 4, "(?i)") == 0;
    const auto flags = std::regex::extended | (anyCase ? std::regex::icase : std::regex::extended);
    try
    {
        return std::make_shared<const std::regex>(key.text.substr(anyCase ? 4 : 0), flags);
    }
    catch (const std::regex_error& e)
    {
        throw fatalError("\"" + key.text + "\" is not a regular expression: " + e.what(),
                         key.where());
    }
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
    if (isFile(path)) return fromFile(path);
    dictionary d;
    d.content_->path = path;
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
    return e && e->isDict;
}

const dictionary* dictionary::findDict(const word& key) const
{
    const dictionaryEntry* e = read(key);
    if (e && !e->isDict)
        fail(key, "'" + key + "' is a value here, but a dictionary " + key + " { ... } is wanted.");
    return e ? &e->dict : nullptr;
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

List<word> dictionary::dictKeys() const
{
    List<word> all;
    for (const dictionaryEntry& e : content_->entries)
        if (!e.pattern && e.isDict) all.push_back(e.key);
    return all;
}

const dictionaryEntry& dictionary::valueEntry(const word& key) const
{
    const dictionaryEntry* e = read(key);
    if (!e)
        throw fatalError("The entry '" + key + "' is missing." + didYouMean(key, keys()) +
                             "\nPresent: " + join(keys()),
                         where());
    if (e->isDict) fail(key, "'" + key + "' is a dictionary here, but a value is wanted.");
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
    dictionaryEntry* e = content_->exact(key);
    if (!e) e = &content_->entries.emplace_back();
    e->key = key;
    e->isDict = false;
    e->dict = dictionary();
    e->value = std::move(tokens);
    e->read = std::make_shared<bool>(false);
}

dictionary& dictionary::subDictOrAdd(const word& key)
{
    dictionaryEntry* e = content_->exact(key);
    if (!e)
    {
        e = &content_->entries.emplace_back();
        e->key = key;
        e->isDict = true;
        e->dict.content_->path = path();
        e->dict.content_->scope = content_->scopeOf(key);
    }
    if (!e->isDict) fail(key, "'" + key + "' is a value here, but a dictionary is wanted.");
    return e->dict;
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
            if (e.isDict) e.dict.checkAllRead();
            continue;
        }
        // an included file may hold settings for others, or for macros alone
        const fileLocation at = content_->where(e);
        if (at.file != path()) continue;
        const List<word> asked(content_->asked->begin(), content_->asked->end());
        const word kind = e.isDict ? "dictionary" : "entry";
        throw fatalError("Nothing reads the " + kind + " '" + e.key + "'." +
                             didYouMean(e.key, asked) + "\nValid entries here are: " +
                             (asked.empty() ? "none" : join(asked)) + "\nCorrect or remove it.",
                         at);
    }
}

void dictionary::markAllRead() const
{
    for (const dictionaryEntry& e : content_->entries) markRead(e);
}

}  // namespace ispf
