/************************************************************************
PURPOSE: (Contact between bodies of a simulation, computed by Pong.)
LIBRARY DEPENDENCIES: ((pong/src/PongContact.cpp))
************************************************************************/
#ifndef PONG_CONTACT_HH
#define PONG_CONTACT_HH

#include <string>

/* Pong's own headers stay out of this file: Trick's generators see plain numbers and this name. */
struct PongContactWorld;

/* One movable group: the state of a body goes in, the wrench on it comes out. */
class PongPort {
  public:
    PongPort();

    std::string object;         /* (--)    Name of the Object; ports of one Object share its model */
    std::string model;          /* (--)    Model file, below PongContact::models */
    std::string group;          /* (--)    Path of the movable group in the model; empty for the root */

    double position[3];         /* (m)     Group origin in the common frame */
    double orientation[4];      /* (--)    Quaternion w x y z, Hamilton: group components to common components */
    double linear_velocity[3];  /* (m/s)   Of the group origin, common axes */
    double angular_velocity[3]; /* (rad/s) Common axes */

    double force[3];            /* (N)     On the group, common axes */
    double moment[3];           /* (N*m)   On the group about its origin, common axes */
};

#define PONG_PORTS_MAX 16
#define PONG_PAIRS_MAX 16
#define PONG_STATE_NUMBERS 13
#define PONG_WRENCH_NUMBERS 6

/* Owner of a world. Trick's Python interface assigns members of simulation objects as a whole; an assignment does not
 * copy the world, which the owner keeps for itself. */
class PongContactOwner {
  public:
    PongContactOwner() : world(0) {}
    PongContactOwner(const PongContactOwner &) : world(0) {}
    PongContactOwner &operator=(const PongContactOwner &) { return *this; }
    ~PongContactOwner() { destroy(); }

    void destroy();

    PongContactWorld *world;    /* ** (--) Not part of a checkpoint: the restart job builds it again */
};

class PongContact {
  public:
    PongContact();

    /* Jobs: which job class each belongs to is in SIM_berthing/S_define. */
    int initialize();
    int evaluate();
    int commit();
    int checkpoint();
    int restart();
    int freeze();
    int unfreeze();
    int shutdown();

    /* For input files and initialization jobs. */
    int add_port(const std::string &object, const std::string &model, const std::string &group);
    int add_pair(const std::string &first, const std::string &second);

    std::string models;                /* (--) Folder of the model files */
    PongPort ports[PONG_PORTS_MAX];    /* (--) The first port_count are used */
    int port_count;                    /* (--) Number of ports */
    std::string first[PONG_PAIRS_MAX]; /* (--) Objects that may touch: the one named first in each pair */
    std::string second[PONG_PAIRS_MAX];/* (--) Objects that may touch: the other one */
    int pair_count;                    /* (--) Number of pairs */
    unsigned int workers;              /* (--) Threads beside the calling one; 0 by default */
    unsigned int fifo_priority;        /* (--) Of the workers, 1 to 99; 0 does not ask */

    unsigned int contacts;             /* (--) Contacts of the last evaluation */
    unsigned int flags;                /* (--) What the last evaluation had to leave out: PONG_FLAG_... of pong.h */
    unsigned int flagged_frames;       /* (--) Commits whose frame had a flag */

    int committed;                     /* (--) 1 once a frame is committed */
    double committed_state[PONG_PORTS_MAX][PONG_STATE_NUMBERS];   /* (--) States of the last commit */
    double committed_wrench[PONG_PORTS_MAX][PONG_WRENCH_NUMBERS]; /* (--) Wrenches of the last commit */
    unsigned char *contact_state;      /* (--) What Pong remembers, written by the checkpoint job */
    unsigned int contact_state_bytes;  /* (--) Size of contact_state */

  private:
    PongContactOwner owner;            /* ** (--) Of the world */

    void build();
    void send_states();
    void fetch_wrenches();
    bool at_committed_states() const;
};

#endif
