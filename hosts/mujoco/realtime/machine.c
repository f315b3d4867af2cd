#define _POSIX_C_SOURCE 200809L

#include "machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { GIVE_UP = 20 }; /* periods that the schedule may be behind before it begins anew */

static void refuse(int code, const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why);
    exit(code);
}

/* --- options -------------------------------------------------------------------------------------------------------- */

static const char *text(int argc, char **argv, int *i)
{
    if (*i + 1 >= argc) {
        refuse(WRONG_USE, argv[*i], "needs a value behind it");
    }
    return argv[++*i];
}

static double amount(int argc, char **argv, int *i, double least, double most)
{
    const char *option = argv[*i], *written = text(argc, argv, i);
    char *end;
    double value = strtod(written, &end);
    if (end == written || *end != '\0' || !(value >= least && value <= most)) {
        refuse(WRONG_USE, option, "not a number that it can have");
    }
    return value;
}

static void read_options(run_options *o, int argc, char **argv)
{
    int i;
    memset(o, 0, sizeof *o);
    o->wishes.core = -1;
    o->seconds = 600.0;
    for (i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--fast") == 0) {
            o->fast = 1;
        } else if (strcmp(argv[i], "--seconds") == 0) {
            o->seconds = amount(argc, argv, &i, 1e-3, 600.0);
        } else if (strcmp(argv[i], "--lock") == 0) {
            o->wishes.lock_memory = 1;
        } else if (strcmp(argv[i], "--fifo") == 0) {
            o->wishes.fifo = (int)amount(argc, argv, &i, 1.0, 99.0);
        } else if (strcmp(argv[i], "--core") == 0) {
            o->wishes.core = (int)amount(argc, argv, &i, 0.0, 1023.0);
        } else if (strcmp(argv[i], "--end") == 0) {
            o->end = text(argc, argv, &i);
        } else if (argv[i][0] != '-' && o->folder == NULL) {
            o->folder = argv[i];
        } else {
            refuse(WRONG_USE, argv[i], "no such option");
        }
    }
    if (o->folder == NULL) {
        fprintf(stderr, "%s FOLDER [--fast] [--seconds S] [--lock] [--fifo PRIORITY] [--core N] [--end FILE]\n", argv[0]);
        exit(WRONG_USE);
    }
}

/* --- the machine ---------------------------------------------------------------------------------------------------- */

static void set_velocities(machine *m)
{
    int i;
    for (i = 0; i < m->model->nv; i++) {
        m->data->qvel[i] = number_at(&m->numbers, "qvel", i);
    }
}

/* Opens FOLDER/machine.xml and FOLDER/numbers.txt, at rest except for the velocities in `qvel`. Changes to
 * the folder, because the plugin searches the models from there. */
static void open_machine(machine *m, const run_options *o)
{
    char error[1000] = "";
    memset(m, 0, sizeof *m);
    if (chdir(o->folder) != 0) {
        refuse(WRONG_USE, o->folder, "no folder to go into");
    }
    mj_loadPluginLibrary(PLUGIN);
    read_numbers(&m->numbers, "numbers.txt");
    m->model = mj_loadXML("machine.xml", NULL, error, sizeof error);
    if (m->model == NULL) {
        refuse(REFUSED, "machine.xml", error);
    }
    m->data = mj_makeData(m->model);
    if (m->data == NULL) {
        refuse(REFUSED, "machine.xml", "no data could be made; MuJoCo's log tells why");
    }
    m->sensed = m->data->sensordata + m->model->sensor_adr[id_of(m, mjOBJ_SENSOR, "contact")];
    set_velocities(m);
    mj_forward(m->model, m->data);
}

static void close_machine(machine *m)
{
    mj_deleteData(m->data);
    mj_deleteModel(m->model);
    free(m->numbers.text);
}

int id_of(const machine *m, mjtObj kind, const char *name)
{
    int id = mj_name2id(m->model, kind, name);
    if (id < 0) {
        refuse(WRONG_USE, name, "not in machine.xml");
    }
    return id;
}

int place_of(const machine *m, const char *joint) { return m->model->jnt_qposadr[id_of(m, mjOBJ_JOINT, joint)]; }

int speed_of(const machine *m, const char *joint) { return m->model->jnt_dofadr[id_of(m, mjOBJ_JOINT, joint)]; }

/* --- phases --------------------------------------------------------------------------------------------------------- */

void begin_phases(phases *p, const char *const *names, int first)
{
    int i;
    memset(p, 0, sizeof *p);
    p->names = names;
    p->now = first;
    for (i = 0; i < MOST_PHASES; i++) {
        p->ends[i] = -1.0;
    }
}

void enter_phase(phases *p, const machine *m, int phase)
{
    p->ends[p->now] = m->data->time;
    p->now = phase;
    p->since = p->unmet = m->data->time;
}

int has_held(phases *p, const machine *m, int holds, double seconds)
{
    if (!holds) {
        p->unmet = m->data->time;
    }
    return holds && m->data->time - p->unmet > seconds;
}

void print_ends(const phases *p, int count)
{
    int i;
    for (i = 0; i < count; i++) {
        if (p->ends[i] >= 0.0) {
            printf("%-9s ended at %7.3f s\n", p->names[i], p->ends[i]);
        }
    }
}

/* --- the run -------------------------------------------------------------------------------------------------------- */

static void step(machine *m)
{
    mj_step(m->model, m->data);
    if (m->sensed[2] != 0.0) {
        fprintf(stderr, "at %.6f s a step could not be computed: status %d\n", m->data->time, (int)m->sensed[2]);
        exit(REFUSED);
    }
    m->flags |= (int)m->sensed[1];
}

static void write_end(const machine *m, const char *file)
{
    FILE *stream = fopen(file, "wb");
    size_t places = (size_t)m->model->nq, speeds = (size_t)m->model->nv;
    if (stream == NULL || fwrite(m->data->qpos, sizeof(double), places, stream) != places ||
        fwrite(m->data->qvel, sizeof(double), speeds, stream) != speeds || fclose(stream) != 0) {
        refuse(WRONG_USE, file, "cannot be written");
    }
}

static void print_grants(const grants *granted)
{
    printf("memory: %s\nscheduling: %s\ncore: %s\n", granted->memory, granted->scheduling, granted->core);
}

/* Returns 1 if the program is over, 0 if the seconds of the options have passed. */
static int run_machine(machine *m, const run_options *o, const program *p)
{
    double period = m->model->opt.timestep;
    size_t steps = (size_t)(o->seconds / period + 0.5), n;
    int over = 0;
    schedule plan;
    grants granted;
    make_schedule(&plan, o->fast ? "as fast as it goes" : "paced", (long long)(period * 1e9 + 0.5), steps);
    become_real_time(&o->wishes, &granted);
    print_grants(&granted);
    plan.release = now_ns() + plan.period;
    for (n = 0; n < steps; n++) {
        long long start;
        if (!o->fast) {
            behind(&plan, GIVE_UP);
            sleep_until(plan.release);
        }
        start = now_ns();
        if (o->fast) {
            plan.release = start;
        }
        over = !p->control(m, p->sequencer);
        if (over) {
            break;
        }
        step(m);
        end_frame(&plan, start);
    }
    print_schedule(&plan);
    free_schedule(&plan);
    if (o->end != NULL) {
        write_end(m, o->end);
    }
    return over;
}

int run_program(const program *p, int argc, char **argv)
{
    run_options o;
    machine m;
    int outcome;
    read_options(&o, argc, argv);
    open_machine(&m, &o);
    p->open(p->sequencer, &m);
    if (run_machine(&m, &o, p)) {
        outcome = p->judge(p->sequencer, &m);
    } else {
        printf("stopped in the phase %s\n", p->phases->names[p->phases->now]);
        outcome = UNFINISHED;
    }
    close_machine(&m);
    return outcome;
}
