// SPDX-License-Identifier: GPL-3.0-or-later
#include "patchSurface.H"

#include <cmath>

namespace ispf
{

namespace
{

class planeSurface : public patchSurface
{
public:
    planeSurface(const vector& point, const vector& normal, scalar reach)
        : point_(point), normal_(normal.normalized()), reach_(reach)
    {
    }

    surfaceFoot find(const vector& x, scalar) const override
    {
        surfaceFoot f;
        f.depth = (x - point_).dot(normal_);
        f.found = std::abs(f.depth) <= reach_;
        f.normal = normal_, f.foot = f.nearest = x - f.depth * normal_;
        return f;
    }

    bool crosses(const vector& a, const vector& b) const override
    {
        return ((a - point_).dot(normal_) <= 0) != ((b - point_).dot(normal_) <= 0);
    }

    surfaceFoot firstCrossing(const vector& a, const vector& b) const override
    {
        surfaceFoot f;
        f.found = crosses(a, b);
        if (!f.found) return f;
        const scalar da = (a - point_).dot(normal_), db = (b - point_).dot(normal_);
        f.normal = normal_, f.foot = a + da / (da - db) * (b - a);
        return f;
    }

    vector areaVector(label) const override { return vector::Zero(); }
    bool rimWithin(const vector&, scalar) const override { return false; }
    bool surelyFar(const vector& x) const override
    {
        return std::abs((x - point_).dot(normal_)) > reach_;
    }

private:
    vector point_, normal_;
    scalar reach_;
};

}  // namespace

std::unique_ptr<patchSurface> patchSurface::plane(const vector& point, const vector& normal,
                                                  scalar reach)
{
    return std::make_unique<planeSurface>(point, normal, reach);
}

}  // namespace ispf
