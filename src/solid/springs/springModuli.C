// SPDX-License-Identifier: GPL-3.0-or-later
#include "springModuli.H"
#include "forPairs.H"

#include <limits>

namespace ispf
{

kelvinVector kelvin(const tensor& s)
{
    const scalar r2 = std::sqrt(2.0);
    kelvinVector v;
    v << s(0, 0), s(1, 1), s(2, 2), r2 * s(1, 2), r2 * s(0, 2), r2 * s(0, 1);
    return v;
}

modulusTensor particleModulus(const structureReference& ref, const referenceNeighbours& pairs,
                              const List<scalar>& k, label i)
{
    modulusTensor C = modulusTensor::Zero();
    forNeighbours<among::all>(pairs, i, [&](pairIndex p, label) {
        const vector d = pairs.separation(ref, i, p);
        const kelvinVector m = kelvin(d * d.transpose());
        C += k[p] / d.squaredNorm() * m * m.transpose();
    });
    return C / (2 * ref.volume());
}

scalar isotropicShear(const modulusTensor& C, int nDims)
{
    // the double trace C_iijj equals sum k d0^2/(2 V), which is 15 G in space and 8 G in the plane
    return C.topLeftCorner<3, 3>().sum() / (nDims == 3 ? 15 : 8);
}

scalar shearAnisotropy(const modulusTensor& C, int nDims)
{
    Eigen::MatrixXd basis;  // columns: traceless symmetric tensors
    if (nDims == 3)
    {
        basis = Eigen::MatrixXd::Zero(6, 5);
        basis.col(0).head<3>() = vector(1, -1, 0) / std::sqrt(2.0);
        basis.col(1).head<3>() = vector(1, 1, -2) / std::sqrt(6.0);
        basis.block<3, 3>(3, 2).setIdentity();
    }
    else
    {
        basis = Eigen::MatrixXd::Zero(6, 2);
        basis.col(0).head<3>() = vector(1, -1, 0) / std::sqrt(2.0);
        basis(5, 1) = 1;
    }
    const Eigen::MatrixXd shear = basis.transpose() * C * basis;
    const Eigen::VectorXd moduli =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(shear, Eigen::EigenvaluesOnly).eigenvalues();
    const scalar least = moduli.minCoeff(), most = moduli.maxCoeff();
    return least > 1e-9 * most ? most / least : std::numeric_limits<scalar>::infinity();
}

quarticTensor quartic(const vector& n)
{
    scalar q[15];
    quarticComponents(n[0], n[1], n[2], q);
    return Eigen::Map<const quarticTensor>(q);
}

quarticTensor isotropicQuartic(int nDims)
{
    quarticTensor q = quarticTensor::Zero();
    for (int a = 0; a < nDims; ++a) q[a] = 3;  // C_1111 = 3 G, C_1122 = G
    for (int a = 9; a < (nDims == 3 ? 12 : 10); ++a) q[a] = std::sqrt(6.0);
    return q;
}

quarticRotation quarticTurn(const tensor& R)
{
    // least squares over enough directions to span the 15 components
    constexpr int nDirections = 60;
    Eigen::MatrixXd before(nDirections, 15), after(nDirections, 15);
    for (int k = 0; k < nDirections; ++k)
    {
        const vector n =
            vector(std::sin(1 + 2.3 * k), std::sin(2 + 3.7 * k), std::sin(3 + 5.1 * k));
        before.row(k) = quartic(n.normalized()), after.row(k) = quartic(R * n.normalized());
    }
    return before.colPivHouseholderQr().solve(after).transpose();
}

}  // namespace ispf
