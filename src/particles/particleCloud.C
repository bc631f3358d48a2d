// SPDX-License-Identifier: GPL-3.0-or-later
#include "particleCloud.H"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ispf
{

label particleCloud::zoneIndex(const word& name, const fileLocation& where) const
{
    List<word> names;
    for (size_t z = 0; z < zones.size(); ++z)
    {
        if (zones[z].name == name) return label(z);
        names.push_back(zones[z].name);
    }
    throw fatalError(
        "Unknown zone '" + name + "'." + didYouMean(name, names) + "\n" + validWords("zone", names),
        where);
}

// Visits all owned fields, so that sorting, deleting and adding treat each in the same way
template <class Visit>
void particleCloud::forAllFields(Visit&& visit)
{
    visit(x), visit(Up), visit(zone), visit(phase), visit(id), visit(uFixed), visit(pFixed);
    visit(pGiven);
    for (auto& [name, field] : scalars) visit(field);
    for (auto& [name, field] : vectors) visit(field);
    for (auto& [name, field] : integers) visit(field);
}

void particleCloud::append(const vector& position, std::uint8_t zoneIndex, const vec4& up,
                           globalId number)
{
    clearGhosts();
    const zoneInfo& z = zones.at(zoneIndex);
    if (z.phase == phaseType::solid)
    {
        if (n_ > nSolid_)
            throw fatalError("Solid particle " + std::to_string(number) +
                             " follows a fluid one; solids must come first");
        ++nSolid_;
    }
    ++n_;
    forAllFields([&](auto& field) { field.resize(n_); });
    const label i = n_ - 1;
    x[i] = vec4::from(position), Up[i] = up, zone[i] = zoneIndex, phase[i] = z.phase;
    id[i] = number, uFixed[i] = z.fixed, pFixed[i] = 0, pGiven[i] = 0;
    for (auto& [name, field] : scalars) field[i] = 0;
    for (auto& [name, field] : vectors) field[i] = vec4{};
    for (auto& [name, field] : integers) field[i] = 0;
    nextId_ = std::max(nextId_, number + 1);
}

void particleCloud::remove(const List<char>& flag)
{
    clearGhosts();
    forAllFields([&](auto& field) {
        label to = nSolid_;
        for (label i = nSolid_; i < n_; ++i)
            if (!flag[i]) field[to++] = field[i];
        field.resize(to);
    });
    n_ = label(x.size());
}

void particleCloud::sortFluid(scalar cellSize)
{
    clearGhosts();
    const label nFluid = n_ - nSolid_;
    if (nFluid < 2) return;
    vector low = x[nSolid_].xyz(), high = low;
    for (label i = nSolid_; i < n_; ++i)
        low = low.cwiseMin(x[i].xyz()), high = high.cwiseMax(x[i].xyz());
    const auto cell = [&](label i, int d) { return std::int64_t((x[i][d] - low[d]) / cellSize); };
    const std::int64_t nx = std::int64_t((high[0] - low[0]) / cellSize) + 1;
    const std::int64_t ny = std::int64_t((high[1] - low[1]) / cellSize) + 1;
    List<std::int64_t> key(n_);
    for (label i = nSolid_; i < n_; ++i) key[i] = (cell(i, 2) * ny + cell(i, 1)) * nx + cell(i, 0);
    List<label> order(nFluid);
    std::iota(order.begin(), order.end(), nSolid_);
    std::stable_sort(order.begin(), order.end(), [&](label a, label b) { return key[a] < key[b]; });
    forAllFields([&](auto& field) {
        const auto old = field;
        for (label k = 0; k < nFluid; ++k) field[nSolid_ + k] = old[order[k]];
    });
}

void particleCloud::clearGhosts()
{
    x.resize(n_), Up.resize(n_), phase.resize(n_);
    owner_.clear(), rule_.clear(), offset_.clear(), depth_.clear();
    wallScale_.clear(), ownImage_.clear(), solidView_.clear();
    volume_.clear(), stretched_ = false;
    rules_.clear(), surface.clear();
}

label particleCloud::addRule(const Eigen::Matrix4d& M, const tensor& R)
{
    rules_.push_back({M, R});
    return label(rules_.size()) - 1;
}

void particleCloud::addImage(label source, label rule, const vector& position, const vec4& b)
{
    x.push_back(vec4::from(position)), Up.push_back(vec4{});
    phase.push_back(phase[source]);
    owner_.push_back({.index = source}), rule_.push_back(rule), offset_.push_back(b);
    depth_.push_back(vec4{}), volume_.push_back(1);
}

void particleCloud::addMirror(const imageSource& source, const vector& position, const vec4& b)
{
    addImage(source.particle, source.rule, position, b);
    volume_.back() = source.volume;
    phase.back() = phaseType::mirror;
    stretched_ = stretched_ || source.volume != 1;
}

void particleCloud::addRigid(const vector& position, const vector& velocity)
{
    x.push_back(vec4::from(position)), Up.push_back(vec4::from(velocity));
    phase.push_back(phaseType::rigid);
    owner_.push_back({}), rule_.push_back(0), offset_.push_back(vec4::from(velocity));
    depth_.push_back(vec4{}), volume_.push_back(1);
}

void particleCloud::addRigid(const vector& position, const vector& velocity, const vector& foot)
{
    addRigid(position, velocity);
    const scalar depth = (foot - position).norm();
    if (depth > 0) depth_.back() = vec4::from((foot - position) / depth, depth);
}

tensor particleCloud::freeDirections() const
{
    tensor turned = tensor::Zero();
    label last = -1;
    for (label g = n_; g < nAll(); ++g)
    {
        if (ghostSource(g) < 0 || phase[g] == phaseType::mirror || ruleIndex(g) == last) continue;
        last = ruleIndex(g);
        const tensor d = ruleOf(g).R - tensor::Identity();
        turned += d.transpose() * d;
    }
    const Eigen::SelfAdjointEigenSolver<tensor> e(turned);
    tensor free = tensor::Zero();
    for (int k = 0; k < 3; ++k)
        if (e.eigenvalues()[k] < 1e-12)
            free += e.eigenvectors().col(k) * e.eigenvectors().col(k).transpose();
    return free;
}

bool particleCloud::hasRigid() const
{
    return std::any_of(owner_.begin(), owner_.end(),
                       [](const ghostOwner& o) { return o.index < 0; });
}

// Fills the ghosts of f with image(g, rule, value of the owner), or with rigid(g) if g has no owner
template <class Image, class Rigid>
void particleCloud::fill(List<vec4>& f, const Image& image, const Rigid& rigid) const
{
    f.resize(x.size());
    forEach(0, nGhosts(), [&](label g) {
        const label source = owner_[g].index;
        f[n_ + g].s = source < 0 ? rigid(g) : image(g, rules_[rule_[g]], f[source].s);
    });
}

// M s
static simd4 product(const ghostRule& rule, const simd4& s)
{
    const scalar* M = rule.M.data();  // column-major
    simd4 sum = {};
    for (int c = 0; c < 4; ++c)
        sum += s[c] * simd4{M[4 * c], M[4 * c + 1], M[4 * c + 2], M[4 * c + 3]};
    return sum;
}

void particleCloud::fillGhosts(List<vec4>& f, bool homogeneous) const
{
    const auto b = [&](label g) { return homogeneous ? simd4{} : offset_[g].s; };
    fill(
        f, [&](label g, const ghostRule& rule, const simd4& s) { return b(g) + product(rule, s); },
        b);
}

void particleCloud::fillGradientGhosts(List<vec4>& f) const
{
    const auto image = [](label, const ghostRule& rule, const simd4& s) {
        return vec4::from(rule.R * vector(s[0], s[1], s[2]), rule.M(3, 3) * s[3]).s;
    };
    fill(f, image, [](label) { return simd4{}; });
}

scalar particleCloud::maxSpeed() const
{
    const scalar most = maxOf(n(), [&](label begin, label end) {
        scalar m = 0;
        for (label i = begin; i < end; ++i) m = std::max(m, Up[i].xyz().squaredNorm());
        return m;
    });
    return std::sqrt(std::max(most, 0.0));
}

word particleCloud::describe(label i) const
{
    return "particle " + std::to_string(id[i]) + " (zone " + zones[zone[i]].name + ") at (" +
           str(x[i][0]) + " " + str(x[i][1]) + " " + str(x[i][2]) + ")";
}

void particleCloud::checkFinite(scalar time) const
{
    for (label i = 0; i < n_; ++i)
    {
        scalar sum = 0;
        for (int k = 0; k < 4; ++k) sum += x[i][k] + Up[i][k];
        if (!std::isfinite(sum))
            throw fatalError("Time " + str(time) + " s: " + describe(i) + " has U = (" +
                             str(Up[i][0]) + " " + str(Up[i][1]) + " " + str(Up[i][2]) +
                             "), p = " + str(Up[i][3]) +
                             ": the run has become unstable. Reduce deltaT, and see whether a load "
                             "or a motion jumps; the last written time is intact");
    }
}

}  // namespace ispf
