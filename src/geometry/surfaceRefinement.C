// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceRefinement.H"

#include <algorithm>
#include <cmath>
#include <map>

namespace ispf
{

namespace
{

class division
{
public:
    division(triSurface& s, scalar longest) : s_(s), longest_(longest) {}

    // Divides every triangle with long edges once; false if there was none.  The longer two edges are divided at once, into
    // as many parts as they need: halves of halves of a needle would be three times as many per pass, not twice
    bool pass()
    {
        triangles_.clear(), patch_.clear(), inner_.clear();
        for (label t = 0; t < s_.size(); ++t) divide(t);
        const bool changed = triangles_.size() != s_.triangles.size();
        s_.triangles.swap(triangles_), s_.patch.swap(patch_);
        return changed;
    }

private:
    using chain = List<label>;

    scalar length(label a, label b) const { return (s_.nodes[b] - s_.nodes[a]).norm(); }

    // Nodes from a to b, the same for all triangles at this edge
    chain between(label a, label b)
    {
        const auto [at, isNew] = inner_.try_emplace(std::minmax(a, b));
        chain& inner = at->second;
        const label parts = isNew ? label(std::ceil(length(a, b) / longest_)) : 0;
        const vector low = s_.nodes[std::min(a, b)], high = s_.nodes[std::max(a, b)];
        for (label k = 1; k < parts; ++k)
        {
            inner.push_back(label(s_.nodes.size()));
            s_.nodes.push_back(low + scalar(k) / scalar(parts) * (high - low));
        }
        chain whole = {std::min(a, b)};
        whole.insert(whole.end(), inner.begin(), inner.end());
        whole.push_back(std::max(a, b));
        if (a > b) std::reverse(whole.begin(), whole.end());
        return whole;
    }

    void add(label a, label b, label c, label patch)
    {
        if (a != b && b != c && c != a) triangles_.push_back({a, b, c}), patch_.push_back(patch);
    }

    // Triangles between two chains, across the shorter diagonals
    void zip(const chain& a, const chain& b, label patch)
    {
        for (size_t i = 0, j = 0; i + 1 < a.size() || j + 1 < b.size();)
        {
            const bool mayA = i + 1 < a.size(), mayB = j + 1 < b.size();
            if (mayA && (!mayB || length(a[i + 1], b[j]) <= length(a[i], b[j + 1])))
                add(a[i], a[i + 1], b[j], patch), ++i;
            else add(a[i], b[j + 1], b[j], patch), ++j;
        }
    }

    // From the corner opposite the shortest edge towards it
    void divide(label t)
    {
        triSurface::triangle f = s_.triangles[t];
        const scalar most = std::max({length(f[0], f[1]), length(f[1], f[2]), length(f[2], f[0])});
        if (most <= longest_) return add(f[0], f[1], f[2], s_.patch[t]);
        for (int k = 0;
             k < 2 && !(length(f[1], f[2]) <= std::min(length(f[0], f[1]), length(f[2], f[0])));
             ++k)
            f = {f[1], f[2], f[0]};
        chain left = between(f[0], f[1]), right = between(f[0], f[2]);
        const chain base = between(f[1], f[2]);
        left.pop_back(), right.pop_back();
        zip(left, right, s_.patch[t]);
        zip(base, {left.back(), right.back()}, s_.patch[t]);
    }

    triSurface& s_;
    scalar longest_;
    List<triSurface::triangle> triangles_;
    List<label> patch_;
    std::map<std::pair<label, label>, chain> inner_;  // nodes inside the edges in this pass
};

}  // namespace

void refine(triSurface& surface, scalar longest)
{
    division d(surface, longest);
    while (d.pass())
        ;
}

}  // namespace ispf
