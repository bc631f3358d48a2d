// SPDX-License-Identifier: GPL-3.0-or-later
#include "Function1.H"
#include "targets.H"

#include <cstdlib>
#include <iostream>

namespace ispf::fuzz
{

namespace
{

template <class T>
void ask(const ispf::dictionary& d, const word& key)
{
    d.get<T>(key);
}
void askWord(const ispf::dictionary& d, const word& key)
{
    d.choose(key, {"a", "b"});
}
void askFunction(const ispf::dictionary& d, const word& key)
{
    Function1::New(key, d, "/proc/self/fdinfo/none")->value(0.5);
}

constexpr void (*questions[])(const ispf::dictionary&, const word&) = {
    ask<scalar>,     ask<label>,        ask<bool>,         ask<word>,
    ask<vector>,     ask<tensor>,       ask<List<scalar>>, ask<List<label>>,
    ask<List<word>>, ask<List<vector>>, askWord,           askFunction};

// Asks one question each: most end in an exception, which is slow under the sanitizers
void askAll(const ispf::dictionary& d, size_t& turn)
{
    for (const word& key : d.keys())
        quietly([&] { questions[turn++ % std::size(questions)](d, key); });
    for (const word& key : d.dictKeys()) askAll(d.subDict(key), turn);
    quietly([&] { d.checkAllRead(); });
}

}  // namespace

void dictionary(const word& bytes)
{
    quietly([&] {
        const auto d = ispf::dictionary::fromString(bytes);
        const word once = d.toString();
        word twice;
        try
        {
            twice = ispf::dictionary::fromString(once).toString();
        }
        catch (const fatalError& e)
        {
            twice = formatted(e);
        }
        if (once != twice)
        {
            std::cerr << "written:\n" << once << "\nread and written again:\n" << twice << "\n";
            std::abort();
        }
        size_t turn = bytes.size();
        askAll(d, turn);
    });
}

}  // namespace ispf::fuzz
