// SPDX-License-Identifier: GPL-3.0-or-later
// Structure model of particles tied by permanent springs.  Linear ones are those of Monteleone et al., Eq. (2),
//
//     m_s f_s = k_e h sum_j (d0_sj - d_sj) (x_s - x_j)/d_sj,      k = k_e h
//
// with one stiffness k per link (springLinks).  A link to an image x_j' = R x_j + t stands in row
// i, its inverse in row j.  The energy counts each as half, so that a quarter of a body between two
// symmetry planes has a quarter of its energy, and
//
//     f_i = -sum t d n,   K_ii += A,   K_ij -= A R,   A = s n n^T + t (I - n n^T)
//     tau_i = 1/(2 V) sum t d^2 n n^T
//
// t is the link's force over d, s its slope (linkLaw.H): k (1 - d0/d) and k if the link is linear.
//
// A link to an image of the particle itself has its -A R in an entry of column i: K_ii is the same as in a whole body.
#include "followerTies.H"
#include "linkLaw.H"
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

template <class Law>
ISPF_HOT void ownForce(const Law& law, const linkTable& links, const vec4* x, label i, simd4& f)
{
    const simd4 xi = x[i].s;
    forNeighbours<among::same>(links, i, [&](pairIndex p, label j) {
        const simd4 e = xi - x[j].s;
        const scalar d = std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
        f -= law.tension(links.k[p], links.d0[p], d) * e;
    });
}

// A = (s - t) n n^T + t I
template <class Law>
ISPF_INLINE tensor linkBlock(const Law& law, const vector& e, scalar k, scalar d0, bool positive,
                             int nDims)
{
    const scalar d2 = e.squaredNorm(), d = std::sqrt(d2), tension = law.tension(k, d0, d);
    const scalar t = positive && tension < 0 ? 0 : tension;
    tensor A = ((law.slope(k, d0, d) - t) / d2) * e * e.transpose();
    for (int a = 0; a < nDims; ++a) A(a, a) += t;
    return A;
}

template <class Law>
class springNetwork : public structureModel
{
public:
    springNetwork(const dictionary& dict, const structureReference& ref, const Law& law)
        : structureModel(ref), law_(law)
    {
        const springLinks all(dict, ref_);
        G_ = all.G;
        ties_ = std::make_unique<followerTies>(ref_, gradient_, List<scalar>(size_t(n()), G_));
        summary_ = "springNetwork, " + law.description() + all.summary + ties_->summary();
        links_ = movingLinks(all, ref_.fixed);
        makePattern();
    }

    void force(const List<vec4>& x, List<vec4>& f) const override;
    scalar energy(const List<vec4>& x) const override;
    void stress(const List<vec4>& x, List<tensor>& tau) const override;
    blockMatrix3 tangentPattern() const override { return pattern_.withZeros(); }
    using structureModel::assembleTangent;
    void assembleTangent(const List<vec4>& x, tangentKind kind, const List<scalar>& p,
                         blockMatrix3& K) const override;
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

    const Law law_;
    linkTable links_;
    std::unique_ptr<followerTies> ties_;
    blockMatrix3 pattern_;  // without values
    word summary_;
};

template <class Law>
void springNetwork<Law>::makePattern()
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
        pattern_.rowStart.push_back(label(pattern_.column.size()));
    }
    pattern_ = ties_->withPattern(std::move(pattern_));
    for (label i = 0; i < n(); ++i)
    {
        const label first = pattern_.rowStart[i], last = pattern_.rowStart[i + 1];
        forNeighbours<among::all>(links_, i, [&](pairIndex p, label j) {
            const auto at = std::lower_bound(pattern_.column.begin() + first,
                                             pattern_.column.begin() + last, j);
            links_.slot[p] = label(at - pattern_.column.begin());
        });
    }
}

template <class Law>
void springNetwork<Law>::force(const List<vec4>& x, List<vec4>& f) const
{
    f.resize(std::max<size_t>(f.size(), size_t(n())));
    parallelFor(
        n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i)
            {
                simd4 sum = {};
                ownForce(law_, links_, x.data(), i, sum);
                f[i].s = sum;
                forNeighbours<among::others>(links_, i, [&](pairIndex p, label) {
                    const vector e = separation(x, i, p);
                    f[i].s -= vec4::from(law_.tension(links_.k[p], links_.d0[p], e.norm()) * e).s;
                });
            }
        },
        256);
    ties_->addForce(x, f);
}

template <class Law>
scalar springNetwork<Law>::energy(const List<vec4>& x) const
{
    return ties_->energy(x) + parallelSum(n(), [&](label begin, label end) {
               scalar sum = 0;
               for (label i = begin; i < end; ++i)
                   forNeighbours<among::all>(links_, i, [&](pairIndex p, label) {
                       sum +=
                           0.5 * law_.energy(links_.k[p], links_.d0[p], separation(x, i, p).norm());
                   });
               return sum;
           });
}

template <class Law>
void springNetwork<Law>::stress(const List<vec4>& x, List<tensor>& tau) const
{
    tau.assign(size_t(n()), tensor::Zero());
    forPairs<among::all>(links_, 0, n(), [&](label i, pairIndex p, label) {
        const vector e = separation(x, i, p);
        const scalar tension = law_.tension(links_.k[p], links_.d0[p], e.norm());
        tau[i] += tension / (2 * ref_.volume()) * e * e.transpose();
    });
    ties_->addStress(x, tau);
}

template <class Law>
void springNetwork<Law>::tangentRow(const List<vec4>& x, bool positive, label i,
                                    blockMatrix3& K) const
{
    K.diagonal[i].setZero();
    for (label s = K.rowStart[i]; s < K.rowStart[i + 1]; ++s) K.value[s].setZero();
    forNeighbours<among::all>(links_, i, [&](pairIndex p, label) {
        const tensor A =
            linkBlock(law_, separation(x, i, p), links_.k[p], links_.d0[p], positive, ref_.nDims);
        K.diagonal[i] += A;
        tensor& block = K.value[links_.slot[p]];
        if (links_.image[p]) block -= A * ref_.images[links_.image[p] - 1].R;
        else block -= A;
    });
}

template <class Law>
void springNetwork<Law>::assembleTangent(const List<vec4>& x, tangentKind kind, const List<scalar>&,
                                         blockMatrix3& K) const
{
    parallelFor(
        n(),
        [&](label begin, label end) {
            for (label i = begin; i < end; ++i) tangentRow(x, kind == tangentKind::positive, i, K);
        },
        256);
    ties_->addTangent(K);
}

template <class Law>
List<label> springNetwork<Law>::linkCounts() const
{
    List<label> count;
    for (label i = 0; i < n(); ++i) count.push_back(label(rowOf<among::all>(links_, i).size()));
    ties_->addLinkCounts(count);
    return count;
}

}  // namespace

std::unique_ptr<structureModel> newSpringNetwork(const dictionary& dict,
                                                 const structureReference& ref)
{
    const scalar b = dict.getInRangeOrDefault("stiffening", 0, 100, 0);
    if (b > 0) return std::make_unique<springNetwork<stiffeningLink>>(dict, ref, stiffeningLink{b});
    return std::make_unique<springNetwork<linearLink>>(dict, ref, linearLink{});
}

}  // namespace ispf
