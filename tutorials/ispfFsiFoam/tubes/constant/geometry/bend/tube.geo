// A bent tube between straight legs, with open ends [mm]
SetFactory("OpenCASCADE");
R0 = 4; L0 = 20;        // radius, leg along z
Rb = 12; angle = 90;    // radius of the axis, degrees
L1 = 20;                // leg after the bend
a = angle*Pi/180;
Disk(1) = {0, 0, -L0, R0};
leg() = Extrude { 0, 0, L0 } { Surface{1}; };
arc() = Extrude { {0, 1, 0}, {Rb, 0, 0}, a } { Surface{leg(0)}; };
behind() = Extrude { L1*Sin(a), 0, L1*Cos(a) } { Surface{arc(0)}; };
// the end, and what divides the tube
Delete { Volume{:}; }
Delete { Surface{1, leg(0), arc(0), behind(0)}; }
