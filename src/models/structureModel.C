// SPDX-License-Identifier: GPL-3.0-or-later
#include "structureModel.H"
#include "parallel.H"

namespace ispf
{

std::unique_ptr<structureModel> newSpringNetwork(const dictionary&, const structureReference&);

namespace
{

structureReference checked(const structureReference& ref)
{
    ref.check();
    return ref;
}

// y = K x, and its norm
scalar product(const structureTangent& K, const List<vector>& x, List<vector>& y)
{
    const label n = label(K.diagonal.size());
    const auto rows = [&](label begin, label end) {
        scalar sum = 0;
        for (label i = begin; i < end; ++i)
        {
            y[i] = K.diagonal[i] * x[i];
            for (label s = K.rowStart[i]; s < K.rowStart[i + 1]; ++s)
                y[i] += K.value[s] * x[K.column[s]];
            sum += y[i].squaredNorm();
        }
        return sum;
    };
    return std::sqrt(parallelSum(n, rows));
}

}  // namespace

structureModel::structureModel(const structureReference& ref) : ref_(checked(ref)), gradient_(ref_)
{
}

std::unique_ptr<structureModel> structureModel::New(const dictionary& dict,
                                                    const structureReference& ref)
{
    if (dict.empty()) return nullptr;
    const word model = dict.choose("structureModel", {"springNetwork"});
    // one projection serves both media: a density jump would need a variable-density one
    if (dict.found("rho") && std::abs(dict.get<scalar>("rho") / ref.rho - 1) > 1e-6)
        dict.fail("rho", "the solid's density must equal the fluid's, " + str(ref.rho) +
                             " kg/m^3: fluid and solid are solved as one medium of one density. "
                             "Leave the entry out, or change the fluid's");
    std::unique_ptr<structureModel> made;
    if (model == "springNetwork") made = newSpringNetwork(dict, ref);
    return made;
}

scalar structureModel::stableTimeStep(const List<vec4>& x, scalar mass) const
{
    structureTangent K = tangentPattern();
    assembleTangent(x, tangentKind::positive, K);
    // Power iteration from a rough start (the fastest mode is at grid scale).  Its value approaches
    // the largest eigenvalue from below; by Gershgorin it cannot exceed the largest block row sum.
    List<vector> u(n()), Ku(n());
    for (label i = 0; i < n(); ++i)
        u[i] = vector(std::sin(12.9898 * i), std::sin(78.233 * i + 1), std::sin(37.719 * i + 2));
    scalar length = 0, omega2 = 0;
    for (const vector& v : u) length += v.squaredNorm();
    length = std::sqrt(length);
    for (int iteration = 0; iteration < 40; ++iteration)
    {
        const scalar next = product(K, u, Ku);
        omega2 = next / length / mass;
        for (label i = 0; i < n(); ++i) u[i] = Ku[i] / next;
        length = 1;
    }
    return 2 / std::sqrt(omega2);
}

}  // namespace ispf
