/* The contact engine's side of the docking: the scene, states in, wrenches out; and where a run begins. */
#ifndef DOCKING_SCENE_H
#define DOCKING_SCENE_H

#include "docking_dynamics.h"
#include "pong.h"

#include <stddef.h>

/* Ends the program, with 3, if the engine refuses a call. */
void check(pong_status status, const char *call);

#define CHECK(call) check((call), #call)

enum { VEHICLE, RING, FIRST_LATCH, TARGET = FIRST_LATCH + LATCHES, PARTS };

typedef struct {
    pong_world *world;
    pong_object_id chaser, target;
    pong_interface_id parts[PARTS]; /* where states go in and wrenches come out */
} contact_scene;

pong_state to_state(motion m);
wrench from_wrench(const pong_wrench *w);

/* Loads the models of a folder and makes the world; tells the dynamics where the latches are. */
void open_scene(contact_scene *scene, const pong_config *config, const char *models, docking *d);
void send_states(contact_scene *scene, const docking *d);
contact_wrenches fetch_wrenches(contact_scene *scene);

/* Misalignment and rates of the ring at first contact. */
typedef struct {
    char name[48];
    double speed;            /* closing, m/s */
    double lateral_x, lateral_y, roll, pitch, yaw; /* m and degrees */
    double lateral_rate;     /* away from the axis, m/s */
    double turn_rate;        /* about the same axes as the misalignment and away from alignment, degrees/s */
} docking_case;

docking_case make_case(const char *name, double speed);

enum { CORNERS = 64 };

/* Corners of the standard's box: 2 closing speeds, 4 directions of the lateral 0.10 m, 2 senses of the roll of 4
 * degrees, 4 directions of the tilt of 4 degrees. */
docking_case corner(int index);

/* Finds a case by name; returns 0 if there is none. */
int find_case(const char *name, docking_case *c);

/* The chaser on its line of approach, with the two ring faces `gap` apart. */
void approach(docking *d, const docking_case *c, double gap, int moving);

/* The gap at which the case's first contact comes: evaluating leaves no trace in the engine, so it may be asked. */
double first_contact_gap(contact_scene *scene, docking *d, const docking_case *c);

#endif
