// joints.h - where joints hold their bodies, and how far they may go.
#ifndef FE_DRAW_JOINTS_H
#define FE_DRAW_JOINTS_H
#include "draw/drawing.h"

void fe__draw_joint_lines(const fe__drawing *drawing, fe__pen *pen); // anchors and frames
void fe__draw_joint_forces(const fe__drawing *drawing, fe__pen *pen);
void fe__draw_joint_limits(const fe__drawing *drawing, fe__pen *pen);
void fe__draw_joint_points(const fe__drawing *drawing, fe__pen *pen);

#endif
