// SPDX-License-Identifier: GPL-3.0-or-later
#include "faceVectors.H"
#include "cellClosing.H"
#include "rawList.H"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <memory>

namespace ispf
{

namespace
{

constexpr simd4 inSpace = {1, 1, 1, 0};

// Bound of the eigenvalues of a correction: 4 times that of a full support (doc/constants.md)
constexpr scalar mostCorrected = 4;

// Bound of lambda_max(sum_j a_ij a_ij^T / w_ij): 1 in full order, 2 beside a wall.  Beyond the bound faces are shortened
constexpr scalar mostFace = 6;

struct alignas(32) columns  // of a matrix
{
    simd4 c[3];

    static columns of(const tensor& m)
    {
        columns r;
        for (int k = 0; k < 3; ++k) r.c[k] = simd4{m(0, k), m(1, k), m(2, k), 0};
        return r;
    }
    tensor matrix() const
    {
        tensor m;
        for (int k = 0; k < 3; ++k)
            for (int a = 0; a < 3; ++a) m(a, k) = c[k][a];
        return m;
    }
    ISPF_INLINE simd4 operator*(const simd4& d) const
    {
        return c[0] * d[0] + c[1] * d[1] + c[2] * d[2];
    }
};

// The arrays that the loops over pairs read
struct view
{
    const std::int64_t* start;
    const std::int64_t* end;
    const label* index;
    const scalar* F;
    const vec4* x;
    const columns* B;
    const vec4* psi;
    const scalar* share;  // s_i of (2.7)

    ISPF_INLINE pairRange row(label i) const { return {start[i], end[i]}; }
    // way: r_ij.  corrected, closing: the two terms of (2.3) over w_ij
    ISPF_INLINE simd4 way(label i, label j) const { return (x[j].s - x[i].s) * inSpace; }
    ISPF_INLINE simd4 corrected(label i, label j, const simd4& d) const
    {
        return 0.5 * std::min(share[i], share[j]) * (B[i] * d + B[j] * d);
    }
    ISPF_INLINE simd4 closing(label i, label j) const { return psi[i].s - psi[j].s; }
};

// sum_j a_ij (x) (x_j - x_i)
ISPF_HOT void momentRange(const view& v, label begin, label end, columns* moment)
{
    for (label i = begin; i < end; ++i)
    {
        simd4 m0 = {}, m1 = {}, m2 = {};
        forNeighbours(v, v.row(i), [&](pairIndex k, label j) {
            const simd4 d = v.way(i, j), a = -v.F[k] * (v.corrected(i, j, d) + v.closing(i, j));
            m0 += a * d[0], m1 += a * d[1], m2 += a * d[2];
        });
        moment[i] = {{m0, m1, m2}};
    }
}

// sum_j a_ij + b_i
ISPF_HOT void openRange(const view& v, const vec4* b, label begin, label end, vec4* left)
{
    for (label i = begin; i < end; ++i)
    {
        left[i].s = sumNeighbours(v, v.row(i), b[i].s * inSpace, [&](pairIndex k, label j) {
            return -v.F[k] * (v.corrected(i, j, v.way(i, j)) + v.closing(i, j));
        });
    }
}

// sum_j of the squared components of a_ij / w_ij, added up over components: sum_j |a_ij|^2 / w_ij, without psi
ISPF_HOT void sizeRange(const view& v, label begin, label end, scalar* size)
{
    for (label i = begin; i < end; ++i)
    {
        const simd4 sum = sumNeighbours(v, v.row(i), simd4{}, [&](pairIndex k, label j) {
            const simd4 f = v.corrected(i, j, v.way(i, j));
            return -v.F[k] * f * f;
        });
        size[i] = sum[0] + sum[1] + sum[2];
    }
}

// Writes a_ij to `a` and sum_j a_ij + b_i to `left`
ISPF_HOT void writeRange(const view& v, const vec4* b, int nDims, label begin, label end, scalar* a,
                         vec4* left)
{
    for (label i = begin; i < end; ++i)
    {
        simd4 sum = b[i].s * inSpace;
        forNeighbours(v, v.row(i), [&](pairIndex k, label j) {
            const simd4 face = -v.F[k] * (v.corrected(i, j, v.way(i, j)) + v.closing(i, j));
            sum += face;
            scalar* kept = a + nDims * k;
            kept[0] = face[0], kept[1] = face[1];
            if (nDims == 3) kept[2] = face[2];
        });
        left[i].s = sum;
    }
}

// The steps of faceVectors::build
class builder
{
public:
    builder(const particleCloud& cloud, const neighbourList& list, const medium& within)
        : cloud_(cloud), list_(list), within_(within), B_(cloud.nAll()), psi_(cloud.nAll())
    {
        poor_.assign(cloud.n(), 0), closed_.assign(cloud.n(), 0), share_.assign(cloud.nAll(), 1);
        bodies_ = connectedBodies(cloud, list, within);
    }

    // A particle with few neighbours gets a bounded correction.  One with next to none is not closed
    void start(const List<tensor>& M)
    {
        forMedium([&](label i) {
            const tensor& one = within_.one[i];
            tensor own = (tensor::Identity() - M[i]) * one;
            if (one.trace() > mostCorrected)
                if (const Eigen::SelfAdjointEigenSolver<tensor> e(one);
                    e.eigenvalues()[2] > mostCorrected)
                {
                    poor_[i] = 1;
                    own = e.eigenvectors() * e.eigenvalues().cwiseMin(mostCorrected).asDiagonal() *
                          e.eigenvectors().transpose();
                }
            B_[i] = columns::of(own);
            closed_[i] = !cloud_.beyondOpen(i) && !(poor_[i] && alone(i));
        });
        closing_ = std::make_unique<cellClosing>(cloud_, list_, within_, bodies_, closed_);
        takeInside(), fillB();
    }

    // The support of a strip's particles is truncated: they get the mean correction of the fluid before the face
    void takeInside()
    {
        for (const cellClosing::strip& s : closing_->strips())
            for (const label i : s.members)
            {
                columns sum = {};
                scalar all = 0;
                forNeighbours(list_, within_.row(list_, i), [&](pairIndex k, label j) {
                    if (j >= cloud_.n() || !closed_[j]) return;
                    for (int a = 0; a < 3; ++a) sum.c[a] -= list_.F[k] * B_[j].c[a];
                    all -= list_.F[k];
                });
                for (int a = 0; a < 3 && all > 0; ++a) B_[i].c[a] = sum.c[a] / all;
            }
    }

    // sum_j w_ij |x_ij|^2 is nDims in the midst of fluid and a quarter of that in a corner
    bool alone(label i) const
    {
        constexpr scalar least = 0.1;  // doc/constants.md
        const auto term = [&](pairIndex k, label j) {
            return -list_.F[k] * (cloud_.x[j].xyz() - cloud_.x[i].xyz()).squaredNorm();
        };
        return sumNeighbours(list_, within_.row(list_, i), 0.0, term) < least * cloud_.nDims;
    }

    void sweep(const List<tensor>& M, scalar relaxation)
    {
        const tensor one = vector(1, 1, cloud_.nDims == 2 ? 0 : 1).asDiagonal();
        List<columns> moment(cloud_.n());
        forRanges([&](label i, label end) { momentRange(sight(), i, end, moment.data()); });
        count();
        forMedium([&](label i) {
            if (poor_[i] || cloud_.stripOf(i) > 0) return;
            const columns change =
                columns::of(relaxation * (one - moment[i].matrix() - M[i]) * within_.one[i]);
            for (int a = 0; a < 3; ++a) B_[i].c[a] += change.c[a];
        });
        takeInside(), fillB();
    }

    // Starts from psi of the same fit in the step before, if it is known.  The first sweep comes before: it has psi = 0, so
    // that its B depends on positions alone
    void takePsi(const List<vec4>& psi)
    {
        if (psi.empty()) return;
        std::copy(psi.begin() + within_.first, psi.begin() + cloud_.n(),
                  psi_.begin() + within_.first);
        closing_->admit(psi_);
        cloud_.fillGradientGhosts(psi_);
    }

    // Solves (2.4) and (4.10) for psi, from the present psi on
    void close(const List<vec4>& b, scalar tolerance, faceVectors::closure& result)
    {
        constexpr int most = 5;  // residuals, doc/constants.md
        bool done = false;
        for (int k = 0; k < most && !done; ++k)
        {
            List<vec4> r = residual(b);
            done = closing_->improve(r, psi_, tolerance, result.iterations);
            cloud_.fillGradientGhosts(psi_);
        }
    }

    // - sum_j a_ij - b_i.  A strip has the sum over its pairs with particles in no strip, and half its face
    List<vec4> residual(const List<vec4>& b) const
    {
        List<vec4> r(cloud_.n());
        const view v = sight();
        forRanges([&](label i, label end) { openRange(v, b.data(), i, end, r.data()); });
        count();
        forMedium([&](label i) { r[i].s *= -inSpace; });
        for (const cellClosing::strip& s : closing_->strips())
        {
            simd4 sum = -s.half.s;
            for (const label i : s.members)
                forNeighbours(list_, within_.row(list_, i), [&](pairIndex k, label j) {
                    if (cloud_.stripOf(cloud_.ownerOf(j)) > 0) return;
                    sum += list_.F[k] * (v.corrected(i, j, v.way(i, j)) + v.closing(i, j));
                });
            for (const label i : s.members) r[i].s = sum;
        }
        return r;
    }

    // Shortens the corrected part of the faces beyond mostFace; psi closes the cells again
    void shorten()
    {
        const label n = cloud_.n();
        List<scalar> share(cloud_.nAll(), 1);
        forRanges([&](label i, label end) { sizeRange(sight(), i, end, share.data()); });
        count();
        forMedium([&](label i) {
            const bool maybe = share[i] > mostFace;
            share[i] = 1;
            if (!maybe) return;
            tensor sum = tensor::Zero();
            const view v = sight();
            forNeighbours(v, v.row(i), [&](pairIndex k, label j) {
                const simd4 f = v.corrected(i, j, v.way(i, j));
                const vector a(f[0], f[1], f[2]);
                sum -= v.F[k] * a * a.transpose();
            });
            const Eigen::SelfAdjointEigenSolver<tensor> e(sum, Eigen::EigenvaluesOnly);
            if (e.eigenvalues()[2] > mostFace) share[i] = std::sqrt(mostFace / e.eigenvalues()[2]);
        });
        for (label g = n; g < cloud_.nAll(); ++g)
            if (cloud_.ghostSource(g) >= 0) share[g] = share[cloud_.ghostSource(g)];
        share_ = std::move(share);
    }

    label nPoor() const { return label(std::count(poor_.begin(), poor_.end(), 1)); }
    void keepPsi(List<vec4>& psi) const { psi.assign(psi_.begin(), psi_.begin() + cloud_.n()); }

    // Writes a_ij and the residuals, after closing.  The mean over each body is taken off the residuals: a uniform p then
    // has no gradient
    void write(const List<vec4>& b, faceVectors& faces, faceVectors::closure& result) const
    {
        List<vec4>& c = faces.left;
        faces.nDims = cloud_.nDims;
        // the last vector is read as four numbers
        remake(faces.a, faces.nDims * list_.index.size() + 4), c.assign(cloud_.n(), vec4{});
        forRanges([&](label i, label end) {
            writeRange(sight(), b.data(), faces.nDims, i, end, faces.a.data(), c.data());
        });
        count(faces.nDims * label(sizeof(scalar)));
        const auto [squares, nClosed] =
            sumsOf(within_.first, cloud_.n(), [&](label i) -> std::array<scalar, 2> {
                if (closed_[i]) return {magSqr(c[i].s), 1};
                c[i] = vec4{};
                return {};
            });
        result.defect = cloud_.dx * std::sqrt(squares / std::max<scalar>(1, nClosed));
        closing_->removeMeans(c, true);
        faces.poor = poor_, faces.bodies = bodies_;
    }

private:
    view sight() const
    {
        return {list_.start.data(), within_.end->data(), list_.index.data(), list_.F.data(),
                cloud_.x.data(),    B_.data(),           psi_.data(),        share_.data()};
    }

    // A loop over the pairs that reads F, and writes some bytes per pair
    void count(label written = 0) const
    {
        countPairs(list_.nPairs() - list_.start[within_.first],
                   label(sizeof(label) + sizeof(scalar)) + written);
    }
    template <class Body>
    void forRanges(Body&& body) const
    {
        const label first = within_.first;
        parallelFor(cloud_.n() - first,
                    [&](label from, label to) { body(first + from, first + to); });
    }
    template <class Body>
    void forMedium(Body&& body) const
    {
        forRanges([&](label i, label end) {
            for (; i < end; ++i) body(i);
        });
    }
    void fillB()
    {
        const label n = cloud_.n();
        parallelFor(cloud_.nGhosts(), [&](label from, label to) {
            for (label g = n + from; g < n + to; ++g)
                if (cloud_.ghostSource(g) >= 0)
                {
                    const tensor& R = cloud_.ruleOf(g).R;
                    B_[g] = columns::of(R * B_[cloud_.ghostSource(g)].matrix() * R.transpose());
                }
        });
    }

    const particleCloud& cloud_;
    const neighbourList& list_;
    const medium& within_;
    List<columns> B_;
    List<vec4> psi_;
    List<char> poor_, closed_;
    List<scalar> share_;
    connectedBodies bodies_;
    std::unique_ptr<cellClosing> closing_;
};

}  // namespace

faceVectors::closure faceVectors::build(const particleCloud& cloud, const neighbourList& list,
                                        const medium& within, const List<vec4>& b,
                                        const List<tensor>& M, const fitted& psi, scalar tolerance)
{
    // The least eigenvalue that the relaxation of the sweeps is made for; tolerance of all fits but the last, over that of the
    // last (doc/constants.md)
    constexpr scalar least = 0.4, loosely = 100;
    closure result;
    builder faces(cloud, list, within);
    faces.start(M);
    result.poor = faces.nPoor();
    for (int k = 1; k <= fits; ++k)
    {
        List<vec4>& ofFit = *psi[k - 1];
        faces.sweep(
            M, 2 / (1 + least + (1 - least) * std::cos(M_PI * (k - 0.5) / fits)));  // Chebyshev
        faces.takePsi(ofFit);
        if (k == fits) faces.shorten();
        faces.close(b, k == fits ? tolerance : loosely * tolerance, result);
        faces.keepPsi(ofFit);
    }
    faces.write(b, *this, result);
    return result;
}

}  // namespace ispf
