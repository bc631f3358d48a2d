// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceSearch.H"

#include "execution.H"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ispf
{

namespace
{

constexpr label leafSize = 4;
constexpr int maxDepth = 64;
constexpr int wideDepth = 3 * maxDepth / 2 + 4;  // three more for each level of a tree of four

// Nearest point of a triangle (Ericson 2005, Real-Time Collision Detection, sec. 5.1.5).
// part: 0 facet, 1..3 edge from corner part-1, 4..6 corner part-4
vector nearestOfTriangle(const std::array<vector, 3>& t, const vector& p, int& part)
{
    const vector ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
    const scalar d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return part = 4, t[0];
    const vector bp = p - t[1];
    const scalar d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return part = 5, t[1];
    const scalar vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return part = 1, t[0] + d1 / (d1 - d3) * ab;
    const vector cp = p - t[2];
    const scalar d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return part = 6, t[2];
    const scalar vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return part = 3, t[0] + d2 / (d2 - d6) * ac;
    const scalar va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        return part = 2, t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
    part = 0;
    return t[0] + vb / (va + vb + vc) * ab + vc / (va + vb + vc) * ac;
}

// Squared distance, with the nearest point.  Not a part of an ISPF_HOT function: the result is the same on all machines
__attribute__((noinline)) scalar distSqr(const std::array<vector, 3>& t, const vector& p, vector& q,
                                         int& part)
{
    q = nearestOfTriangle(t, p, part);
    return (q - p).squaredNorm();
}

struct nearestTriangle
{
    scalar limit;   // squared distance
    label at = -1;  // place in the order of the tree
    vector point = vector::Zero();
    int part = 0;
};

ISPF_INLINE simd4 dot(const simd4 (&a)[3], const simd4 (&b)[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

ISPF_INLINE simd4 larger(simd4 a, simd4 b)
{
    return a > b ? a : b;
}

ISPF_INLINE simd4 smaller(simd4 a, simd4 b)
{
    return a < b ? a : b;
}

// Squared distance from the end of `from` to the segment of `along`, both from one point
ISPF_INLINE simd4 toSegment(const simd4 (&from)[3], const simd4 (&along)[3])
{
    const simd4 zero = {};
    simd4 t = dot(from, along) / larger(dot(along, along), zero + 1e-300);
    t = smaller(larger(t, zero), zero + 1);
    simd4 off[3];
    for (int d = 0; d < 3; ++d) off[d] = from[d] - t * along[d];
    return dot(off, off);
}

// Squared distances from p to four triangles, too small by less than rounding errors of the largest length
ISPF_INLINE simd4 lowerDistSqr(const triangleQuad& t, const vector& p)
{
    simd4 ap[3], bp[3], bc[3];
    for (int d = 0; d < 3; ++d)
    {
        ap[d] = p[d] - t.a[d];
        bp[d] = ap[d] - t.ab[d];
        bc[d] = t.ac[d] - t.ab[d];
    }
    simd4 least = smaller(toSegment(bp, bc), smaller(toSegment(ap, t.ab), toSegment(ap, t.ac)));
    const simd4 bb = dot(t.ab, t.ab), cc = dot(t.ac, t.ac), bcDot = dot(t.ab, t.ac);
    const simd4 d1 = dot(t.ab, ap), d2 = dot(t.ac, ap);
    const simd4 v = d1 * cc - d2 * bcDot, w = d2 * bb - d1 * bcDot, whole = bb * cc - bcDot * bcDot;
    const simd4 n[3] = {t.ab[1] * t.ac[2] - t.ab[2] * t.ac[1],
                        t.ab[2] * t.ac[0] - t.ab[0] * t.ac[2],
                        t.ab[0] * t.ac[1] - t.ab[1] * t.ac[0]};
    const simd4 height = dot(ap, n), zero = {},
                plane = height * height / larger(dot(n, n), zero + 1e-300);
    const simd4 within = v < zero ? zero : w < zero ? zero : v + w > whole ? zero : zero + 1;
    least = within > zero ? smaller(plane, least) : least;
    return least * (1 - 1e-9) - 1e-20 * (dot(ap, ap) + bb + cc);
}

ISPF_HOT void findNearest(const boxQuad* boxes, const triangleQuad* leaves,
                          const std::array<vector, 3>* corners, label root, const vector& p,
                          nearestTriangle& best)
{
    struct entry
    {
        label child;
        scalar distSqr;
    };
    entry stack[wideDepth];
    int top = 0;
    stack[top++] = {root, 0};
    while (top > 0)
    {
        const entry e = stack[--top];
        if (e.distSqr > best.limit) continue;
        if (e.child < 0)
        {
            const triangleQuad& leaf = leaves[-1 - e.child];
            const simd4 lower = lowerDistSqr(leaf, p);
            for (int k = 0; k < leaf.n; ++k)
            {
                if (lower[k] > best.limit) continue;
                vector q;
                int part;
                const scalar d2 = distSqr(corners[leaf.begin + k], p, q, part);
                if (d2 > best.limit || (d2 == best.limit && best.at >= 0)) continue;
                best = {d2, leaf.begin + k, q, part};
            }
            continue;
        }
        const boxQuad& four = boxes[e.child];
        simd4 sum = {};
        for (int d = 0; d < 3; ++d)
        {
            const simd4 off = larger(larger(four.min[d] - p[d], p[d] - four.max[d]), simd4{});
            sum += off * off;
        }
        const int bottom = top;
        for (int k = 0; k < 4; ++k)
        {
            if (sum[k] > best.limit) continue;
            int at = top++;
            for (; at > bottom && stack[at - 1].distSqr < sum[k]; --at) stack[at] = stack[at - 1];
            stack[at] = {four.child[k], sum[k]};
        }
    }
}

// Fraction of the segment from a along d at which it meets the triangle, else infinity
// (Moeller & Trumbore 1997, J. Graphics Tools 2).  A segment in the plane of the triangle does not meet it
scalar meets(const std::array<vector, 3>& t, const vector& a, const vector& d)
{
    constexpr scalar none = std::numeric_limits<scalar>::infinity();
    const vector e1 = t[1] - t[0], e2 = t[2] - t[0], h = d.cross(e2);
    const scalar det = e1.dot(h);
    if (std::abs(det) <= 1e-14 * d.norm() * e1.norm() * e2.norm()) return none;
    // so that a segment through a shared edge meets one of its triangles
    constexpr scalar slack = 1e-9;
    const vector s = a - t[0], q = s.cross(e1);
    const scalar u = s.dot(h) / det, v = d.dot(q) / det, f = e2.dot(q) / det;
    if (u < -slack || v < -slack || u + v > 1 + slack || f < 0 || f > 1) return none;
    return f;
}

bool overlaps(const boundBox& box, const vector& a, const vector& inverse, scalar limit)
{
    scalar low = 0, high = limit;
    for (int k = 0; k < 3; ++k)
    {
        if (std::isinf(inverse[k]))  // parallel to the slab: 0 times infinity must not decide
        {
            if (a[k] < box.min[k] || a[k] > box.max[k]) return false;
            continue;
        }
        const scalar t0 = (box.min[k] - a[k]) * inverse[k], t1 = (box.max[k] - a[k]) * inverse[k];
        low = std::max(low, std::min(t0, t1));
        high = std::min(high, std::max(t0, t1));
    }
    return low <= high * (1 + 1e-12) + 1e-300;
}

}  // namespace

surfaceSearch::surfaceSearch(triSurface surface) : surface_(std::move(surface))
{
    for (label t = 0; t < surface_.size(); ++t) order_.push_back(t);
    if (!order_.empty()) build(0, surface_.size());
    for (const label t : order_)
        corners_.push_back({surface_.corner(t, 0), surface_.corner(t, 1), surface_.corner(t, 2)});
    if (!order_.empty()) root_ = quadOf(0);
    setNormals();
}

label surfaceSearch::build(label begin, label end)
{
    const label index = label(nodes_.size());
    nodes_.emplace_back();
    node n;
    n.begin = begin, n.end = end;
    boundBox centres;
    for (label k = begin; k < end; ++k)
    {
        for (int c = 0; c < 3; ++c) n.box.add(surface_.corner(order_[k], c));
        centres.add(surface_.centre(order_[k]));
    }
    if (end - begin > leafSize)
    {
        int axis;
        (centres.max - centres.min).maxCoeff(&axis);
        const label half = (begin + end) / 2;
        std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                         [&](label s, label t) {
                             const scalar a = surface_.centre(s)[axis];
                             const scalar b = surface_.centre(t)[axis];
                             return a < b || (a == b && s < t);
                         });
        build(begin, half);
        n.second = build(half, end);
    }
    nodes_[index] = n;
    return index;
}

// Makes a quad of up to four nodes: the given one, or its children and theirs.  Returns its index, a leaf's as -1 - index
label surfaceSearch::quadOf(label i)
{
    const node& n = nodes_[i];
    if (n.second == 0)
    {
        triangleQuad t = {};
        t.begin = n.begin, t.n = n.end - n.begin;
        for (int k = 0; k < t.n; ++k)
            for (int d = 0; d < 3; ++d)
            {
                const std::array<vector, 3>& c = corners_[n.begin + k];
                t.a[d][k] = c[0][d], t.ab[d][k] = c[1][d] - c[0][d], t.ac[d][k] = c[2][d] - c[0][d];
            }
        leaves_.push_back(t);
        return -label(leaves_.size());
    }
    List<label> children;
    for (const label child : {i + 1, n.second})
        if (const label second = nodes_[child].second; second == 0) children.push_back(child);
        else children.insert(children.end(), {child + 1, second});
    const label index = label(quads_.size());
    quads_.emplace_back();
    boxQuad four;
    constexpr scalar nowhere = 1e200;  // its square is infinite
    for (int d = 0; d < 3; ++d) four.min[d] = four.max[d] = simd4{} + nowhere;
    for (size_t k = 0; k < children.size(); ++k)
    {
        const boundBox& box = nodes_[children[k]].box;
        for (int d = 0; d < 3; ++d) four.min[d][k] = box.min[d], four.max[d][k] = box.max[d];
        four.child[k] = quadOf(children[k]);
    }
    quads_[index] = four;
    return index;
}

void surfaceSearch::setNormals()
{
    struct side  // side k of a triangle; edge: its two nodes
    {
        std::pair<label, label> edge;
        label triangle;
        int k;
    };
    List<side> sides;
    nodeNormal_.assign(surface_.nodes.size(), vector::Zero());
    for (label t = 0; t < surface_.size(); ++t)
    {
        const vector n = surface_.normal(t);
        facetNormal_.push_back(n);
        for (int k = 0; k < 3; ++k)
        {
            sides.push_back(
                {std::minmax(surface_.triangles[t][k], surface_.triangles[t][(k + 1) % 3]), t, k});
            const vector u = surface_.corner(t, (k + 1) % 3) - surface_.corner(t, k);
            const vector v = surface_.corner(t, (k + 2) % 3) - surface_.corner(t, k);
            nodeNormal_[surface_.triangles[t][k]] += std::atan2(u.cross(v).norm(), u.dot(v)) * n;
        }
    }
    edgeNormal_.resize(surface_.size());
    rim_.assign(surface_.size(), 0);
    List<char> onRim(surface_.nodes.size(), 0);
    std::sort(sides.begin(), sides.end(), [](const side& a, const side& b) {
        return std::tie(a.edge, a.triangle, a.k) < std::tie(b.edge, b.triangle, b.k);
    });
    for (size_t first = 0, last; first < sides.size(); first = last)
    {
        vector sum = vector::Zero();
        for (last = first; last < sides.size() && sides[last].edge == sides[first].edge; ++last)
            sum += facetNormal_[sides[last].triangle];
        for (size_t s = first; s < last; ++s)
        {
            const auto& [edge, t, k] = sides[s];
            edgeNormal_[t][k] = sum.normalized();
            if (last > first + 1) continue;
            rim_[t] |= std::uint8_t(1 << k);
            onRim[edge.first] = onRim[edge.second] = 1;
        }
    }
    for (label t = 0; t < surface_.size(); ++t)
        for (int k = 0; k < 3; ++k)
            if (onRim[surface_.triangles[t][k]]) rim_[t] |= std::uint8_t(8 << k);
    for (vector& n : nodeNormal_) n.normalize();
}

void surfaceSearch::finish(surfacePoint& best, int part) const
{
    best.found = true;
    best.rim = part > 0 && (rim_[best.triangle] >> (part - 1) & 1);
    if (part == 0) best.normal = facetNormal_[best.triangle];
    else if (part < 4)
        best.feature = surfaceFeature::edge, best.normal = edgeNormal_[best.triangle][part - 1];
    else
    {
        best.feature = surfaceFeature::corner;
        best.normal = nodeNormal_[surface_.triangles[best.triangle][part - 4]];
    }
}

surfacePoint surfaceSearch::nearest(const vector& p, scalar radius) const
{
    surfacePoint best;
    if (nodes_.empty()) return best;
    nearestTriangle found;
    found.limit = radius < 1e150 ? radius * radius : std::numeric_limits<scalar>::max();
    findNearest(quads_.data(), leaves_.data(), corners_.data(), root_, p, found);
    if (found.at < 0) return best;
    best.point = found.point, best.triangle = order_[found.at];
    best.distance = std::sqrt(found.limit);
    finish(best, found.part);
    return best;
}

scalar surfaceSearch::signedDistance(const vector& p, scalar radius) const
{
    const surfacePoint q = nearest(p, radius);
    return q.found ? q.signedDistance(p) : std::numeric_limits<scalar>::infinity();
}

List<label> surfaceSearch::inBox(const boundBox& box) const
{
    const auto meets = [&](const boundBox& b) {
        return (b.min.array() <= box.max.array()).all() && (box.min.array() <= b.max.array()).all();
    };
    List<label> found;
    label stack[maxDepth];
    int top = 0;
    if (!nodes_.empty()) stack[top++] = 0;
    while (top > 0)
    {
        const label i = stack[--top];
        const node& n = nodes_[i];
        if (!meets(n.box)) continue;
        if (n.second != 0)
        {
            stack[top++] = n.second, stack[top++] = i + 1;
            continue;
        }
        for (label k = n.begin; k < n.end; ++k)
        {
            boundBox of;
            for (const vector& x : corners_[k]) of.add(x);
            if (meets(of)) found.push_back(order_[k]);
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

bool surfaceSearch::within(const vector& p, scalar radius) const
{
    if (nodes_.empty()) return false;
    const scalar limit = radius * radius;
    label stack[maxDepth];
    int top = 0;
    stack[top++] = 0;
    while (top > 0)
    {
        const label i = stack[--top];
        const node& n = nodes_[i];
        if (n.box.distSqr(p) > limit) continue;
        if (n.second != 0)
        {
            stack[top++] = n.second, stack[top++] = i + 1;
            continue;
        }
        for (label k = n.begin; k < n.end; ++k)
        {
            int part;
            if ((nearestOfTriangle(corners_[k], p, part) - p).squaredNorm() <= limit) return true;
        }
    }
    return false;
}

// Calls visit(k) for each triangle near the segment; it returns the fraction beyond which nothing counts any more
template <class Visit>
void surfaceSearch::alongSegment(const vector& a, const vector& b, Visit&& visit) const
{
    if (nodes_.empty()) return;
    const vector inverse = (b - a).cwiseInverse();
    scalar limit = 1;
    label stack[maxDepth];
    int top = 0;
    stack[top++] = 0;
    while (top > 0 && limit >= 0)
    {
        const label i = stack[--top];
        const node& n = nodes_[i];
        if (!overlaps(n.box, a, inverse, limit)) continue;
        if (n.second != 0) stack[top++] = n.second, stack[top++] = i + 1;
        else
            for (label k = n.begin; k < n.end && limit >= 0; ++k) limit = visit(k);
    }
}

bool surfaceSearch::crosses(const vector& a, const vector& b) const
{
    bool hit = false;
    const vector d = b - a;
    alongSegment(a, b, [&](label k) {
        hit = meets(corners_[k], a, d) <= 1;
        return hit ? scalar(-1) : scalar(1);
    });
    return hit;
}

List<label> surfaceSearch::allHits(const vector& a, const vector& b) const
{
    List<label> triangles;
    const vector d = b - a;
    alongSegment(a, b, [&](label k) {
        if (meets(corners_[k], a, d) <= 1) triangles.push_back(order_[k]);
        return scalar(1);
    });
    return triangles;
}

surfaceHit surfaceSearch::firstHit(const vector& a, const vector& b) const
{
    surfaceHit hit;
    const vector d = b - a;
    alongSegment(a, b, [&](label k) {
        const scalar f = meets(corners_[k], a, d);
        if (f <= 1 && (!hit.found || f < hit.fraction)) hit = {true, a + f * d, f, order_[k]};
        return hit.fraction;
    });
    return hit;
}

}  // namespace ispf
