// SPDX-License-Identifier: GPL-3.0-or-later
#include "structureModel.H"
#include "largestEigenvalue.H"

namespace ispf
{

namespace
{

structureReference checked(const structureReference& ref)
{
    ref.check();
    return ref;
}

}  // namespace

structureModel::structureModel(const structureReference& ref) : ref_(checked(ref)), gradient_(ref_)
{
}

scalar structureModel::stableTimeStep(const List<vec4>& x, scalar mass) const
{
    blockMatrix3 K = tangentPattern();
    assembleTangent(x, tangentKind::positive, K);
    return 2 / std::sqrt(largestEigenvalue(K) / mass);
}

}  // namespace ispf
