// SPDX-License-Identifier: GPL-3.0-or-later
// #calc "formula", #eval{ formula }, ${{ formula }} and #neg $name: values that are computed during reading
#include "dictionaryParser.H"
#include "expression.H"

#include <cmath>

namespace ispf
{

namespace
{

token resultToken(const token& at, token::kindType kind, const word& text)
{
    token t = at;
    t.kind = kind, t.text = text;
    return t;
}

// Removes the comments of C++.  The brace that ends the formula also ends a comment, as in OpenFOAM
word withoutComments(const word& formula)
{
    word text;
    for (size_t i = 0; i < formula.size();)
    {
        const bool line = formula.compare(i, 2, "//") == 0,
                   block = formula.compare(i, 2, "/*") == 0;
        if (!line && !block)
        {
            text += formula[i++];
            continue;
        }
        text += ' ';
        const size_t end = line ? formula.find('\n', i) : formula.find("*/", i + 2);
        i = end == word::npos ? formula.size() : end + (line ? 0 : 2);
    }
    return text;
}

// True if OpenFOAM would give another value: it compiles #calc as C++, where 5/2 is 2; here it is 2.5
bool isCutInCpp(const word& formula, scalar value)
{
    return formula.find('/') != word::npos && value != std::floor(value) &&
           formula.find_first_not_of("0123456789+-*/() ") == word::npos;
}

}  // namespace

List<token> dictionaryParser::calculated(const token& directive, source& in)
{
    const token formula = in.take();
    if (formula.kind != token::verbatim && formula.kind != token::quoted)
        fail("#" + directive.text + " wants a formula, #" + directive.text + " \"...\" or #" +
                 directive.text + "{ ... }, found " + formula.described() + ".",
             formula);
    const word text = expanded(withoutComments(formula.text), formula, true);
    spend(10 + text.size() / 16, formula);
    const List<scalar> result = evaluated(text, formula.where(here().scope));
    if (result.size() == 1 && directive.text == "calc" && isCutInCpp(text, result[0]))
        warning("#calc \"" + text + "\" is " + str(result[0]) +
                " here; OpenFOAM would cut the quotient of whole numbers.");
    List<token> tokens;
    for (const scalar v : result)
        tokens.push_back(resultToken(formula, token::plain, numberText(v)));
    if (tokens.size() == 1) return tokens;
    tokens.insert(tokens.begin(), resultToken(formula, token::punctuation, "("));
    tokens.push_back(resultToken(formula, token::punctuation, ")"));
    return tokens;
}

List<token> dictionaryParser::negated(const token& directive, source& in)
{
    List<token> words = operand(directive, in);
    scalar number;
    if (words.size() != 1 || !readNumber(words[0].text, number))
        fail("#neg wants a number, or a macro that stands for one.", directive);
    word& text = words[0].text;
    if (text[0] == '-') text.erase(0, 1);
    else text = "-" + text.substr(text[0] == '+');
    return words;
}

}  // namespace ispf
