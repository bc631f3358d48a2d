// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleTableCheck.H"

#include "checksum.H"
#include "wideColumns.H"

#include <cstdio>
#include <set>

namespace ispf
{

namespace
{

word position(const vector& x)
{
    char text[96];
    std::snprintf(text, sizeof text, "(%.6g %.6g %.6g) m", x[0], x[1], x[2]);
    return text;
}

// Finds what is wrong with a table: the same rules hold for writing and reading
class tableCheck
{
public:
    tableCheck(const particleTable& table, const word& doing, const word& advice)
        : table_(table), doing_(doing), advice_(advice)
    {
    }

    void run() const
    {
        finite("position", table_.x);
        columns([](const word&) { return true; });
        for (const auto& [name, values] : table_.extra) finiteExtra(name, values);
        names();
    }

    template <class Chosen>
    void columns(const Chosen& chosen) const
    {
        for (const auto& [name, values] : table_.scalars)
            if (chosen(name)) column(name, values);
        for (const auto& [name, values] : table_.vectors)
            if (chosen(name)) column(name, values);
        for (const auto& [name, values] : table_.integers)
            if (chosen(name)) sameLength(name, values.size());
    }

private:
    [[noreturn]] void fail(const word& reason) const { throw fatalError(doing_ + reason); }

    void sameLength(const word& name, size_t length) const
    {
        if (length != table_.size())
            fail("column '" + name + "' has " + std::to_string(length) + " rows but there are " +
                 std::to_string(table_.size()) + " particles.");
    }
    template <class T>
    void column(const word& name, const List<T>& values) const
    {
        sameLength(name, values.size());
        finite(name, values);
    }
    static bool isFinite(scalar value) { return std::isfinite(value); }
    static bool isFinite(const vector& value) { return value.allFinite(); }

    template <class T>
    void finite(const word& name, const List<T>& values) const
    {
        for (size_t i = 0; i < values.size(); ++i)
            if (!isFinite(values[i]))
                fail("column '" + name + "' is not a finite number at row " + std::to_string(i) +
                     identity(i) + ", position " + position(table_.x[i]) + ".  " + advice_);
    }
    word identity(size_t row) const
    {
        const auto id = table_.integers.find("id");
        const bool known = id != table_.integers.end() && row < id->second.size();
        return known ? " (particle id " + std::to_string(id->second[row]) + ")" : word();
    }
    void finiteExtra(const word& name, const List<scalar>& values) const
    {
        for (size_t i = 0; i < values.size(); ++i)
            if (!std::isfinite(values[i]))
                fail("array '" + name + "' is not a finite number at index " + std::to_string(i) +
                     ".");
    }
    // True for all components of a field but its first
    template <class Columns>
    static bool isFurther(const word& name, const Columns& columns)
    {
        const word field = fieldOf(name);
        for (size_t k = 1; columns.count(componentName(field, k - 1)); ++k)
            if (name == componentName(field, k)) return true;
        return false;
    }
    void names() const
    {
        std::set<word> seen;
        const auto note = [&](const auto& list, bool isColumn) {
            for (const auto& [name, values] : list)
            {
                if (isColumn && isFurther(name, list)) continue;
                const word field = isColumn && name.ends_with("/0") ? fieldOf(name) : name;
                if (field.empty() || field == "." || field.find('/') != word::npos)
                    fail("'" + name + "' cannot be the name of a column, array or attribute.");
                if (isColumn && !seen.insert(field).second)
                    fail("two columns have the name '" + field + "'.");
            }
        };
        note(table_.scalars, true);
        note(table_.vectors, true);
        note(table_.integers, true);
        note(table_.extra, false);
        note(table_.attributes, false);
    }

    const particleTable& table_;
    word doing_, advice_;
};

}  // namespace

namespace
{

template <class T>
globalId sumOf(const word& name, const T& values)
{
    checksum sum;
    sum.add(name);
    sum.add(values);
    return sum.value();
}

}  // namespace

globalId checksumOf(const word& name, const List<scalar>& values)
{
    return sumOf(name, values);
}

globalId checksumOf(const word& name, const List<vector>& values)
{
    return sumOf(name, values);
}

globalId checksumOf(const word& name, const List<globalId>& values)
{
    return sumOf(name, values);
}

globalId checksumOf(const word& name, const word& text)
{
    return sumOf(name, text);
}

globalId checksumOf(const particleTable& table)
{
    checksum sum;
    sum.add(table.x);
    sum.add(table.scalars);
    sum.add(table.vectors);
    sum.add(table.integers);
    sum.add(table.extra);
    sum.add(table.attributes);
    return sum.value();
}

void checkTable(const particleTable& table, const word& doing, const word& advice)
{
    tableCheck(table, doing + ": ", advice).run();
}

word takeOutUnsound(particleTable& table, const word& field)
{
    const auto isPart = [&](const word& column) { return fieldOf(column) == field; };
    try
    {
        tableCheck(table, "", "").columns(isPart);
        return "";
    }
    catch (const fatalError& e)
    {
        const auto takeOut = [&](auto& columns) {
            std::erase_if(columns, [&](const auto& column) { return isPart(column.first); });
        };
        takeOut(table.scalars), takeOut(table.vectors), takeOut(table.integers);
        return e.what();
    }
}

}  // namespace ispf
