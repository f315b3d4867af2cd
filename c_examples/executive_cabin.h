/* The slow world: a tool that floats in the cabin of the chaser, at 100 Hz. */
#ifndef EXECUTIVE_CABIN_H
#define EXECUTIVE_CABIN_H

#include "docking_dynamics.h"
#include "pong.h"

#define CABIN_FRAME_S 0.01

typedef struct {
    pong_world *world;
    pong_interface_id parts[2]; /* cabin, tool */
    motion tool;
    double tool_mass, tool_inertia; /* kg, kg m2 */
    wrench on_cabin;            /* about the chaser's mass centre, common axes */
} cabin;

void open_cabin(cabin *c);

/* The tool in the middle of the cabin, which moves as the chaser's mass centre does. */
void place_tool(cabin *c, const motion *chaser);

/* One frame: where the cabin is now, contact, and the tool a frame further. */
void cabin_frame(cabin *c, const motion *chaser);

#endif
