// SPDX-License-Identifier: GPL-3.0-or-later
#include "incompleteFactor.H"

#include "messages.H"
#include "execution.H"
#include <algorithm>

namespace ispf
{

incompleteFactor::incompleteFactor(const csrMatrix& A, const word& name, label blockRows)
    : name_(name), blockRows_(blockRows)
{
    split(A);
    inverse_.resize(A.size());
    overBlocks([&](label begin, label end) { factorBlock(A, begin, end); });
    for (label i = 0; i < A.size(); ++i)
        if (!std::isfinite(inverse_[i]))
            throw fatalError(name_ + ": the pivot of row " + std::to_string(i) +
                             " vanishes; choose preconditioner diagonal or none");
}

void incompleteFactor::overBlocks(const std::function<void(label, label)>& body) const
{
    const label n = label(inverse_.size());
    parallelFor((n + blockRows_ - 1) / blockRows_,
                [&](label first, label last) {
                    for (label b = first; b < last; ++b)
                        body(b * blockRows_, std::min(n, (b + 1) * blockRows_));
                },
                1);
}

// Copies the entries below and above the diagonal inside each block
void incompleteFactor::split(const csrMatrix& A)
{
    for (triangle* t : {&lower_, &upper_})
    {
        t->start.assign(1, 0);
        t->start.reserve(A.size() + 1);
        t->column.reserve(A.nEntries() / 2), t->value.reserve(A.nEntries() / 2);
    }
    for (label i = 0; i < A.size(); ++i)
    {
        for (label k = A.rowStart[i]; k < A.rowStart[i + 1]; ++k)
        {
            if (A.column[k] / blockRows_ != i / blockRows_) continue;
            triangle& t = A.column[k] < i ? lower_ : upper_;
            t.column.push_back(A.column[k]), t.value.push_back(A.value[k]);
        }
        for (triangle* t : {&lower_, &upper_}) t->start.push_back(label(t->column.size()));
    }
}

void incompleteFactor::factorBlock(const csrMatrix& A, label begin, label end)
{
    for (label i = begin; i < end; ++i)
    {
        scalar D = A.diagonal[i];
        for (label k = lower_.start[i]; k < lower_.start[i + 1]; ++k)
        {
            const label j = lower_.column[k];
            const auto first = upper_.column.begin() + upper_.start[j];
            const auto last = upper_.column.begin() + upper_.start[j + 1];
            const auto partner = std::find(first, last, i);
            if (partner != last)
                D -= lower_.value[k] * upper_.value[partner - upper_.column.begin()] * inverse_[j];
        }
        inverse_[i] = 1 / D;
    }
}

void incompleteFactor::solveBlock(label begin, label end, const scalar* r, scalar* z) const
{
    for (label i = begin; i < end; ++i)
    {
        scalar sum = r[i];
        for (label k = lower_.start[i]; k < lower_.start[i + 1]; ++k)
            sum -= lower_.value[k] * z[lower_.column[k]];
        z[i] = sum * inverse_[i];
    }
    for (label i = end - 1; i >= begin; --i)
    {
        scalar sum = 0;
        for (label k = upper_.start[i]; k < upper_.start[i + 1]; ++k)
            sum += upper_.value[k] * z[upper_.column[k]];
        z[i] -= sum * inverse_[i];
    }
}

void incompleteFactor::apply(const List<scalar>& r, List<scalar>& z) const
{
    overBlocks([&](label begin, label end) { solveBlock(begin, end, r.data(), z.data()); });
}

}  // namespace ispf
