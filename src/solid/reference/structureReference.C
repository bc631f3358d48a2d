// SPDX-License-Identifier: GPL-3.0-or-later
#include "structureReference.H"
#include "messages.H"

namespace ispf
{

namespace
{

bool same(const isometry& a, const isometry& b, scalar length)
{
    return (a.R - b.R).norm() < 1e-9 && (a.t - b.t).norm() < 1e-6 * length;
}

void checkImages(const structureReference& ref)
{
    const label n = label(ref.images.size());
    for (label m = 0; m < n; ++m)
    {
        const isometry& image = ref.images[m];
        const word name = "Image map " + std::to_string(m) + " of the structure ";
        if ((image.R * image.R.transpose() - tensor::Identity()).norm() > 1e-9)
            throw fatalError(name + "is not rigid: R R^T differs from the identity");
        if (same(image, isometry(), ref.dx)) throw fatalError(name + "is the identity");
        bool inverted = false;
        for (label k = 0; k < n; ++k)
        {
            if (k != m && same(image, ref.images[k], ref.dx))
                throw fatalError(name + "is listed twice (again as " + std::to_string(k) + ")");
            inverted = inverted || same(image.inverse(), ref.images[k], ref.dx);
        }
        if (!inverted)
            throw fatalError(name +
                             "has no inverse in the list: forces would not balance. Give both "
                             "directions of a cyclic patch");
    }
}

}  // namespace

List<std::uint16_t> structureReference::inverseImages() const
{
    List<std::uint16_t> inverse(images.size());
    for (size_t m = 0; m < images.size(); ++m)
        for (size_t k = 0; k < images.size(); ++k)
            if (same(images[m].inverse(), images[k], dx)) inverse[m] = std::uint16_t(k);
    return inverse;
}

void structureReference::check() const
{
    if (nDims != 2 && nDims != 3)
        throw fatalError("A structure has 2 or 3 dimensions, not " + std::to_string(nDims));
    if (!(dx > 0 && h > 0 && support > dx && rho > 0))
        throw fatalError(
            "The structure needs dx, h and rho above zero and a support above dx; got dx " +
            str(dx) + " h " + str(h) + " support " + str(support) + " rho " + str(rho));
    if (x0.empty()) throw fatalError("The structure has no particles");
    if (!rest.empty() && rest.size() != x0.size())
        throw fatalError("The structure has " + std::to_string(x0.size()) + " particles, but " +
                         std::to_string(rest.size()) + " places without stress");
    if (!zone.empty() && zone.size() != x0.size())
        throw fatalError("The structure has " + std::to_string(x0.size()) + " particles and " +
                         std::to_string(zone.size()) + " zone numbers");
    if (fixed.size() != x0.size())
        throw fatalError("The structure has " + std::to_string(x0.size()) + " rest positions but " +
                         std::to_string(fixed.size()) + " clamping flags");
    checkImages(*this);
}

}  // namespace ispf
