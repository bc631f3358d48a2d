// SPDX-License-Identifier: GPL-3.0-or-later
// #if word, #ifeq a b, #else, #endif
#include "dictionaryParser.H"

#include <algorithm>
#include <cstdlib>

namespace ispf
{

namespace
{

bool isNumber(const token& t, scalar& value)
{
    return t.isPlain() && readNumber(t.text, value);
}

// Compares numbers by value, words and strings by their text; a number is never equal to a string
bool equal(const List<token>& a, const List<token>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const token& s, const token& t) {
        scalar x = 0, y = 0;
        const bool number = isNumber(s, x);
        return number == isNumber(t, y) && (number ? x == y : s.text == t.text);
    });
}

// True for "$name" and nothing else: it means the same as $name
bool isQuotedMacro(const token& t)
{
    return t.kind == token::quoted && t.text.size() > 1 && t.text[0] == '$' &&
           t.text.find_first_of("${ \t", 1) == word::npos;
}

}  // namespace

// One operand: a word, a string, a macro, or a formula
List<token> dictionaryParser::operand(const token& name, source& in)
{
    token t = in.take();
    if (isQuotedMacro(t)) t.kind = token::variable, t.text.erase(0, 1);
    else if (t.kind == token::quoted) t.text = expanded(t.text, t, false);
    if (t.kind == token::variable)
    {
        const bool mayBeUnset = name.text == "ifeq" && t.text.find_first_of("${:") == word::npos;
        if (mayBeUnset && !lookup(t.text, t) && !std::getenv(t.text.c_str()))
            return wordsOf("", t);  // as in OpenFOAM
        const macro m = resolved(t);
        if (m.entry && m.entry->isDict())
            fail("#" + name.text + " compares values, and $" + t.text + " is a dictionary.", t);
        List<token> words = m.entry ? m.entry->value : m.words;
        for (token& w : words) w.line = t.line, w.file = t.file;
        return words;
    }
    if (t.kind == token::directive && (t.text == "calc" || t.text == "eval"))
        return calculated(t, in);
    if (t.kind == token::directive && t.text == "neg") return negated(t, in);
    if (t.kind != token::plain && t.kind != token::quoted)
        fail("#" + name.text + " wants a word, a number, a macro, #eval or #calc, found " +
                 t.described() + ".",
             t);
    return {t};
}

bool dictionaryParser::condition(const token& name, source& in)
{
    const List<token> left = operand(name, in);
    const bool comparing = name.text == "ifeq";
    const bool same = comparing && equal(left, operand(name, in));
    if (in.peek().is(';') && in.peek().line == name.line) in.take();
    if (comparing) return same;
    static const List<word> yes = {"true", "on", "yes", "y", "t"},
                            no = {"false", "off", "no", "n", "f", "none"};
    const word text = left.size() == 1 ? left[0].text : "";
    scalar number;
    if (readNumber(text, number)) return number != 0;
    if (std::find(yes.begin(), yes.end(), text) != yes.end()) return true;
    if (std::find(no.begin(), no.end(), text) == no.end())
        fail("#if wants a number or a switch (on off yes no true false), found '" + text + "'.",
             left.empty() ? name : left[0]);
    return false;
}

void dictionaryParser::parseCondition(const token& name, source& in)
{
    if (name.text == "if" || name.text == "ifeq")
    {
        if (in.conditions.size() > 100) fail("Conditions are nested more than 100 deep.", name);
        token opening = name;
        const bool holds = condition(name, in);
        if (!holds) opening.text = "else";
        if (holds || skipBranch(name, in)) in.conditions.push_back(opening);
        return;
    }
    if (in.conditions.empty()) fail("#" + name.text + " without an #if or #ifeq.", name);
    const token opening = in.conditions.back();
    in.conditions.pop_back();
    // if the part before #else was read, the part after it is skipped
    if (name.text != "else" || (opening.text != "else" && !skipBranch(opening, in))) return;
    token second = name;
    second.line = in.line;
    fail("A second #else for the condition at line " + std::to_string(opening.line) + ".", second);
}

// Moves to the place after the #else (true) or #endif (false) that belongs to `opening`
bool dictionaryParser::skipBranch(const token& opening, source& in)
{
    for (int depth = 0;;)
    {
        const token t = in.take();
        if (t.kind == token::end) fail("The #" + opening.text + " here has no #endif.", opening);
        if (t.kind != token::directive) continue;
        if (t.text == "if" || t.text == "ifeq") ++depth;
        if (t.text == "else" && depth == 0) return true;
        if (t.text == "endif" && depth-- == 0) return false;
    }
}

}  // namespace ispf
