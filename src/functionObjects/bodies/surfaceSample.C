// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid pressure, velocity and wall shear stress on walls and open faces, on surfaces of solid zones or on any surface at rest,
// triangle by triangle.  One file per body and time: postProcessing/<name>/<time>/<body>.<ending>
//
//     wallLoad { type surfaceSample; patches (walls); zones (wall); surfaces (section); surfaceFormat vtk; }
//     inner    { type surfaceSample; zones (wall); fields (displacement vonMises residenceTime); }
//
// surfaceFormat: vtk (the default, for ParaView, with <body>.vtk.series) or raw, a table of x y z p U wallShearStress.
// fields: further ones of the particles, fitted to those of the fluid, or of the solid zone if the field is one of a solid
// (particleFields.H).
// wallShearStress is the traction mu (grad U + grad U^T) n of the fluid on the surface without its normal part.
// Triangles without particles before them have NaN, in vtk 0 with `covered` 0.  By default it writes when
// particles are written.
#include "functionObject.H"

#include "fieldSampler.H"
#include "fileNames.H"
#include "vtkSurface.H"
#include "wallShear.H"
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace ispf
{

namespace
{

// U and p are written of the fluid in any case, and no field twice
List<particleField> further(const List<particleField>& all)
{
    std::set<word> written = {"U", "p"};
    List<particleField> others;
    for (const particleField& f : all)
        if (written.insert(f.name()).second) others.push_back(f);
    return others;
}

class surfaceSample : public functionObject
{
public:
    surfaceSample(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          vtk_(dict.chooseOrDefault("surfaceFormat", {"vtk", "raw"}, "vtk") == "vtk"),
          fields_(further(fieldsOf(c.cloud, dict, {}, &c))),
          bodies_(loadedBody::chosen(dict, c))
    {
        for (const particleField& f : fields_)
            if (f.ofSolid() && dict.getOrDefault<List<word>>("zones", {}).size() != bodies_.size())
                dict.fail("fields",
                          "Field " + f.name() + " is one of a solid: give only 'zones' of solids");
    }

    word defaultWriteControl() const override { return "writeTime"; }

    void write() override
    {
        for (const loadedBody& b : bodies_)
        {
            const word file = b.name() + (vtk_ ? ".vtk" : ".raw");
            writeText(folder(case_.time.timeName()) + "/" + file, vtk_ ? vtkText(b) : rawText(b));
            if (vtk_) listTimes(file);
        }
    }

private:
    word numbers(const vector& v) const
    {
        return number(v[0]) + " " + number(v[1]) + " " + number(v[2]);
    }
    word number(scalar v) const { return scientific(v, precision(6)); }

    struct row
    {
        vector centre, U, shear;
        scalar p;
        bool covered;
        List<List<scalar>> others = {};  // of fields_
    };
    // Of all sides, one after the other
    List<row> rowsOf(const loadedBody& b, const List<loadedBody::triangulation>& sides) const
    {
        // VTK's reader stops at a NaN
        const scalar blank = vtk_ ? 0 : std::numeric_limits<scalar>::quiet_NaN();
        const vector none = vector::Constant(blank);
        const List<vector> tau = wallShear(b, sides, case_, pairFriction(case_));
        List<row> rows;
        for (const loadedBody::triangulation& s : sides)
            for (size_t k = 0; k < s.facets.size(); ++k)
            {
                const fluidAt& f = s.fluid[k];
                rows.push_back({s.facets[k].centre, f.U, tau[rows.size()], f.p, true});
                if (!f.covered) rows.back() = {s.facets[k].centre, none, none, blank, false};
            }
        addOthers(b, rows, blank);
        return rows;
    }

    // Values of fields_ at the triangles, from the particles of the solid or of the fluid
    void addOthers(const loadedBody& b, List<row>& rows, scalar blank) const
    {
        if (fields_.empty()) return;
        List<vector> points;
        for (const row& r : rows) points.push_back(r.centre);
        for (const bool solid : {true, false})
        {
            if (std::none_of(fields_.begin(), fields_.end(),
                             [&](const particleField& f) { return f.ofSolid() == solid; }))
                continue;
            fieldSampler sampler(
                dictionary::fromString(solid ? "zones (" + b.name() + ");" : word("phase fluid;")),
                case_);
            sampler.update(points);
            for (size_t f = 0; f < fields_.size(); ++f)
            {
                if (fields_[f].ofSolid() != solid) continue;
                for (size_t k = 0; k < rows.size(); ++k)
                {
                    rows[k].others.resize(fields_.size());
                    rows[k].others[f] = sampler.components(fields_[f], k);
                    for (scalar& v : rows[k].others[f])
                        if (std::isnan(v)) v = blank;
                }
            }
        }
    }

    word rawText(const loadedBody& b) const
    {
        word text =
            "# x\ty\tz\tp\tU_x\tU_y\tU_z\twallShearStress_x\twallShearStress_y\t"
            "wallShearStress_z";
        for (const particleField& f : fields_) text += "\t" + join(f.titles(), "\t");
        text += "\n";
        for (const row& r : rowsOf(b, b.triangulated()))
        {
            word line =
                numbers(r.centre) + " " + number(r.p) + " " + numbers(r.U) + " " + numbers(r.shear);
            for (const List<scalar>& values : r.others)
                for (const scalar v : values) line += " " + number(v);
            for (char& c : line) c = c == ' ' ? '\t' : c;
            text += line + "\n";
        }
        return text;
    }

    word vtkText(const loadedBody& b) const
    {
        List<triSurface> surfaces;
        triangleField p{"p", {}}, U{"U", {}}, shear{"wallShearStress", {}},
            covered{"covered", {}, {}, true};
        List<triangleField> others;
        for (const particleField& f : fields_) others.push_back({f.name(), {}});
        const List<loadedBody::triangulation> sides = b.triangulated();
        for (const loadedBody::triangulation& s : sides) surfaces.push_back(s.surface);
        for (const row& r : rowsOf(b, sides))
        {
            covered.scalars.push_back(r.covered), p.scalars.push_back(r.p);
            U.vectors.push_back(r.U), shear.vectors.push_back(r.shear);
            for (size_t f = 0; f < others.size(); ++f)
                if (const List<scalar>& v = r.others[f]; v.size() == 1)
                    others[f].scalars.push_back(v[0]);
                else others[f].vectors.emplace_back(v[0], v[1], v[2]);
        }
        others.insert(others.begin(), {p, U, shear, covered});
        return ispf::vtkText(b.name() + " at time " + case_.time.timeName(), surfaces, others,
                             precision(6));
    }

    bool vtk_;
    List<particleField> fields_;
    List<loadedBody> bodies_;
};

}  // namespace

std::unique_ptr<functionObject> newSurfaceSample(const word& name, const dictionary& dict,
                                                 const fsiCase& c)
{
    return std::make_unique<surfaceSample>(name, dict, c);
}

}  // namespace ispf
