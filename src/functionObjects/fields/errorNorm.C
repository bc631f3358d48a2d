// SPDX-License-Identifier: GPL-3.0-or-later
// Difference of U and p from an exact solution.  This is given as formulas of x y z [m], the time t [s], and the case's
// rho [kg/m^3], mu [Pa s], nu [m^2/s] and dx [m]:
//
//     error
//     {
//         type    errorNorm;
//         U       ("sin(2*pi*y)*exp(-4*pi^2*nu*t)" 0 0);
//         p       "0";
//         mean    free;           // the level of p is not known; default fixed
//         phase   fluid;          // or zones (a b)
//     }
//
//     L2      sqrt(sum V |f - exact|^2 / sum V)
//     max     the largest |f - exact|
//     exact   sqrt(sum V |exact|^2 / sum V), to make the other two relative
#include "functionObject.H"

#include "dataFile.H"
#include "expression.H"
#include "particleFields.H"
#include <cmath>

namespace ispf
{

namespace
{

// Formulas for the exact components of a field
struct exactField
{
    word name;
    List<expression> component;
};

class errorNorm : public functionObject
{
public:
    errorNorm(const word& name, const dictionary& dict, const fsiCase& c)
        : functionObject(name, dict, c),
          exact_(exactFields(dict, c)),
          meanIsFree_(dict.chooseOrDefault("mean", {"fixed", "free"}, "fixed") == "free"),
          chosen_(c.cloud, dict, "fluid"),
          file_(table("errorNorm.dat",
                      {"Differences from the exact fields: root mean square, largest; root mean "
                       "square of the exact field"},
                      titles()))
    {
    }

    void write() override
    {
        file_.begin(case_.time.value());
        for (const exactField& e : exact_) writeNorms(e);
        file_.endRow();
    }

private:
    static List<exactField> exactFields(const dictionary& dict, const fsiCase& c)
    {
        const std::map<word, scalar> constants = {
            {"rho", c.rho}, {"mu", c.mu}, {"nu", c.nu()}, {"dx", c.cloud.dx}};
        List<exactField> all;
        const auto add = [&](const word& field, const List<word>& formulas) {
            all.push_back({field, {}});
            for (const word& text : formulas)
                all.back().component.emplace_back(text, List<word>{"x", "y", "z", "t"}, constants,
                                                  dict.where(field));
        };
        if (dict.found("U"))
        {
            const List<word> formulas = dict.get<List<word>>("U");
            if (formulas.size() != 3)
                dict.fail("U", "U wants three formulas, e.g. (\"sin(2*pi*y)\" 0 0)");
            add("U", formulas);
        }
        if (dict.found("p")) add("p", {dict.get<word>("p")});
        if (all.empty()) dict.fail("type", "errorNorm wants the exact U, p or both, as formulas");
        return all;
    }

    List<word> titles() const
    {
        List<word> all;
        for (const exactField& e : exact_)
            for (const char* what : {"L2", "max", "exact"})
                all.push_back(word(what) + "(" + e.name + ")");
        return all;
    }

    void writeNorms(const exactField& e)
    {
        const particleCloud& cloud = case_.cloud;
        List<vector> difference, exact;
        for (label i = 0; i < cloud.n(); ++i)
        {
            if (!chosen_(cloud, i)) continue;
            const vector x = cloud.x[i].xyz();
            vector known = vector::Zero(), found = known;
            for (size_t k = 0; k < e.component.size(); ++k)
                known[k] = e.component[k]({x[0], x[1], x[2], case_.time.value()});
            if (e.name == "p") found[0] = cloud.Up[i][3];
            else found = cloud.Up[i].xyz();
            difference.push_back(found - known), exact.push_back(known);
        }
        if (e.name == "p" && meanIsFree_) removeMean(difference), removeMean(exact);
        scalar most = 0;
        for (const vector& d : difference) most = std::max(most, d.norm());
        file_ << rootMeanSquare(difference) << most << rootMeanSquare(exact);
    }

    static void removeMean(List<vector>& values)
    {
        vector sum = vector::Zero();
        for (const vector& v : values) sum += v;
        for (vector& v : values) v -= sum / scalar(values.size());
    }

    static scalar rootMeanSquare(const List<vector>& values)  // for particles of equal volume
    {
        scalar sum = 0;
        for (const vector& v : values) sum += v.squaredNorm();
        return std::sqrt(sum / scalar(values.size()));
    }

    List<exactField> exact_;
    bool meanIsFree_;
    particleSelection chosen_;
    dataFile file_;
};

}  // namespace

std::unique_ptr<functionObject> newErrorNorm(const word& name, const dictionary& dict,
                                             const fsiCase& c)
{
    return std::make_unique<errorNorm>(name, dict, c);
}

}  // namespace ispf
