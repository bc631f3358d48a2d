// SPDX-License-Identifier: GPL-3.0-or-later
// An aneurysm on the side of an artery [mm]: the artery along x, the sac above it, the neck rounded; symmetric about the
// plane y = 0, whose seams stay: gmsh cannot mesh the closed surface around the neck
SetFactory("OpenCASCADE");
Geometry.OCCUnionUnify = 0;
R = 2; L = 24;          // artery: radius, length
Rs = 3.5; H = 4.6;      // sac: radius, height of its centre above the artery's axis
neck = 0.8;             // radius of the rounded neck
Cylinder(1) = {-L/2, 0, 0, L, 0, 0, R};
Sphere(2) = {0, 0, H, Rs};
lumen() = BooleanUnion { Volume{1}; Delete; } { Volume{2}; Delete; };
rim() = Curve In BoundingBox {-Rs, -R - 0.1, 0.5, Rs, R + 0.1, R + 0.1};
round() = Fillet { lumen() } { rim() } { neck };
Box(100) = {-L, 0, -L, 2*L, L, 2*L};
half() = BooleanIntersection { Volume{round()}; Delete; } { Volume{100}; Delete; };
other() = Symmetry {0, 1, 0, 0} { Duplicata { Volume{half()}; } };
BooleanUnion { Volume{half()}; Delete; } { Volume{other()}; Delete; }
