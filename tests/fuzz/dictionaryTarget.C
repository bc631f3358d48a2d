// SPDX-License-Identifier: GPL-3.0-or-later
#include "Function1.H"
#include "targets.H"

#include <cstdlib>
#include <iostream>

namespace ispf::fuzz
{

namespace
{

void quietly(const std::function<void()>& ask)
{
    try
    {
        ask();
    }
    catch (const fatalError& e)
    {
        formatted(e);
    }
}

template <class... T>
void askAs(const ispf::dictionary& d, const word& key)
{
    (quietly([&] { d.get<T>(key); }), ...);
}

void askAll(const ispf::dictionary& d)
{
    for (const word& key : d.keys())
    {
        askAs<scalar, label, bool, word, vector, tensor>(d, key);
        askAs<List<scalar>, List<label>, List<word>, List<vector>>(d, key);
        quietly([&] { d.choose(key, {"a", "b"}); });
        quietly([&] { Function1::New(key, d, "/proc/self/fdinfo/none")->value(0.5); });
    }
    for (const word& key : d.dictKeys()) askAll(d.subDict(key));
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
        askAll(d);
    });
}

}  // namespace ispf::fuzz
