// 28 mm long, 8 mm high
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 28, 8};
Extrude {0, 0, 1} { Surface{1}; }
