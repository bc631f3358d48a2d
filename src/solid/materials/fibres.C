// SPDX-License-Identifier: GPL-3.0-or-later
#include "fibres.H"

#include "expression.H"
#include "fibrePoints.H"
#include "fileNames.H"
#include "messages.H"

#include <cmath>
#include <functional>

namespace ispf
{

namespace
{

using direction = std::function<vector(const vector&)>;

List<direction> uniform(const dictionary& dict)
{
    List<direction> all;
    for (const vector& d : dict.get<List<vector>>("directions"))
        all.push_back([d](const vector&) { return d; });
    return all;
}

List<direction> helix(const dictionary& dict)
{
    const vector point = dict.get<vector>("point", dims::length), axis = dict.get<vector>("axis");
    if (!(axis.norm() > 0)) dict.fail("axis", "The axis of the helices must not be zero");
    const vector along = axis.normalized();
    List<direction> all;
    for (const scalar degrees : dict.get<List<scalar>>("angles"))
    {
        if (!(std::abs(degrees) <= 180))
            dict.fail("angles", "The angle " + str(degrees) + " must be from -180 to 180 degrees");
        const scalar angle = degrees * M_PI / 180;
        all.push_back([=](const vector& x) -> vector {
            const vector around = along.cross(x - point);
            if (!(around.norm() > 0)) return vector::Zero();
            return std::cos(angle) * around.normalized() + std::sin(angle) * along;
        });
    }
    return all;
}

direction formulaOf(const List<word>& texts, const fileLocation& where)
{
    List<std::shared_ptr<expression>> parts;
    for (const word& text : texts)
        parts.push_back(std::make_shared<expression>(text, List<word>{"x", "y", "z"},
                                                     std::map<word, scalar>{}, where));
    if (parts.size() != 3)
        throw fatalError(
            "A direction has three formulas of x, y and z, not " + std::to_string(parts.size()),
            where);
    return [parts](const vector& x) -> vector {
        const List<scalar> at = {x[0], x[1], x[2]};
        return {(*parts[0])(at), (*parts[1])(at), (*parts[2])(at)};
    };
}

List<direction> formula(const dictionary& dict)
{
    List<direction> all = {formulaOf(dict.get<List<word>>("direction1"), dict.where("direction1"))};
    if (dict.found("direction2"))
        all.push_back(formulaOf(dict.get<List<word>>("direction2"), dict.where("direction2")));
    return all;
}

List<direction> points(const dictionary& dict)
{
    csvFormat format;
    format.separator = dict.getOrDefault<word>("separator", ",");
    format.nHeaderLine = dict.getInRangeOrDefault<label>("nHeaderLine", 0, 1000, 1);
    const List<word> columns =
        dict.getOrDefault<List<word>>("columns", {"x", "y", "z", "fx", "fy", "fz"});
    if (columns.size() != 6)
        dict.fail("columns", "Six columns are wanted, (x y z fx fy fz), not " +
                                 std::to_string(columns.size()));
    const fibrePoints::rule rule = {dict.getInRangeOrDefault<label>("neighbours", 1, 100, 4),
                                    dict.getInRange("farthest", 1e-12, 1e3, dims::length)};
    const word caseFolder = folderOf(folderOf(dict.path()));
    List<direction> all;
    for (const word& file : dict.get<List<word>>("files"))
    {
        format.path = fromFolder(caseFolder, expandPath(file));
        if (!isFile(format.path)) dict.fail("files", "There is no file " + format.path);
        const auto family = std::make_shared<fibrePoints>(format, columns, rule, dict);
        all.push_back([family](const vector& x) { return family->at(x); });
    }
    return all;
}

}  // namespace

fibreDirections::fibreDirections(const dictionary& dict, const List<vector>& x0)
{
    const std::map<word, List<direction> (*)(const dictionary&)> kinds = {
        {"uniform", uniform}, {"helix", helix}, {"formula", formula}, {"points", points}};
    const word kind = dict.choose("type", {"uniform", "helix", "formula", "points"});
    for (const direction& at : kinds.at(kind)(dict))
    {
        family_.emplace_back();
        for (const vector& x : x0)
        {
            vector d = at(x);
            if (!(d.norm() > 0))
                dict.fail("type", "The fibres of family " + std::to_string(family_.size()) +
                                      " have no direction at (" + str(x[0]) + " " + str(x[1]) +
                                      " " + str(x[2]) + ")");
            family_.back().push_back(d.normalized());
        }
    }
    if (family_.empty()) dict.fail("type", "The dictionary gives no direction");
}

tensor fibreDirections::axes(label k) const
{
    tensor Q;
    Q.col(0) = of(0, k);
    vector second = nFamilies() > 1 ? of(1, k) : vector(of(0, k).unitOrthogonal());
    second -= second.dot(Q.col(0)) * Q.col(0);
    Q.col(1) = second.norm() > 1e-6 ? vector(second.normalized()) : of(0, k).unitOrthogonal();
    Q.col(2) = vector(Q.col(0)).cross(vector(Q.col(1)));
    return Q;
}

}  // namespace ispf
