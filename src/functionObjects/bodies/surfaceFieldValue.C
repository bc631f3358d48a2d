// SPDX-License-Identifier: GPL-3.0-or-later
// One number for a field of the fluid on a patch, a solid or a surface, as OpenFOAM's function object of this name:
//
//     inletPressure { type surfaceFieldValue; operation areaAverage; patches (inlet); fields (p); }
//
//     areaAverage      mean over the area with particles before it
//     areaIntegrate    integral over that area; [.. m] in two dimensions
//     min, max         of the triangles; magnitudes of vectors
//
// patches: walls and open faces of constant/boundary; zones: surfaces of solids; surfaces: constant/triSurface/<name>.stl.  All
// given together are one area.  fields: p, U, wallShearStress (p), and with zones alone those of the solid (particleFields.H),
// fitted to its particles.  `covered` is the share of the area with particles near
// enough.  Of the modelled part where symmetry planes cut the body.
#include "functionObject.H"

#include "dataFile.H"
#include "fieldSampler.H"
#include "wallShear.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

class surfaceFieldValue : public functionObject
{
public:
    surfaceFieldValue(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          operation_(dict.choose("operation", {"areaAverage", "areaIntegrate", "min", "max"})),
          fields_(dict.getOrDefault<List<word>>("fields", {"p"})),
          bodies_(loadedBody::chosen(dict, c)),
          solid_(solidFieldsOf(dict, c)),
          file_(table("surfaceFieldValue.dat",
                      ofModelled({operation_ + " over the surface; covered: share of its area"}),
                      titles()))
    {
    }

    void write() override
    {
        List<vector> result(fields_.size(), vector::Constant(start()));
        scalar covered = 0, whole = 0;
        const bool shears =
            std::find(fields_.begin(), fields_.end(), "wallShearStress") != fields_.end();
        const auto friction = shears ? std::make_unique<pairFriction>(case_) : nullptr;
        for (const loadedBody& b : bodies_)
        {
            const List<loadedBody::side> sides = b.sides();
            const List<vector> tau =
                shears ? wallShear(b, sides, case_, *friction) : List<vector>();
            const List<List<vector>> ofSolid = solidValues(b, sides);
            size_t n = 0;
            for (const loadedBody::side& s : sides)
                for (size_t k = 0; k < s.facets.size(); ++k, ++n)
                {
                    const scalar area = s.facets[k].area.norm();
                    whole += area;
                    if (!s.fluid[k].covered) continue;
                    covered += area;
                    for (size_t f = 0; f < fields_.size(); ++f)
                    {
                        const vector v = solid_[f]           ? ofSolid[f][n]
                                         : fields_[f] == "p" ? vector(s.fluid[k].p, 0, 0)
                                         : fields_[f] == "U" ? s.fluid[k].U
                                                             : tau[n];
                        const scalar size = isVector(f) ? v.norm() : v[0];
                        if (sums()) result[f] += area * v;
                        else if (operation_ == "min") result[f][0] = std::min(result[f][0], size);
                        else result[f][0] = std::max(result[f][0], size);
                    }
                }
        }
        file_.begin(case_.time.value());
        for (size_t f = 0; f < fields_.size(); ++f)
        {
            if (operation_ == "areaAverage") result[f] /= covered;
            if (covered == 0) result[f].setConstant(std::nan(""));
            if (sums() && isVector(f)) file_ << result[f];
            else file_ << result[f][0];
        }
        file_ << (whole > 0 ? covered / whole : 0);
        file_.endRow();
    }

private:
    bool sums() const { return operation_ != "min" && operation_ != "max"; }
    scalar start() const { return operation_ == "min" ? 1e300 : operation_ == "max" ? -1e300 : 0; }

    bool isVector(size_t f) const { return solid_[f] ? solid_[f]->isVector() : fields_[f] != "p"; }

    // Per field: null if it is one of the fluid
    List<std::shared_ptr<particleField>> solidFieldsOf(const dictionary& dict,
                                                       const fsiCase& c) const
    {
        const List<word> ofFluid = {"p", "U", "wallShearStress"};
        if (fields_.empty()) dict.fail("fields", "It names no field and has no effect");
        List<word> valid = ofFluid;
        const bool solids = dict.getOrDefault<List<word>>("zones", {}).size() == bodies_.size();
        if (solids) valid.insert(valid.end(), solidFieldNames().begin(), solidFieldNames().end());
        const auto isIn = [](const List<word>& names, const word& name) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        List<std::shared_ptr<particleField>> all(fields_.size());
        for (size_t f = 0; f < fields_.size(); ++f)
        {
            if (isIn(ofFluid, fields_[f])) continue;
            if (!solids && isIn(solidFieldNames(), fields_[f]))
                dict.fail("fields", "Field " + fields_[f] +
                                        " is one of solids: it needs 'zones' of solids alone");
            if (!isIn(valid, fields_[f]))
                dict.fail("fields", "There is no field '" + fields_[f] + "' here. " +
                                        validWords("field", valid));
            all[f] = std::make_shared<particleField>(c.cloud, fields_[f], dict.where("fields"), &c);
        }
        return all;
    }

    // Per field of a solid: its values at the facets of all sides, one after the other
    List<List<vector>> solidValues(const loadedBody& b, const List<loadedBody::side>& sides) const
    {
        List<List<vector>> all(fields_.size());
        if (std::none_of(solid_.begin(), solid_.end(), [](const auto& f) { return bool(f); }))
            return all;
        List<vector> points;
        for (const loadedBody::side& s : sides)
            for (const facet& f : s.facets) points.push_back(f.centre);
        fieldSampler sampler(dictionary::fromString("zones (" + b.name() + ");"), case_);
        sampler.update(points);
        for (size_t f = 0; f < fields_.size(); ++f)
            for (size_t k = 0; solid_[f] && k < points.size(); ++k)
                all[f].push_back(isVector(f) ? sampler.sampleVector(*solid_[f], k)
                                             : vector(sampler.sample(*solid_[f], k), 0, 0));
        return all;
    }

    List<word> titles() const
    {
        List<word> all;
        for (const word& f : fields_) all.push_back(operation_ + "(" + f + ")");
        all.push_back("covered");
        return all;
    }

    word operation_;
    List<word> fields_;
    List<loadedBody> bodies_;
    List<std::shared_ptr<particleField>> solid_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newSurfaceFieldValue(const word& name, const dictionary& dict,
                                                     const fsiCase& c)
{
    return std::make_unique<surfaceFieldValue>(name, dict, c);
}

}  // namespace ispf
