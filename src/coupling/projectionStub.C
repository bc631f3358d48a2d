#include "couplingScheme.H"
namespace ispf { std::unique_ptr<couplingScheme> newProjection(fsiCase&) { throw fatalError("coupling projection: not there yet"); } }
