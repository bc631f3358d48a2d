// SPDX-License-Identifier: GPL-3.0-or-later
#include "elasticMultigrid.H"

namespace ispf
{

namespace
{

// Growth of the cells from level to level: smoothed prolongations reach as far
constexpr scalar growth = 3;
constexpr label coarsestSize = 100;  // nodes; their matrix is factorised as a dense one

template <int B>
void setZero(rawList<blockEntry<B>>& x)
{
    std::fill(x.begin(), x.end(), blockEntry<B>{});
}

// to += M from
template <int R, int C>
void addMultiple(const blockRows<R, C>& M, const rawList<blockEntry<C>>& from,
                 rawList<blockEntry<R>>& to)
{
    parallelFor(
        M.size(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
                for (label k = M.start[i]; k < M.start[i + 1]; ++k)
                    addProduct(M.value[k], from[M.column[k]].s, to[i].s);
        },
        256);
}

}  // namespace

void elasticMultigrid::rebuild(const elasticSystem& system, scalar cellSize)
{
    const label n = label(system.x.size());
    scale_ = makeFinest(system, finest_);
    coarse_.clear();
    const auto size = [&] { return coarse_.empty() ? finest_.size() : coarse_.back().size(); };
    scalar extent = 0;
    for (const float4& p : finest_.point) extent = std::max<scalar>({extent, p[0], p[1], p[2]});
    for (; (coarse_.empty() || size() > coarsestSize) && cellSize < growth * extent;
         cellSize *= growth)
    {
        elasticLevel<6> next;
        if (coarse_.empty() ? coarsen(finest_, cellSize, next)
                            : coarsen(coarse_.back(), cellSize, next))
            coarse_.push_back(std::move(next));
    }
    const auto resize = [](auto& v, label n) {
        v.b.resize(n), v.x.resize(n), v.r.resize(n), v.way.resize(n);
    };
    resize(finestVectors_, n);
    vectors_.resize(coarse_.size());
    for (size_t l = 0; l < coarse_.size(); ++l) resize(vectors_[l], coarse_[l].size());
    if (coarse_.empty()) return;

    const elasticLevel<6>& last = coarse_.back();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6 * last.size(), 6 * last.size());
    const auto add = [&](label i, label j, const block<6, 6>& b) {
        for (int r = 0; r < 6; ++r)
            for (int c = 0; c < 6; ++c) dense(6 * i + r, 6 * j + c) += b(r, c);
    };
    for (label i = 0; i < last.size(); ++i)
    {
        add(i, i, last.diagonal[i]);
        for (label k = last.A.start[i]; k < last.A.start[i + 1]; ++k)
            add(i, last.A.column[k], last.A.value[k]);
    }
    // a direction that no row holds: its correction is zero
    const scalar least = 1e-6 * dense.diagonal().mean();
    for (label k = 0; k < dense.rows(); ++k)
        if (dense(k, k) < least) dense(k, k) += least;
    coarsest_.compute(dense);
}

List<label> elasticMultigrid::levelSizes() const
{
    List<label> sizes = {finest_.size()};
    for (const elasticLevel<6>& l : coarse_) sizes.push_back(l.size());
    return sizes;
}

void elasticMultigrid::solveCoarsest() const
{
    auto& v = vectors_.back();
    Eigen::VectorXd b(6 * v.b.size());
    for (size_t i = 0; i < v.b.size(); ++i)
        for (int k = 0; k < 6; ++k) b[6 * i + k] = v.b[i].s[k];
    b = coarsest_.solve(b);
    for (size_t i = 0; i < v.b.size(); ++i)
        for (int k = 0; k < 6; ++k) v.x[i].s[k] = float(b[6 * i + k]);
}

// x = an approximation of A^-1 b on a level; next: index of the coarser one
template <int B>
void elasticMultigrid::cycle(const elasticLevel<B>& level, vectors<B>& v, label next) const
{
    if (next == label(coarse_.size()) && next > 0) return solveCoarsest();
    setZero<B>(v.x);
    v.r = v.b;
    level.smooth(v.r, v.x, v.way);
    if (next == label(coarse_.size())) return;
    level.residual(v.b, v.x, v.r);
    auto& c = vectors_[next];
    setZero<6>(c.b);
    addMultiple(level.restriction, v.r, c.b);
    cycle(coarse_[next], c, next + 1);
    addMultiple(level.prolongation, c.x, v.x);
    level.residual(v.b, v.x, v.r);
    level.smooth(v.r, v.x, v.way);
}

void elasticMultigrid::apply(const List<vec4>& r, List<vec4>& z) const
{
    const label n = finest_.size();
    const scalar squares = parallelSum(n, [&](label i, label e) {
        simd4 sum = {};
        for (; i < e; ++i) sum += r[i].s * r[i].s;
        return sum[0] + sum[1] + sum[2];
    });
    const scalar rms = std::sqrt(squares / std::max(n, 1));
    z.resize(n);
    if (rms == 0) return std::fill(z.begin(), z.end(), vec4{});
    parallelFor(n, [&](label begin, label end) {
        for (label i = begin; i < end; ++i)
        {
            const simd4 s = r[i].s / rms;
            finestVectors_.b[i].s = pack<3>{float(s[0]), float(s[1]), float(s[2]), 0};
        }
    });
    cycle(finest_, finestVectors_, 0);
    parallelFor(n, [&](label begin, label end) {
        const scalar back = rms / scale_;
        for (label i = begin; i < end; ++i)
        {
            const pack<3> v = finestVectors_.x[i].s;
            z[i].s = simd4{v[0] * back, v[1] * back, v[2] * back, 0};
        }
    });
}

}  // namespace ispf
