// SPDX-License-Identifier: GPL-3.0-or-later
#include "windingNumber.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

constexpr label leafSize = 8;
constexpr scalar openingRatio = 2;  // a node counts as a dipole beyond this many radii

vector middle(const std::array<vector, 3>& t)
{
    return (t[0] + t[1] + t[2]) / 3;
}

vector areaVector(const std::array<vector, 3>& t)
{
    return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
}

// A sum of angles.  Keeps the product of complex numbers and the number of whole turns that it does not contain
class angleSum
{
public:
    void add(scalar real, scalar imaginary)
    {
        if (real == 0 && imaginary == 0) return;
        const scalar re = re_ * real - im_ * imaginary, im = re_ * imaginary + im_ * real;
        if (im_ >= 0 && imaginary >= 0 && im < 0) turns_ += 1;
        if (im_ < 0 && imaginary < 0 && im >= 0) turns_ -= 1;
        re_ = re, im_ = im;
    }
    scalar value() const { return std::atan2(im_, re_) + 2 * M_PI * turns_; }

private:
    scalar re_ = 1, im_ = 0, turns_ = 0;
};

// Adds half the solid angle of a triangle (Van Oosterom & Strackee 1983, IEEE Trans. Biomed. Eng. 30)
void addHalfAngle(const std::array<vector, 3>& t, const vector& p, angleSum& sum)
{
    const vector a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const scalar la = a.norm(), lb = b.norm(), lc = c.norm(), size = la * lb * lc;
    if (size == 0) return;
    const scalar volume = a.dot(b.cross(c));
    const scalar below = size + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    sum.add(below / size, volume / size);
}

}  // namespace

windingNumber::windingNumber(const triSurface& surface)
{
    triangles_.reserve(surface.triangles.size());
    for (label t = 0; t < surface.size(); ++t)
        triangles_.push_back({surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2)});
    if (!triangles_.empty()) build(0, label(triangles_.size()));
}

label windingNumber::build(label begin, label end)
{
    const label index = label(nodes_.size());
    nodes_.emplace_back();
    node n;
    n.begin = begin, n.end = end;
    scalar area = 0;
    boundBox box;
    for (label t = begin; t < end; ++t)
    {
        const vector a = areaVector(triangles_[t]);
        area += a.norm();
        n.dipole += a;
        n.centre += a.norm() * middle(triangles_[t]);
        box.add(middle(triangles_[t]));
    }
    n.centre = area > 0 ? vector(n.centre / area) : box.centre();
    for (label t = begin; t < end; ++t)
        for (const vector& c : triangles_[t]) n.radius = std::max(n.radius, (c - n.centre).norm());
    if (end - begin > leafSize)
    {
        int axis;
        (box.max - box.min).maxCoeff(&axis);
        const label half = (begin + end) / 2;
        std::nth_element(
            triangles_.begin() + begin, triangles_.begin() + half, triangles_.begin() + end,
            [axis](const auto& a, const auto& b) { return middle(a)[axis] < middle(b)[axis]; });
        build(begin, half);
        n.second = build(half, end);
    }
    nodes_[index] = n;
    return index;
}

scalar windingNumber::solidAngles(const node& n, const vector& p) const
{
    angleSum sum;
    for (label t = n.begin; t < n.end; ++t) addHalfAngle(triangles_[t], p, sum);
    return 2 * sum.value();
}

scalar windingNumber::value(const vector& p) const
{
    if (nodes_.empty()) return 0;
    label stack[64];
    int top = 0;
    stack[top++] = 0;
    scalar sum = 0;
    while (top > 0)
    {
        const label i = stack[--top];
        const node& n = nodes_[i];
        const vector d = n.centre - p;
        const scalar r2 = d.squaredNorm(), reach = openingRatio * n.radius;
        if (r2 > reach * reach) sum += n.dipole.dot(d) / (r2 * std::sqrt(r2));
        else if (n.second == 0) sum += solidAngles(n, p);
        else stack[top++] = n.second, stack[top++] = i + 1;
    }
    return sum / (4 * M_PI);
}

}  // namespace ispf
