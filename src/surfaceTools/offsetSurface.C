// SPDX-License-Identifier: GPL-3.0-or-later
#include "offsetSurface.H"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace ispf
{

namespace
{

using index3 = std::array<std::int64_t, 3>;

class marcher
{
public:
    marcher(const surfaceSearch& body, scalar distance, scalar spacing, bool flat)
        : body_(body),
          distance_(distance),
          spacing_(spacing),
          dims_(flat ? 2 : 3),
          box_(body.surface().bounds())
    {
        surface_.addPatch("");
        const vector margin = vector::Constant(distance + spacing);
        low_ = box_.min - margin;
        size_ = box_.max + margin - low_;
    }

    triSurface run()
    {
        const scalar widest = size_.head(dims_).maxCoeff();
        std::int64_t cells = 1;
        while (scalar(cells) * spacing_ < widest) cells *= 2;
        if (cells >> bits)
            throw fatalError("The surface is too long to be surrounded: it is " + str(widest, 3) +
                             " m long, more than a million times the spacing of " +
                             str(spacing_, 3) + " m. Are dx and the unit right?");
        divide({0, 0, 0}, cells);
        return std::move(surface_);
    }

private:
    vector at(const vector& index) const
    {
        vector x = low_ + spacing_ * index;
        if (dims_ == 2) x[2] = box_.centre()[2];
        return x;
    }
    static vector real(const index3& i) { return vector(scalar(i[0]), scalar(i[1]), scalar(i[2])); }
    scalar miss(const vector& x) const { return body_.signedDistance(x) - distance_; }

    // Divides the cube into eight until it is a cell or cannot hold the surface: a distance grows no faster than the way
    void divide(const index3& corner, std::int64_t edge)
    {
        vector middle = real(corner);
        for (int d = 0; d < dims_; ++d) middle[d] += 0.5 * scalar(edge);
        if (std::abs(miss(at(middle))) > 0.51 * std::sqrt(scalar(dims_)) * scalar(edge) * spacing_)
            return;
        if (edge == 1) return march(corner);
        for (int part = 0; part < 1 << dims_; ++part)
        {
            index3 c = corner;
            for (int d = 0; d < dims_; ++d) c[d] += (part >> d & 1) * edge / 2;
            divide(c, edge / 2);
        }
    }

    // Divides the cell into simplices whose edges lead from its lowest to its highest corner
    void march(const index3& corner)
    {
        std::array<int, 3> axes = {0, 1, 2};
        do {
            List<index3> corners = {corner};
            for (int d = 0; d < dims_; ++d)
                corners.push_back(corners.back()), ++corners.back()[axes[d]];
            cut(corners);
        } while (std::next_permutation(axes.begin(), axes.begin() + dims_));
    }

    void cut(const List<index3>& corners)
    {
        List<index3> in, out;
        for (const index3& c : corners) (value(c) < 0 ? in : out).push_back(c);
        if (in.empty() || out.empty()) return;
        List<label> ring;  // around the cut
        if (in.size() == 2 && out.size() == 2)
            ring = {node(in[0], out[0]), node(in[0], out[1]), node(in[1], out[1]),
                    node(in[1], out[0])};
        else
            for (const index3& i : in)
                for (const index3& o : out) ring.push_back(node(i, o));
        const vector outward = mean(out) - mean(in);
        if (dims_ == 2) return addPrism(ring[0], ring[1], outward);
        for (size_t k = 2; k < ring.size(); ++k) addFacet({ring[0], ring[k - 1], ring[k]}, outward);
    }

    static vector mean(const List<index3>& corners)
    {
        vector sum = vector::Zero();
        for (const index3& c : corners) sum += real(c);
        return sum / scalar(corners.size());
    }

    void addFacet(triSurface::triangle f, const vector& outward)
    {
        const auto& x = surface_.nodes;
        const vector normal = (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]);
        if (normal.dot(outward) < 0) std::swap(f[1], f[2]);
        surface_.triangles.push_back(f);
        surface_.patch.push_back(0);
    }

    // Nodes are pairs of a lower and an upper end
    void addPrism(label a, label b, const vector& outward)
    {
        addFacet({a, b, b + 1}, outward);
        addFacet({a, b + 1, a + 1}, outward);
    }

    scalar value(const index3& i)
    {
        const auto [found, isNew] = values_.emplace(key(i), 0);
        if (isNew) found->second = miss(at(real(i)));
        return found->second;
    }

    static constexpr int bits = 20;  // of an index
    static std::uint64_t key(const index3& i)
    {
        return std::uint64_t(i[0]) | std::uint64_t(i[1]) << bits | std::uint64_t(i[2]) << 2 * bits;
    }

    // The node on the edge between two corners of a simplex, the same for all simplices
    label node(const index3& a, const index3& b)
    {
        const auto [low, high] = std::minmax(a, b);
        std::uint64_t edge = key(low) << 3;
        for (int d = 0; d < 3; ++d) edge |= std::uint64_t(high[d] - low[d]) << d;
        const auto [found, isNew] = nodes_.emplace(edge, label(surface_.nodes.size()));
        if (!isNew) return found->second;
        const vector x = at(real(low)), way = at(real(high)) - x;
        vector p = x + root(x, way, value(low), value(high)) * way;
        if (dims_ == 2)
        {
            surface_.nodes.push_back({p[0], p[1], box_.min[2]});
            p[2] = box_.max[2];
        }
        surface_.nodes.push_back(p);
        return found->second;
    }

    // Where the distance is right between x and x + way: regula falsi with halved ends (Illinois).  Nodes at the corners of
    // cells would make facets without area
    scalar root(const vector& x, const vector& way, scalar f0, scalar f1) const
    {
        constexpr scalar precision = 1e-4, nearest = 0.005;
        scalar t0 = 0, t1 = 1, t = 0;
        for (int k = 0, last = 0; k < 30; ++k)
        {
            t = t0 + (t1 - t0) * f0 / (f0 - f1);
            const scalar f = miss(x + t * way);
            if (std::abs(f) < precision * spacing_) break;
            const int side = f * f0 > 0 ? 0 : 1;
            (side ? t1 : t0) = t, (side ? f1 : f0) = f;
            if (k > 0 && side == last) (side ? f0 : f1) *= 0.5;
            last = side;
        }
        return std::clamp(t, nearest, 1 - nearest);
    }

    const surfaceSearch& body_;
    const scalar distance_, spacing_;
    const int dims_;
    const boundBox box_;
    vector low_, size_;
    triSurface surface_;
    std::unordered_map<std::uint64_t, scalar> values_;
    std::unordered_map<std::uint64_t, label> nodes_;
};

}  // namespace

triSurface offsetSurface(const surfaceSearch& body, scalar distance, scalar spacing, bool flat)
{
    return marcher(body, distance, spacing, flat).run();
}

}  // namespace ispf
