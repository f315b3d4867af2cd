/************************************************************************
PURPOSE: (A rigid body whose group frame need not be at its mass centre.)
LIBRARY DEPENDENCIES: ((berthing/src/RigidBody.cpp))
************************************************************************/
#ifndef RIGID_BODY_HH
#define RIGID_BODY_HH

#define RIGID_BODY_NUMBERS 12

/* Integrated are the mass centre, its velocity, the rotation vector since the start of the step and the angular
 * momentum. A quaternion integrated by component would leave the unit sphere between stages. */
class RigidBody {
  public:
    RigidBody();

    int initialize();
    void add_wrench(const double force[3], const double moment[3]);
    void derivatives(double out[RIGID_BODY_NUMBERS]) const;
    void get_numbers(double out[RIGID_BODY_NUMBERS]) const;
    void set_numbers(const double in[RIGID_BODY_NUMBERS]);
    void end_step();
    void clear_wrench();

    /* Given by the input file. */
    double mass;                /* (kg)        Mass */
    double inertia[3][3];       /* (kg*m2)     About the mass centre, group axes */
    double mass_center[3];      /* (m)         In the group frame */
    double thrust[3];           /* (N)         At the mass centre, group axes */

    /* Motion of the group frame: given at the start, then computed. */
    double position[3];         /* (m)         Group origin in the common frame */
    double orientation[4];      /* (--)        Quaternion w x y z, Hamilton: group components to common components */
    double linear_velocity[3];  /* (m/s)       Of the group origin, common axes */
    double angular_velocity[3]; /* (rad/s)     Common axes */

    /* State. */
    double center[3];           /* (m)         Mass centre in the common frame */
    double velocity[3];         /* (m/s)       Of the mass centre */
    double momentum[3];         /* (kg*m2/s)   Angular momentum about the mass centre, common axes */
    double attitude[4];         /* (--)        Orientation at the start of the step */
    double turn[3];             /* (rad)       Rotation vector since then, common axes */

    double force[3];            /* (N)         Sum on the body, common axes */
    double moment[3];           /* (N*m)       Sum about the mass centre, common axes */
    double inverse_inertia[3][3]; /* (1/kg/m2) Of inertia */

  private:
    void update_motion();
};

#endif
