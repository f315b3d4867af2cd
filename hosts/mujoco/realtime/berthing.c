/* The berthing at 1 kHz: the arm brings the module, four latches pull it onto the stops, hold it and open,
 * and the standoffs push it off. The sequencer is that of mechanisms/berthing/sequencer.py; its numbers come
 * from its folder (mechanisms/from_c.py).
 *
 *     berthing FOLDER [--fast] [--seconds S] [--lock] [--fifo PRIORITY] [--core N] [--end FILE]
 *
 * Exit code: 0 if no latch moved early, all closed, the rings were pressed together as predicted and the module went off; 1
 * if not, 2 for a wrong option or file, 3 if MuJoCo or Pong refused something, 4 if it was stopped before its end.
 */
#include "machine.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LATCHES = 4, ARM = 6 };
enum phase { APPROACH, CAPTURE, LIMP, PULL, HOLD, BOLT, OPEN, AWAY, PHASES };
static const char *const NAMES[PHASES] = { "approach", "capture", "limp", "pull", "hold", "bolt", "open", "away" };

/* Parameters of the sequence; rows of the folder's numbers.txt have the same names. */
typedef struct {
    double start_gap, pushed_gap, approach_speed, ready_stroke, ready_turn, ready_for, caught, caught_for, capture_most;
    double limp_for, ramp, stands, stands_for, pull_most, held_for, bolted_for, stowed, stowed_within, open_most, away_for;
    double closed_least, capture_share, free_speed;
} limits;

typedef struct {
    limits l;
    phases phases;
    double gap;
    int fault; /* a latch did not draw its fitting in */
    double moved_early, pressed_gap;
    double arm[ARM];
    int crank[LATCHES], crank_speed[LATCHES], stroke[LATCHES], turn[LATCHES], height, bolts, arm_group;
} sequencer;

static void read_limits(limits *l, const numbers *n)
{
    const struct {
        const char *name;
        double *value;
    } rows[] = {
        { "start_gap", &l->start_gap },       { "pushed_gap", &l->pushed_gap },       { "approach_speed", &l->approach_speed },
        { "ready_stroke", &l->ready_stroke }, { "ready_turn", &l->ready_turn },       { "ready_for", &l->ready_for },
        { "caught", &l->caught },             { "caught_for", &l->caught_for },       { "capture_most", &l->capture_most },
        { "limp_for", &l->limp_for },         { "ramp", &l->ramp },                   { "stands", &l->stands },
        { "stands_for", &l->stands_for },     { "pull_most", &l->pull_most },         { "held_for", &l->held_for },
        { "bolted_for", &l->bolted_for },     { "stowed", &l->stowed },               { "stowed_within", &l->stowed_within },
        { "open_most", &l->open_most },       { "away_for", &l->away_for },           { "closed_least", &l->closed_least },
        { "capture_share", &l->capture_share }, { "free_speed", &l->free_speed },
    };
    size_t i;
    for (i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        *rows[i].value = number(n, rows[i].name);
    }
}

static void open_sequencer(void *state, const machine *m)
{
    sequencer *s = state;
    char name[24];
    int i;
    memset(s, 0, sizeof *s);
    read_limits(&s->l, &m->numbers);
    s->gap = s->l.start_gap;
    begin_phases(&s->phases, NAMES, APPROACH);
    for (i = 0; i < ARM; i++) {
        s->arm[i] = number_at(&m->numbers, "arm", i);
    }
    for (i = 0; i < LATCHES; i++) {
        sprintf(name, "crank_%d", i);
        s->crank[i] = place_of(m, name);
        s->crank_speed[i] = speed_of(m, name);
        sprintf(name, "plunger_%d", i);
        s->stroke[i] = place_of(m, name);
        sprintf(name, "paddle_%d", i);
        s->turn[i] = place_of(m, name);
    }
    s->height = 3 * id_of(m, mjOBJ_BODY, "passive") + 2;
    s->bolts = id_of(m, mjOBJ_EQUALITY, "bolts");
    s->arm_group = 1 << (int)number(&m->numbers, "arm_group");
}

/* --- sensors ---------------------------------------------------------------------------------------------------------- */

static double least(const double *values, const int *at)
{
    double found = values[at[0]];
    int i;
    for (i = 1; i < LATCHES; i++) {
        found = fmin(found, values[at[i]]);
    }
    return found;
}

static double fastest(const sequencer *s, const machine *m)
{
    double found = 0.0;
    int i;
    for (i = 0; i < LATCHES; i++) {
        found = fmax(found, fabs(m->data->qvel[s->crank_speed[i]]));
    }
    return found;
}

/* Largest distance of a crank from its stowed angle, rad. */
static double farthest(const sequencer *s, const machine *m)
{
    double found = 0.0;
    int i;
    for (i = 0; i < LATCHES; i++) {
        found = fmax(found, fabs(m->data->qpos[s->crank[i]] - s->l.stowed));
    }
    return found;
}

static int all_ready(const sequencer *s, const machine *m)
{
    const double *places = m->data->qpos;
    return least(places, s->stroke) >= s->l.ready_stroke && least(places, s->turn) >= s->l.ready_turn;
}

static int is_stowed(const sequencer *s, double crank) { return crank <= s->l.stowed + s->l.stowed_within; }

static int all_stowed(const sequencer *s, const machine *m)
{
    int i, stowed = 1;
    for (i = 0; i < LATCHES; i++) {
        stowed = stowed && is_stowed(s, m->data->qpos[s->crank[i]]);
    }
    return stowed;
}

/* --- the phases ----------------------------------------------------------------------------------------------------- */

static int finished(sequencer *s, const machine *m)
{
    const limits *l = &s->l;
    double waited = m->data->time - s->phases.since;
    switch (s->phases.now) {
    case APPROACH:
        return has_held(&s->phases, m, all_ready(s, m), l->ready_for);
    case CAPTURE:
        return has_held(&s->phases, m, least(m->data->qpos, s->crank) >= l->caught, l->caught_for) || waited > l->capture_most;
    case LIMP:
        return waited > l->limp_for;
    case PULL:
        return (has_held(&s->phases, m, fastest(s, m) < l->stands, l->stands_for) && waited > l->ramp) || waited > l->pull_most;
    case HOLD:
        return waited > l->held_for;
    case BOLT:
        return waited > l->bolted_for;
    case OPEN:
        return all_stowed(s, m) || waited > l->open_most;
    default:
        return 0;
    }
}

static void next(sequencer *s, const machine *m)
{
    if (s->phases.now == PULL) {
        s->fault = least(m->data->qpos, s->crank) < s->l.closed_least;
    }
    if (s->phases.now == HOLD) {
        s->pressed_gap = m->data->xpos[s->height];
    }
    enter_phase(&s->phases, m, s->phases.now + 1);
}

/* Voltage at which a turning motor acts as one with this share of the stall torque, and the same free speed. */
static double driven(const sequencer *s, double share, double speed)
{
    return fmin(1.0, fmax(-1.0, share + (1.0 - share) * speed / s->l.free_speed));
}

static double voltage(const sequencer *s, const machine *m, int latch)
{
    double speed = m->data->qvel[s->crank_speed[latch]], risen;
    switch (s->phases.now) {
    case CAPTURE:
    case LIMP:
        return driven(s, s->l.capture_share, speed);
    case PULL:
        risen = fmin(1.0, (m->data->time - s->phases.since) / s->l.ramp);
        return driven(s, s->l.capture_share + (1.0 - s->l.capture_share) * risen, speed);
    case HOLD:
    case BOLT:
        return 1.0;
    case OPEN:
        return is_stowed(s, m->data->qpos[s->crank[latch]]) ? 0.0 : -1.0;
    default:
        return 0.0;
    }
}

static void drive(const sequencer *s, machine *m)
{
    int i;
    for (i = 0; i < LATCHES; i++) {
        m->data->ctrl[i] = voltage(s, m, i);
    }
    for (i = 0; i < ARM; i++) {
        m->data->ctrl[LATCHES + i] = i == 2 ? s->gap + s->arm[i] : s->arm[i];
    }
    m->model->opt.disableactuator = s->phases.now <= CAPTURE ? 0 : s->arm_group;
    m->data->eq_active[s->bolts] = s->phases.now == BOLT || s->phases.now == OPEN;
}

static int control(machine *m, void *state)
{
    sequencer *s = state;
    if (finished(s, m)) {
        next(s, m);
    }
    if (s->phases.now == APPROACH) {
        s->gap = fmax(s->l.pushed_gap, s->l.start_gap - s->l.approach_speed * m->data->time);
        s->moved_early = fmax(s->moved_early, farthest(s, m));
    }
    if (s->phases.now == AWAY && m->data->time - s->phases.since > s->l.away_for) {
        return 0;
    }
    drive(s, m);
    return 1;
}

/* --- the outcome ---------------------------------------------------------------------------------------------------- */

static int judge(const void *state, const machine *m)
{
    const sequencer *s = state;
    double predicted = number(&m->numbers, "pressed_gap"), within = number(&m->numbers, "pressed_within");
    double gap = m->data->xpos[s->height];
    int held = fabs(s->pressed_gap - predicted) <= within * fabs(predicted);
    int off = gap > number(&m->numbers, "away_gap"), early = s->moved_early > number(&m->numbers, "moved_early");
    print_ends(&s->phases, AWAY);
    printf("latches moved by %.1e rad before the indicators were ready; rings pressed together by %.1f um, predicted %.1f um;"
           " gap at the end %.4f m; flags %d\n",
           s->moved_early, -1e6 * s->pressed_gap, -1e6 * predicted, gap, m->flags);
    printf("verdict: %s, %s\n", s->fault ? "a latch did not close" : "berthed", off ? "pushed off" : "not pushed off");
    return !s->fault && held && off && !early && m->flags == 0 ? AS_PREDICTED : OTHERWISE;
}

int main(int argc, char **argv)
{
    sequencer s;
    program p = { &s, &s.phases, open_sequencer, control, judge };
    return run_program(&p, argc, argv);
}
