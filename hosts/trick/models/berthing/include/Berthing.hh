/************************************************************************
PURPOSE: (A thruster presses a payload onto a platform that floats.)
LIBRARY DEPENDENCIES:
    ((berthing/src/Berthing.cpp)
     (berthing/src/RigidBody.cpp)
     (pong/src/PongContact.cpp))
************************************************************************/
#ifndef BERTHING_HH
#define BERTHING_HH

#include "berthing/include/RigidBody.hh"
#include "pong/include/PongContact.hh"
#include "trick/regula_falsi.h"

class Berthing {
  public:
    Berthing();

    /* Jobs, in the order of SIM_berthing/S_define. */
    int default_data();
    int initialize();
    int derivatives();
    int integrate();
    double touch();
    int accept();

    RigidBody payload;          /* (--) On three feet */
    RigidBody platform;         /* (--) A slab; its upper face is the plane z = 0 of its group frame */
    PongContact contact;        /* (--) Between them */

    int cut_at_touch;           /* (--) 1: the thruster stops when the first foot touches, which is a dynamic event */
    double touch_time;          /* (s)  Time of that event; negative before it */
    int integrations_back;      /* (--) Steps of the integrator with a negative length, on the search for the event */
    REGULA_FALSI gap;           /* (--) Search for the root of the gap between the feet and the platform */

  private:
    double feet_gap() const;
    void exchange();
};

#endif
