// SPDX-License-Identifier: GPL-3.0-or-later
#include "transientNetworks.H"

#include "execution.H"
#include "messages.H"

#include <algorithm>
#include <cmath>

namespace ispf
{

namespace
{

// Numbers of a symmetric tensor
constexpr int rows[] = {0, 1, 2, 1, 0, 0}, columns[] = {0, 1, 2, 2, 2, 1};
constexpr size_t nNumbers = 6;

// Shares of (5.35): of what was, and of C^-1 at the start and at the end of the time that has passed
struct fading
{
    scalar kept = 1, start = 0, end = 0;

    fading(scalar passed, scalar time)
    {
        const scalar a = passed / time;
        if (!(a > 0)) return;
        kept = std::exp(-a);
        const scalar mean = -std::expm1(-a) / a;
        start = mean - kept, end = 1 - mean;
    }
};

}  // namespace

transientNetworks::transientNetworks(const zoneMaterials& materials, const referenceGradient& fit,
                                     const List<char>& active, scalar volume)
    : materials_(materials),
      fit_(fit),
      volume_(volume),
      first_({0}),
      strands_(active.size(), tensor::Zero()),
      share_(active.size(), 0)
{
    for (label k = 0; k < label(active.size()); ++k)
    {
        first_.push_back(first_[k] + (active[k] ? label(materials.branches(k).size()) : 0));
        most_ = std::max(most_, materials.fastModulus(k) - materials.shearModulus(k));
    }
    recall({});
}

// Sets the law of particle k to that of the accepted state
void transientNetworks::settle(label k)
{
    strands_[k].setZero(), share_[k] = 0;
    forBranches(k, [&](label i, const relaxationBranch& b) {
        strands_[k] += b.G * B_[i], share_[k] += b.G;
    });
}

void transientNetworks::recall(const List<scalar>& numbers)
{
    B_.assign(size_t(first_.back()), tensor::Identity());
    if (!numbers.empty() && numbers.size() != nNumbers * B_.size())
        throw fatalError("The particles remember " + std::to_string(numbers.size() / nNumbers) +
                         " branches of relaxation, constant/structureProperties gives them " +
                         std::to_string(B_.size()) +
                         ": 'relaxation' has another number of branches than in the run that "
                         "wrote them, or the solid is another. Give as many branches as there, or "
                         "begin at time 0");
    for (size_t i = 0; !numbers.empty() && i < B_.size(); ++i)
        for (size_t c = 0; c < nNumbers; ++c)
            B_[i](rows[c], columns[c]) = B_[i](columns[c], rows[c]) = numbers[nNumbers * i + c];
    for (label k = 0; k < label(share_.size()); ++k)
        if (acts(k)) settle(k);
}

List<scalar> transientNetworks::numbers() const
{
    List<scalar> all;
    all.reserve(nNumbers * B_.size());
    for (const tensor& B : B_)
        for (size_t c = 0; c < nNumbers; ++c) all.push_back(B(rows[c], columns[c]));
    return all;
}

void transientNetworks::inverses(const List<vec4>& x, List<tensor>& inverse) const
{
    fit_.apply(x, inverse);
    parallelFor(
        label(share_.size()),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
            {
                if (!acts(k)) continue;
                const scalar J = inverse[k].determinant();
                const tensor back = std::cbrt(J) * inverse[k].inverse();
                inverse[k] = back * back.transpose();
            }
        },
        256);
}

// (5.36)
void transientNetworks::begin(const List<vec4>& x, scalar ahead)
{
    inverses(x, began_);
    parallelFor(
        label(share_.size()),
        [&](label begin, label end) {
            for (label k = begin; k < end; ++k)
            {
                if (!acts(k)) continue;
                strands_[k].setZero(), share_[k] = 0;
                forBranches(k, [&](label i, const relaxationBranch& b) {
                    const fading f(ahead, b.time);
                    strands_[k] += b.G * (f.kept * B_[i] + f.start * began_[k]);
                    share_[k] += b.G * (f.kept + f.start);
                });
            }
        },
        256);
}

// (5.35) and, for what is lost, (5.38)
scalar transientNetworks::end(const List<vec4>& x, scalar dt)
{
    List<tensor> ended;
    inverses(x, ended);
    return parallelSum(label(share_.size()), [&](label begin, label end) {
        scalar lost = 0;
        for (label k = begin; k < end; ++k)
        {
            if (!acts(k)) continue;
            const tensor before = began_[k].inverse(), now = ended[k].inverse();
            forBranches(k, [&](label i, const relaxationBranch& b) {
                const fading f(dt, b.time);
                const auto held = [&](const tensor& C) {  // without the rounding of a zero
                    return b.G / 2 * std::max(C.cwiseProduct(B_[i]).sum() - 3, scalar(0));
                };
                lost += volume_ * (f.end * held(before) + f.start * held(now));
                B_[i] = f.kept * B_[i] + f.start * began_[k] + f.end * ended[k];
            });
            settle(k);
        }
        return lost;
    });
}

}  // namespace ispf
