// SPDX-License-Identifier: GPL-3.0-or-later
#include "fibrePoints.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Two largest eigenvalues of a mean dyad that differ by less, over the largest, are equal up to rounding
constexpr scalar noMainDirection = 1e-9;

}  // namespace

fibrePoints::fibrePoints(const csvFormat& format, const List<word>& columns, const rule& r,
                         const dictionary& dict)
    : rule_(r)
{
    List<csvColumn> wanted;
    for (size_t k = 0; k < columns.size(); ++k)
        wanted.push_back({columns[k], "columns", k < 3 ? dims::length : dims::none});
    for (const csvRow& row : csvRows(format, wanted, dict))
    {
        const auto& v = row.values;
        const point p{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, row.where};
        if (!(p.f.norm() > 0))
            throw fatalError("The direction of a fibre must not be zero", row.where);
        points_.push_back({p.x, p.f.normalized(), p.where});
    }
    if (points_.empty())
        throw fatalError("There are no points in " + format.path, {format.path, "", 1, 0});
    std::stable_sort(points_.begin(), points_.end(),
                     [](const point& a, const point& b) { return a.x[0] < b.x[0]; });
}

// The nearest points, nearest first
List<fibrePoints::neighbour> fibrePoints::nearest(const vector& x) const
{
    const size_t wanted = std::min(size_t(rule_.neighbours), points_.size());
    List<neighbour> best;
    // false if this point and all beyond it are farther than the best
    const auto look = [&](const point& p) {
        const bool full = best.size() == wanted;
        if (full && std::abs(p.x[0] - x[0]) > best.back().distance) return false;
        const scalar distance = (p.x - x).norm();
        if (full && !(distance < best.back().distance)) return true;
        if (full) best.pop_back();
        const auto before = [](const neighbour& n, scalar d) { return n.distance < d; };
        best.insert(std::lower_bound(best.begin(), best.end(), distance, before), {distance, &p});
        return true;
    };
    const auto middle = std::lower_bound(points_.begin(), points_.end(), x[0],
                                         [](const point& p, scalar v) { return p.x[0] < v; });
    for (auto p = middle; p != points_.end() && look(*p); ++p) {}
    for (auto p = std::make_reverse_iterator(middle); p != points_.rend() && look(*p); ++p) {}
    return best;
}

// (5.39)
vector fibrePoints::at(const vector& x) const
{
    const List<neighbour> around = nearest(x);
    const neighbour& first = around.front();
    if (first.distance > rule_.farthest)
        throw fatalError("The particle at rest at (" + str(x[0]) + " " + str(x[1]) + " " +
                             str(x[2]) + ") m is " + str(first.distance) +
                             " m from its nearest point, in this line. 'farthest' of the fibres "
                             "allows " +
                             str(rule_.farthest) +
                             " m. Do the places have the unit that the header tells, [m] without?",
                         first.of->where);
    tensor M = tensor::Zero();
    for (const neighbour& n : around)
    {
        if (n.distance > rule_.farthest) break;
        // weights over that of the nearest point, so that none is infinite
        const scalar share = n.distance > 0 ? first.distance / n.distance : 1;
        M += share * share * n.of->f * n.of->f.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<tensor> eigen(M);
    const vector values = eigen.eigenvalues();
    if (values[2] - values[1] < noMainDirection * values[2]) return vector::Zero();
    const vector main = eigen.eigenvectors().col(2);
    return main.dot(first.of->f) < 0 ? vector(-main) : main;
}

}  // namespace ispf
