// SPDX-License-Identifier: GPL-3.0-or-later
// A left atrium in short and its appendage [mm]: a vein from the left, the mitral valve below the atrium, the appendage with a
// neck, a body and two lobes on the right; symmetric about the plane y = 0, whose seams stay: gmsh cannot mesh the closed
// surface of the body
SetFactory("OpenCASCADE");
Geometry.OCCUnionUnify = 0;
Sphere(1) = {0, 0, 0, 20};                              // atrium
Cylinder(2) = {-10, 0, 8, -22, 0, 0, 7};                // vein
Cylinder(3) = {0, 0, -10, 0, 0, -18, 11};               // to the mitral valve
Cone(4) = {12, 0, 5, 22, 0, 8, 6, 8};                   // neck, growing wider
Sphere(5) = {34, 0, 13, 8.5};                           // body
Sphere(6) = {42, 0, 22, 6};                             // lobes
Sphere(7) = {43, 0, 6, 5};
whole() = BooleanUnion { Volume{1}; Delete; } { Volume{2:7}; Delete; };
Box(100) = {-100, 0, -100, 200, 100, 200};
half() = BooleanIntersection { Volume{whole()}; Delete; } { Volume{100}; Delete; };
other() = Symmetry {0, 1, 0, 0} { Duplicata { Volume{half()}; } };
BooleanUnion { Volume{half()}; Delete; } { Volume{other()}; Delete; }
