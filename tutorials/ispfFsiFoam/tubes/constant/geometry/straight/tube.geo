// A straight tube with open ends [mm]
SetFactory("OpenCASCADE");
R0 = 4; L0 = 40;
Cylinder(1) = {0, 0, -L0, 0, 0, L0, R0};
e = R0/100;
ends() = Surface In BoundingBox {-R0-e, -R0-e, -L0-e, R0+e, R0+e, -L0+e};
ends() += Surface In BoundingBox {-R0-e, -R0-e, -e, R0+e, R0+e, e};
Delete { Volume{1}; }
Delete { Surface{ends()}; }
