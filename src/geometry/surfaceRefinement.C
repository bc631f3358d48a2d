// SPDX-License-Identifier: GPL-3.0-or-later
#include "surfaceRefinement.H"

#include <algorithm>
#include <map>

namespace ispf
{

namespace
{

class halving
{
public:
    halving(triSurface& s, scalar longest) : s_(s), longest_(longest) {}

    // Splits every triangle with long edges once; false if there was none
    bool pass()
    {
        triangles_.clear(), patch_.clear(), middle_.clear();
        for (label t = 0; t < s_.size(); ++t) split(t);
        const bool changed = triangles_.size() != s_.triangles.size();
        s_.triangles.swap(triangles_), s_.patch.swap(patch_);
        return changed;
    }

private:
    scalar length(label a, label b) const { return (s_.nodes[b] - s_.nodes[a]).norm(); }
    bool isLong(label a, label b) const { return length(a, b) > longest_; }

    label middle(label a, label b)
    {
        const auto [at, isNew] = middle_.try_emplace(std::minmax(a, b), label(s_.nodes.size()));
        if (isNew) s_.nodes.push_back(0.5 * (s_.nodes[a] + s_.nodes[b]));
        return at->second;
    }

    void add(label a, label b, label c, label patch)
    {
        triangles_.push_back({a, b, c}), patch_.push_back(patch);
    }

    // Turns the triangle so that its long edges come first: a-b if there is one, a-b and b-c if there are two
    void split(label t)
    {
        triSurface::triangle f = s_.triangles[t];
        const label patch = s_.patch[t];
        const auto cut = [&](int k) { return isLong(f[k % 3], f[(k + 1) % 3]); };
        const int n = cut(0) + cut(1) + cut(2);
        for (int k = 0; k < 2 && (n == 1 || n == 2) && !(cut(0) && !cut(2)); ++k)
            f = {f[1], f[2], f[0]};
        const auto [a, b, c] = f;
        if (n == 0) return add(a, b, c, patch);
        const label ab = middle(a, b);
        if (n == 1) return add(a, ab, c, patch), add(ab, b, c, patch);
        const label bc = middle(b, c);
        add(ab, b, bc, patch);
        if (n == 3)
        {
            const label ca = middle(c, a);
            add(a, ab, ca, patch), add(ab, bc, ca, patch), add(ca, bc, c, patch);
        }
        else if (length(a, bc) < length(ab, c)) add(a, ab, bc, patch), add(a, bc, c, patch);
        else add(a, ab, c, patch), add(ab, bc, c, patch);
    }

    triSurface& s_;
    scalar longest_;
    List<triSurface::triangle> triangles_;
    List<label> patch_;
    std::map<std::pair<label, label>, label> middle_;  // nodes of the edges halved in this pass
};

}  // namespace

void refine(triSurface& surface, scalar longest)
{
    halving h(surface, longest);
    while (h.pass())
        ;
}

}  // namespace ispf
