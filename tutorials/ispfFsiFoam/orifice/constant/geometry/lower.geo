// The lower plate: 0.4 mm thick, leaning downstream by 45 degrees, its tip 0.4 mm off the axis
SetFactory("OpenCASCADE");
foot = 8; thick = 0.4; tip = 3.6;
side = thick/Sqrt(2);
reach = tip - side;
Point(1) = {foot, 0, 0};
Point(2) = {foot + 2*side, 0, 0};
Point(3) = {foot + 2*side + reach, reach, 0};
Point(4) = {foot + side + reach, tip, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Extrude {0, 0, 1} { Surface{1}; }
