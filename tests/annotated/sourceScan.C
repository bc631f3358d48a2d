// SPDX-License-Identifier: GPL-3.0-or-later
#include "sourceScan.H"

#include "fileNames.H"
#include <algorithm>
#include <regex>

namespace fs = std::filesystem;

namespace annotated
{

namespace
{

// Functions of a dictionary, and functions that pass a key on to one
const std::regex call(
    R"(((?:[A-Za-z_][\w.\[\]]*(?:\(\))?)?)(?:\.|->)(getOrDefault|getInRangeOrDefault|getInRange|get|found|isDict|findDict|subDict|subOrEmptyDict|chooseOrDefault|choose|tokens|tokenList)(?:<[^;()]*>)?\(|()\b(Function1::New|New|nonZero|acceleration|radiusOf|rowsIn|inFile|scalarOf|placeOf)(?:<[^;()]*>)?\()");

word withoutComments(const word& text)
{
    word out;
    for (size_t i = 0; i < text.size(); ++i)
    {
        if (text.compare(i, 2, "//") == 0)
        {
            i = std::min(text.find('\n', i), text.size() - 1);
            out += '\n';
        }
        else if (text[i] == '"')
        {
            const size_t from = i;
            for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
            out += text.substr(from, i - from + 1);
        }
        else out += text[i];
    }
    return out;
}

// Arguments of the call whose bracket opens before `i`
List<word> argumentsAt(const word& text, size_t i)
{
    List<word> all(1);
    for (int depth = 1; i < text.size(); ++i)
    {
        const char c = text[i];
        if (c == '"')
        {
            const size_t from = i;
            for (++i; text[i] != '"'; ++i) i += text[i] == '\\';
            all.back() += text.substr(from, i - from + 1);
            continue;
        }
        depth += (c == '(' || c == '{' || c == '[') - (c == ')' || c == '}' || c == ']');
        if (depth == 0) break;
        if (c == ',' && depth == 1) all.emplace_back();
        else if (!std::isspace(static_cast<unsigned char>(c)) || c == ' ') all.back() += c;
    }
    for (word& a : all)
    {
        a.erase(0, std::min(a.find_first_not_of(' '), a.size()));
        a.erase(a.find_last_not_of(' ') + 1);
    }
    return all;
}

bool isLiteral(const word& a)
{
    return a.size() > 1 && a.front() == '"' && a.back() == '"' && a.find('"', 1) + 1 == a.size();
}

// for (const char* key : {"a", "b"}): the words that the nearest such loop before i gives `name`
List<word> loopWords(const word& text, size_t i, const word& name)
{
    List<word> words;
    const size_t loop = text.rfind(" " + name + " : {", i);
    if (loop == word::npos || i - loop > 600) return words;
    const size_t from = loop + name.size() + 5;
    for (const word& a : argumentsAt(text, from))
        if (isLiteral(a)) words.push_back(a.substr(1, a.size() - 2));
    return words;
}

void scan(const fs::path& path, List<request>& all)
{
    const word text = withoutComments(ispf::readText(path.string()));
    for (std::sregex_iterator m(text.begin(), text.end(), call), end; m != end; ++m)
    {
        const size_t at = size_t(m->position()) + size_t(m->length());
        request r{fs::relative(path, root()).string(),
                  1 + int(std::count(text.begin(), text.begin() + long(at), '\n')),
                  (*m)[1],
                  (*m)[2].matched ? (*m)[2] : (*m)[4],
                  "",
                  argumentsAt(text, at)};
        const bool wrapper = !(*m)[2].matched;
        const auto literal = wrapper
                                 ? std::find_if(r.arguments.begin(), r.arguments.end(), isLiteral)
                             : isLiteral(r.arguments[0]) ? r.arguments.begin()
                                                         : r.arguments.end();
        if (literal != r.arguments.end()) r.key = literal->substr(1, literal->size() - 2);
        if (!wrapper && r.key.empty())
            for (const word& w : loopWords(text, at, r.arguments[0]))
            {
                request one = r;
                one.key = w;
                all.push_back(one);
            }
        const bool looped = !wrapper && r.key.empty() && !all.empty() &&
                            all.back().file == r.file && all.back().line == r.line &&
                            all.back().arguments == r.arguments;
        if (!looped && (!wrapper || !r.key.empty())) all.push_back(r);
    }
}

}  // namespace

fs::path root()
{
    return fs::path(__FILE__).is_absolute() ? fs::path(__FILE__).parent_path() / "../.."
                                            : fs::current_path();
}

List<request> requests()
{
    List<request> all;
    for (const word folder : {"src", "applications"})
        for (const auto& f : fs::recursive_directory_iterator(root() / folder))
        {
            const word name = f.path().filename().string();
            const bool source = f.path().extension() == ".C" || f.path().extension() == ".H";
            if (source && name.rfind("dictionary", 0) != 0) scan(f.path(), all);
        }
    return all;
}

}  // namespace annotated
