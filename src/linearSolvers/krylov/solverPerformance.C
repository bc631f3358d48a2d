// SPDX-License-Identifier: GPL-3.0-or-later
#include "solverPerformance.H"
#include "execution.H"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace ispf
{

solverControls solverControls::fromDict(const dictionary& dict, const solverControls& otherwise)
{
    solverControls c = otherwise;
    c.tolerance = dict.getInRangeOrDefault("tolerance", 0, 0.1, c.tolerance);
    c.relTol = dict.getInRangeOrDefault("relTol", 0, 0.5, c.relTol);
    c.absTol = dict.getInRangeOrDefault("absTol", 0, 1e300, c.absTol);
    c.maxIter = dict.getInRangeOrDefault<label>("maxIter", 1, 1e6, c.maxIter);
    return c;
}

word solverPerformance::line() const
{
    word text = solverName + ":  Solving for " + fieldName +
                ", Initial residual = " + str(initialResidual) +
                ", Final residual = " + str(finalResidual) + ", No Iterations " +
                std::to_string(nIterations);
    switch (status)
    {
        case solverStatus::stagnated:
            return text + " (stagnated)";
        case solverStatus::breakdown:
            return text + " (breakdown)";
        case solverStatus::notFinite:
            return text + " (not finite)";
        default:
            return text;
    }
}

void solverPerformance::print() const
{
    info() << line() << std::endl;
    if (setupCpu >= 0)
        info() << solverName << ":  CPU time for " << fieldName << ", set-up = " << setupCpu
               << " s, solution = " << solveCpu << " s" << std::endl;
}

convergence::convergence(const solverControls& controls, const word& solver, const word& field,
                         scalar normB, scalar initialNorm)
    : maxIter_(controls.maxIter)
{
    result_.solverName = solver;
    result_.fieldName = field;
    // b = 0: the first residual is the only scale
    result_.normFactor = normB > 0 ? normB : initialNorm > 0 ? initialNorm : 1;
    result_.initialResidual = initialNorm / result_.normFactor;
    target_ = std::max(
        {controls.tolerance * result_.normFactor, controls.relTol * initialNorm, controls.absTol});
}

bool convergence::stop(label n, scalar residualNorm)
{
    countIterations(n - result_.nIterations);
    result_.nIterations = n;
    result_.finalResidual = residualNorm / result_.normFactor;
    if (!std::isfinite(residualNorm))
    {
        fail(solverStatus::notFinite);
        return true;
    }
    result_.converged = residualNorm <= target_;
    result_.status = result_.converged ? solverStatus::converged : solverStatus::maxIter;
    return result_.converged || n >= maxIter_;
}

}  // namespace ispf
