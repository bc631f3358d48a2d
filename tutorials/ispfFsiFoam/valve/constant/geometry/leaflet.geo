// 2 mm thick, slanted downstream from the wall to a round end; its middle is 2.1 mm from the plane in the middle of the channel
SetFactory("OpenCASCADE");
x = 12; y = 11; length = 14.2; angle = -38.66*Pi/180; half = 1;
Rectangle(1) = {x, y - half, 0, length, 2*half};
Disk(2) = {x + length, y, 0, half};
BooleanUnion(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Rotate {{0, 0, 1}, {x, y, 0}, angle} { Surface{3}; }
Rectangle(4) = {0, 0, 0, 40, 10};
BooleanIntersection(5) = { Surface{3}; Delete; }{ Surface{4}; Delete; };
Extrude {0, 0, 1} { Surface{5}; }
