// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleScene.H"

#include <cmath>
#include <random>

namespace theory
{

namespace
{

const vec2 centre(0.5, 0.5);
constexpr double discRadius = 0.2;

mat2 boundedInverse(const mat2& m)
{
    const Eigen::SelfAdjointEigenSolver<mat2> e(m);
    return e.eigenvectors() * e.eigenvalues().cwiseMax(0.15).cwiseInverse().asDiagonal() *
           e.eigenvectors().transpose();
}

}  // namespace

std::string name(shape s)
{
    const char* names[] = {"periodic", "box", "step", "disc"};
    return names[int(s)];
}

double kernel(double r, double h)
{
    const double q = r / h;
    return q >= 2 ? 0 : 7 / (4 * M_PI * h * h) * std::pow(1 - q / 2, 4) * (1 + 2 * q);
}

double slopeByDistance(double r, double h)
{
    const double q = r / h;
    return q >= 2 ? 0 : -35 / (4 * M_PI * std::pow(h, 4)) * std::pow(1 - q / 2, 3);
}

scene::scene(shape kind_, int n, unsigned seed, double jitter, int relaxations)
    : kind(kind_), dx(1.0 / n), h(1.3 / n), V(1.0 / n / n)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-jitter, jitter);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const vec2 p((i + 0.5) * dx, (j + 0.5) * dx);
            if (inside(p)) x.push_back(p + dx * vec2(shift(random), shift(random)));
        }
    if (!periodic()) placeWalls();
    nWalls = int(others.size());
    if (kind == shape::disc) placeDisc();
    for (int k = 0; k < relaxations; ++k) relax();
    findNeighbours();
    spreadFacets();
    correct();
}

bool scene::inside(const vec2& p) const
{
    if (kind == shape::disc) return (p - centre).norm() > discRadius;
    if (kind == shape::periodic) return true;
    const bool cut = kind == shape::step && p[0] > 0.5 && p[1] > 0.5;
    return p.minCoeff() > 0 && p.maxCoeff() < 1 && !cut;
}

void scene::placeWalls()
{
    std::vector<vec2> corner = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (kind == shape::step) corner = {{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}};
    for (size_t k = 0; k < corner.size(); ++k)
    {
        const vec2 from = corner[k], way = corner[(k + 1) % corner.size()] - from;
        const int m = int(std::lround(way.norm() / dx));
        for (int q = 0; q < m; ++q)
            facets.push_back({from + (q + 0.5) / m * way, vec2(way[1], -way[0]) / m});
    }
    const int n = int(std::lround(1 / dx));
    for (int j = -3; j < n + 3; ++j)
        for (int i = -3; i < n + 3; ++i)
        {
            const vec2 p((i + 0.5) * dx, (j + 0.5) * dx);
            if (!inside(p)) others.push_back(p);
        }
}

// S_k = 2 c V sum_solid g is antisymmetric: the sum is zero.  c makes sum S (x) x = - area I at the circle
void scene::placeDisc()
{
    const int n = int(std::lround(1 / dx));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const vec2 p((i + 0.5) * dx, (j + 0.5) * dx);
            if (!inside(p)) others.push_back(p);
        }
    const double area = V * double(others.size()), radius = std::sqrt(area / M_PI);
    double covered = 0;
    for (size_t k = 0; k < others.size(); ++k)
    {
        vec2 S = vec2::Zero();
        for (size_t l = 0; l < others.size(); ++l)
            S -= 2 * V * V * slopeByDistance((others[l] - others[k]).norm(), h) *
                 (others[l] - others[k]);
        if (S.norm() < 1e-9 * dx) continue;
        const vec2 foot = centre + radius * (others[k] - centre).normalized();
        facets.push_back({foot, S, int(k)});
        covered -= S.dot(foot - centre) / 2;
    }
    for (facet& f : facets) f.S *= area / covered;
}

vec2 scene::difference(const vec2& to, const vec2& from) const
{
    vec2 d = to - from;
    if (periodic())
        for (int c = 0; c < 2; ++c) d[c] -= std::round(d[c]);
    return d;
}

void scene::findNeighbours()
{
    fluid.assign(size(), {});
    beside.assign(size(), {});
    const int m = std::max(3, int(1 / (2 * h)));
    const auto cell = [&](const vec2& p, int c) {
        const int q = int(std::floor(p[c] * m));
        return periodic() ? (q % m + m) % m : std::clamp(q, 0, m - 1);
    };
    std::vector<std::vector<int>> cells(m * m);  // fluid from 0, the others behind
    const auto at = [&](int q) -> const vec2& { return q < size() ? x[q] : others[q - size()]; };
    for (int q = 0; q < size() + int(others.size()); ++q)
        cells[cell(at(q), 0) + m * cell(at(q), 1)].push_back(q);
    for (int i = 0; i < size(); ++i)
        for (int v = -1; v <= 1; ++v)
            for (int u = -1; u <= 1; ++u)
            {
                int a = cell(x[i], 0) + u, b = cell(x[i], 1) + v;
                if (periodic()) a = (a + m) % m, b = (b + m) % m;
                if (a < 0 || b < 0 || a >= m || b >= m) continue;
                for (const int q : cells[a + m * b])
                {
                    const vec2 r = difference(at(q), x[i]);
                    if (q == i || r.norm() >= 2 * h) continue;
                    const double w = -V * slopeByDistance(r.norm(), h);
                    if (q < size()) fluid[i].push_back({q, r, w});
                    else beside[i].push_back({q - size(), r, w});
                }
            }
}

// Neighbours push each other apart, by 1/r^2
void scene::relax()
{
    findNeighbours();
    for (int i = 0; i < size(); ++i)
    {
        vec2 way = vec2::Zero();
        for (const auto* list : {&fluid[i], &beside[i]})
            for (const neighbour& q : *list)
                way -= 0.02 * dx * dx * dx * q.r / std::pow(q.r.norm(), 3);
        x[i] += way * std::min(1.0, 0.05 * dx / way.norm());
    }
}

void scene::spreadFacets()
{
    shares.assign(size(), {});
    for (size_t k = 0; k < facets.size(); ++k)
    {
        double sum = 0;
        std::vector<share> found;
        std::vector<int> of;
        for (int i = 0; i < size(); ++i)
        {
            const vec2 r = difference(facets[k].x, x[i]);
            if (r.norm() >= 2 * h || r.dot(facets[k].S) <= 0) continue;
            found.push_back({int(k), kernel(r.norm(), h), r});
            of.push_back(i);
            sum += found.back().weight;
        }
        for (size_t q = 0; q < of.size(); ++q)
        {
            found[q].weight /= sum;
            shares[of[q]].push_back(found[q]);
        }
    }
}

void scene::correct()
{
    for (int i = 0; i < size(); ++i)
    {
        mat2 m = mat2::Zero();
        for (const neighbour& q : fluid[i]) m += q.w * q.r * q.r.transpose();
        BFluid.push_back(boundedInverse(m));
        for (const neighbour& q : beside[i]) m += q.w * q.r * q.r.transpose();
        BAll.push_back(boundedInverse(m));
    }
}

vec2 scene::b(int i) const
{
    vec2 sum = vec2::Zero();
    for (const share& s : shares[i]) sum += s.weight / (2 * V) * facets[s.k].S;
    return sum;
}

mat2 scene::T(int i) const
{
    mat2 sum = mat2::Zero();
    for (const share& s : shares[i]) sum += s.weight / V * facets[s.k].S * s.r.transpose();
    return sum;
}

matrix fromEntries(int rows, int columns, const entries& e)
{
    matrix m(rows, columns);
    m.setFromTriplets(e.begin(), e.end());
    return m;
}

}  // namespace theory
