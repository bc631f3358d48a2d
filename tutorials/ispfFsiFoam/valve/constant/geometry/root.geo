// The part of the leaflet beyond the wall, 2 mm deep
SetFactory("OpenCASCADE");
x = 9.5; y = 13; length = 10; angle = -38.66*Pi/180; half = 1;
Rectangle(1) = {x, y - half, 0, length, 2*half};
Rotate {{0, 0, 1}, {x, y, 0}, angle} { Surface{1}; }
Rectangle(2) = {0, 10, 0, 40, 2};
BooleanIntersection(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Extrude {0, 0, 1} { Surface{3}; }
