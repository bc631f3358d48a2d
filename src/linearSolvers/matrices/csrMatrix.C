// SPDX-License-Identifier: GPL-3.0-or-later
#include "csrMatrix.H"

#include "messages.H"
#include "execution.H"
#include <algorithm>

namespace ispf
{

namespace
{

struct rows
{
    const label* start;
    const std::int32_t* column;
    const scalar* value;
    const scalar* diagonal;
};

ISPF_INLINE scalar rowProduct(const rows& A, label i, const scalar* x)
{
    scalar sum = 0;
    const label end = A.start[i + 1];
#pragma omp simd reduction(+ : sum)
    for (label k = A.start[i]; k < end; ++k) sum += A.value[k] * x[A.column[k]];
    return sum + A.diagonal[i] * x[i];
}

ISPF_HOT void productRange(const rows& A, label begin, label end, const scalar* x, scalar* y)
{
    for (label i = begin; i < end; ++i) y[i] = rowProduct(A, i, x);
}

rows rowsOf(const csrMatrix& A)
{
    return {A.rowStart.data(), A.column.data(), A.value.data(), A.diagonal.data()};
}

}  // namespace

void csrMatrix::apply(const List<scalar>& x, List<scalar>& y) const
{
    const rows A = rowsOf(*this);
    parallelFor(size(),
                [&](label begin, label end) { productRange(A, begin, end, x.data(), y.data()); });
    countPairs(label(value.size()), sizeof(std::int32_t) + sizeof(scalar));
}

label csrMatrix::row(label i, std::int32_t* columns, scalar* values) const
{
    std::copy(column.begin() + rowStart[i], column.begin() + rowStart[i + 1], columns);
    std::copy(value.begin() + rowStart[i], value.begin() + rowStart[i + 1], values);
    return most(i);
}

void csrMatrix::check() const
{
    const label n = size();
    if (label(rowStart.size()) != n + 1 || rowStart.front() != 0)
        throw fatalError("csrMatrix: rowStart must have " + std::to_string(n + 1) +
                         " entries and begin with 0");
    if (label(column.size()) < nEntries() || label(value.size()) < nEntries())
        throw fatalError("csrMatrix: column and value are shorter than rowStart says (" +
                         std::to_string(nEntries()) + ")");
    for (label i = 0; i < n; ++i)
    {
        bool good = rowStart[i] <= rowStart[i + 1];
        for (label k = rowStart[i]; good && k < rowStart[i + 1]; ++k)
            good = column[k] >= 0 && column[k] < n && column[k] != i;
        if (!good)
            throw fatalError("csrMatrix: row " + std::to_string(i) +
                             " runs backwards or lists itself or a column outside the matrix");
    }
}

csrMatrix csrMatrix::fromTriplets(label n, const List<triplet>& triplets)
{
    List<triplet> sorted(triplets);
    std::stable_sort(sorted.begin(), sorted.end(), [](const triplet& a, const triplet& b) {
        return a.row != b.row ? a.row < b.row : a.column < b.column;
    });
    csrMatrix A;
    A.rowStart.assign(n + 1, 0);
    A.diagonal.assign(n, 0);
    label lastRow = -1, lastColumn = -1;
    for (const triplet& t : sorted)
    {
        if (t.row < 0 || t.row >= n || t.column < 0 || t.column >= n)
            throw fatalError("csrMatrix: triplet (" + std::to_string(t.row) + ", " +
                             std::to_string(t.column) + ") lies outside a matrix of " +
                             std::to_string(n) + " rows");
        if (t.row == t.column) A.diagonal[t.row] += t.value;
        else if (t.row == lastRow && t.column == lastColumn) A.value.back() += t.value;
        else
        {
            A.column.push_back(t.column), A.value.push_back(t.value);
            ++A.rowStart[t.row + 1];
            lastRow = t.row, lastColumn = t.column;
        }
    }
    for (label i = 0; i < n; ++i) A.rowStart[i + 1] += A.rowStart[i];
    return A;
}

csrMatrix csrMatrix::fromOperator(const linearOperator& A)
{
    const label n = A.size();
    List<triplet> entries;
    List<scalar> unit(n, 0), columnOfA(n);
    for (label j = 0; j < n; ++j)
    {
        unit[j] = 1;
        A.apply(unit, columnOfA);
        unit[j] = 0;
        for (label i = 0; i < n; ++i)
            if (columnOfA[i] != 0) entries.push_back({i, j, columnOfA[i]});
    }
    return fromTriplets(n, entries);
}

}  // namespace ispf
