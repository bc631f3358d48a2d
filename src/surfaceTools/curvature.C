// SPDX-License-Identifier: GPL-3.0-or-later
// Radii of curvature of triangulated surfaces: the curvature tensor of Cohen-Steiner and Morvan 2003,
//     T = 1/A sum_e beta_e |e| e e^T   over the edges e at a node, beta_e the angle between their facets,
// where A and |e| count with their share within the barycentric cells of the node.
#include "featureSize.H"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

namespace ispf
{

namespace
{

const scalar sharp = std::cos(50 * M_PI / 180);
constexpr scalar precision = 1e-7;  // of coordinates, relative to the size: STL may hold floats

class nodeCurvature
{
public:
    nodeCurvature(const triSurface& s, scalar spacing, bool flat)
        : s_(s),
          tensors_(s.nodes.size(), tensor::Zero()),
          areas_(s.nodes.size(), 0),
          left_(s.nodes.size(), 0)
    {
        const scalar noise = precision * s.bounds().diagonal();
        const scalar leastHeight = std::sqrt(10 * noise * spacing);
        for (label t = 0; t < s.size(); ++t)
        {
            const vector a = s.areaVector(t);
            if (flat && std::abs(a[2]) > 0.9 * a.norm()) continue;
            scalar longest = 0;
            for (int k = 0; k < 3; ++k)
                longest = std::max(longest, (s.corner(t, (k + 1) % 3) - s.corner(t, k)).norm());
            if (2 * a.norm() < leastHeight * longest) leaveOut(t);
            else addFacet(t, a.norm());
        }
        for (const auto& [nodes, facets] : facetsAt_) addEdge(nodes, facets);
        smooth();
    }

    featureSize smallest() const
    {
        featureSize best;
        for (size_t i = 0; i < areas_.size(); ++i)
        {
            if (left_[i] || areas_[i] == 0) continue;
            const Eigen::SelfAdjointEigenSolver<tensor> solver(tensors_[i], Eigen::EigenvaluesOnly);
            const scalar radius = areas_[i] / solver.eigenvalues().cwiseAbs().maxCoeff();
            if (radius < best.size) best.size = radius, best.at = s_.nodes[i];
        }
        return best;
    }

private:
    using edge = std::pair<label, label>;

    void leaveOut(label t)
    {
        for (const label n : s_.triangles[t]) left_[n] = 1;
    }

    void addFacet(label t, scalar area)
    {
        for (int k = 0; k < 3; ++k)
        {
            const label a = s_.triangles[t][k], b = s_.triangles[t][(k + 1) % 3];
            areas_[a] += area / 3;
            facetsAt_[std::minmax(a, b)].push_back(t);
        }
    }

    void addEdge(const edge& e, const List<label>& facets)
    {
        const auto [a, b] = e;
        const vector n0 = s_.normal(facets[0]), n1 = s_.normal(facets.back()),
                     along = s_.nodes[b] - s_.nodes[a];
        const bool open = facets.size() == 1;  // an edge of the sides of a prism
        if (facets.size() > 2 || n0.dot(n1) < sharp) left_[a] = left_[b] = 1;
        if (open || facets.size() > 2) return;
        // convex if the centre of the other facet lies below this facet
        const scalar below = (s_.centre(facets[1]) - s_.nodes[a]).dot(n0) < 0 ? 1 : -1;
        const scalar angle = below * std::atan2(n0.cross(n1).norm(), n0.dot(n1));
        const tensor share = 0.5 * angle * along * along.transpose() / along.norm();
        tensors_[a] += share, tensors_[b] += share;
    }

    // Averages over each node and its neighbours: in irregular facets a single node says little
    void smooth()
    {
        const List<tensor> tensors = tensors_;
        const List<scalar> areas = areas_;
        for (const auto& [nodes, facets] : facetsAt_)
            for (const auto& [i, j] : {nodes, edge(nodes.second, nodes.first)})
                if (!left_[j]) tensors_[i] += tensors[j], areas_[i] += areas[j];
    }

    const triSurface& s_;
    List<tensor> tensors_;
    List<scalar> areas_;
    List<char> left_;
    std::map<edge, List<label>> facetsAt_;
};

}  // namespace

featureSize smallestRadius(const triSurface& surface, scalar spacing, bool flat)
{
    return nodeCurvature(surface, spacing, flat).smallest();
}

}  // namespace ispf
