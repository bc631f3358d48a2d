// SPDX-License-Identifier: GPL-3.0-or-later
#include "developingProfile.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

faceElements::faceElements(const faceMesh& face, List<char> heldNodes) : held(std::move(heldNodes))
{
    const triSurface& s = face.surface();
    const label n = label(s.nodes.size());
    List<Eigen::Triplet<scalar>> entries;
    lumped = Eigen::VectorXd::Zero(n);
    for (label t = 0; t < s.size(); ++t)
    {
        const scalar area = s.areaVector(t).norm();
        this->area += area;
        for (int a = 0; a < 3; ++a)
        {
            const label i = s.triangles[t][a];
            if (held[i]) continue;
            lumped[i] += area / 3;
            const vector ea = s.corner(t, (a + 2) % 3) - s.corner(t, (a + 1) % 3);
            for (int b = 0; b < 3; ++b)
            {
                const vector eb = s.corner(t, (b + 2) % 3) - s.corner(t, (b + 1) % 3);
                if (const label j = s.triangles[t][b]; !held[j])
                    entries.emplace_back(i, j, ea.dot(eb) / (4 * area));
            }
        }
    }
    for (label i = 0; i < n; ++i)
        if (held[i]) entries.emplace_back(i, i, 1);
    stiffness.resize(n, n);
    stiffness.setFromTriplets(entries.begin(), entries.end());
}

std::unique_ptr<faceElements::factor> faceElements::factorised(scalar mass) const
{
    Eigen::SparseMatrix<scalar> A = stiffness;
    for (label i = 0; i < label(lumped.size()); ++i) A.coeffRef(i, i) += mass * lumped[i];
    return std::make_unique<factor>(A);
}

developingProfile::developingProfile(const faceMesh& face, const List<char>& held, scalar nu,
                                     const List<scalar>& start)
    : elements_(face, held), nu_(nu), start_(start), w_(start)
{
}

const List<scalar>& developingProfile::advance(const List<scalar>& kept, scalar dt, scalar mean)
{
    const label n = label(start_.size());
    if (kept.size() == start_.size()) w_ = kept;
    else
        for (label i = 0; i < n; ++i) w_[i] = mean * start_[i];
    if (dt > 0)
    {
        const scalar mass = 1 / (nu_ * dt);
        if (factoredFor_ != dt)
        {
            factor_ = elements_.factorised(mass), factoredFor_ = dt;
            driven_ = factor_->solve(elements_.lumped / nu_);
        }
        const Eigen::Map<const Eigen::VectorXd> before(w_.data(), n);
        const Eigen::VectorXd coasting =
            factor_->solve(mass * elements_.lumped.cwiseProduct(before));
        const scalar lacks = mean - elements_.mean(coasting);
        const Eigen::VectorXd after = coasting + lacks / elements_.mean(driven_) * driven_;
        w_.assign(after.data(), after.data() + n);
    }
    largest_ = 0;
    for (const scalar w : w_) largest_ = std::max(largest_, std::abs(w));
    return w_;
}

}  // namespace ispf
