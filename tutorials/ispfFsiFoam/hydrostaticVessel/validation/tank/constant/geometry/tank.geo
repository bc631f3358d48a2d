// SPDX-License-Identifier: GPL-3.0-or-later
// A cube of 1 m, turned by odd angles; its face z = 1 m becomes the open one
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Rotate { {0, 0, 1}, {0.5, 0.5, 0.5}, 0.4 } { Volume{1}; }
Rotate { {1, 0, 0}, {0.5, 0.5, 0.5}, 0.3 } { Volume{1}; }
Physical Volume("water") = {1};
Physical Surface("top") = {6};
