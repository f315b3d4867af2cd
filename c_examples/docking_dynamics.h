/* Two vehicles, a soft-capture ring on a six-axis attenuation, three latches: the executive's own dynamics.
 * The contact engine knows nothing of this file: it is given states and returns wrenches. */
#ifndef DOCKING_DYNAMICS_H
#define DOCKING_DYNAMICS_H

#include "docking_math.h"

enum { LATCHES = 3 };

/* A wrench about the origin of the body part it acts on, along the axes of the common frame. */
typedef struct { vec3 force, moment; } wrench;

/* State of a body part in the common frame. */
typedef struct { vec3 position; quat orientation; vec3 velocity, rate; } motion;

/* A vehicle: its axes are those of its docking port, which lies on its z axis. */
typedef struct {
    double mass;     /* kg */
    double inertia_xy, inertia_z; /* about the mass centre, kg m2 */
    double port;     /* distance of the port ahead of the mass centre along its own z, m */
    motion centre;   /* of the mass centre */
} vehicle;

/* Springs and dampers of the attenuation, on each axis of the ring against its vehicle. */
typedef struct {
    double axial_k, axial_c;       /* N/m, N s/m */
    double lateral_k, lateral_c;
    double turning_k, turning_c;   /* N m/rad, N m s/rad; the same for pitch, yaw and roll */
} attenuation;

typedef struct {
    vec3 place;      /* of the extended latch in the ring's frame, m */
    quat turn;       /* latch frame to ring frame; the latch slides along its own x */
    vec3 slide;      /* that axis in the ring's frame */
    double travel;   /* m: 0 extended, negative retracted */
    double speed;    /* of the latch in the common frame along its slide, m/s */
} latch;

typedef struct {
    /* what does not change */
    double ring_mass;                       /* kg, without the latches */
    double ring_inertia_xy, ring_inertia_z; /* kg m2, about the ring's origin */
    double ring_extension;                  /* of the ring ahead of its vehicle's port, m */
    double latch_mass, latch_preload, latch_k, latch_c; /* kg, N, N/m, N s/m */
    double stop_k, stop_c;                  /* of a latch's stop, N/m, N s/m */
    int latches_locked;                     /* 1: held retracted */
    attenuation capture, settle;            /* before and after soft capture */
    double settle_ramp;                     /* time over which the one becomes the other, s */

    /* state */
    vehicle chaser, target;
    motion ring;
    latch latches[LATCHES];
    double settling;                        /* 0 capture … 1 settle */
    int captured;                           /* set by the executive when all latches hold */

    /* energy account since the start, J */
    double lost;                            /* in dampers and stops */
    double actuator_work;                   /* put in while the attenuation stiffens */
    double contact_work;                    /* done by contact on all bodies */
    double attenuation_force;               /* last force between ring and vehicle, N */
    double attenuation_moment;              /* N m */
} docking;

/* Everything that contact does in one frame. */
typedef struct {
    wrench vehicle, ring, latch[LATCHES], target;
} contact_wrenches;

/* The vehicles and the ring with the values that the model's README states; positions come with place_chaser(). */
void docking_defaults(docking *d);

/* Tells where a latch sits in the ring's frame. */
void place_latch(docking *d, int index, vec3 place, quat turn);

/* Target at rest with its port at the common origin, looking along -z; chaser before it: the ring's face at
 * `offset` with the rotation `tilt` (a rotation vector), its centre moving with `velocity` and turning with `rate`. */
void place_chaser(docking *d, vec3 offset, vec3 tilt, vec3 velocity, vec3 rate);

motion chaser_port(const docking *d);
motion target_port(const docking *d);
motion latch_motion(const docking *d, int index);

/* One semi-implicit Euler step: all velocities from the present forces, then all positions from the new velocities. */
void docking_step(docking *d, const contact_wrenches *contact, double dt);

double kinetic_energy(const docking *d);
double spring_energy(const docking *d);

/* The ring's face and the vehicles against each other. */
typedef struct {
    double gap;            /* between the two ring faces along the target's axis, m */
    double lateral, tilt, roll; /* of the ring against the target's port, m and rad */
    double stroke;         /* compression of the attenuation, m */
    double closing;        /* rate of the chaser's port towards the target's, m/s */
    double drift;          /* speed of the chaser's port against the target's, m/s */
    double turning;        /* angular rate of the two vehicles against each other, rad/s */
    double vehicle_tilt;   /* between the two vehicles' axes, rad */
} alignment;

alignment align(const docking *d);

#endif
