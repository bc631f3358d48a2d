// SPDX-License-Identifier: GPL-3.0-or-later
// Wall shear stress and pressure of the fluid on walls and on surfaces of solid zones, triangle by triangle, and their
// history:
//
//     shear { type wallShearStress; patches (walls); zones (wall); start 0.8; }
//
//     wallShearStress     tau = - mu (grad U + grad U^T) n without its normal part, n out of the fluid [Pa]: along the flow
//     TAWSS               1/T int |tau| dt [Pa]
//     OSI                 (1 - |int tau dt|/int |tau| dt)/2, from 0 to 0.5
//     RRT                 1/((1 - 2 OSI) TAWSS) = T/|int tau dt| [1/Pa]
//
// (He & Ku 1996, J. Biomech. Eng. 118; Himburg et al. 2004, Ann. Biomed. Eng. 32).  The integrals begin at `start` [s] and
// have the value of each step's end (wallShear.H).
// A triangle without particles before it has `covered` 0 and zeros; it does not count in means and integrals.
#include "functionObject.H"

#include "fileNames.H"
#include "vtkSurface.H"
#include "wallShear.H"
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace ispf
{

namespace
{

// A triangle sums these from the start on
struct history
{
    scalar time = 0, size = 0;  // int dt [s], int |tau| dt [Pa s]
    vector sum = vector::Zero();

    static constexpr size_t nNumbers = 5;

    void add(const vector& tau, scalar dt) { time += dt, size += tau.norm() * dt, sum += tau * dt; }
    scalar TAWSS() const { return time > 0 ? size / time : 0; }
    scalar OSI() const { return size > 0 ? 0.5 * std::max(0.0, 1 - sum.norm() / size) : 0; }
    scalar RRT() const { return sum.norm() > 0 ? time / sum.norm() : 0; }
};

// Mean over the area and largest value
struct meanAndMax
{
    scalar sum = 0, area = 0, most = 0;

    void add(scalar value, scalar a) { sum += a * value, area += a, most = std::max(most, value); }
    scalar mean() const { return area > 0 ? sum / area : std::nan(""); }
};

class wallShearStress : public functionObject
{
public:
    wallShearStress(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          start_(
              dict.getOrDefault<scalar>("start", -std::numeric_limits<scalar>::max(), dims::time))
    {
        for (const word& b : dict.getOrDefault<List<word>>("patches", {}))
            bodies_.push_back(loadedBody::wall(b, c, dict.where("patches")));
        for (const word& b : dict.getOrDefault<List<word>>("zones", {}))
            bodies_.push_back(loadedBody::solid(b, c, dict.where("zones")));
        if (bodies_.empty())
            throw fatalError(
                "wallShearStress wants patches, the names of walls, or zones, of solids.",
                dict.where());
        histories_.resize(bodies_.size());
        for (const loadedBody& b : bodies_)
            files_.push_back(
                table(b.name() + ".dat",
                      ofModelled({"Wall shear stress on " + b.name() +
                                      " [Pa]: mean over the area and largest value",
                                  "RRT [1/Pa]; covered: share of the area with fluid before it"}),
                      {"mean(tau)", "max(tau)", "mean(TAWSS)", "max(TAWSS)", "mean(OSI)",
                       "max(OSI)", "max(RRT)", "mean(p)", "covered"}));
    }

    word defaultWriteControl() const override { return "writeTime"; }

    void execute() override
    {
        const scalar now = case_.time.value();
        const scalar from = std::isnan(last_) ? now - case_.time.deltaTBehind() : last_;
        const scalar dt = now - std::max(from, start_);
        last_ = now;
        if (!(dt > 0)) return;
        const pairFriction friction(case_);
        for (size_t b = 0; b < bodies_.size(); ++b)
        {
            const List<sample> samples = samplesOf(bodies_[b], bodies_[b].lasting(), friction);
            histories_[b].resize(samples.size());
            for (size_t k = 0; k < samples.size(); ++k)
                if (samples[k].covered) histories_[b][k].add(samples[k].tau, dt);
        }
    }

    void write() override
    {
        const pairFriction friction(case_);
        for (size_t b = 0; b < bodies_.size(); ++b)
        {
            const List<loadedBody::triangulation> sides = bodies_[b].lasting();
            const List<sample> samples = samplesOf(bodies_[b], sides, friction);
            histories_[b].resize(samples.size());
            writeRow(files_[b], samples, histories_[b]);
            writeSurface(bodies_[b].name(), sides, samples, histories_[b]);
        }
    }

    bool sumsOverTime() const override { return true; }

    // Time of the last addition, `start`, then for each body its key, the number of triangles and their histories
    List<scalar> state() const override
    {
        List<scalar> all = {last_, start_};
        for (size_t b = 0; b < bodies_.size(); ++b)
        {
            all.push_back(keyOf(bodies_[b])), all.push_back(scalar(histories_[b].size()));
            for (const history& h : histories_[b])
                all.insert(all.end(), {h.time, h.size, h.sum[0], h.sum[1], h.sum[2]});
        }
        return std::isnan(last_) ? List<scalar>() : all;
    }

    void restore(const List<scalar>& state) override
    {
        size_t at = 0;
        const auto next = [&] { return at < state.size() ? state[at++] : -1; };
        const scalar last = next(), start = next();
        std::map<scalar, List<history>> kept;
        while (at < state.size())
        {
            List<history>& body = kept[next()];
            for (label n = label(next()); n > 0; --n)
            {
                history& h = body.emplace_back();
                h.time = next(), h.size = next();
                for (int a = 0; a < 3; ++a) h.sum[a] = next();
            }
        }
        const auto anew = [&](const word& why) {
            warning("Function object " + name() + ": " + why + " the time " +
                    case_.time.timeName() +
                    " written, so TAWSS, OSI and RRT begin anew at this time.");
        };
        last_ = last;
        if (start != start_) return anew("`start` is not that of");
        for (size_t b = 0; b < bodies_.size(); ++b)
        {
            size_t n = 0;
            for (const loadedBody::triangulation& s : bodies_[b].lasting()) n += s.facets.size();
            const auto found = kept.find(keyOf(bodies_[b]));
            if (found != kept.end() && found->second.size() == n) histories_[b] = found->second;
            else anew("the triangles of " + bodies_[b].name() + " are not those of");
        }
    }

private:
    // A whole number that another body hardly has (FNV-1a of its kind and name)
    static scalar keyOf(const loadedBody& body)
    {
        std::uint64_t key = 14695981039346656037u;
        for (const char c : (body.isWall() ? "wall " : "zone ") + body.name())
            key = (key ^ std::uint8_t(c)) * 1099511628211u;
        return scalar(key >> 12);
    }

    struct sample
    {
        vector tau = vector::Zero();
        scalar p = 0, area;
        bool covered;
    };

    List<sample> samplesOf(const loadedBody& body, const List<loadedBody::triangulation>& sides,
                           const pairFriction& friction) const
    {
        const List<vector> tau = wallShear(body, sides, case_, friction);
        List<sample> all;
        for (const loadedBody::triangulation& s : sides)
            for (size_t k = 0; k < s.facets.size(); ++k)
            {
                const scalar area = s.facets[k].area.norm();
                // a triangle without area has no normal
                all.push_back({.area = area, .covered = s.fluid[k].covered && area > 0});
                if (!all.back().covered) continue;
                all.back().tau = tau[all.size() - 1];
                all.back().p = s.fluid[k].p;
            }
        return all;
    }

    void writeRow(dataFile& file, const List<sample>& samples, const List<history>& histories) const
    {
        meanAndMax tau, TAWSS, OSI, RRT, p;
        scalar area = 0;
        for (size_t k = 0; k < samples.size(); ++k)
        {
            const sample& s = samples[k];
            area += s.area;
            if (s.covered) tau.add(s.tau.norm(), s.area), p.add(s.p, s.area);
            const history& h = histories[k];
            if (h.time > 0)
                TAWSS.add(h.TAWSS(), s.area), OSI.add(h.OSI(), s.area), RRT.add(h.RRT(), s.area);
        }
        file.begin(case_.time.value())
            << tau.mean() << tau.most << TAWSS.mean() << TAWSS.most << OSI.mean() << OSI.most
            << RRT.most << p.mean() << (area > 0 ? tau.area / area : 0);
        file.endRow();
    }

    void writeSurface(const word& body, const List<loadedBody::triangulation>& sides,
                      const List<sample>& samples, const List<history>& histories) const
    {
        List<triSurface> surfaces;
        for (const loadedBody::triangulation& s : sides) surfaces.push_back(s.surface);
        triangleField tau{"wallShearStress", {}}, p{"p", {}}, TAWSS{"TAWSS", {}}, OSI{"OSI", {}},
            RRT{"RRT", {}}, covered{"covered", {}, {}, true};
        for (const sample& s : samples)
            tau.vectors.push_back(s.tau), p.scalars.push_back(s.p),
                covered.scalars.push_back(s.covered);
        for (const history& h : histories)
            TAWSS.scalars.push_back(h.TAWSS()), OSI.scalars.push_back(h.OSI()),
                RRT.scalars.push_back(h.RRT());
        const word time = case_.time.timeName();
        writeText(folder(time) + "/" + body + ".vtk",
                  vtkText(body + " at time " + time, surfaces, {tau, p, TAWSS, OSI, RRT, covered},
                          precision(6)));
        listTimes(body + ".vtk");
    }

    scalar start_;
    List<loadedBody> bodies_;
    List<List<history>> histories_;  // per body and triangle
    scalar last_ = std::nan("");     // [s] end of the last addition; NaN: there was none
    List<dataFile> files_;
};

}  // namespace

std::unique_ptr<functionObject> newWallShearStress(const word& name, const dictionary& dict,
                                                   const fsiCase& c)
{
    return std::make_unique<wallShearStress>(name, dict, c);
}

}  // namespace ispf
