// SPDX-License-Identifier: GPL-3.0-or-later
#include "viscosityModel.H"

#include "execution.H"
#include "pairViscosity.H"
#include "sphc.H"

#include <cmath>
#include <limits>

namespace ispf
{

namespace
{

class CarreauYasuda : public viscosityModel
{
public:
    CarreauYasuda(const dictionary& dict, scalar mu)
        : excess_(dict.getInRange("mu0", 0, 1e30, dims::dynamicViscosity) / mu - 1),
          lambda_(dict.getInRange("lambda", 0, 1e30, dims::time)),
          a_(dict.getInRangeOrDefault("a", 1e-3, 1e3, 2)),
          n_(dict.getInRange("n", 0, 1))
    {
        if (excess_ < 0)
            dict.fail("mu0",
                      "mu0, the viscosity at rest, must not be below the limit at high shear "
                      "rates, " +
                          str(mu) + " Pa s");
    }
    scalar ratio(scalar g) const override
    {
        return 1 + excess_ * std::pow(1 + std::pow(lambda_ * g, a_), (n_ - 1) / a_);
    }
    word description() const override
    {
        return "CarreauYasuda, at rest " + str(1 + excess_, 4) + " times that";
    }

private:
    scalar excess_, lambda_, a_, n_;
};

class Casson : public viscosityModel
{
public:
    Casson(const dictionary& dict, scalar mu)
        : rate_(dict.getInRange("yieldStress", 0, 1e30, dims::pressure) / mu),
          most_(dict.getInRange("muMax", 0, 1e30, dims::dynamicViscosity) / mu)
    {
        if (most_ < 1)
            dict.fail("muMax", "muMax must not be below the limit at high shear rates, " + str(mu) +
                                   " Pa s");
    }
    scalar ratio(scalar g) const override
    {
        const scalar root = 1 + std::sqrt(rate_ / std::max(g, std::numeric_limits<scalar>::min()));
        return std::min(root * root, most_);
    }
    word description() const override { return "Casson, at rest " + str(most_, 4) + " times that"; }

private:
    scalar rate_;  // yield stress over mu [1/s]
    scalar most_;
};

}  // namespace

std::unique_ptr<viscosityModel> viscosityModel::New(const dictionary& dict, scalar mu)
{
    const word kind = dict.chooseOrDefault("viscosityModel",
                                           {"Newtonian", "CarreauYasuda", "Casson"}, "Newtonian");
    if (kind == "Newtonian") return nullptr;
    if (!(mu > 0))
        dict.fail("viscosityModel",
                  "This model needs a mu (or nu) above zero: the viscosity at high "
                  "shear rates");
    if (kind == "Casson") return std::make_unique<Casson>(dict, mu);
    return std::make_unique<CarreauYasuda>(dict, mu);
}

void viscosityModel::update(particleCloud& cloud, const neighbourList& list,
                            const kernelCorrection& B) const
{
    cloud.fillGhosts(cloud.Up, false);
    const List<scalar> rate = sphc::shearRate({cloud, list, B}, cloud.Up);
    List<scalar>& of = cloud.scalars[viscosityRatio];
    of.assign(cloud.n(), 1);
    forEach(cloud.nSolid(), cloud.n(), [&](label i) { of[i] = ratio(rate[i]); });
}

}  // namespace ispf
