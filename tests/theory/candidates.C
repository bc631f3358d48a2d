// SPDX-License-Identifier: GPL-3.0-or-later
#include "candidates.H"

namespace theory
{

operatorPair candidate::build(const scene& s) const
{
    return direct ? direct(s) : faceVectors(s, options).pair(options.linearAtWall);
}

std::vector<candidate> candidates()
{
    const auto faces = [](const std::string& name, int sweeps, int passes, bool linear) {
        candidate c{name};
        c.closed = true;
        c.options.sweeps = sweeps, c.options.passes = passes, c.options.linearAtWall = linear;
        return c;
    };
    candidate today{"today", false}, plain{"plain adjoint"}, open{"symmetric, open"};
    today.direct = oneSidedPair, plain.direct = plainAdjoint;
    open.options.closed = open.options.linearAtWall = false;
    std::vector<candidate> list{today, plain, open, faces("faces 3/1, p_i", 3, 1, false)};
    for (const int passes : {1, 2, 6})
        list.push_back(faces("faces 3/" + std::to_string(passes), 3, passes, true));
    list.push_back(fitted(5e-3, 20));
    list.push_back(fitted(1e-3, 200));
    return list;
}

candidate sweptFaces()
{
    candidate c{"faces 3/1"};
    c.closed = true;
    return c;
}

candidate fitted(double penalty, int iterations)
{
    candidate c{"faces fitted " + std::to_string(iterations)};
    c.closed = true;
    c.options.leastSquares = penalty, c.options.iterations = iterations;
    return c;
}

}  // namespace theory
