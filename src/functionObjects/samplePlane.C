// SPDX-License-Identifier: GPL-3.0-or-later
#include "samplePlane.H"
#include "pointSampler.H"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <sstream>

namespace ispf
{

namespace
{

// Neighbours within 2 dx take part; a point further than dx from any particle is blank
constexpr scalar radiusFactor = 2, blankFactor = 1;

vector mirrored(const vector& v, const vector& unitNormal)
{
    return v - 2 * unitNormal.dot(v) * unitNormal;
}

word number(scalar value)
{
    if (!std::isfinite(value)) return "NaN";
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

List<word> words(const word& text)
{
    std::istringstream stream(text);
    return {std::istream_iterator<word>(stream), {}};
}

label count(const List<scalar>& range, scalar spacing)
{
    return label(std::lround((range[1] - range[0]) / spacing)) + 1;
}

}  // namespace

samplePlane::samplePlane(const word& name, const dictionary& dict)
    : name_(name),
      dict_(dict),
      point_(dict.get<vector>("point", dims::length)),
      normal_(dict.get<vector>("normal").normalized()),
      xAxis_(dict.get<vector>("xAxis")),
      xRange_(dict.get<List<scalar>>("xRange", dims::length)),
      yRange_(dict.get<List<scalar>>("yRange", dims::length)),
      zones_(dict.get<List<word>>("zones")),
      fields_(dict.get<List<word>>("fields")),
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
        sliceZones_ = slice->get<List<word>>("zones");
        sliceThickness_ = slice->getInRange("thickness", 1e-30, 1e30, dims::length);
    }
}

List<char> samplePlane::inZones(const particleTable& particles, const List<word>& names) const
{
    const auto known = particles.attributes.find("zones");
    const auto index = particles.integers.find("zone");
    if (known == particles.attributes.end() || index == particles.integers.end())
        throw fatalError(
            "The particles have no zones: attribute 'zones' or column 'zone' is absent");
    const List<word> valid = words(known->second);
    List<char> chosen(valid.size(), false);
    for (const word& name : names)
    {
        const auto at = std::find(valid.begin(), valid.end(), name);
        if (at == valid.end())
            dict_.fail("zones", "'" + name + "' is not a zone.\n" + validWords("zone", valid));
        chosen[size_t(at - valid.begin())] = true;
    }
    List<char> result;
    for (const globalId zone : index->second)
        result.push_back(zone >= 0 && size_t(zone) < chosen.size() && chosen[size_t(zone)]);
    return result;
}

particleTable samplePlane::nearPlane(const particleTable& particles, scalar distance) const
{
    particleTable result;
    result.attributes = particles.attributes;
    // every combination of the symmetry planes is one image
    for (size_t image = 0; image < size_t(1) << images_.size(); ++image)
    {
        const auto map = [&](vector v) {
            for (size_t k = 0; k < images_.size(); ++k)
                if (image >> k & 1) v = mirrored(v, images_[k]);
            return v;
        };
        for (size_t i = 0; i < particles.size(); ++i)
        {
            const vector x = map(particles.x[i] - point_);
            if (std::abs(x.dot(normal_)) > distance) continue;
            result.x.push_back(x);
            for (const auto& [name, values] : particles.scalars)
                result.scalars[name].push_back(values[i]);
            for (const auto& [name, values] : particles.vectors)
                result.vectors[name].push_back(map(values[i]));
            for (const auto& [name, values] : particles.integers)
                result.integers[name].push_back(values[i]);
        }
    }
    return result;
}

word samplePlane::grid(const particleTable& particles) const
{
    const scalar dx = particles.scalarAttribute("dx");
    const particleTable near = nearPlane(particles, radiusFactor * dx);
    const List<char> chosen = inZones(near, zones_);
    List<vector> x;
    List<label> row;
    for (size_t i = 0; i < near.size(); ++i)
        if (chosen[i]) x.push_back(near.x[i]), row.push_back(label(i));
    const pointSampler sampler(x, radiusFactor * dx), all(near.x, radiusFactor * dx);

    word text = "# x\ty";
    for (const word& field : fields_)
    {
        if (near.vectors.count(field))
            text += "\t" + field + "_x\t" + field + "_y\t" + field + "_n";
        else if (near.scalars.count(field)) text += "\t" + field;
        else
        {
            List<word> valid;
            for (const auto& column : near.vectors) valid.push_back(column.first);
            for (const auto& column : near.scalars) valid.push_back(column.first);
            dict_.fail("fields", "the particles have no field '" + field + "'.\n" +
                                     validWords("field", valid));
        }
    }
    text += "\n";
    for (label j = 0; j < count(yRange_, spacing_); ++j)
    {
        for (label i = 0; i < count(xRange_, spacing_); ++i)
        {
            const scalar px = xRange_[0] + i * spacing_, py = yRange_[0] + j * spacing_;
            const vector point = px * xAxis_ + py * yAxis_;
            const auto nearest = all.nearest(point);
            const bool blank = nearest.index < 0 || nearest.distance > blankFactor * dx ||
                               !chosen[size_t(nearest.index)];
            auto weights = sampler.weights(point);
            for (auto& c : weights) c.index = row[size_t(c.index)];

            text += number(px) + "\t" + number(py);
            for (const word& field : fields_)
            {
                if (const auto f = near.scalars.find(field); f != near.scalars.end())
                {
                    text += "\t" + (blank ? "NaN" : number(sampler.sum(weights, f->second, 0.0)));
                    continue;
                }
                const vector v =
                    pointSampler::sum<vector>(weights, near.vectors.at(field), vector::Zero());
                for (const vector& axis : {xAxis_, yAxis_, normal_})
                    text += "\t" + (blank ? "NaN" : number(axis.dot(v)));
            }
            text += "\n";
        }
        text += "\n";
    }
    return text;
}

word samplePlane::slice(const particleTable& particles) const
{
    const particleTable near = nearPlane(particles, sliceThickness_ / 2);
    const List<char> chosen = inZones(near, sliceZones_);
    const List<globalId>& zone = near.integers.at("zone");
    const List<word> zoneNames = words(near.attributes.at("zones"));
    const auto U = near.vectors.find("U");
    word text = "# x\ty\tn\tzone\tU_x\tU_y\tU_n\n";
    for (size_t i = 0; i < near.size(); ++i)
    {
        if (!chosen[i]) continue;
        for (const vector& axis : {xAxis_, yAxis_, normal_})
            text += number(axis.dot(near.x[i])) + "\t";
        text += zoneNames[size_t(zone[i])];
        for (const vector& axis : {xAxis_, yAxis_, normal_})
            text += "\t" + (U == near.vectors.end() ? "NaN" : number(axis.dot(U->second[i])));
        text += "\n";
    }
    return text;
}

}  // namespace ispf
