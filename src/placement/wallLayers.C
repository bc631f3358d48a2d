// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallLayers.H"

#include "cellList.H"
#include "execution.H"
#include <cmath>

namespace ispf
{

namespace
{

constexpr scalar reach = 2.1;     // in dx, of the neighbours that give the normal
constexpr scalar tubeRadius = 1;  // in dx: no layer has a hole of this width
constexpr scalar gap = 1.6;       // in dx, along the normal: two layers are about 1 apart
// variance along the normal, in dx^2; for two layers it is about 0.3
constexpr scalar sheetBelow = 0.1;

// Mean normal of the neighbours of i: the normal of one particle is uncertain by some 10 degrees
vector smoothed(const particleSurface& surface, const cellList& cells, const vector& x, label i,
                label n, scalar dx)
{
    vector sum = vector::Zero();
    cells.near(x, reach * dx, [&](label j, scalar) {
        if (j < n && surface.open(j) && surface.sheet[j] == surface.sheet[i] &&
            surface.inward[j].dot(surface.inward[i]) > 0.7)
            sum += surface.inward[j];
    });
    return sum.normalized();
}

scalar depthBelow(const cellList& cells, const List<vector>& body, const vector& x,
                  const vector& inward, scalar dx, scalar most)
{
    List<scalar> along;
    const scalar half = 0.5 * most * dx;
    cells.near(x + half * inward, half + tubeRadius * dx, [&](label j, scalar) {
        const vector off = body[j] - x;
        const scalar s = off.dot(inward);
        if (s > 0 && (off - s * inward).norm() <= tubeRadius * dx) along.push_back(s / dx);
    });
    std::sort(along.begin(), along.end());
    scalar last = 0;
    for (const scalar s : along)
    {
        if (s - last > gap || s > most) break;
        last = s;
    }
    return last;
}

scalar median(List<scalar>& values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

particleSurface::particleSurface(const List<vector>& points, label n, scalar dx, int nDims)
    : openness(n, 0), inward(n, vector::Zero()), sheet(n, 0)
{
    const cellList cells(points, dx);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            scalar total = 0;
            vector first = vector::Zero();
            // in 2D z is never the thin direction
            tensor second = vector(0, 0, nDims == 2 ? 1e3 : 0).asDiagonal();
            cells.near(points[i], reach * dx, [&](label j, scalar d2) {
                if (j == i) return;
                const scalar q = 1 - std::sqrt(d2) / (reach * dx), w = q * q;
                const vector d = (points[j] - points[i]) / dx;
                total += w, first += w * d, second += w * d * d.transpose();
            });
            if (total == 0) continue;
            const Eigen::SelfAdjointEigenSolver<tensor> spread(tensor(second / total));
            sheet[i] = spread.eigenvalues()[0] < sheetBelow;
            openness[i] = first.norm() / total;
            inward[i] = sheet[i] ? vector(spread.eigenvectors().col(0))
                                 : vector(first / std::max(first.norm(), 1e-300));
        }
    });
}

List<scalar> layersBelow(const List<vector>& body, label n, scalar dx, int nDims, scalar most)
{
    const particleSurface surface(body, n, dx, nDims);
    const cellList cells(body, dx);
    List<scalar> own(n, 0), layers(n, 0);
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            if (!surface.open(i)) continue;
            const vector inward = smoothed(surface, cells, body[i], i, n, dx);
            own[i] = 1 + depthBelow(cells, body, body[i], inward, dx, most - 1);
        }
    });
    parallelFor(n, [&](label begin, label end) {
        List<scalar> around;
        for (label i = begin; i < end; ++i)
        {
            if (own[i] == 0) continue;
            around.clear();
            cells.near(body[i], 2.5 * dx, [&](label j, scalar) {
                if (j < n && own[j] > 0) around.push_back(own[j]);
            });
            layers[i] = median(around);
        }
    });
    return layers;
}

}  // namespace ispf
