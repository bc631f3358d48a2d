// SPDX-License-Identifier: GPL-3.0-or-later
#include "uniformStressTest.H"
#include "PCG.H"
#include "execution.H"

#include <algorithm>

namespace ispf
{

namespace
{

// over G: each outer pass divides the volume error by about this number
constexpr scalar penalty = 50;
constexpr int outerPasses = 4;
constexpr scalar tolerance = 1e-5;

void toPoints(const List<scalar>& flat, List<vec4>& points)
{
    for (size_t i = 0; i < points.size(); ++i)
        points[i].s = simd4{flat[3 * i], flat[3 * i + 1], flat[3 * i + 2], 0};
}

void toFlat(const List<vec4>& points, List<scalar>& flat)
{
    for (size_t i = 0; i < points.size(); ++i)
        for (int a = 0; a < 3; ++a) flat[3 * i + a] = points[i][a];
}

// u -> K u + penalty G sum V (tr strain) d(tr strain)/du
class penalisedStiffness : public linearOperator
{
public:
    explicit penalisedStiffness(const structureModel& model)
        : model_(model), K_(model.tangentPattern()), u_(size_t(model.n())), f_(u_), g_(u_)
    {
        List<vec4> x(u_.size());
        for (label i = 0; i < model.n(); ++i) x[i] = vec4::from(model.reference().x0[i]);
        model.assembleTangent(x, tangentKind::positive, K_);
    }

    label size() const override { return 3 * model_.n(); }
    const blockMatrix3& K() const { return K_; }

    void apply(const List<scalar>& x, List<scalar>& y) const override
    {
        toPoints(x, u_);
        model_.gradient().applyLinear(u_, stress_);
        for (tensor& s : stress_)
            s = tensor::Identity() * (-penalty * model_.shearModulus() * s.trace());
        model_.gradient().forces(stress_, f_);
        K_.apply(u_, g_);
        for (size_t i = 0; i < f_.size(); ++i) f_[i].s += g_[i].s;
        toFlat(f_, y);
    }

private:
    const structureModel& model_;
    blockMatrix3 K_;
    mutable List<vec4> u_, f_, g_;
    mutable List<tensor> stress_;
};

class blockDiagonal : public preconditioner
{
public:
    blockDiagonal(const structureModel& model, const blockMatrix3& K) : inverse_(K.diagonal)
    {
        // V/dx^2 (d tr strain/du)^2 is about a third; a rough value is enough
        const structureReference& ref = model.reference();
        const scalar volumetric =
            0.3 * penalty * model.shearModulus() * ref.volume() / (ref.dx * ref.dx);
        for (tensor& D : inverse_) D = (D + volumetric * tensor::Identity()).inverse().eval();
    }
    void apply(const List<scalar>& r, List<scalar>& z) const override
    {
        for (size_t i = 0; i < inverse_.size(); ++i)
        {
            const vector v = inverse_[i] * vector(r[3 * i], r[3 * i + 1], r[3 * i + 2]);
            for (int a = 0; a < 3; ++a) z[3 * i + a] = v[a];
        }
    }
    word name() const override { return "blockDiagonal"; }

private:
    List<tensor> inverse_;
};

}  // namespace

stressResponse uniformStressTest(const structureModel& model,
                                 const std::function<tensor(label)>& stress)
{
    const size_t n = size_t(model.n());
    const referenceGradient& gradient = model.gradient();
    const penalisedStiffness A(model);
    const blockDiagonal M(model, A.K());
    solverControls controls;
    controls.tolerance = tolerance, controls.maxIter = 5000;
    PCG solver(controls, "displacement");

    stressResponse response;
    response.p.assign(n, 0), response.u.resize(n), response.load.resize(n);
    List<scalar> u(3 * n, 0), b(3 * n);
    List<tensor> applied(n);
    for (int pass = 0; pass < outerPasses; ++pass)
    {
        for (size_t i = 0; i < n; ++i)
            applied[i] = -stress(label(i)) - response.p[i] * tensor::Identity();
        gradient.forces(applied, response.load);
        toFlat(response.load, b);
        const solverPerformance performance = solver.solve(A, M, b, u);
        if (!performance.converged)
            throw fatalError("The static solution of the structure did not converge: " +
                             performance.line());
        response.iterations += performance.nIterations;
        toPoints(u, response.u);
        gradient.applyLinear(response.u, response.strain);
        for (size_t i = 0; i < n; ++i)
            response.p[i] -= penalty * model.shearModulus() * response.strain[i].trace();
    }
    for (tensor& e : response.strain) e = 0.5 * (e + e.transpose()).eval();
    for (size_t i = 0; i < n; ++i) applied[i] = -stress(label(i));
    gradient.forces(applied, response.load);
    return response;
}

namespace
{

// Mean stress of the links between particles with inside[i], per displacement
tensor linkStress(const structureModel& model, const List<vec4>& u, const List<char>& inside)
{
    // scale of the displacement: the stress of the links is not linear in it
    constexpr scalar small = 1e-4;
    List<vec4> x(u.size());
    for (size_t i = 0; i < x.size(); ++i)
        x[i] = vec4::from(model.reference().x0[i] + small * u[i].xyz());
    List<tensor> tau;
    model.stress(x, tau);
    tensor sum = tensor::Zero();
    for (size_t i = 0; i < tau.size(); ++i)
        if (inside[i]) sum += tau[i];
    return sum / (small * scalar(std::count(inside.begin(), inside.end(), char(true))));
}

}  // namespace

scalar modulusRatio(const structureModel& model, const vector& axis, const List<char>& inside)
{
    const int nDims = model.reference().nDims;
    const scalar strain = 0.01, named = (nDims == 3 ? 3 : 4) * model.shearModulus();
    const stressResponse response = uniformStressTest(
        model, [&](label) -> tensor { return strain * named * axis * axis.transpose(); });
    List<scalar> measured;
    for (size_t i = 0; i < inside.size(); ++i)
        if (inside[i]) measured.push_back(axis.dot(response.strain[i] * axis));
    if (measured.empty())
        throw fatalError("No particle of the structure lies in the measured part");
    const auto middle = measured.begin() + std::ptrdiff_t(measured.size() / 2);
    std::nth_element(measured.begin(), middle, measured.end());
    // softer edges leave more stress to the middle, and some stress across the axis
    const tensor tau = linkStress(model, response.u, inside);
    const scalar across = (tau.trace() - axis.dot(tau * axis)) / (nDims - 1);
    return (axis.dot(tau * axis) - across) / (named * *middle);
}

}  // namespace ispf
