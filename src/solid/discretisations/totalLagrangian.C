// SPDX-License-Identifier: GPL-3.0-or-later
// Structure model of any material on the deformation gradient of the rest neighbours, theory 5.8.  Its energy is
//
//     Psi = sum_k [V W(F_k) + V (kappa/2) (J_k - 1)^2 + (c_k/2) sum_a w_a |e_a|^2]                        (5.19)
//     e_a = x_a - x_k - F_k R_a
//
// The second part controls changes of volume that the constraint does not see, the third one motions that no F_k sees.
// Entries:
//
//     material { type neoHookean; E 1.5e6; }      // or materials { .. }, see zoneMaterials.H
//     zeroEnergy 0.2;                             // alpha: weight of the third part, over that of G
//     radius     1.75;                            // reach of the neighbours of F_k [dx]
//
// Where moduli differ the defaults are 1 and the support of the kernel: p and the stress jump there, section 5.8.
#include "followerTies.H"
#include "forPairs.H"
#include "stencilTangent.H"
#include "structureModel.H"
#include "transientNetworks.H"
#include "volumeStiffness.H"
#include "zoneMaterials.H"

#include <cmath>

namespace ispf
{

namespace
{

// kappa of (5.20) over G
constexpr scalar volumeShare = 1;

// C^+ of section 5.8: the nearest matrix without negative eigenvalues
modulusMatrix positivePart(const modulusMatrix& C)
{
    const Eigen::SelfAdjointEigenSolver<modulusMatrix> eigen(C);
    return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
           eigen.eigenvectors().transpose();
}

// (C + T)^+, and at least half of C^+, (7.24)
modulusMatrix stablePart(const modulusMatrix& C, const modulusMatrix& T)
{
    const modulusMatrix K = positivePart(C + T);
    return K + positivePart(0.5 * positivePart(C) - K);
}

// Removes the components across the plane of a two-dimensional solid
void keepPlane(modulusMatrix& C)
{
    for (const int across : {2, 5, 6, 7, 8}) C.row(across).setZero(), C.col(across).setZero();
}

// dP of the viscous stress over a change dF of the velocity gradient, per viscosity, (5.28)
modulusMatrix viscousModulus(const tensor& F)
{
    const tensor inverse = F.inverse(), square = inverse * inverse.transpose();
    modulusMatrix C;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            for (int d = 0; d < 3; ++d)
                for (int s = 0; s < 3; ++s)
                    C(r + 3 * c, s + 3 * d) =
                        (r == s ? square(d, c) : 0) + inverse(d, r) * inverse(c, s);
    return C;
}

structureReference within(structureReference ref, scalar radius)
{
    // includes a shell of lattice neighbours at exactly the radius
    ref.support = radius * ref.dx * (1 + 1e-6);
    return ref;
}

class totalLagrangian : public structureModel
{
public:
    totalLagrangian(const dictionary& dict, const structureReference& ref)
        : structureModel(ref),
          materials_(dict, ref.x0, ref.zone, ref.zoneNames),
          zeroEnergy_(dict.getInRangeOrDefault("zeroEnergy", 0, 10, materials_.differ() ? 1 : 0.2)),
          near_(within(
              ref_, dict.getInRangeOrDefault("radius", 1.2, 4,
                                             materials_.differ() ? ref_.support / ref_.dx : 1.75))),
          fit_(near_),
          pairs_(fit_.neighbours()),
          ties_(ref_, fit_, moduli())
    {
        G_ = materials_.stiffest();
        setPrestretch();
        findActive();
        setMoments();
        tangent_ = std::make_unique<stencilTangent>(ref_, fit_, active_);
        if (materials_.remembers())
            networks_ =
                std::make_unique<transientNetworks>(materials_, fit_, active_, ref_.volume());
    }

    using structureModel::fromRest;
    void fromRest(const List<vec4>& x, List<tensor>& F) const override;
    void force(const List<vec4>& x, List<vec4>& f) const override;
    scalar energy(const List<vec4>& x) const override;
    void stress(const List<vec4>& x, List<tensor>& tau) const override;
    bool stress(const motion& m, List<tensor>& tau) const override;
    blockMatrix3 tangentPattern() const override { return ties_.withPattern(tangent_->pattern()); }
    using structureModel::assembleTangent;
    void assembleTangent(const List<vec4>& x, tangentKind kind, const List<scalar>& p,
                         blockMatrix3& K) const override;
    bool damps() const override { return materials_.damps(); }
    void assembleDamping(const List<vec4>& x, blockMatrix3& D) const override;
    List<label> linkCounts() const override;
    word description() const override;
    scalar shearModulus(label k) const override { return materials_.fastModulus(k); }
    label material(label k) const override { return materials_.number(k); }
    solidMemory* memory() override { return networks_.get(); }

private:
    List<scalar> moduli() const;
    void setPrestretch();
    void findActive();
    void setMoments();

    // x_a - x_k of a pair in the row of k
    vector bond(const List<vec4>& x, label k, std::int64_t p) const
    {
        const vector xa = x[pairs_.index[p]].xyz();
        return (pairs_.image[p] ? ref_.images[pairs_.image[p] - 1](xa) : xa) - x[k].xyz();
    }
    // e_a of (5.19)
    vector missed(const List<vec4>& x, const tensor& F, label k, std::int64_t p) const
    {
        return bond(x, k, p) + F * pairs_.separation(ref_, k, p);
    }
    // F F0 of (7.19)
    tensor fromRest(const tensor& F, label k) const
    {
        return prestretch_.empty() ? F : tensor(F * prestretch_[k]);
    }
    modulusMatrix materialModulus(const tensor& F, label k) const;
    bool remembers(label k) const { return networks_ && networks_->acts(k); }
    // The first two parts of (5.19), with (5.30) and (7.19), and their derivative
    scalar energyOf(const tensor& F, label k) const
    {
        return materials_.energy(fromRest(F, k), k) + volumeOf(k).energy(F) +
               (remembers(k) ? networks_->energy(F, k) : 0);
    }
    tensor stressOf(const tensor& F, label k) const
    {
        tensor P = materials_.stress(fromRest(F, k), k);
        if (!prestretch_.empty()) P *= prestretch_[k].transpose();
        P += volumeOf(k).stress(F);
        if (remembers(k)) P += networks_->stress(F, k);
        return P;
    }
    volumeStiffness volumeOf(label k) const { return {volumeShare * materials_.shearModulus(k)}; }
    modulusMatrix modulus(const tensor& F, tangentKind kind, label k, scalar p) const;
    modulusMatrix restModulus(label k) const;
    void assembleRest(blockMatrix3& K) const;

    const zoneMaterials materials_;
    const scalar zeroEnergy_;        // alpha of (5.20)
    const structureReference near_;  // the solid at rest, with neighbours up to `radius`
    const referenceGradient fit_;    // F of the energy
    const referenceNeighbours& pairs_;
    const followerTies ties_;
    List<tensor> prestretch_;  // F0 of (7.19); empty: none
    List<char>
        active_;  // per k: it or one of its neighbours is free, and it does not follow another
    List<tensor> moment_;  // M_k [m^2]
    List<scalar> star_;    // c_k of (5.20), zero where k is not active
    std::unique_ptr<stencilTangent> tangent_;
    std::unique_ptr<transientNetworks> networks_;  // null: no material has a memory
};

List<scalar> totalLagrangian::moduli() const
{
    List<scalar> G;
    for (label k = 0; k < n(); ++k) G.push_back(materials_.shearModulus(k));
    return G;
}

void totalLagrangian::setPrestretch()
{
    if (ref_.rest.empty()) return;
    List<vec4> rest;
    for (const vector& X : ref_.rest) rest.push_back(vec4::from(X));
    fit_.apply(rest, prestretch_);
    for (tensor& F : prestretch_) F = F.inverse().eval();
}

void totalLagrangian::fromRest(const List<vec4>& x, List<tensor>& F) const
{
    structureModel::fromRest(x, F);
    for (size_t k = 0; k < prestretch_.size(); ++k) F[k] *= prestretch_[k];
}

void totalLagrangian::findActive()
{
    for (label k = 0; k < n(); ++k)
        active_.push_back(
            !fit_.follows(k) &&
            (!ref_.fixed[k] || anyNeighbour<among::all>(
                                   pairs_, k, [&](pairIndex, label j) { return !ref_.fixed[j]; })));
}

void totalLagrangian::setMoments()
{
    for (label k = 0; k < n(); ++k)
    {
        tensor M = tensor::Zero();
        if (!fit_.follows(k)) M = fit_.inverseMoment(k).inverse();
        if (ref_.nDims == 2) M(2, 2) = 0;
        moment_.push_back(M);
        star_.push_back(active_[k] ? zeroEnergy_ * materials_.shearModulus(k) * ref_.volume() *
                                         ref_.nDims / M.trace()
                                   : 0);
    }
}

// (5.22)
void totalLagrangian::force(const List<vec4>& x, List<vec4>& f) const
{
    List<tensor> P;
    fit_.apply(x, P);
    parallelFor(
        n(),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
                P[k] =
                    active_[k]
                        ? tensor(stressOf(P[k], k) - star_[k] / ref_.volume() * P[k] * moment_[k])
                        : tensor(tensor::Zero());
        },
        256);
    fit_.forces(P, f);
    forPairs<among::all>(pairs_, 0, n(), [&](label i, pairIndex p, label j) {
        f[i].s += vec4::from((star_[i] + star_[j]) * fit_.weight(p) * bond(x, i, p)).s;
    });
    ties_.addForce(x, f);
}

scalar totalLagrangian::energy(const List<vec4>& x) const
{
    List<tensor> F;
    fit_.apply(x, F);
    return ties_.energy(x) + parallelSum(n(), [&](label begin, label end) {
               scalar sum = 0;
               for (label k = begin; k < end; ++k)
               {
                   if (!active_[k]) continue;
                   sum += ref_.volume() * energyOf(F[k], k);
                   forNeighbours<among::all>(pairs_, k, [&](pairIndex p, label) {
                       sum += 0.5 * star_[k] * fit_.weight(p) * missed(x, F[k], k, p).squaredNorm();
                   });
               }
               return sum;
           });
}

// (5.24)
void totalLagrangian::stress(const List<vec4>& x, List<tensor>& tau) const
{
    List<tensor> F;
    fit_.apply(x, F);
    tau.assign(size_t(n()), tensor::Zero());
    parallelFor(
        n(),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
            {
                if (!active_[k]) continue;
                tau[k] = stressOf(F[k], k) * F[k].transpose();
                forNeighbours<among::all>(pairs_, k, [&](pairIndex p, label) {
                    const vector e = missed(x, F[k], k, p);
                    tau[k] += star_[k] / ref_.volume() * fit_.weight(p) * e * e.transpose();
                });
            }
        },
        256);
    ties_.addStress(x, tau);
}

// That of the material at F F0, for a change of F
modulusMatrix totalLagrangian::materialModulus(const tensor& F, label k) const
{
    const modulusMatrix C = materials_.tangent(fromRest(F, k), k);
    if (prestretch_.empty()) return C;
    modulusMatrix turn = modulusMatrix::Zero();  // of dF to dF F0
    for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
            for (int r = 0; r < 3; ++r) turn(r + 3 * c, r + 3 * d) = prestretch_[k](d, c);
    return turn.transpose() * C * turn;
}

// C' of (5.23), with the turning force of the pressure, (7.16)
modulusMatrix totalLagrangian::modulus(const tensor& F, tangentKind kind, label k, scalar p) const
{
    modulusMatrix C = materialModulus(F, k) + volumeOf(k).tangent(F),
                  turning = -p * cofactorDerivative(F);
    if (remembers(k)) C += networks_->tangent(F, k);
    const bool plane = ref_.nDims == 2;
    if (plane) keepPlane(C), keepPlane(turning);
    if (kind == tangentKind::full) C += turning;
    else C = p < 0 ? stablePart(C, turning) : positivePart(C + turning);
    // its rounding would couple the plane with the direction across it, where nothing but inertia resists
    if (plane) keepPlane(C);
    C *= ref_.volume();
    for (int c = 0; c < ref_.nDims; ++c)
        for (int d = 0; d < ref_.nDims; ++d)
            for (int r = 0; r < ref_.nDims; ++r)
                C(r + 3 * c, r + 3 * d) -= star_[k] * moment_[k](c, d);
    return C;
}

// (7.26): change of Cauchy's stress over grad w, where the rest places move by - w
modulusMatrix totalLagrangian::restModulus(label k) const
{
    const tensor one = tensor::Identity(), F0 = fromRest(one, k);
    const tensor stress = materials_.stress(F0, k) * F0.transpose();
    modulusMatrix C = materialModulus(one, k), ahead = modulusMatrix::Zero();
    for (int c = 0; c < 3; ++c)
    {
        for (int r = 0; r < 3; ++r)
            for (int d = 0; d < 3; ++d) C(r + 3 * c, c + 3 * d) += stress(r, d);
        ahead.block<3, 3>(3 * c, 3 * c) = F0;
    }
    C *= ahead;
    if (ref_.nDims == 2) keepPlane(C);
    return ref_.volume() * C;
}

// J of (7.27).  The rest of a particle that follows others follows them too
void totalLagrangian::assembleRest(blockMatrix3& K) const
{
    List<modulusMatrix> C(active_.size());
    forEach(0, n(), [&](label k) {
        if (active_[k]) C[k] = restModulus(k);
    });
    tangent_->assemble(C, List<scalar>(active_.size(), 0), K);
    ties_.addTangent(K);
}

void totalLagrangian::assembleTangent(const List<vec4>& x, tangentKind kind, const List<scalar>& p,
                                      blockMatrix3& K) const
{
    if (kind == tangentKind::rest) return assembleRest(K);
    List<tensor> F;
    fit_.apply(x, F);
    List<modulusMatrix> C(active_.size());
    parallelFor(
        n(),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
                if (active_[k]) C[k] = modulus(F[k], kind, k, p.empty() ? 0 : p[k]);
        },
        64);
    tangent_->assemble(C, star_, K);
    ties_.addTangent(K);
}

// tau of (5.14), (5.32) and (5.28)
bool totalLagrangian::stress(const motion& m, List<tensor>& tau) const
{
    tau.assign(size_t(n()), tensor::Zero());
    forEach(0, n(), [&](label k) {
        if (fit_.follows(k)) return;
        tau[k] = materials_.stress(m.fromRest[k], k) * m.fromRest[k].transpose();
        if (remembers(k)) tau[k] += networks_->stress(m.F[k], k) * m.F[k].transpose();
        const tensor L = m.rate[k] * m.F[k].inverse();
        tau[k] += materials_.viscosity(k) * (L + L.transpose());
    });
    return true;
}

// (5.29)
void totalLagrangian::assembleDamping(const List<vec4>& x, blockMatrix3& D) const
{
    List<tensor> F;
    fit_.apply(x, F);
    List<modulusMatrix> C(active_.size(), modulusMatrix::Zero());
    parallelFor(
        n(),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
            {
                if (!active_[k] || materials_.viscosity(k) == 0) continue;
                C[k] = ref_.volume() * materials_.viscosity(k) * viscousModulus(F[k]);
                if (ref_.nDims == 2) keepPlane(C[k]);
            }
        },
        64);
    tangent_->assemble(C, List<scalar>(active_.size(), 0), D);
}

List<label> totalLagrangian::linkCounts() const
{
    List<label> count;
    for (label k = 0; k < n(); ++k) count.push_back(active_[k] ? pairs_.count(k) : 0);
    ties_.addLinkCounts(count);
    return count;
}

word totalLagrangian::description() const
{
    return "totalLagrangian, " + materials_.description() + ", " +
           str(scalar(pairs_.nPairs()) / n(), 3) + " neighbours per particle, zeroEnergy " +
           str(zeroEnergy_, 3) + ties_.summary();
}

}  // namespace

std::unique_ptr<structureModel> newTotalLagrangian(const dictionary& dict,
                                                   const structureReference& ref)
{
    return std::make_unique<totalLagrangian>(dict, ref);
}

}  // namespace ispf
