// SPDX-License-Identifier: GPL-3.0-or-later
#include "energyLedger.H"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

namespace ispf
{

namespace entries
{

const stateEntry<energyLedger::account> energies{"energyLedger"};

}  // namespace entries

const std::array<word, energyLedger::nStores + energyLedger::nTerms + 1> energyLedger::titles = {
    "kinetic",   "elastic", "potential",  "walls",    "faces",  "forces",  "sources",
    "viscosity", "step",    "stabiliser", "shifting", "solver", "leftOver"};

energyLedger::energyLedger(fsiCase& c) : c_(c)
{
    if (!c.cloud.state.find(entries::energies))
        c.cloud.state.set(entries::energies, {std::numeric_limits<scalar>::quiet_NaN()});
    file_ =
        std::make_unique<dataFile>(c.caseFolder() + "/postProcessing/energyLedger/" +
                                       c.time.timeName(c.time.startTime()) + "/energyLedger.dat",
                                   List<word>{"Energies of the whole body [J]" +
                                              word(c.cloud.nDims == 2 ? ", per metre" : "") +
                                              "; walls and what follows: put in since the start"},
                                   List<word>(titles.begin(), titles.end()), 9);
}

List<scalar> energyLedger::sums(const fsiCase& c)
{
    const account kept = c.cloud.state.get(entries::energies, {});
    return List<scalar>(kept.begin() + nStores, kept.end());
}

energyLedger::account energyLedger::kept() const
{
    return c_.cloud.state.get(entries::energies, {});
}

scalar energyLedger::kineticNow() const
{
    const particleCloud& cloud = c_.cloud;
    const auto square = [&](label i) {
        return cloud.isFree(i) ? cloud.Up[i].xyz().squaredNorm() : 0;
    };
    return 0.5 * c_.rho * cloud.volume() * sumOf(0, cloud.n(), square);
}

std::array<scalar, energyLedger::nStores> energyLedger::energies(const List<vec4>& x) const
{
    const particleCloud& cloud = c_.cloud;
    const scalar mass = c_.rho * cloud.volume();
    const auto height = [&](label i) {
        return cloud.isFree(i) ? -c_.bodyForce[cloud.zone[i]].dot(x[i].xyz()) : 0;
    };
    const scalar heights = c_.bodyForce.empty() ? 0 : sumOf(0, cloud.n(), height);
    const scalar elasticNow =
        (c_.structure ? c_.structure->energy(x) : 0) + (further_ ? further_(x) : 0);
    return {kineticNow(), elasticNow, mass * heights};
}

// The energies differ from those at the end of the last step if particles were exchanged, a force has changed, or a user has
// edited the case between runs
void energyLedger::begin(const List<vec4>& x)
{
    terms_ = {}, left_ = 0;
    begin_ = energies(x);
    last_ = begin_;
    if (const account sums = kept(); !std::isnan(sums[0]))
        std::copy_n(sums.begin(), nStores, last_.begin());
    terms_[c_.walls->hasOpen() ? faces : forces] +=
        begin_[kinetic] - last_[kinetic] + begin_[potential] - last_[potential];
    terms_[step] += begin_[elastic] - last_[elastic];
}

scalar energyLedger::level(const List<vec4>& up) const
{
    const auto [n, sum] = sumsOf(c_.cloud.nSolid(), c_.cloud.n(), [&](label i) {
        return c_.cloud.isFree(i) ? std::array<scalar, 2>{1, up[i][3]} : std::array<scalar, 2>{};
    });
    return n > 0 ? sum / n : 0;
}

scalar energyLedger::taken() const
{
    const account sums = kept();
    scalar without = 0;
    for (const term t : {step, stabiliser, shifting}) without -= sums[nStores + t] + terms_[t];
    return std::max(scalar(0), std::min(-terms_[viscosity], without)) /
           (c_.rho * c_.cloud.volume());
}

void energyLedger::bookFriction(const viscousPairs::power& friction, scalar factor)
{
    terms_[viscosity] += factor * friction.dissipated;
    terms_[walls] += factor * friction.walls, terms_[faces] += factor * friction.faces;
}

// Terms of the row of particle i over dt V.  `left` is the residual of a solved row.  The solver's term is its work against
// p less the mean p.  The mean p times the missing volume is work of the boundary
std::array<scalar, energyLedger::nTerms> energyLedger::parts(label i, const continuityRow& r,
                                                             scalar level) const
{
    const particleCloud& cloud = c_.cloud;
    std::array<scalar, nTerms> of{};
    of[stabiliser] -= r.p * r.stabiliser;
    of[walls] -= r.p * (r.wallFlux - r.faceFlux), of[faces] -= r.p * r.faceFlux;
    if (cloud.pHeld(i)) of[faces] += r.p * r.row;
    else
    {
        const scalar left = r.row - r.source;
        of[sources] += r.p * r.source, of[solver] += (r.p - level) * left;
        of[c_.walls->hasOpen() ? faces : walls] += level * left;
    }
    if (!cloud.isFree(i)) of[cloud.isFluid(i) ? faces : walls] += cloud.Up[i].xyz().dot(r.gradient);
    return of;
}

scalar energyLedger::bookSprings(const List<vec4>& f, scalar dt)
{
    const auto [free, clamped] = sumsOf(0, label(f.size()), [&](label i) {
        const scalar work = dt * f[i].xyz().dot(c_.cloud.Up[i].xyz());
        return c_.cloud.isFree(i) ? std::array<scalar, 2>{work, 0} : std::array<scalar, 2>{0, work};
    });
    terms_[springs] += free + clamped, terms_[walls] -= clamped;
    return free;
}

void energyLedger::end()
{
    end_ = energies(c_.cloud.x);
    terms_[step] += terms_[springs] + end_[elastic] - begin_[elastic], terms_[springs] = 0;
    terms_[forces] += end_[potential] - begin_[potential];
    left_ = std::accumulate(end_.begin(), end_.end(), scalar(0)) -
            std::accumulate(last_.begin(), last_.end(), scalar(0)) -
            std::accumulate(terms_.begin(), terms_.end(), scalar(0));
}

void energyLedger::book()
{
    account sums = kept();
    std::copy(end_.begin(), end_.end(), sums.begin());
    for (int t = 0; t < nTerms; ++t) sums[nStores + t] += terms_[t];
    sums.back() += left_;
    c_.cloud.state.set(entries::energies, sums);
}

std::pair<scalar, scalar> energyLedger::fromNothing() const
{
    scalar gained = left_, of = end_[kinetic] + begin_[kinetic];
    for (int t = viscosity; t < nTerms; ++t) gained += terms_[t];
    // Without the solver's residual, which its tolerance bounds.  In fluid at rest with a guessed p it would be most of the gain
    gained -= terms_[solver];
    // a change before the step, e.g. by the user between two runs, is not made by the step
    gained -= begin_[elastic] - last_[elastic];
    for (int t = 0; t < nTerms; ++t) of += std::abs(terms_[t]);
    return {gained, of};
}

word energyLedger::largest() const
{
    int most = viscosity;
    for (int t = viscosity; t < nTerms; ++t)
        if (t != solver && terms_[t] > terms_[most]) most = t;
    return left_ > terms_[most] ? titles.back() : titles[nStores + most];
}

void energyLedger::writeLine()
{
    const scalar whole = c_.walls->symmetryFactor();
    const account sums = kept();
    file_->begin(c_.time.value());
    for (const scalar value : sums) *file_ << whole * value;
    file_->endRow();
    info() << "energy ledger [J]:";
    for (size_t k = 0; k < sums.size(); ++k)
        if (sums[k] != 0 || k == kinetic || k + 1 == sums.size())
            info() << " " << titles[k] << " " << str(whole * sums[k])
                   << (k + 1 < sums.size() ? "," : "\n");
}

}  // namespace ispf
