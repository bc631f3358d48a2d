// SPDX-License-Identifier: GPL-3.0-or-later
#include "region.H"

#include "expression.H"
#include "fileNames.H"
#include "surfaceSearch.H"
#include "surfaceTopology.H"
#include "windingNumber.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Share of the interval of length 1 about d that is below 0.  Lengths of a region are in widths of its border
scalar below(scalar d)
{
    return std::clamp(0.5 - d, 0.0, 1.0);
}

class box : public region
{
public:
    box(const dictionary& dict, scalar width, int nDims)
        : width_(width),
          nDims_(nDims),
          min_(dict.get<vector>("min", dims::length)),
          max_(dict.get<vector>("max", dims::length))
    {
        for (int a = 0; a < nDims; ++a)
            if (!(max_[a] > min_[a])) dict.fail("max", "max must be above min along each axis");
    }
    scalar share(const vector& x) const override
    {
        scalar all = 1;
        for (int a = 0; a < nDims_; ++a)
        {
            const scalar from = std::max(x[a] - 0.5 * width_, min_[a]),
                         to = std::min(x[a] + 0.5 * width_, max_[a]);
            all *= std::max(to - from, 0.0) / width_;
        }
        return all;
    }

private:
    scalar width_;
    int nDims_;
    vector min_, max_;
};

class sphere : public region
{
public:
    sphere(const dictionary& dict, scalar width)
        : width_(width),
          centre_(dict.get<vector>("centre", dims::length)),
          radius_(dict.getInRange("radius", 1e-30, 1e30, dims::length))
    {
    }
    scalar share(const vector& x) const override
    {
        return below(((x - centre_).norm() - radius_) / width_);
    }

private:
    scalar width_;
    vector centre_;
    scalar radius_;
};

class cylinder : public region
{
public:
    cylinder(const dictionary& dict, scalar width, int nDims)
        : width_(width),
          from_(dict.get<vector>("point1", dims::length)),
          to_(nDims == 2 ? from_ : dict.get<vector>("point2", dims::length)),
          radius_(dict.getInRange("radius", 1e-30, 1e30, dims::length)),
          length_((to_ - from_).norm()),
          axis_(nDims == 2 ? vector(vector::UnitZ()) : vector((to_ - from_) / length_))
    {
        if (nDims == 3 && !(length_ > 0))
            dict.fail("point2", "point1 and point2 are the same point");
    }
    scalar share(const vector& x) const override
    {
        const vector d = x - from_;
        const scalar along = axis_.dot(d);
        const scalar round = below(((d - along * axis_).norm() - radius_) / width_);
        if (length_ == 0) return round;
        return round * below(-along / width_) * below((along - length_) / width_);
    }

private:
    scalar width_;
    vector from_, to_;
    scalar radius_, length_;
    vector axis_;
};

class formula : public region
{
public:
    explicit formula(const dictionary& dict)
        : value_(dict.get<word>("formula"), {"x", "y", "z"}, {}, dict.where("formula"))
    {
    }
    scalar share(const vector& x) const override
    {
        return std::clamp(value_({x[0], x[1], x[2]}), 0.0, 1.0);
    }

private:
    expression value_;
};

class closedSurface : public region
{
public:
    closedSurface(const dictionary& dict, scalar width, const word& caseFolder)
        : closedSurface(read(dict, caseFolder), width)
    {
    }
    scalar share(const vector& x) const override
    {
        if (bounds_.distSqr(x) > 0.25 * width_ * width_) return 0;
        const scalar d = near_.nearest(x, 0.5 * width_).distance;
        const bool inside = winding_.inside(x);
        return below(std::min(d / width_, 0.5) * (inside ? -1 : 1));
    }

private:
    closedSurface(triSurface s, scalar width)
        : width_(width), bounds_(s.bounds()), winding_(s), near_(std::move(s))
    {
    }
    static triSurface read(const dictionary& dict, const word& caseFolder)
    {
        static const std::map<word, scalar> units = {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}};
        List<word> names;
        for (const auto& unit : units) names.push_back(unit.first);
        triSurface s = readSTL(fromFolder(caseFolder, expandPath(dict.get<word>("file"))));
        s.scale(units.at(dict.choose("unit", names)));
        const closednessReport report = checkClosed(s);
        if (!report.closed()) dict.fail("file", "The surface is not closed: " + report.describe());
        orientOutward(s);
        return s;
    }

    scalar width_;
    boundBox bounds_;
    windingNumber winding_;
    surfaceSearch near_;
};

}  // namespace

std::unique_ptr<region> region::New(const dictionary& dict, scalar dx, int nDims,
                                    const word& caseFolder)
{
    if (dict.found("file") == dict.found("shape"))
        throw fatalError(dict.scope() + " needs either a shape or a file", dict.where());
    const scalar width = border * dx;
    if (dict.found("file")) return std::make_unique<closedSurface>(dict, width, caseFolder);
    const word shape = dict.choose("shape", {"box", "sphere", "cylinder", "formula"});
    if (shape == "box") return std::make_unique<box>(dict, width, nDims);
    if (shape == "sphere") return std::make_unique<sphere>(dict, width);
    if (shape == "cylinder") return std::make_unique<cylinder>(dict, width, nDims);
    return std::make_unique<formula>(dict);
}

}  // namespace ispf
