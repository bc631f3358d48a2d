// SPDX-License-Identifier: GPL-3.0-or-later
#include "cellClosing.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

constexpr simd4 inSpace = {1, 1, 1, 0};

// Shares of the diagonal for particles, for the matrix of the blocks and for strips.  They fix the constant part of psi,
// which changes no a_ij.  The share of the strips also takes a sum of areas that is not zero
constexpr scalar level = 1e-9, regular = 1e-6, stripLevel = 1e-5;

constexpr int most = 200;  // iterations
// The last step over the blocks may enlarge the residual
constexpr scalar safe = 0.9;
// Share of its residual to which single precision surely solves
constexpr scalar atOnce = 1e-5;

// sum_j w_ij (f_i - f_j), with scale -F_ij for w_ij
ISPF_HOT void graphRange(const neighbourList& list, const std::int64_t* rowEnd, float scale,
                         const float4* f, label begin, label end, float4* result)
{
    for (label i = begin; i < end; ++i)
    {
        const float4 fi = f[i];
        result[i] = sumNeighbours(
            list, {list.start[i], rowEnd[i]}, float4{},
            [&](pairIndex k, label j) -> float4 { return scale * float(list.F[k]) * (f[j] - fi); });
    }
}

float4 narrow(const simd4& v)
{
    return __builtin_convertvector(v, float4);
}
simd4 widen(const float4& v)
{
    return __builtin_convertvector(v, simd4);
}
float dot(const float4& f, const float4& g)
{
    const float4 fg = f * g;
    return fg[0] + fg[1] + fg[2];
}

}  // namespace

cellClosing::cellClosing(const particleCloud& cloud, const neighbourList& list,
                         const medium& within, const connectedBodies& bodies,
                         const List<char>& closed)
    : cloud_(cloud), list_(list), within_(within), bodies_(bodies), closed_(closed)
{
    nClosed_ = label(std::count(closed.begin(), closed.end(), 1));
    drained_.assign(bodies.n, 0);
    for (label i = within.first; i < cloud.n(); ++i)
        if (cloud.beyondOpen(i)) drained_[bodies.of[i]] = 1;
    gatherStrips();
    if (nClosed_ > 0) setDiagonal();
}

void cellClosing::gatherStrips()
{
    weight_.assign(cloud_.n(), 1), inStrip_.assign(cloud_.n(), 0);
    strips_.resize(cloud_.stripArea.size()), besideStrip_.resize(strips_.size());
    for (label i = within_.first; i < cloud_.n(); ++i)
        if (const label k = cloud_.stripOf(i); k > 0)
            strips_[k].members.push_back(i), inStrip_[i] = 1;
    const tensor free = cloud_.freeDirections();
    List<label> place(cloud_.nAll(), -1);  // of a particle in the list of the present strip
    for (size_t k = 0; k < strips_.size(); ++k)
    {
        if (strips_[k].members.empty()) continue;
        strips_[k].half = vec4::from(free * cloud_.stripArea[k] / (2 * cloud_.volume()));
        List<beside>& others = besideStrip_[k];
        for (const label i : strips_[k].members)
        {
            weight_[i] = 1 / float(strips_[k].members.size());
            forNeighbours(list_, within_.row(list_, i), [&](pairIndex at, label j) {
                if (inStrip_[cloud_.ownerOf(j)]) return;
                if (place[j] < 0) place[j] = label(others.size()), others.push_back({j, 0});
                others[place[j]].w -= list_.F[at];
            });
        }
        for (const beside& b : others) place[b.j] = -1;
    }
}

// sum_j w_ij; for a strip its sum over particles in no strip
void cellClosing::setDiagonal()
{
    const label first = within_.first, n = cloud_.n();
    const scalar square = cloud_.dx * cloud_.dx;
    diagonal_.assign(n, 1);
    List<scalar> ofBlock(n);
    parallelFor(n - first, [&](label from, label to) {
        for (label i = first + from; i < first + to; ++i)
        {
            const scalar sum =
                sumNeighbours(list_, within_.row(list_, i), 0.0,
                              [&](pairIndex k, label) -> scalar { return -list_.F[k]; });
            if (sum > 0) diagonal_[i] = float(square * sum);
        }
    });
    for (size_t k = 0; k < strips_.size(); ++k)
    {
        scalar sum = 0;
        for (const beside& b : besideStrip_[k]) sum += b.w;
        for (const label i : strips_[k].members) diagonal_[i] = sum > 0 ? float(square * sum) : 1;
    }
    forEach(first, n, [&](label i) {
        ofBlock[i] = (closed_[i] ? regular : stripLevel) * weight_[i] * diagonal_[i] / square;
    });
    blocks_ = std::make_unique<blockLaplacian>(
        blockLaplacian::graph{cloud_, list_, within_, bodies_, closed_, inStrip_}, ofBlock);
}

void cellClosing::admit(List<vec4>& psi) const
{
    forEach(within_.first, cloud_.n(), [&](label i) {
        if (!active(i)) psi[i] = vec4{};
    });
    for (const strip& s : strips_)
    {
        simd4 sum = {};
        for (const label i : s.members) sum += psi[i].s;
        for (const label i : s.members) psi[i].s = sum / scalar(s.members.size());
    }
}

void cellClosing::removeMeans(List<vec4>& f, bool drained) const
{
    List<vec4> mean(bodies_.n);  // [3]: number of particles
    // Serial: there may be as many bodies as particles, and each block would need sums for all bodies
    for (label i = within_.first; i < cloud_.n(); ++i)
        if (closed_[i]) mean[bodies_.of[i]].s += f[i].s * inSpace + simd4{0, 0, 0, 1};
    const tensor free = cloud_.freeDirections();
    for (label body = 0; body < bodies_.n; ++body)
    {
        const scalar count = drained || !drained_[body] ? mean[body][3] : 0;
        mean[body] = count > 0 ? vec4::from(free * mean[body].xyz() / count) : vec4{};
    }
    forEach(within_.first, cloud_.n(), [&](label i) {
        if (closed_[i]) f[i].s -= mean[bodies_.of[i]].s;
    });
}

// Conjugate gradients in units of dx: r is dx times the residual, p and d are ways of psi over dx
struct cellClosing::search
{
    const cellClosing& c;
    const label first, n;
    const tensor free;
    List<float4> r, q, p, d, ofBlock;
    scalar rr = 0, rz = 0;

    search(const cellClosing& closing, const List<vec4>& residual)
        : c(closing),
          first(c.within_.first),
          n(c.cloud_.n()),
          free(c.cloud_.freeDirections()),
          r(n),
          q(n),
          p(c.cloud_.nAll()),
          d(n)
    {
        forMedium([&](label i) { r[i] = narrow(c.cloud_.dx * residual[i].s); });
    }

    template <class Body>
    void forMedium(const Body& body) const
    {
        parallelFor(n - first, [&](label from, label to) {
            for (label i = first + from; i < first + to; ++i) body(i);
        });
    }

    // A strip has no psi in directions that symmetry planes turn
    float4 alongFree(const float4& f) const
    {
        return narrow(vec4::from(free * vec4{widen(f)}.xyz()).s);
    }
    float holds(label i) const { return float(c.closed_[i] ? level : stripLevel) * c.diagonal_[i]; }
    float4 preconditioned(label i) const
    {
        if (!c.active(i)) return float4{};
        const float4 z = ofBlock[c.blocks_->of(i)] + r[i] / c.diagonal_[i];
        return c.inStrip_[i] ? alongFree(z) : z;
    }
    // Sets ofBlock, r.r and r.z for the present r
    void precondition()
    {
        c.blocks_->solve(r, c.weight_, ofBlock);
        const List<scalar> sums = blockSums(n - first, 2, [&](label from, label to, scalar* of) {
            of[0] = of[1] = 0;
            for (label i = first + from; i < first + to; ++i)
            {
                of[0] += c.weight_[i] * dot(r[i], r[i]);
                of[1] += c.weight_[i] * dot(r[i], preconditioned(i));
            }
        });
        rr = sums[0], rz = sums[1];
    }
    void fillGhosts()
    {
        const particleCloud& cloud = c.cloud_;
        parallelFor(cloud.nGhosts(), [&](label from, label to) {
            for (label g = n + from; g < n + to; ++g)
            {
                const label source = cloud.ghostSource(g);
                if (source < first) continue;
                p[g] = narrow(vec4::from(cloud.ruleOf(g).R * vec4{widen(p[source])}.xyz()).s);
            }
        });
    }
    // q = A p.  Returns p.q
    scalar product()
    {
        const scalar square = c.cloud_.dx * c.cloud_.dx;
        List<float4> ofStrip(c.strips_.size());
        for (size_t k = 0; k < ofStrip.size(); ++k)
        {
            if (c.strips_[k].members.empty()) continue;
            const float4 own = p[c.strips_[k].members[0]];
            simd4 sum = {};
            for (const beside& b : c.besideStrip_[k]) sum += square * b.w * widen(own - p[b.j]);
            ofStrip[k] = alongFree(narrow(sum));
        }
        countPairs(c.list_.nPairs() - c.list_.start[first], sizeof(label) + sizeof(scalar));
        return parallelSum(n - first, [&](label from, label to) {
            graphRange(c.list_, c.within_.end->data(), float(square), p.data(), first + from,
                       first + to, q.data());
            scalar sum = 0;
            for (label i = first + from; i < first + to; ++i)
            {
                if (c.inStrip_[i]) q[i] = ofStrip[c.cloud_.stripOf(i)];
                else if (!c.closed_[i]) q[i] = float4{};
                q[i] += holds(i) * p[i];
                sum += c.weight_[i] * dot(p[i], q[i]);
            }
            return sum;
        });
    }
    // After precondition(), until r.r is at most `enough`.  Returns the number of iterations
    int run(scalar enough, int atMost)
    {
        forMedium([&](label i) { p[i] = preconditioned(i); });
        int done = 0;
        for (; done < atMost && rr > enough && rz > 0; ++done)
        {
            fillGhosts();
            const scalar pq = product();
            if (!(pq > 0)) break;
            const float alpha = float(rz / pq);
            forMedium([&](label i) { d[i] += alpha * p[i], r[i] -= alpha * q[i]; });
            const scalar before = rz;
            precondition();
            const float beta = float(rz / before);
            forMedium([&](label i) { p[i] = preconditioned(i) + beta * p[i]; });
        }
        countIterations(done);
        return done;
    }
};

bool cellClosing::improve(List<vec4>& r, List<vec4>& psi, scalar tolerance, int& iterations) const
{
    if (nClosed_ == 0) return true;
    const label first = within_.first, n = cloud_.n();
    const scalar square = cloud_.dx * cloud_.dx;
    const tensor free = cloud_.freeDirections();
    parallelFor(n - first, [&](label from, label to) {
        for (label i = first + from; i < first + to; ++i)
        {
            const scalar hold = (closed_[i] ? level : stripLevel) * diagonal_[i] / square;
            r[i].s = active(i) ? (r[i].s - hold * psi[i].s) * inSpace : simd4{};
            if (inStrip_[i]) r[i] = vec4::from(free * r[i].xyz());
        }
    });
    // If the b_i of a body do not add up to zero, (2.4) has no solution: their mean is subtracted.  A body with an open face
    // needs no correction, its strip takes the rest
    removeMeans(r, false);

    search s(*this, r);
    s.precondition();
    const scalar enough = safe * safe * nClosed_ * tolerance * tolerance;
    const scalar reached = s.rr * atOnce * atOnce;
    iterations += s.run(std::max(enough, reached), most);
    // The last step leaves no residual sum over any block.  blockLaplacian is not exact for planes askew to the axes
    s.forMedium([&](label i) {
        simd4 way = widen(s.d[i]);
        if (active(i)) way += vec4::from(free * vec4{widen(s.ofBlock[blocks_->of(i)])}.xyz()).s;
        psi[i].s += cloud_.dx * way;
    });
    return reached <= enough;
}

}  // namespace ispf
