// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceSection.H"

#include <cmath>
#include <limits>
#include <numbers>

namespace ispf
{

namespace
{

using point2 = Eigen::Vector2d;
constexpr scalar none = std::numeric_limits<scalar>::quiet_NaN();

scalar cross(const point2& a, const point2& b)
{
    return a[0] * b[1] - a[1] * b[0];
}

// Adds the segment from a to b to the radii of the angles that it spans
void addSegment(const point2& a, const point2& b, List<scalar>& radii)
{
    const label n = label(radii.size());
    const scalar step = 2 * std::numbers::pi / n;
    const scalar from = std::atan2(a[1], a[0]), turn = std::atan2(cross(a, b), a.dot(b));
    const scalar low = std::min(from, from + turn), high = std::max(from, from + turn);
    for (label k = label(std::ceil(low / step - 0.5)); k <= label(std::floor(high / step - 0.5));
         ++k)
    {
        const scalar angle = (k + 0.5) * step;
        const scalar along = cross({std::cos(angle), std::sin(angle)}, b - a);
        if (std::abs(along) < 1e-12 * (b - a).norm()) continue;  // it runs through the axis
        scalar& r = radii[((k % n) + n) % n];
        const scalar hit = cross(a, b - a) / along;
        if (hit >= 0 && !(hit >= r)) r = hit;  // also if there is no radius yet
    }
}

}  // namespace

axisFrame::axisFrame(const vector& p, const vector& a)
    : point(p), axis(a.normalized()), e1(axis.unitOrthogonal()), e2(axis.cross(e1))
{
}

List<scalar> sectionRadii(const triSurface& surface, const List<structureImage>& images,
                          const axisFrame& frame, scalar height, label n)
{
    List<scalar> radii(n, none);
    const vector origin = frame.point + height * frame.axis;
    for (size_t m = 0; m <= images.size(); ++m)
        for (label t = 0; t < surface.size(); ++t)
        {
            vector c[3];
            scalar above[3];
            for (int k = 0; k < 3; ++k)
            {
                const vector& x = surface.corner(t, k);
                c[k] = (m ? images[m - 1](x) : x) - origin;
                above[k] = c[k].dot(frame.axis);
            }
            point2 ends[2];
            int met = 0;
            for (int k = 0; k < 3; ++k)
            {
                const int l = (k + 1) % 3;
                if ((above[k] >= 0) == (above[l] >= 0)) continue;
                const vector x = c[k] + above[k] / (above[k] - above[l]) * (c[l] - c[k]);
                ends[met++] = {x.dot(frame.e1), x.dot(frame.e2)};
            }
            if (met == 2) addSegment(ends[0], ends[1], radii);
        }
    return radii;
}

List<structureImage> imagesAboutAxis(const List<structureImage>& images, const axisFrame& frame)
{
    List<structureImage> kept;
    for (const structureImage& map : images)
    {
        const vector a = map(frame.point), b = map(frame.point + frame.axis);
        if ((a - frame.point).norm() < 1e-9 && (b - frame.point - frame.axis).norm() < 1e-9)
            kept.push_back(map);
    }
    return kept;
}

diameterRange diametersOf(const List<scalar>& radii)
{
    const size_t half = radii.size() / 2;
    diameterRange range{0, none, none};
    label n = 0;
    for (size_t k = 0; k < half; ++k)
    {
        const scalar d = radii[k] + radii[k + half];
        if (std::isnan(d)) continue;
        range.mean += d, ++n;
        if (!(range.min <= d)) range.min = d;
        if (!(range.max >= d)) range.max = d;
    }
    range.mean = n ? range.mean / n : none;
    return range;
}

}  // namespace ispf
