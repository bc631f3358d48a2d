// SPDX-License-Identifier: GPL-3.0-or-later
// Fields at fixed points over time; one file per field, as OpenFOAM's probes:
//
//     chamber { type probes; fields (p U); probeLocations ((0 0 10e-3)); zones (chamber); }
//
// fields: U p (default), or fields that a model has registered.  zones, radius: see fieldSampler.H.  A probe
// outside them has NaN.  Points that move with a solid are given at rest:
//
//     tip { type materialProbes; probeLocations ((0.6 0.2 0)); zones (flag); }
//
// fields: displacement (default), U, p, or fields that a model has registered.
#include "functionObject.H"

#include "dataFile.H"
#include "fieldSampler.H"
#include "fileNames.H"
#include <fstream>

namespace ispf
{

namespace
{

constexpr size_t width = 14;

word aligned(const word& text, size_t w)
{
    return word(text.size() < w ? w - text.size() : 1, ' ') + text;
}

class probes : public functionObject
{
public:
    probes(const word& name, const dictionary& dict, const fsiCase& c, fieldSampler::frame frame)
        : functionObject(name, dict, c),
          points_(dict.get<List<vector>>("probeLocations", dims::length)),
          sampler_(dict, c, frame),
          fields_(fieldsOf(c.cloud, dict, defaults(frame), &c)),
          files_(fields_.size())
    {
        if (points_.empty()) dict.fail("probeLocations", "At least one point (x y z) is wanted.");
        if (frame == fieldSampler::frame::rest) refuseUnreached(dict);
    }

    void write() override
    {
        sampler_.update(points_);
        if (!files_.front().is_open()) tellUnreached();
        for (size_t f = 0; f < fields_.size(); ++f)
        {
            if (!files_[f].is_open()) open(f);
            files_[f] << aligned(str(case_.time.value(), 12), width);
            for (size_t k = 0; k < points_.size(); ++k) files_[f] << value(fields_[f], k);
            files_[f] << std::endl;
            if (!files_[f])
                throw fatalError("Cannot write " + startFolder() + "/" + fields_[f].name() +
                                 ". Is the disk full?");
        }
    }

private:
    static List<word> defaults(fieldSampler::frame frame)
    {
        if (frame == fieldSampler::frame::rest) return {"displacement"};
        return {"U", "p"};
    }

    // A point of the solid is at the same place of the rest for ever
    void refuseUnreached(const dictionary& dict)
    {
        sampler_.update(points_);
        for (size_t k = 0; k < points_.size(); ++k)
            if (!sampler_.reaches(k))
                dict.fail("probeLocations", "No solid is at rest within reach of probe " +
                                                std::to_string(k) + " at " + at(points_[k]) +
                                                "; the nearest particle is at " +
                                                at(sampler_.nearest(points_[k])));
    }

    static word at(const vector& x)
    {
        return "(" + str(x[0]) + " " + str(x[1]) + " " + str(x[2]) + ")";
    }

    void tellUnreached() const
    {
        for (size_t k = 0; k < points_.size(); ++k)
            if (!sampler_.reaches(k))
                warning("probes: no particle is within reach of probe " + std::to_string(k) +
                        " at " + at(points_[k]) + "; nan is written until one comes");
    }

    size_t columnWidth(const particleField& f) const
    {
        return f.isVector() ? 3 * width + 2 : width;
    }

    word value(const particleField& f, size_t k) const
    {
        word text;
        for (const scalar v : sampler_.components(f, k))
            text += (text.empty() ? "" : " ") + scientific(v, precision(6));
        return aligned(f.isVector() ? "(" + text + ")" : text, columnWidth(f));
    }

    void open(size_t f)
    {
        const word path = tablePath(fields_[f].name());
        word header, numbers = "#" + aligned("Probe", width - 1);
        for (size_t k = 0; k < points_.size(); ++k)
        {
            header += "# Probe " + std::to_string(k) + " " + at(points_[k]) + "\n";
            numbers += aligned(std::to_string(k), columnWidth(fields_[f]));
        }
        writeText(path, header + numbers + "\n#" + aligned("Time", width - 1) + "\n");
        files_[f].open(path, std::ios::app);
    }

    List<vector> points_;
    fieldSampler sampler_;
    List<particleField> fields_;
    List<std::ofstream> files_;
};

}  // namespace

std::unique_ptr<functionObject> newProbes(const word& name, const dictionary& dict,
                                          const fsiCase& c)
{
    return std::make_unique<probes>(name, dict, c, fieldSampler::frame::present);
}

std::unique_ptr<functionObject> newMaterialProbes(const word& name, const dictionary& dict,
                                                  const fsiCase& c)
{
    return std::make_unique<probes>(name, dict, c, fieldSampler::frame::rest);
}

}  // namespace ispf
