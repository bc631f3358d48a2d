// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of soft tissue that are exponential in a quadratic form of the strain,
//
//     W = c/2 (exp Q - 1),   Q = E : B : E,   E = A^T (C - 1)/2 A
//
// in axes A that follow the fibres (fibres.H: the first family, the second across it, and across both).
//
// Fung (Y. C. Fung, K. Fronek and P. Patitucci 1979, Am. J. Physiol. 237), entries c [Pa] and
//     normal  (b11 b22 b33 b12 b23 b31)   Q = b11 E11^2 + b22 E22^2 + b33 E33^2 + 2 b12 E11 E22 + 2 b23 E22 E33 + 2 b31 E33 E11
//     shear   (b44 b55 b66)                 + b44 (2 E12)^2 + b55 (2 E23)^2 + b66 (2 E31)^2
//
// Guccione (J. M. Guccione, A. D. McCulloch and L. K. Waldman 1991, J. Biomech. Eng. 113), entries C [Pa], bf, bt, bfs [1]
//     Q = bf Eff^2 + bt (Ess^2 + Enn^2 + 2 Esn^2) + 2 bfs (Efs^2 + Efn^2)
#include "fibres.H"
#include "isochoricLaw.H"

#include <algorithm>
#include <array>
#include <cmath>

namespace ispf
{

namespace
{

using form = modulusMatrix;  // B, of nine components of E

// Adds b E_ij E_kl to the form, as a symmetric one of symmetric strains
void add(form& B, scalar b, int i, int j, int k, int l)
{
    for (const int p : {i + 3 * j, j + 3 * i})
        for (const int q : {k + 3 * l, l + 3 * k}) B(p, q) += b / 8, B(q, p) += b / 8;
}

// E becomes A E A^T
modulusMatrix turnOf(const tensor& A)
{
    modulusMatrix turn;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            for (int m = 0; m < 3; ++m)
                for (int n = 0; n < 3; ++n) turn(r + 3 * c, m + 3 * n) = A(r, m) * A(c, n);
    return turn;
}

class exponentialLaw : public isochoricLaw
{
public:
    exponentialLaw(const word& name, scalar c, const form& B, const dictionary& dict,
                   const List<vector>& x0)
        : name_(name), c_(c), B_(B), fibres_(dict.subDict("fibres"), x0)
    {
        checkFamilies(dict, label(x0.size()));
    }

    // Largest at rest of the shears between two axes, and of those along their bisectors, (C_ii + C_jj - 2 C_ij)/4: the control of
    // (5.20) has to hold particles against the stiffest of them.  A law may be weak in shear and stiff along its axes
    scalar shearModulus() const override
    {
        scalar most = 0;
        for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)})
        {
            const int p = i + 3 * j, q = j + 3 * i;
            most = std::max({most, B_(p, p) + B_(q, q) + 2 * B_(p, q),
                             B_(4 * i, 4 * i) + B_(4 * j, 4 * j) - 2 * B_(4 * i, 4 * j)});
        }
        return c_ * most / 4;
    }
    word description() const override { return name_; }

private:
    // True if the second axis has no effect: a turn by an angle about the first leaves the form as it is
    bool isotropicAcross() const
    {
        const modulusMatrix turn =
            turnOf(Eigen::AngleAxisd(0.5, vector::UnitX()).toRotationMatrix());
        return (turn * B_ * turn.transpose() - B_).norm() < 1e-9 * B_.norm();
    }

    void checkFamilies(const dictionary& dict, label n) const
    {
        const dictionary fibres = dict.subDict("fibres");
        const label wanted = isotropicAcross() ? 1 : 2, given = fibres_.nFamilies();
        if (given != wanted)
            fibres.fail("type",
                        name_ + " with these numbers " +
                            (wanted == 1 ? "is alike in all directions across the fibres, "
                                           "and wants one family"
                                         : "is not alike in all directions across the "
                                           "fibres, and wants two families: the second gives the "
                                           "direction of the second axis") +
                            ". There are " + std::to_string(given));
        for (label k = 0; wanted == 2 && k < n; ++k)
            if (!(fibres_.of(0, k).cross(fibres_.of(1, k)).norm() > 1e-3))
                fibres.fail("type",
                            "Both families have the same direction at the solid's particle " +
                                std::to_string(k) +
                                ": the direction of the second axis is not known");
    }

    // E in the axes of the fibres, dQ/dE and exp Q
    struct strained
    {
        tensor A;
        tensorColumn E, slope;
        scalar Q;

        strained(const form& B, const tensor& axes, const tensor& C)
            : A(axes),
              E(columnOf(0.5 * axes.transpose() * (C - tensor::Identity()) * axes)),
              slope(2 * B * E),
              Q(0.5 * slope.dot(E))
        {
        }
    };
    strained in(const tensor& C, label k) const { return {B_, fibres_.axes(k), C}; }

    scalar at(const tensor& C, label k) const override { return c_ / 2 * std::expm1(in(C, k).Q); }
    tensor slope(const tensor& C, label k) const override
    {
        const strained s = in(C, k);
        const tensor inAxes = Eigen::Map<const tensor>(s.slope.data());
        return c_ / 4 * std::exp(s.Q) * s.A * inAxes * s.A.transpose();
    }
    modulusMatrix curvature(const tensor& C, label k) const override
    {
        const strained s = in(C, k);
        const modulusMatrix turn = turnOf(s.A);
        const modulusMatrix inAxes = s.slope * s.slope.transpose() + 2 * B_;
        return c_ / 8 * std::exp(s.Q) * turn * inAxes * turn.transpose();
    }

    word name_;
    scalar c_;
    form B_;
    fibreDirections fibres_;
};

void checkPositive(const form& B, const dictionary& dict, const word& key)
{
    const Eigen::SelfAdjointEigenSolver<form> e(B, Eigen::EigenvaluesOnly);
    // three of nine directions are antisymmetric and have no strain
    if (e.eigenvalues()[0] < -1e-12 * e.eigenvalues()[8])
        dict.fail(key,
                  "The quadratic form Q is negative for some strain: the solid would give way");
}

}  // namespace

std::unique_ptr<material> newFung(const dictionary& dict, const List<vector>& x0)
{
    const List<scalar> normal = dict.get<List<scalar>>("normal"),
                       shear = dict.get<List<scalar>>("shear");
    if (normal.size() != 6) dict.fail("normal", "This needs 6 numbers: b11 b22 b33 b12 b23 b31");
    if (shear.size() != 3) dict.fail("shear", "This needs 3 numbers: of 12, 23 and 31");
    form B = form::Zero();
    for (int i = 0; i < 3; ++i) add(B, normal[i], i, i, i, i);
    for (int i = 0; i < 3; ++i)
    {
        const int j = (i + 1) % 3;
        add(B, 2 * normal[3 + i], i, i, j, j), add(B, 4 * shear[i], i, j, i, j);
    }
    checkPositive(B, dict, "normal");
    return std::make_unique<exponentialLaw>(
        "Fung", dict.getInRange("c", 1e-12, 1e15, dims::pressure), B, dict, x0);
}

std::unique_ptr<material> newGuccione(const dictionary& dict, const List<vector>& x0)
{
    const scalar bf = dict.getInRange("bf", 1e-12, 1e6), bt = dict.getInRange("bt", 1e-12, 1e6),
                 bfs = dict.getInRange("bfs", 1e-12, 1e6);
    form B = form::Zero();
    add(B, bf, 0, 0, 0, 0), add(B, bt, 1, 1, 1, 1), add(B, bt, 2, 2, 2, 2);
    add(B, 2 * bt, 1, 2, 1, 2), add(B, 2 * bfs, 0, 1, 0, 1), add(B, 2 * bfs, 0, 2, 0, 2);
    return std::make_unique<exponentialLaw>(
        "Guccione", dict.getInRange("C", 1e-12, 1e15, dims::pressure), B, dict, x0);
}

}  // namespace ispf
