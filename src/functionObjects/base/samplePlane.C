// SPDX-License-Identifier: GPL-3.0-or-later
#include "samplePlane.H"
#include "pointSampler.H"

#include <algorithm>
#include <cstdio>

namespace ispf
{

namespace
{

// Neighbours within 2 dx count; a point further than dx from any particle is blank
constexpr scalar radiusFactor = 2, blankFactor = 1;

word number(scalar value)
{
    if (!std::isfinite(value)) return "NaN";
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

List<char> chosenZones(const particleCloud& cloud, const dictionary& dict)
{
    List<char> chosen(cloud.zones.size(), false);
    for (const word& name : dict.get<List<word>>("zones"))
        chosen[cloud.zoneIndex(name, dict.where("zones"))] = true;
    return chosen;
}

label count(const List<scalar>& range, scalar spacing)
{
    return label(std::lround((range[1] - range[0]) / spacing)) + 1;
}

}  // namespace

samplePlane::samplePlane(const word& name, const dictionary& dict, const particleCloud& cloud)
    : name_(name),
      point_(dict.get<vector>("point", dims::length)),
      normal_(dict.get<vector>("normal").normalized()),
      xAxis_(dict.get<vector>("xAxis")),
      xRange_(dict.get<List<scalar>>("xRange", dims::length)),
      yRange_(dict.get<List<scalar>>("yRange", dims::length)),
      inZones_(chosenZones(cloud, dict)),
      fields_(fieldsOf(cloud, dict)),
      images_(dict.getOrDefault<List<vector>>("images", {}, dims::length))
{
    if (!(normal_.norm() > 0)) dict.fail("normal", "must not be zero");
    for (const char* key : {"zones", "fields"})
        if (dict.get<List<word>>(key).empty()) dict.fail(key, "must name one at least");
    xAxis_ -= xAxis_.dot(normal_) * normal_;
    if (!(xAxis_.norm() > 0)) dict.fail("xAxis", "lies along the normal; choose another direction");
    xAxis_.normalize();
    yAxis_ = xAxis_.cross(normal_);
    for (const word key : {"xRange", "yRange"})
    {
        const List<scalar>& range = key == "xRange" ? xRange_ : yRange_;
        if (range.size() != 2 || range[0] >= range[1]) dict.fail(key, "must be (low high)");
    }
    const scalar length = std::max(xRange_[1] - xRange_[0], yRange_[1] - yRange_[0]);
    spacing_ = dict.getInRange("spacing", length / 10000, length, dims::length);
    for (vector& n : images_)
    {
        if (!(n.norm() > 0)) dict.fail("images", "a normal must not be zero");
        n.normalize();
    }
    if (const dictionary* slice = dict.findDict("slice"))
    {
        inSlice_ = chosenZones(cloud, *slice);
        sliceThickness_ = slice->getInRange("thickness", 1e-30, 1e30, dims::length);
    }
}

struct samplePlane::image
{
    label i;
    size_t image;  // bits of the symmetry planes that mirror it
    vector x;
};

vector samplePlane::mirrored(vector v, size_t image) const
{
    for (size_t k = 0; k < images_.size(); ++k)
        if (image >> k & 1) v -= 2 * images_[k].dot(v) * images_[k];
    return v;
}

List<samplePlane::image> samplePlane::nearPlane(const particleCloud& cloud, scalar distance) const
{
    List<image> result;
    // every combination of the symmetry planes is one image
    for (size_t m = 0; m < size_t(1) << images_.size(); ++m)
        for (label i = 0; i < cloud.n(); ++i)
            if (const vector x = mirrored(cloud.x[i].xyz() - point_, m);
                std::abs(x.dot(normal_)) <= distance)
                result.push_back({i, m, x});
    return result;
}

word samplePlane::grid(const particleCloud& cloud) const
{
    const scalar dx = cloud.dx;
    const List<image> near = nearPlane(cloud, radiusFactor * dx);
    List<vector> all, chosen;
    List<label> row;
    for (size_t k = 0; k < near.size(); ++k)
    {
        all.push_back(near[k].x);
        if (inZones_[cloud.zone[near[k].i]]) chosen.push_back(near[k].x), row.push_back(label(k));
    }
    const pointSampler sampler(chosen, radiusFactor * dx), any(all, radiusFactor * dx);
    word text = "# x\ty";
    for (const particleField& f : fields_)
        text += "\t" +
                (f.isVector() ? f.name() + "_x\t" + f.name() + "_y\t" + f.name() + "_n" : f.name());
    text += "\n";
    for (label j = 0; j < count(yRange_, spacing_); ++j)
    {
        for (label i = 0; i < count(xRange_, spacing_); ++i)
        {
            const scalar px = xRange_[0] + i * spacing_, py = yRange_[0] + j * spacing_;
            const vector point = px * xAxis_ + py * yAxis_;
            const auto nearest = any.nearest(point);
            const bool blank = nearest.index < 0 || nearest.distance > blankFactor * dx ||
                               !inZones_[cloud.zone[near[size_t(nearest.index)].i]];
            const auto weights = sampler.weights(point);
            text += number(px) + "\t" + number(py);
            for (const particleField& f : fields_)
            {
                vector v = vector::Zero();
                for (const auto& [index, weight] : weights)
                {
                    const image& at = near[size_t(row[size_t(index)])];
                    if (f.isVector()) v += weight * mirrored(f.vectorAt(at.i), at.image);
                    else v[0] += weight * f.at(at.i);
                }
                if (!f.isVector()) text += "\t" + (blank ? "NaN" : number(v[0]));
                else
                    for (const vector& axis : {xAxis_, yAxis_, normal_})
                        text += "\t" + (blank ? "NaN" : number(axis.dot(v)));
            }
            text += "\n";
        }
        text += "\n";
    }
    return text;
}

word samplePlane::slice(const particleCloud& cloud) const
{
    word text = "# x\ty\tn\tzone\tU_x\tU_y\tU_n\n";
    for (const image& at : nearPlane(cloud, sliceThickness_ / 2))
    {
        if (!inSlice_[cloud.zone[at.i]]) continue;
        for (const vector& axis : {xAxis_, yAxis_, normal_}) text += number(axis.dot(at.x)) + "\t";
        text += cloud.zones[cloud.zone[at.i]].name;
        const vector U = mirrored(cloud.Up[at.i].xyz(), at.image);
        for (const vector& axis : {xAxis_, yAxis_, normal_}) text += "\t" + number(axis.dot(U));
        text += "\n";
    }
    return text;
}

}  // namespace ispf
