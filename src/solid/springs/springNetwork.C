// SPDX-License-Identifier: GPL-3.0-or-later
// Structure model of particles tied by permanent linear springs: Monteleone et al., Eq. (2),
//
//     m_s f_s = k_e h sum_j (d0_sj - d_sj) (x_s - x_j)/d_sj,      k = k_e h
//
// with one stiffness k per link (springLinks).  A link to an image x_j' = R x_j + t stands in row
// i, its inverse in row j.  The energy counts each as half, so that a quarter of a body between two
// symmetry planes has a quarter of its energy, and
//
//     f_i = -sum k (d - d0) n,   K_ii += A,   K_ij -= A R,   A = k [n n^T + (1 - d0/d)(I - n n^T)]
//     tau_i = 1/(2 V) sum k (d - d0) d n n^T
//
// A link to an image of the particle itself has its -A R in an entry of column i: K_ii is the same as in a whole body.
#include "springLinks.H"
#include "structureModel.H"
#include "forPairs.H"

#include <algorithm>

namespace ispf
{

namespace
{

struct linkTable
{
    List<std::int64_t> start, mid;  // rows; [mid, next start) are links to images
    List<std::int32_t> index;       // partner
    List<std::uint16_t> image;      // 0: the partner itself, m: images[m - 1]
    List<scalar> d0, k;
    // Block of the tangent's row; links to images of the particle itself have one too
    List<label> slot;
};

// Rows of the links that can move: links between two clamped particles are left out
linkTable movingLinks(const springLinks& all, const List<char>& fixed)
{
    linkTable links;
    links.start.push_back(0);
    const referenceNeighbours& pairs = all.pairs;
    for (label i = 0; i < pairs.n(); ++i)
    {
        const auto add = [&](pairIndex p, label j) {
            if (fixed[i] && fixed[j]) return;
            links.index.push_back(j), links.image.push_back(pairs.image[p]);
            links.d0.push_back(all.d0[p]), links.k.push_back(all.k[p]);
        };
        forNeighbours<among::same>(pairs, i, add);
        links.mid.push_back(pairIndex(links.index.size()));
        forNeighbours<among::others>(pairs, i, add);
        links.start.push_back(pairIndex(links.index.size()));
    }
    return links;
}

ISPF_HOT void ownForce(const linkTable& links, const vec4* x, label i, simd4& f)
{
    const simd4 xi = x[i].s;
    forNeighbours<among::same>(links, i, [&](pairIndex p, label j) {
        const simd4 e = xi - x[j].s;
        const scalar d = std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
        f -= links.k[p] * (1 - links.d0[p] / d) * e;
    });
}

// A = k [(1 - g) n n^T + g I], g = 1 - d0/d
ISPF_INLINE tensor linkBlock(const vector& e, scalar k, scalar d0, bool positive, int nDims)
{
    const scalar d2 = e.squaredNorm(), stretch = 1 - d0 / std::sqrt(d2);
    const scalar g = positive && stretch < 0 ? 0 : stretch;
    tensor A = (k * (1 - g) / d2) * e * e.transpose();
    for (int a = 0; a < nDims; ++a) A(a, a) += k * g;
    return A;
}

class springNetwork : public structureModel
{
public:
    springNetwork(const dictionary& dict, const structureReference& ref) : structureModel(ref)
    {
        const springLinks all(dict, ref_);
        G_ = all.G;
        summary_ = "springNetwork, " + all.summary;
        links_ = movingLinks(all, ref_.fixed);
        makePattern();
    }

    void force(const List<vec4>& x, List<vec4>& f) const override;
    scalar energy(const List<vec4>& x) const override;
    void stress(const List<vec4>& x, List<tensor>& tau) const override;
    blockMatrix3 tangentPattern() const override { return pattern_.withZeros(); }
    void assembleTangent(const List<vec4>& x, tangentKind kind, blockMatrix3& K) const override;
    List<label> linkCounts() const override;
    word description() const override { return summary_; }

private:
    void makePattern();
    void tangentRow(const List<vec4>& x, bool positive, label i, blockMatrix3& K) const;

    vector separation(const List<vec4>& x, label i, std::int64_t p) const
    {
        const vector xj = x[links_.index[p]].xyz();
        return x[i].xyz() - (links_.image[p] ? ref_.images[links_.image[p] - 1](xj) : xj);
    }

    linkTable links_;
    blockMatrix3 pattern_;  // without values
    word summary_;
};

void springNetwork::makePattern()
{
    links_.slot.resize(links_.index.size());
    pattern_.rowStart.push_back(0);
    for (label i = 0; i < n(); ++i)
    {
        List<std::int32_t> columns(links_.index.begin() + links_.start[i],
                                   links_.index.begin() + links_.start[i + 1]);
        std::sort(columns.begin(), columns.end());
        pattern_.column.insert(pattern_.column.end(), columns.begin(),
                               std::unique(columns.begin(), columns.end()));
        const label first = pattern_.rowStart.back(), last = label(pattern_.column.size());
        forNeighbours<among::all>(links_, i, [&](pairIndex p, label j) {
            const auto at =
                std::lower_bound(pattern_.column.begin() + first, pattern_.column.end(), j);
            links_.slot[p] = label(at - pattern_.column.begin());
        });
        pattern_.rowStart.push_back(last);
    }
}

void springNetwork::force(const List<vec4>& x, List<vec4>& f) const
{
    f.resize(std::max<size_t>(f.size(), size_t(n())));
    parallelFor(
        n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                simd4 sum = {};
                ownForce(links_, x.data(), i, sum);
                f[i].s = sum;
                forNeighbours<among::others>(links_, i, [&](pairIndex p, label) {
                    const vector e = separation(x, i, p);
                    f[i].s -= vec4::from(links_.k[p] * (1 - links_.d0[p] / e.norm()) * e).s;
                });
            }
        },
        256);
}

scalar springNetwork::energy(const List<vec4>& x) const
{
    return parallelSum(n(), [&](label begin, label end) {
        scalar sum = 0;
        for (label i = begin; i < end; ++i)
            forNeighbours<among::all>(links_, i, [&](pairIndex p, label) {
                const scalar stretch = separation(x, i, p).norm() - links_.d0[p];
                sum += 0.25 * links_.k[p] * stretch * stretch;
            });
        return sum;
    });
}

void springNetwork::stress(const List<vec4>& x, List<tensor>& tau) const
{
    tau.assign(size_t(n()), tensor::Zero());
    forPairs<among::all>(links_, 0, n(), [&](label i, pairIndex p, label) {
        const vector e = separation(x, i, p);
        const scalar weight = links_.k[p] * (1 - links_.d0[p] / e.norm());
        tau[i] += weight / (2 * ref_.volume()) * e * e.transpose();
    });
}

void springNetwork::tangentRow(const List<vec4>& x, bool positive, label i, blockMatrix3& K) const
{
    K.diagonal[i].setZero();
    for (label s = K.rowStart[i]; s < K.rowStart[i + 1]; ++s) K.value[s].setZero();
    forNeighbours<among::all>(links_, i, [&](pairIndex p, label) {
        const tensor A =
            linkBlock(separation(x, i, p), links_.k[p], links_.d0[p], positive, ref_.nDims);
        K.diagonal[i] += A;
        tensor& block = K.value[links_.slot[p]];
        if (links_.image[p]) block -= A * ref_.images[links_.image[p] - 1].R;
        else block -= A;
    });
}

void springNetwork::assembleTangent(const List<vec4>& x, tangentKind kind, blockMatrix3& K) const
{
    parallelFor(
        n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i) tangentRow(x, kind == tangentKind::positive, i, K);
        },
        256);
}

List<label> springNetwork::linkCounts() const
{
    List<label> count;
    for (label i = 0; i < n(); ++i) count.push_back(label(rowOf<among::all>(links_, i).size()));
    return count;
}

}  // namespace

std::unique_ptr<structureModel> newSpringNetwork(const dictionary& dict,
                                                 const structureReference& ref)
{
    return std::make_unique<springNetwork>(dict, ref);
}

}  // namespace ispf
