// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphm.H"
#include "imageEntries.H"

#include <algorithm>

namespace ispf
{

namespace
{

// The rows of one block of particles; all blocks are joined at the end
struct block
{
    List<label> length;
    List<std::int32_t> column;
    List<scalar> value;
};

class pressureAssembly
{
public:
    pressureAssembly(const stencil& s, const List<scalar>& stiffness, csrMatrix& A)
        : s_(s), stiffness_(stiffness), A_(A)
    {
        images_.build(s.cloud, s.list, stiffness);
    }

    void run()
    {
        const label n = s_.cloud.n(), nBlocks = (n + blockRows - 1) / blockRows;
        A_.diagonal.resize(n);
        List<block> part(nBlocks);
        parallelFor(
            nBlocks,
            [&](label begin, label end) {
                for (label b = begin; b < end; ++b)
                    for (label i = b * blockRows; i < std::min(n, (b + 1) * blockRows); ++i)
                        row(i, part[b]);
            },
            1);
        join(part);
    }

private:
    static constexpr label blockRows = 2048;

    void row(label i, block& out)
    {
        const size_t first = out.column.size();
        scalar diagonal = images_.diagonal[i];
        forNeighbours<among::connected>(s_.list, i, [&](pairIndex k, label j) {
            if (j >= s_.cloud.n()) return;
            const scalar w = -(stiffness_[i] + stiffness_[j]) * s_.list.F[k];
            if (negligible(w, s_.cloud.dx)) return;
            diagonal += w;
            add(out, j, -w);
        });
        const size_t owned = out.column.size();
        // by hand: the entries of images are no list of neighbours
        for (label k = images_.start[i]; k < images_.start[i + 1]; ++k)
            addImage(out, {first, owned}, images_.entries[k]);

        if (s_.cloud.pHeld(i)) out.column.resize(first), out.value.resize(first);
        // a particle without neighbours gets a regular row
        A_.diagonal[i] = diagonal > 0 ? diagonal : 1 / (s_.cloud.dx * s_.cloud.dx);
        out.length.push_back(label(out.column.size() - first));
    }

    void add(block& out, label j, scalar value) const
    {
        if (!s_.cloud.pHeld(j)) out.column.push_back(j), out.value.push_back(value);
    }

    // Adds the entry of an image.  If its source is also a neighbour, among [first, owned), both share one entry
    void addImage(block& out, std::pair<size_t, size_t> neighbours,
                  const imageEntries::entry& e) const
    {
        const auto from = out.column.begin() + neighbours.first,
                   to = out.column.begin() + neighbours.second;
        const auto found = std::find(from, to, e.column);
        if (found != to) out.value[size_t(found - out.column.begin())] += e.offDiagonal;
        else add(out, e.column, e.offDiagonal);
    }

    void join(const List<block>& part)
    {
        csrMatrix& A = A_;
        const label n = s_.cloud.n();
        A.rowStart.assign(n + 1, 0);
        label row = 0;
        for (const block& p : part)
            for (const label length : p.length)
                A.rowStart[row + 1] = A.rowStart[row] + length, ++row;
        A.column.resize(A.rowStart[n]), A.value.resize(A.rowStart[n]);
        parallelFor(
            label(part.size()),
            [&](label begin, label end) {
                for (label b = begin; b < end; ++b)
                {
                    const label to = A.rowStart[b * blockRows];
                    std::copy(part[b].column.begin(), part[b].column.end(), A.column.begin() + to);
                    std::copy(part[b].value.begin(), part[b].value.end(), A.value.begin() + to);
                }
            },
            1);
    }

    const stencil& s_;
    const List<scalar>& stiffness_;
    csrMatrix& A_;
    imageEntries images_;
};

}  // namespace

void sphm::laplacian(const stencil& s, const List<scalar>& stiffness, csrMatrix& A)
{
    pressureAssembly(s, stiffness, A).run();
}

}  // namespace ispf
