// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearSolver.H"

#include "FGMRES.H"
#include "PBiCGStab.H"
#include "PCG.H"
#include "execution.H"
#include "cellMultigrid.H"
#include "choleskySolver.H"
#include "diagonalPreconditioner.H"
#include "incompleteFactor.H"
#include "luSolver.H"
#include <ctime>
#include <ostream>

namespace ispf
{

namespace
{

const List<word> solverWords = {"PCG", "PBiCGStab", "FGMRES", "direct"};
const List<word> preconditionerWords = {"multigrid", "DIC", "DILU", "diagonal", "none"};

// Refuses keys that only another choice of words uses
void refuse(const dictionary& dict, const List<word>& keys, const word& choice)
{
    for (const word& key : keys)
        if (dict.found(key))
            dict.fail(key,
                      "It has no effect with " + choice + ", which does not use it. Leave it away");
}

// CPU time of all threads between calls; reads the clock only if it is on
class cpuLaps
{
public:
    explicit cpuLaps(bool on) : on_(on), last_(on ? std::clock() : 0) {}
    scalar lap()
    {
        if (!on_) return -1;
        const std::clock_t now = std::clock(), before = last_;
        last_ = now;
        return scalar(now - before) / CLOCKS_PER_SEC;
    }

private:
    bool on_;
    std::clock_t last_;
};

bool profiling(const dictionary& dict)
{
    return dict.getOrDefault("profiling", false);
}

class iterativeSolver : public linearSolver
{
public:
    iterativeSolver(const word& fieldName, const word& solver, const dictionary& dict)
        : method_(solver),
          dict_(dict),
          name_(dict.choose("preconditioner", preconditionerWords)),
          controls_(solverControls::fromDict(dict)),
          profiling_(profiling(dict))
    {
        if (solver == "PCG") krylov_ = std::make_unique<PCG>(controls_, fieldName);
        if (solver == "PBiCGStab") krylov_ = std::make_unique<PBiCGStab>(controls_, fieldName);
        if (solver == "FGMRES")
            krylov_ = std::make_unique<FGMRES>(
                controls_, fieldName, dict.getInRangeOrDefault<label>("restart", 1, 1000, 60));
        else refuse(dict, {"restart"}, "solver " + solver);

        if (name_ != "multigrid")
        {
            refuse(dict, {"cycle", "omega", "coarsestSize"}, "preconditioner " + name_);
            return;
        }
        options_.cycle = word(solver == "PBiCGStab" ? "V" : "K");
        options_.read(dict);
        if (solver == "PBiCGStab" && options_.cycle == "K")
            dict.fail("cycle",
                      "the K-cycle differs from one application to the next, which "
                      "PBiCGStab does not bear; use cycle V, or solver FGMRES");
    }

    solverPerformance solve(const linearSystem& system, const List<scalar>& b,
                            List<scalar>& x) override
    {
        if (method_ == "PCG" && !system.symmetric)
            dict_.fail("solver", "the matrix is not symmetric; use PBiCGStab or FGMRES");
        solverControls controls = controls_;
        controls.absTol = std::max(controls.absTol, system.floor);
        krylov_->setControls(controls);
        cpuLaps cpu(profiling_);
        const preconditioner& M = prepare(system);
        const scalar setup = cpu.lap();
        solverPerformance done = iterate(
            system.whole ? *system.whole : static_cast<const linearOperator&>(system.A), M, b, x);
        done.setupCpu = setup, done.solveCpu = cpu.lap();
        return done;
    }

private:
    solverPerformance iterate(const linearOperator& A, const preconditioner& M,
                              const List<scalar>& b, List<scalar>& x)
    {
        if (floating_.empty()) return krylov_->solve(A, M, b, x);
        List<scalar> compatible(b);
        floating_.project(compatible);
        floating_.project(x);
        const solverPerformance done = krylov_->solve(A, M, compatible, x);
        floating_.project(x);
        return done;
    }

    // Builds the preconditioner and finds the floating parts of a symmetric system
    const preconditioner& prepare(const linearSystem& system)
    {
        const csrMatrix& A = system.A;
        floating_ = constantNullSpace();
        if (name_ == "multigrid")
        {
            buildMultigrid(system);
            if (system.symmetric) floating_ = multigrid_->nullSpace();
            return *multigrid_;
        }
        if (system.symmetric) floating_ = constantNullSpace::of(A);
        if (name_ == "DIC" && !system.symmetric)
            dict_.fail("preconditioner", "DIC needs a symmetric matrix; use DILU");
        if (name_ == "diagonal") preconditioner_ = std::make_unique<diagonalPreconditioner>(A);
        else if (name_ == "none") preconditioner_ = std::make_unique<noPreconditioner>();
        else preconditioner_ = std::make_unique<incompleteFactor>(A, name_);
        return *preconditioner_;
    }

    void buildMultigrid(const linearSystem& system)
    {
        if (!system.points)
            dict_.fail("preconditioner",
                       "this system has no points to build a multigrid on; use "
                       "DILU, diagonal or none");
        const List<std::uint8_t> groups = system.groups ? *system.groups : List<std::uint8_t>();
        if (multigrid_ && options_.cellSize == system.cellSize)
            return multigrid_->rebuild(system.A, *system.points, groups);
        options_.cellSize = system.cellSize;
        multigrid_ = std::make_unique<cellMultigrid>(system.A, *system.points, options_, groups);
    }

    word method_;
    dictionary dict_;  // for messages
    word name_;        // name of the preconditioner
    solverControls controls_;
    bool profiling_;
    multigridOptions options_;
    std::unique_ptr<cellMultigrid> multigrid_;
    std::unique_ptr<preconditioner> preconditioner_;
    constantNullSpace floating_;
    std::unique_ptr<krylovSolver> krylov_;
};

class directSolver : public linearSolver
{
public:
    directSolver(const word& fieldName, const dictionary& dict)
        : fieldName_(fieldName), profiling_(profiling(dict))
    {
        refuse(dict,
               {"preconditioner", "tolerance", "relTol", "absTol", "maxIter", "restart", "cycle",
                "omega", "coarsestSize"},
               "solver direct");
    }

    solverPerformance solve(const linearSystem& system, const List<scalar>& b,
                            List<scalar>& x) override
    {
        const constantNullSpace floating =
            system.symmetric ? constantNullSpace::of(system.A) : constantNullSpace();
        List<scalar> right(b), r(b.size());
        floating.project(right);
        residual(system.A, right, x, r);
        solverControls once;
        once.maxIter = 1;
        convergence state(once, word("direct") + (system.symmetric ? "Cholesky" : "LU"), fieldName_,
                          norm(right), norm(r));
        cpuLaps cpu(profiling_);
        if (system.symmetric) cholesky_.factorise(system.A);
        else lu_.factorise(system.A);
        const scalar setup = cpu.lap();
        if (system.whole) return refined(system, floating, right, x);
        if (system.symmetric) cholesky_.apply(right, x);
        else lu_.apply(right, x);
        residual(system.A, right, x, r);
        state.stop(1, norm(r));
        solverPerformance done = state.result();
        done.setupCpu = setup, done.solveCpu = cpu.lap();
        return done;
    }

private:
    // Solves with the factor of A as preconditioner, for an operator without a matrix
    solverPerformance refined(const linearSystem& system, const constantNullSpace& floating,
                              const List<scalar>& right, List<scalar>& x)
    {
        solverControls controls;
        controls.tolerance = 1e-12, controls.maxIter = 200, controls.absTol = system.floor;
        floating.project(x);
        PCG solver(controls, fieldName_);
        const solverPerformance done = solver.solve(*system.whole, cholesky_, right, x);
        floating.project(x);
        return done;
    }

    word fieldName_;
    bool profiling_;
    choleskySolver cholesky_;
    luSolver lu_;
};

}  // namespace

std::unique_ptr<linearSolver> linearSolver::New(const word& fieldName, const dictionary& dict)
{
    const word solver = dict.choose("solver", solverWords);
    if (solver == "direct") return std::make_unique<directSolver>(fieldName, dict);
    return std::make_unique<iterativeSolver>(fieldName, solver, dict);
}

}  // namespace ispf
