// SPDX-License-Identifier: GPL-3.0-or-later
// Fields along a line, one file per time: postProcessing/<name>/<time>/line.dat
//
//     above { type lineProfile; start (-8e-3 0 13.5e-3); end (8e-3 0 13.5e-3); nPoints 65;
//             fields (U p); zones (chamber); }
//
// By default it writes when particles are written.  Points without particles have NaN.
#include "functionObject.H"

#include "dataFile.H"
#include "fieldSampler.H"
#include "fileNames.H"

namespace ispf
{

namespace
{

class lineProfile : public functionObject
{
public:
    lineProfile(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          fields_(fieldsOf(c.cloud, dict, {"U", "p"}, &c)),
          sampler_(dict, c)
    {
        const vector a = dict.get<vector>("start", dims::length),
                     b = dict.get<vector>("end", dims::length);
        const label n = dict.getInRangeOrDefault<label>("nPoints", 2, 1e6, 101);
        if (!((b - a).norm() > 0)) dict.fail("end", "The line has no length: start and end agree.");
        for (label k = 0; k < n; ++k) points_.push_back(a + scalar(k) / (n - 1) * (b - a));
    }

    word defaultWriteControl() const override { return "writeTime"; }

    void write() override
    {
        sampler_.update(points_);
        word text = "# distance\tx\ty\tz";
        for (const particleField& f : fields_) text += "\t" + join(f.titles(), "\t");
        text += "\n";
        for (size_t k = 0; k < points_.size(); ++k)
        {
            const auto put = [&](scalar v) { text += scientific(v, precision(6)) + "\t"; };
            put((points_[k] - points_[0]).norm());
            for (int d = 0; d < 3; ++d) put(points_[k][d]);
            for (const particleField& f : fields_)
                for (const scalar v : sampler_.components(f, k)) put(v);
            text.pop_back();
            text += "\n";
        }
        writeText(folder(case_.time.timeName()) + "/line.dat", text);
    }

private:
    List<vector> points_;
    List<particleField> fields_;
    fieldSampler sampler_;
};

}  // namespace

std::unique_ptr<functionObject> newLineProfile(const word& name, const dictionary& dict,
                                               const fsiCase& c)
{
    return std::make_unique<lineProfile>(name, dict, c);
}

}  // namespace ispf
