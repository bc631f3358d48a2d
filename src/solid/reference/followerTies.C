// SPDX-License-Identifier: GPL-3.0-or-later
#include "followerTies.H"
#include "forPairs.H"

#include <algorithm>

namespace ispf
{

followerTies::followerTies(const structureReference& ref, const referenceGradient& fit,
                           const List<scalar>& G)
    : ref_(ref)
{
    for (label i = 0; i < ref.n(); ++i)
    {
        if (!fit.follows(i)) continue;
        const label l = fit.leader(i);
        const vector R = ref.x0[i] - ref.x0[l];
        tie t{i, G[i] * ref.volume() / R.squaredNorm(), {{i, 0, 1}, {l, 0, -1}}};
        forNeighbours<among::all>(fit.neighbours(), l, [&](pairIndex p, label a) {
            const scalar w = fit.slope(l, p).dot(R);
            t.parts.push_back({a, fit.neighbours().image[p], -w});
            t.parts[1].weight += w;
        });
        if (std::any_of(t.parts.begin(), t.parts.end(),
                        [&](const part& a) { return !ref.fixed[a.particle]; }))
            ties_.push_back(std::move(t));
    }
    setMatrix();
}

void followerTies::setMatrix()
{
    tensor one = tensor::Zero();
    one.diagonal().head(ref_.nDims).setOnes();
    const auto turned = [&](const part& a) -> tensor {
        if (!a.image) return a.weight * one;
        return a.weight * one * ref_.images[a.image - 1].R;
    };
    List<blockMatrix3::entry> entries;
    for (const tie& t : ties_)
        for (const part& a : t.parts)
            for (const part& b : t.parts)
                entries.push_back(
                    {a.particle, b.particle, t.c * turned(a).transpose() * turned(b)});
    K_ = blockMatrix3::ofEntries(ref_.n(), std::move(entries));
}

vector followerTies::missed(const List<vec4>& x, const tie& t) const
{
    vector y = vector::Zero();
    for (const part& a : t.parts)
    {
        vector at = x[a.particle].xyz();
        if (a.image) at = ref_.images[a.image - 1](at);
        y += a.weight * at;
    }
    return y;
}

scalar followerTies::energy(const List<vec4>& x) const
{
    scalar sum = 0;
    for (const tie& t : ties_) sum += 0.5 * t.c * missed(x, t).squaredNorm();
    return sum;
}

void followerTies::addForce(const List<vec4>& x, List<vec4>& f) const
{
    for (const tie& t : ties_)
    {
        const vector force = -t.c * missed(x, t);
        for (const part& a : t.parts)
        {
            vector share = a.weight * force;
            if (a.image) share = (ref_.images[a.image - 1].R.transpose() * share).eval();
            f[a.particle].s += vec4::from(share).s;
        }
    }
}

// The virial of a tie is c y y^T, as the places with their weights sum up to y
void followerTies::addStress(const List<vec4>& x, List<tensor>& tau) const
{
    for (const tie& t : ties_)
    {
        const vector y = missed(x, t);
        tau[t.follower] += t.c / ref_.volume() * y * y.transpose();
    }
}

void followerTies::addTangent(blockMatrix3& K) const
{
    if (!empty()) K = K.plus(K_);
}

void followerTies::addLinkCounts(List<label>& count) const
{
    for (const tie& t : ties_) count[t.follower] += label(t.parts.size()) - 1;
}

blockMatrix3 followerTies::withPattern(blockMatrix3 pattern) const
{
    return empty() ? pattern : pattern.withZeros().plus(K_).withZeros();
}

word followerTies::summary() const
{
    return empty() ? "" : ", " + std::to_string(ties_.size()) + " at sharp tips follow others";
}

}  // namespace ispf
