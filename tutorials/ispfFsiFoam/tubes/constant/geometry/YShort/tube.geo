// A branching tube with open ends; lengths of the axes from the point where they meet [mm]
SetFactory("OpenCASCADE");
R0 = 4; L0 = 20;
R1 = 4; L1 = 30;        // the short branch
R2 = 4; L2 = 45;        // the long branch
angle = 30;             // of each branch to the tube, degrees
a = angle*Pi/180;
Cylinder(1) = {0, 0, -L0, 0, 0, L0, R0};
Cylinder(2) = {0, 0, 0, L1*Sin(a), 0, L1*Cos(a), R1};
Cylinder(3) = {0, 0, 0, -L2*Sin(a), 0, L2*Cos(a), R2};
Sphere(4) = {0, 0, 0, R0};
BooleanUnion { Volume{1}; Delete; } { Volume{2:4}; Delete; }
e = R0/100;
ends() = Surface In BoundingBox {-R0-e, -R0-e, -L0-e, R0+e, R0+e, -L0+e};
ends() += Surface In BoundingBox {L1*Sin(a)-R1*Cos(a)-e, -R1-e, L1*Cos(a)-R1*Sin(a)-e,
                                  L1*Sin(a)+R1*Cos(a)+e, R1+e, L1*Cos(a)+R1*Sin(a)+e};
ends() += Surface In BoundingBox {-L2*Sin(a)-R2*Cos(a)-e, -R2-e, L2*Cos(a)-R2*Sin(a)-e,
                                  -L2*Sin(a)+R2*Cos(a)+e, R2+e, L2*Cos(a)+R2*Sin(a)+e};
Delete { Volume{:}; }
Delete { Surface{ends()}; }
