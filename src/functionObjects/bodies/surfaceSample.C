// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid pressure, velocity and wall shear stress on walls, on surfaces of solid zones or on any surface at rest,
// triangle by triangle.  One file per body and time: postProcessing/<name>/<time>/<body>.<ending>
//
//     wallLoad { type surfaceSample; patches (walls); zones (wall); surfaces (section); surfaceFormat vtk; }
//
// surfaceFormat: vtk (the default, for ParaView) or raw, a table of x y z p U wallShearStress.
// wallShearStress is the traction mu (grad U + grad U^T) n of the fluid on the surface without its normal part.
// Triangles without particles before them have NaN, in vtk 0 with `covered` 0.  By default it writes when
// particles are written.
#include "functionObject.H"

#include "fileNames.H"
#include "loadedBody.H"
#include "vtkSurface.H"
#include <limits>

namespace ispf
{

namespace
{

class surfaceSample : public functionObject
{
public:
    surfaceSample(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          vtk_(dict.chooseOrDefault("surfaceFormat", {"vtk", "raw"}, "vtk") == "vtk")
    {
        for (const word& b : dict.getOrDefault<List<word>>("patches", {}))
            bodies_.push_back(loadedBody::wall(b, c, dict.where("patches")));
        for (const word& b : dict.getOrDefault<List<word>>("zones", {}))
            bodies_.push_back(loadedBody::solid(b, c, dict.where("zones")));
        for (const word& b : dict.getOrDefault<List<word>>("surfaces", {}))
            bodies_.push_back(loadedBody::surface(b, c, dict.where("surfaces")));
        if (bodies_.empty())
            throw fatalError(
                "surfaceSample wants patches, the names of walls, zones, of solids, or surfaces, "
                "of "
                "constant/triSurface.",
                dict.where());
    }

    word defaultWriteControl() const override { return "writeTime"; }

    void write() override
    {
        for (const loadedBody& b : bodies_)
            writeText(folder(case_.time.timeName()) + "/" + b.name() + (vtk_ ? ".vtk" : ".raw"),
                      vtk_ ? vtkText(b) : rawText(b));
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
    };
    List<row> rowsOf(const loadedBody::side& s) const
    {
        // VTK's reader stops at a NaN
        const scalar blank = vtk_ ? 0 : std::numeric_limits<scalar>::quiet_NaN();
        List<row> rows;
        for (size_t k = 0; k < s.facets.size(); ++k)
        {
            const vector n = s.facets[k].area.normalized(), none = vector::Constant(blank);
            const fluidAt& f = s.fluid[k];
            rows.push_back({s.facets[k].centre, f.U, shearOn(n, f, case_), f.p, true});
            if (!f.covered) rows.back() = {s.facets[k].centre, none, none, blank, false};
        }
        return rows;
    }

    word rawText(const loadedBody& b) const
    {
        word text =
            "# x\ty\tz\tp\tU_x\tU_y\tU_z\twallShearStress_x\twallShearStress_y\t"
            "wallShearStress_z\n";
        for (const loadedBody::triangulation& s : b.triangulated())
            for (const row& r : rowsOf(s))
            {
                word line = numbers(r.centre) + " " + number(r.p) + " " + numbers(r.U) + " " +
                            numbers(r.shear);
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
        for (const loadedBody::triangulation& s : b.triangulated())
        {
            surfaces.push_back(s.surface);
            for (const row& r : rowsOf(s))
                covered.scalars.push_back(r.covered), p.scalars.push_back(r.p),
                    U.vectors.push_back(r.U), shear.vectors.push_back(r.shear);
        }
        return ispf::vtkText(b.name() + " at time " + case_.time.timeName(), surfaces,
                             {p, U, shear, covered}, precision(6));
    }

    bool vtk_;
    List<loadedBody> bodies_;
};

}  // namespace

std::unique_ptr<functionObject> newSurfaceSample(const word& name, const dictionary& dict,
                                                 const fsiCase& c)
{
    return std::make_unique<surfaceSample>(name, dict, c);
}

}  // namespace ispf
