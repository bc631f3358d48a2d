// SPDX-License-Identifier: GPL-3.0-or-later
#include "jitteredLattice.H"

#include <algorithm>
#include <array>
#include <map>
#include <random>

namespace ispf
{

namespace
{

using cellIndex = std::array<int, 3>;

// -W'/r of the Wendland C2 kernel, up to a factor
scalar pairWeight(scalar q)
{
    return std::pow(std::max(0.0, 1 - q), 3);
}

// Neighbour search by cells as wide as the support or wider
class cellGrid
{
public:
    cellGrid(const List<vector>& x, scalar support, int period)
        : x_(x),
          size_(period > 0 ? period / std::floor(period / support) : support),
          period_(period),
          nPeriod_(period > 0 ? int(std::floor(period / support)) : 0)
    {
        for (size_t i = 0; i < x.size(); ++i) rows_[cellOf(x[i])].push_back(label(i));
    }

    // Calls body(j) for the points of the 27 cells around point i
    void around(label i, const std::function<void(label)>& body) const
    {
        const cellIndex own = cellOf(x_[i]);
        for (int q = 0; q < 27; ++q)
        {
            cellIndex c = {own[0] + q % 3 - 1, own[1] + q / 3 % 3 - 1, own[2] + q / 9 - 1};
            if (nPeriod_ > 0)
                for (int& k : c) k = (k + nPeriod_) % nPeriod_;
            const auto cell = rows_.find(c);
            if (cell != rows_.end())
                for (const label j : cell->second) body(j);
        }
    }

    vector between(label i, label j) const
    {
        vector d = x_[i] - x_[j];
        if (period_ > 0)
            for (int k = 0; k < 3; ++k) d[k] -= period_ * std::round(d[k] / period_);
        return d;
    }

private:
    cellIndex cellOf(const vector& x) const
    {
        cellIndex c;
        for (int d = 0; d < 3; ++d) c[d] = int(std::floor(x[d] / size_));
        return c;
    }

    const List<vector>& x_;
    scalar size_;
    int period_, nPeriod_;
    std::map<cellIndex, List<label>> rows_;
};

List<vector> makePoints(int nx, int ny, int nz, const jitteredLattice::choices& c)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<scalar> jitter(-0.15, 0.15);
    List<vector> x;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
            {
                const vector at(i + 0.5, j + 0.5, k + 0.5);
                const vector shift(jitter(random), jitter(random), jitter(random));
                if (c.keep(at)) x.push_back(at + shift);
            }
    return x;
}

}  // namespace

jitteredLattice::jitteredLattice(int nx, int ny, int nz, const choices& c)
    : x(makePoints(nx, ny, nz, c)), support(c.support)
{
    const cellGrid grid(x, support, c.period);
    List<scalar> kappa;
    for (const vector& p : x) kappa.push_back(c.coefficient(p));
    A.rowStart.push_back(0);
    for (label i = 0; i < label(x.size()); ++i)
    {
        scalar sum = 0;
        grid.around(i, [&](label j) {
            const scalar q = grid.between(i, j).norm() / support;
            if (j == i || q >= 1 || !c.joined(x[i], x[j])) return;
            A.column.push_back(j);
            A.value.push_back(-pairWeight(q) * 2 * kappa[i] * kappa[j] / (kappa[i] + kappa[j]));
            sum -= A.value.back();
        });
        A.diagonal.push_back(sum * (1 + c.held(x[i])));
        A.rowStart.push_back(label(A.column.size()));
    }
}

List<scalar> randomVector(label n, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<scalar> normal;
    List<scalar> v(n);
    for (scalar& value : v) value = normal(random);
    return v;
}

scalar relativeResidual(const linearOperator& A, const List<scalar>& b, const List<scalar>& x)
{
    List<scalar> Ax(b.size());
    A.apply(x, Ax);
    scalar rr = 0, bb = 0;
    for (size_t i = 0; i < b.size(); ++i) rr += std::pow(b[i] - Ax[i], 2), bb += b[i] * b[i];
    return std::sqrt(rr / bb);
}

}  // namespace ispf
