// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a dictionary as text, in the layout of OpenFOAM.
#include "dictionaryContent.H"

#include <charconv>

namespace ispf
{

namespace
{

constexpr size_t keyWidth = 16, indent = 4;

word writtenKey(const dictionaryEntry& e)
{
    if (e.quoted || e.key.find_first_of("\"\n") != word::npos) return inQuotes(e.key);
    const List<token> words = tokenize(e.key, "");
    scalar number;
    const bool plain = words[0].isPlain() && words[0].text == e.key && !readNumber(e.key, number);
    return plain ? e.key : inQuotes(e.key);
}

// True if no blank stands between the two: brackets touch their contents, 3(1 2 3), [0 1 -1 0 0 0 0]
bool isTight(const token& left, const token& right)
{
    if (left.is('(') || left.is('[') || right.is(')') || right.is(']')) return true;
    if (right.kind == token::numbers) return true;
    scalar count;
    return (right.is('(') || right.is('{')) && left.isPlain() && readNumber(left.text, count);
}

size_t countOf(const List<token>& value, size_t k)
{
    size_t n = 1;
    if (k == 0 || value[k].kind != token::numbers) return n;
    const word& text = value[k - 1].text;
    std::from_chars(text.data(), text.data() + text.size(), n);
    return n;
}

}  // namespace

word writtenValue(const List<token>& value)
{
    word text;
    for (size_t k = 0; k < value.size(); ++k)
    {
        if (k > 0 && !isTight(value[k - 1], value[k])) text += ' ';
        text += written(value[k], countOf(value, k));
    }
    return text;
}

void dictionary::write(const dictionaryEntry& e, word& text, size_t level)
{
    const word margin(level * indent, ' ');
    const word key = e.named      ? writtenKey(e)
                     : e.isDict() ? std::to_string(e.dict->allKeys().size())
                                  : writtenValue(e.value);
    text += margin + key;
    if (e.isDict())
    {
        text += "\n" + margin + (e.named ? "{\n" : "(\n");
        e.dict->write(text, level + 1);
        text += margin + (e.named ? "}\n" : ")\n");
        return;
    }
    if (!e.named) return void(text += '\n');
    if (!e.value.empty()) text += word(key.size() < keyWidth ? keyWidth - key.size() : 1, ' ');
    text += writtenValue(e.value) + ";\n";
}

void dictionary::write(word& text, size_t level) const
{
    if (level == 0 && content_->header)
    {
        text += "FoamFile\n{\n";
        content_->header->write(text, 1);
        text += "}\n";
    }
    for (const dictionaryEntry& e : content_->entries)
    {
        if (level == 0 && !text.empty()) text += '\n';
        write(e, text, level);
    }
}

word dictionary::toString() const
{
    word text;
    write(text, 0);
    return text;
}

word dictionary::toString(const word& key) const
{
    word text;
    if (const dictionaryEntry* e = read(key)) write(*e, text, 0);
    return text;
}

word dictionary::valueText(const word& key) const
{
    word text;
    if (isDict(key)) subDict(key).write(text, 1);
    else text = writtenValue(tokenList(key));
    return text;
}

}  // namespace ispf
