/* The end effector at 1 kHz: captures a free flyer, presses it, releases it and pushes it off. The sequencer is that of
 * mechanisms/end_effector/capture.py; phases, limits and controls come from its folder (mechanisms/from_c.py).
 *
 *     end_effector FOLDER [--fast] [--seconds S] [--lock] [--fifo PRIORITY] [--core N] [--end FILE]
 *
 * Exit code: 0 if it captured with the predicted preload and let go, 1 if not, 2 for a wrong option or file, 3 if MuJoCo or
 * Pong refused something, 4 if it was stopped before its end.
 */
#include "machine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum phase { APPROACH, SNARE, RETRACT, RIGIDIZE, HOLD, RELEASE, OPEN, PUSH, DONE, PHASES };
static const char *const NAMES[PHASES] = { "approach", "snare", "retract", "rigidize", "hold", "release", "open", "push", "done" };

/* A row `phase` of the folder's numbers: longest duration; voltages of ring, screw and plungers, and the
 * ring's brake; the joint whose rest ends the phase, if any. */
typedef struct {
    double limit, ring, brake, screw, plungers;
    int rests; /* address of its speed, or -1 */
    double slower_than, lasting;
} phase_row;

typedef struct {
    phase_row rows[PHASES];
    phases phases;
    enum phase missed; /* in which it gave up; DONE if it did not */
    double carriage;
    int steps_after;
    double on_pads, preload; /* N, at the end of the hold */
    int turn, turning, retract, turn_dof;
    int ring, screw, plungers;
    int shell, payload;
} sequencer;

static phase_row read_row(const machine *m, enum phase phase)
{
    phase_row row;
    char **words = row_of(&m->numbers, "phase", (int)phase);
    if (words == NULL || strcmp(words[1], NAMES[phase]) != 0) {
        fprintf(stderr, "numbers.txt: the phase %s is not where it should be\n", NAMES[phase]);
        exit(WRONG_USE);
    }
    row.limit = strtod(words[2], NULL);
    row.ring = strtod(words[3], NULL);
    row.brake = strtod(words[4], NULL);
    row.screw = strtod(words[5], NULL);
    row.plungers = strtod(words[6], NULL);
    row.rests = strcmp(words[7], "-") == 0 ? -1 : speed_of(m, words[7]);
    row.slower_than = strtod(words[8], NULL);
    row.lasting = strtod(words[9], NULL);
    return row;
}

static enum phase first_phase(const machine *m)
{
    char **words = row_of(&m->numbers, "begin", 0);
    int i;
    for (i = 0; words != NULL && i < PHASES; i++) {
        if (strcmp(words[1], NAMES[i]) == 0) {
            return (enum phase)i;
        }
    }
    fprintf(stderr, "numbers.txt: no phase to begin with\n");
    exit(WRONG_USE);
}

static void open_sequencer(void *state, const machine *m)
{
    sequencer *s = state;
    int i;
    memset(s, 0, sizeof *s);
    for (i = 0; i < PHASES; i++) {
        s->rows[i] = read_row(m, (enum phase)i);
    }
    begin_phases(&s->phases, NAMES, first_phase(m));
    s->missed = DONE;
    s->turn = place_of(m, "turn");
    s->turning = s->turn_dof = speed_of(m, "turn");
    s->retract = place_of(m, "retract");
    s->ring = id_of(m, mjOBJ_ACTUATOR, "ring");
    s->screw = id_of(m, mjOBJ_ACTUATOR, "screw");
    s->plungers = id_of(m, mjOBJ_ACTUATOR, "plungers");
    s->shell = id_of(m, mjOBJ_BODY, "shell");
    s->payload = id_of(m, mjOBJ_BODY, "payload");
}

/* --- sensors ---------------------------------------------------------------------------------------------------------- */

/* Force (N) and moment (N m) on a movable group; NULL if the machine has no group of this name. */
static const double *on(const machine *m, const char *group)
{
    char **words;
    int i;
    for (i = 0; (words = row_of(&m->numbers, "group", i)) != NULL; i++) {
        if (strcmp(words[1], group) == 0) {
            return m->sensed + 3 + 6 * atoi(words[2]);
        }
    }
    return NULL;
}

static int touched(const machine *m, const char *group, int numbers)
{
    const double *wrench = on(m, group);
    int i;
    for (i = 0; wrench != NULL && i < numbers; i++) {
        if (wrench[i] != 0.0) {
            return 1;
        }
    }
    return 0;
}

/* Force along the shell's axis, N: positive where a group is pushed inwards. */
static double axial(const sequencer *s, const machine *m, const char *group)
{
    const double *axes = m->data->xmat + 9 * s->shell, *force = on(m, group);
    return force == NULL ? 0.0 : -(axes[2] * force[0] + axes[5] * force[1] + axes[8] * force[2]);
}

/* Height of the plate's centre above the plane of the open snare, m. */
static double height(const sequencer *s, const machine *m)
{
    const double *axes = m->data->xmat + 9 * s->shell;
    const double *from = m->data->xpos + 3 * s->shell, *to = m->data->xpos + 3 * s->payload;
    return axes[2] * (to[0] - from[0]) + axes[5] * (to[1] - from[1]) + axes[8] * (to[2] - from[2]);
}

static int near(const sequencer *s, const machine *m) { return height(s, m) <= number(&m->numbers, "plate_height"); }

/* --- the phases ----------------------------------------------------------------------------------------------------- */

static int rested(sequencer *s, const machine *m, const phase_row *row)
{
    return has_held(&s->phases, m, fabs(m->data->qvel[row->rests]) <= row->slower_than, row->lasting);
}

static int apart(sequencer *s, const machine *m)
{
    return has_held(&s->phases, m, !touched(m, "plungers", 3), number(&m->numbers, "apart_for"));
}

static int unloaded(const sequencer *s, const machine *m)
{
    double moved = s->carriage - m->data->qpos[s->retract];
    return moved > number(&m->numbers, "extended") || axial(s, m, "pads") < number(&m->numbers, "unloaded");
}

static int finished(sequencer *s, const machine *m)
{
    const phase_row *row = &s->rows[s->phases.now];
    if (m->data->time - s->phases.since >= row->limit) {
        return 1;
    }
    if (row->rests >= 0) {
        return rested(s, m, row);
    }
    switch (s->phases.now) {
    case APPROACH:
        return near(s, m);
    case RELEASE:
        return unloaded(s, m);
    case OPEN:
        return m->data->qpos[s->turn] <= number(&m->numbers, "open_turn");
    case PUSH:
        return apart(s, m);
    default:
        return 0;
    }
}

/* True if the phase failed: nothing entered the mouth, the closed snare touches nothing, or nothing presses the pads. */
static int failed(const sequencer *s, const machine *m)
{
    switch (s->phases.now) {
    case APPROACH:
        return !near(s, m);
    case SNARE:
        return !touched(m, "fixture", 6);
    case RETRACT:
        return !touched(m, "pads", 6);
    default:
        return 0;
    }
}

static void next(sequencer *s, const machine *m)
{
    if (failed(s, m)) {
        s->missed = s->phases.now;
        enter_phase(&s->phases, m, DONE);
    } else {
        enter_phase(&s->phases, m, s->phases.now + 1);
    }
    s->carriage = m->data->qpos[s->retract];
}

/* Voltage of the ring's motor, whose current is limited. */
static double ring_voltage(const sequencer *s, const machine *m, double wanted)
{
    double limit = number(&m->numbers, "snare_torque") / number(&m->numbers, "stall_torque");
    double turning = m->data->qvel[s->turning] / number(&m->numbers, "free_speed");
    return fmin(limit + turning, fmax(turning - limit, wanted));
}

static void drive(const sequencer *s, machine *m)
{
    const phase_row *row = &s->rows[s->phases.now];
    m->data->ctrl[s->ring] = ring_voltage(s, m, row->ring);
    m->data->ctrl[s->screw] = row->screw;
    m->data->ctrl[s->plungers] = row->plungers;
    m->model->dof_frictionloss[s->turn_dof] = row->brake;
}

static int control(machine *m, void *state)
{
    sequencer *s = state;
    if (s->phases.now == DONE && ++s->steps_after > (int)number(&m->numbers, "steps_after")) {
        return 0;
    }
    if (s->phases.now == HOLD) {
        s->on_pads = axial(s, m, "pads");
        s->preload = s->on_pads + axial(s, m, "teeth") + axial(s, m, "rollers");
    }
    if (s->phases.now != DONE && finished(s, m)) {
        next(s, m);
    }
    drive(s, m);
    return 1;
}

/* --- the outcome ---------------------------------------------------------------------------------------------------- */

static int judge(const void *state, const machine *m)
{
    const sequencer *s = state;
    double predicted = number(&m->numbers, "preload"), within = number(&m->numbers, "preload_within");
    int captured = s->missed == DONE && s->on_pads > 0.5 * predicted;
    print_ends(&s->phases, DONE);
    printf("preload %.1f N, predicted %.1f N; flags %d\n", s->preload, predicted, m->flags);
    printf("verdict: %s\n", captured ? "captured, pressed, released" : "not captured");
    return captured && fabs(s->preload - predicted) <= within * predicted && m->flags == 0 ? AS_PREDICTED : OTHERWISE;
}

int main(int argc, char **argv)
{
    sequencer s;
    program p = { &s, &s.phases, open_sequencer, control, judge };
    return run_program(&p, argc, argv);
}
