// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the hemisphere-capped cylinder benchmark and writes it as IGES.  Needs OpenCASCADE, which the
// solver and its utilities do not need.  Usage: writeIges A|B arc|ellipse file.igs
//
// Axis z, base plane of the elastic chamber at z = 0, lengths in mm.  Four solids of revolution
// that touch without gap, as BRep solids (IGES entity 186):
//
//     wall     the elastic chamber                          red
//     flange   the part of it that is clamped               dark grey
//     chamber  fluid: lumen, nozzle bore, syringe           blue; plunger face orange
//     buffer   fluid around the chamber                     light blue; open faces green
//
// The space outside of all four is rigid: syringe, nozzle, base plate.  Every CAD program keeps
// colours; generateParticles selects zones and patches by them.
//
// S: stated in the paper, D: deduced from its numbers, A: assumed.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BSplineCurve.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Ax1.hxx>

#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

struct dimensions
{
    double innerRadius = 10;      // S
    double wall = 2;              // S  of the cylinder and at the dome's foot
    double tipWall = 3;           // S  at the tip of the dome
    double length = 20;           // D  of the cylinder: A 17.3, B 20
    double nozzleTip = 7.5;       // A  above the base: A 0 (flush), B 7.5
    double nozzleBore = 5;        // A  radius: A 6, B 5
    double nozzleOuter = 6;       // A  radius; B only
    double nozzleDepth = 5;       // A  straight bore below the base, then a step to the syringe
    double syringeRadius = 8;     // S
    double syringeLength = 17.4;  // D  from the step to the plunger at bottom dead centre
    // The volume is deduced (the particles that remain when the wall is subtracted).  The shape is
    // assumed: a ring as thick as the wall that extends inward under the wall, because only there it
    // can hold the wall
    double flangeThickness = 2;  // A
    double flangeRadius = 14.3;  // D  654 mm3
    double bufferRadius = 15;    // D
    double bufferHeight = 35;    // D
};

dimensions variant(const std::string& name)
{
    dimensions d;
    if (name == "B") return d;
    if (name != "A") throw std::runtime_error("variant " + name + " is not known; valid: A B");
    d.length = 17.3;         // D  the stated lumen of 7.53 ml, nothing inside
    d.nozzleTip = 0;         // A  flush
    d.nozzleBore = 6;        // A
    d.syringeLength = 19.5;  // D
    d.flangeRadius = 16.2;   // D  1021 mm3
    d.bufferHeight = 33.2;   // D
    return d;
}

// The nozzle with another bore and the same thickness: the paper does not state its width
void changeBore(dimensions& d, double diameter)
{
    const double thickness = d.nozzleOuter - d.nozzleBore;
    d.nozzleBore = diameter / 2;
    d.nozzleOuter = d.nozzleBore + thickness;
    if (d.nozzleBore <= 0 || d.nozzleBore > d.syringeRadius ||
        (d.nozzleTip > 0 && d.nozzleOuter >= d.innerRadius))
        throw std::runtime_error("a bore of " + std::to_string(diameter) + " mm does not fit");
}

// A closed outline in the half-plane of radius and height, edge by edge
class outline
{
public:
    outline(double r, double z) : start_(r, 0, z), at_(start_) {}

    // role: colour of the face that the edge sweeps, if it is not that of the solid
    outline& line(double r, double z, const std::string& role = "")
    {
        const gp_Pnt to(r, 0, z);
        return add(BRepBuilderAPI_MakeEdge(at_, to), to, role);
    }
    // Adds a conic from the present end to the given end.  Its end tangents meet at `tangents`: an exact
    // rational quadratic.  Middle weight: the cosine of half the angle, also for a squeezed circle
    outline& conic(const gp_Pnt& tangents, double r, double z, double weight)
    {
        const gp_Pnt to(r, 0, z);
        TColgp_Array1OfPnt poles(1, 3);
        poles(1) = at_, poles(2) = tangents, poles(3) = to;
        TColStd_Array1OfReal weights(1, 3), knots(1, 2);
        weights(1) = weights(3) = 1, weights(2) = weight;
        knots(1) = 0, knots(2) = 1;
        TColStd_Array1OfInteger multiplicity(1, 2);
        multiplicity(1) = multiplicity(2) = 3;
        Handle(Geom_BSplineCurve) curve =
            new Geom_BSplineCurve(poles, weights, knots, multiplicity, 2);
        return add(BRepBuilderAPI_MakeEdge(curve), to, "");
    }
    outline& close(const std::string& role = "") { return line(start_.X(), start_.Z(), role); }

    struct solid
    {
        TopoDS_Shape shape;
        // roles of the faces through these points
        std::vector<std::pair<gp_Pnt, std::string>> roles;
    };
    solid revolve() const
    {
        BRepBuilderAPI_MakeWire wire;
        for (const TopoDS_Edge& edge : edges_) wire.Add(edge);
        const gp_Ax1 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
        BRepPrimAPI_MakeRevol turn(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), axis);
        return {turn.Shape(), roles_};
    }

private:
    outline& add(const TopoDS_Edge& edge, const gp_Pnt& to, const std::string& role)
    {
        edges_.push_back(edge);
        if (!role.empty()) roles_.push_back({gp_Pnt(0.5 * (at_.XYZ() + to.XYZ())), role});
        at_ = to;
        return *this;
    }
    gp_Pnt start_, at_;
    std::vector<TopoDS_Edge> edges_;
    std::vector<std::pair<gp_Pnt, std::string>> roles_;
};

// The dome's outer outline as a conic: the point where its end tangents meet, and its middle weight
struct dome
{
    gp_Pnt tangents;
    double weight;
};

dome outerDome(const dimensions& d, const std::string& shape)
{
    const double r = d.innerRadius + d.wall, tip = d.innerRadius + d.tipWall, top = d.length + tip;
    if (shape == "ellipse") return {gp_Pnt(r, 0, top), std::sqrt(0.5)};  // A  half axes 12 and 13
    if (shape != "arc")
        throw std::runtime_error("dome " + shape + " is not known; valid: arc ellipse");
    // A  circle through foot and tip, centre on the axis
    const double radius = (r * r + tip * tip) / (2 * tip);
    const double angle = M_PI / 2 + std::asin((tip - radius) / radius);
    return {gp_Pnt(radius * std::tan(angle / 2), 0, top), std::cos(angle / 2)};
}

outline::solid wall(const dimensions& d, const dome& outer)
{
    const double r = d.innerRadius, L = d.length;
    return outline(r, 0)
        .line(r + d.wall, 0)
        .line(r + d.wall, L)
        .conic(outer.tangents, 0, L + r + d.tipWall, outer.weight)
        .line(0, L + r)
        .conic(gp_Pnt(r, 0, L + r), r, L, std::sqrt(0.5))
        .close()
        .revolve();
}

outline::solid flange(const dimensions& d)
{
    return outline(d.innerRadius, -d.flangeThickness)
        .line(d.flangeRadius, -d.flangeThickness)
        .line(d.flangeRadius, 0)
        .line(d.innerRadius + d.wall, 0)  // the face of the wall's foot ends here
        .line(d.innerRadius, 0)
        .close()
        .revolve();
}

outline::solid chamber(const dimensions& d)
{
    const double r = d.innerRadius, L = d.length, plunger = -d.nozzleDepth - d.syringeLength;
    outline o(0, plunger);
    o.line(d.syringeRadius, plunger, "plunger");
    if (d.nozzleBore != d.syringeRadius)
        o.line(d.syringeRadius, -d.nozzleDepth).line(d.nozzleBore, -d.nozzleDepth);
    o.line(d.nozzleBore, d.nozzleTip);
    if (d.nozzleTip > 0) o.line(d.nozzleOuter, d.nozzleTip).line(d.nozzleOuter, 0);
    return o.line(r, 0)
        .line(r, L)
        .conic(gp_Pnt(r, 0, L + r), 0, L + r, std::sqrt(0.5))
        .close()
        .revolve();
}

outline::solid buffer(const dimensions& d, const dome& outer)
{
    const double r = d.innerRadius + d.wall, top = d.length + d.innerRadius + d.tipWall;
    outline o(r, 0);
    if (d.flangeRadius < d.bufferRadius) o.line(d.flangeRadius, 0);  // flange, then base plate
    return o.line(d.bufferRadius, 0)
        .line(d.bufferRadius, d.bufferHeight, "open")
        .line(0, d.bufferHeight, "open")
        .line(0, top)
        .conic(outer.tangents, r, d.length, outer.weight)
        .close()
        .revolve();
}

// Percentages that IGES keeps exactly
Quantity_Color colourOf(const std::string& role)
{
    const auto rgb = [](double r, double g, double b) {
        return Quantity_Color(r / 255, g / 255, b / 255, Quantity_TOC_sRGB);
    };
    if (role == "wall") return rgb(204, 0, 0);
    if (role == "flange") return rgb(102, 102, 102);
    if (role == "chamber") return rgb(0, 102, 204);
    if (role == "plunger") return rgb(255, 153, 0);
    if (role == "buffer") return rgb(153, 204, 255);
    return rgb(0, 153, 51);  // open
}

void add(const Handle(TDocStd_Document) & document, const outline::solid& s,
         const std::string& name)
{
    const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    const auto colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
    const TDF_Label top = shapes->AddShape(s.shape, false);
    const auto colour = [&](const TopoDS_Shape& face, const std::string& role) {
        colours->SetColor(shapes->AddSubShape(top, face), colourOf(role), XCAFDoc_ColorSurf);
    };
    for (TopExp_Explorer at(s.shape, TopAbs_FACE); at.More(); at.Next())
    {
        std::string role = name;
        for (const auto& [point, own] : s.roles)
            if (BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(point), at.Current()).Value() <
                1e-6)
                role = own;
        colour(at.Current(), role);
    }
    GProp_GProps mass;
    BRepGProp::VolumeProperties(s.shape, mass, 1e-10);
    std::cout << name << " " << mass.Mass() << " mm3\n";
}

// Sets author and time, so that the bytes are always the same
void scrub(const Handle(IGESData_IGESModel) & model, const std::string& name)
{
    const auto text = [](const char* s) { return new TCollection_HAsciiString(s); };
    IGESData_GlobalSection global = model->GlobalSection();
    global.SetSendName(text(name.c_str()));
    global.SetFileName(text(name.c_str()));
    global.SetDate(text("20000101.000000"));
    global.SetLastChangeDate(text("20000101.000000"));
    global.SetAuthorName(text("ispf"));
    global.SetCompanyName(text(""));
    model->SetGlobalSection(global);
}

int main(int argc, char** argv)
try
{
    if (argc != 4 && argc != 5)
        throw std::runtime_error("usage: writeIges A|B arc|ellipse file.igs [bore]");
    dimensions d = variant(argv[1]);
    if (argc == 5) changeBore(d, std::stod(argv[4]));
    const dome outer = outerDome(d, argv[2]);
    std::cout.precision(10);

    Handle(TDocStd_Document) document;
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
    add(document, wall(d, outer), "wall");
    add(document, flange(d), "flange");
    add(document, chamber(d), "chamber");
    add(document, buffer(d, outer), "buffer");

    IGESControl_Controller::Init();
    Interface_Static::SetIVal("write.iges.brep.mode", 1);
    IGESCAFControl_Writer writer;
    writer.SetColorMode(true);
    writer.SetNameMode(false);
    if (!writer.Transfer(document))
        throw std::runtime_error("OpenCASCADE could not convert to IGES");
    const std::string path = argv[3];
    scrub(writer.Model(), path.substr(path.find_last_of('/') + 1));
    if (!writer.Write(path.c_str())) throw std::runtime_error("cannot write " + path);
    return 0;
}
catch (const std::exception& error)
{
    std::cerr << "writeIges: " << error.what() << "\n";
    return 1;
}
