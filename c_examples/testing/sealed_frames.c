/* From seal on, frames take no memory and give none back: every call that belongs to frames is made, over and over, with
 * bodies that come and go, while all threads' calls of the allocator are counted.
 *
 *     sealed_frames [--frames N] [--run 0|1|2] [--plant]      N frames per run, 10000 unless given
 *
 * With --plant each frame of the host asks for memory itself: the program must then fail, and tell the number.
 */
#include "crowd.h"
#include "sealed_frames_counter.h"

#include <pthread.h>
#include <stdlib.h>

/* The scene never has more; the worst case would be 7,000, and to save them takes longer than to find them. */
enum { CAPACITY = 512 };

typedef struct run {
    crowd scene;
    long frames;
    int plant;
    /* Buffers of the host for the frames, allocated before they begin. */
    pong_contact *contacts;
    unsigned char *block;
    size_t block_size;
    /* Results. */
    long touching, apart, shared, by_law;
    unsigned long allocated, freed;
} run;

static void fetch(run *r)
{
    crowd *s = &r->scene;
    pong_wrench wrenches[CROWD_PARTS];
    pong_state state;
    const char *path;
    size_t count;
    uint64_t value;
    OK(pong_get_wrenches(s->world, s->parts, PONG_REFERENCE_FRAME_GROUP, wrenches, CROWD_PARTS));
    OK(pong_get_wrench(s->world, s->parts[1], PONG_REFERENCE_FRAME_COMMON, wrenches));
    OK(pong_get_state(s->world, s->parts[0], &state));
    OK(pong_contact_count(s->world, &count));
    OK(pong_get_contacts(s->world, r->contacts, s->sealed.contact_capacity, &count));
    if (count > 0) {
        OK(pong_primitive_path(s->world, r->contacts[0].a.interface, r->contacts[0].a.primitive, &path));
        OK(pong_get_primitive_user_data(s->world, r->contacts[0].a.interface, r->contacts[0].a.primitive, &value));
    }
    OK(pong_get_object_user_data(s->world, s->ball, &value));
    OK(pong_object_name(s->world, s->ball, &path));
    r->touching += count > 0;
    r->apart += count == 0;
    r->by_law += count > 0 && r->contacts[count - 1].pair.bits == s->pairs[2].bits;
}

static void look(run *r)
{
    crowd *s = &r->scene;
    pong_report report;
    pong_ledger ledger;
    pong_energy_account account;
    pong_pair_energy_account pair;
    pong_tally tally;
    pong_worker worker;
    pong_surface_values values;
    pong_interface_id interface;
    size_t count, i;
    OK(pong_get_report(s->world, &report));
    OK(pong_get_ledger(s->world, &ledger));
    OK(pong_get_energy_account(s->world, &account));
    OK(pong_pair_energy_account_count(s->world, &count));
    for (i = 0; i < count; i += 1) {
        OK(pong_get_pair_energy_account(s->world, i, &pair));
    }
    OK(pong_tally_count(s->world, &count));
    for (i = 0; i < count; i += 1) {
        OK(pong_get_tally(s->world, i, &tally));
    }
    OK(pong_worker_count(s->world, &count));
    for (i = 0; i <= count; i += 1) {
        OK(pong_get_worker(s->world, i, &worker));
        r->shared += i > 0 && worker.blocks > 0;
    }
    OK(pong_get_surface(s->world, s->pad_model, "felt", &values));
    OK(pong_find_interface(s->world, s->ball, "arm", &interface));
}

/* Three stages of an integrator, then the state that is accepted; now and then of one pair only. */
static void stages(run *r, long n)
{
    crowd *s = &r->scene;
    pong_state states[CROWD_PARTS];
    int stage;
    for (stage = 0; stage < 3; stage += 1) {
        crowd_states(n + stage, states);
        OK(pong_set_states(s->world, s->parts, states, CROWD_PARTS));
        OK(pong_evaluate(s->world));
        fetch(r);
    }
    OK(pong_set_state(s->world, s->parts[0], &states[0]));
    if (n % 2 == 0) {
        OK(pong_commit(s->world));
    } else {
        OK(pong_commit_pairs(s->world, &s->pairs[n % CROWD_PAIRS], 1));
        OK(pong_commit_pairs(s->world, s->pairs, CROWD_PAIRS));
    }
}

static void one_step(run *r, long n)
{
    crowd *s = &r->scene;
    pong_state states[CROWD_PARTS];
    crowd_states(n, states);
    OK(pong_set_states(s->world, s->parts, states, CROWD_PARTS));
    OK(pong_step(s->world));
    fetch(r);
}

static void between(run *r, long n)
{
    crowd *s = &r->scene;
    if (n % 7 == 0) {
        OK(pong_save_contact_state(s->world, r->block, r->block_size));
    }
    if (n % 11 == 10) {
        OK(pong_restore_contact_state(s->world, r->block, r->block_size));
    }
    if (n % 13 == 0) {
        OK(pong_clear_contact_history(s->world, n % 2 == 0 ? s->pad : s->ball));
    }
    if (n % 17 == 0 || n % 17 == 3) {
        OK(pong_set_pair_enabled(s->world, s->pairs[n / 17 % CROWD_PAIRS], n % 17 == 3));
    }
    if (n % 64 == 63) {
        OK(pong_quiesce(s->world));
    }
}

static void frame(run *r, long n)
{
    if (n % 4 == 0) {
        OK(pong_prewake(r->scene.world, 100));
    }
    if (n % 8 == 7) {
        stages(r, n);
    } else {
        one_step(r, n);
    }
    if (n % 5 == 0) {
        look(r);
    }
    between(r, n);
    if (r->plant) {
        void *volatile planted = malloc(8);
        free(planted);
    }
}

static pthread_mutex_t gate = PTHREAD_MUTEX_INITIALIZER;

/* In a thread that has not called the library before: its first call must not ask for memory either. */
static void *all_frames(void *argument)
{
    run *r = argument;
    unsigned long allocated, freed;
    long n;
    pthread_mutex_lock(&gate);
    allocated = allocations();
    freed = frees();
    for (n = 0; n < r->frames; n += 1) {
        frame(r, n);
    }
    r->allocated = allocations() - allocated;
    r->freed = frees() - freed;
    pthread_mutex_unlock(&gate);
    return NULL;
}

static void measure(run *r, uint32_t workers, uint32_t optional)
{
    pong_config config = pong_default_config();
    pthread_t host;
    unsigned long before = allocations();
    pthread_mutex_lock(&gate);
    TEST(pthread_create(&host, NULL, all_frames, r) == 0);
    config.workers = workers;
    config.oversubscribe = 1;
    config.contact_capacity = CAPACITY;
    config.keep_ledger = optional;
    config.energy_accounts = optional ? PONG_COUPLING_ZERO_ORDER_HOLD : 0;
    config.delay_frames = optional;
    config.report_times = optional;
    open_crowd(&r->scene, &config);
    TEST(r->scene.sealed.workers == workers && r->scene.sealed.contact_capacity == CAPACITY);
    /* The counter sees the library. */
    TEST(allocations() > before + 100);
    OK(pong_contact_state_size(r->scene.world, &r->block_size));
    r->contacts = malloc((size_t)r->scene.sealed.contact_capacity * sizeof *r->contacts);
    r->block = malloc(r->block_size);
    OK(pong_save_contact_state(r->scene.world, r->block, r->block_size));
    pthread_mutex_unlock(&gate);
    pthread_join(host, NULL);
    TEST(r->allocated == 0 && r->freed == 0);
    TEST(r->touching > 0 && r->apart > 0 && r->by_law > 0);
    OK(pong_destroy_world(r->scene.world));
    free(r->contacts);
    free(r->block);
}

int main(int argc, char **argv)
{
    static const uint32_t kinds[3][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 } }; /* workers, ledger and times */
    run r;
    long frames = 10000, touching = 0, apart = 0, shared = 0;
    unsigned long allocated = 0, freed = 0;
    int i, plant = 0, only = -1;
    for (i = 1; i < argc; i += 1) {
        if (strcmp(argv[i], "--plant") == 0) {
            plant = 1;
        } else if (strcmp(argv[i], "--frames") == 0 && i + 1 < argc) {
            frames = strtol(argv[++i], NULL, 10);
        } else if (strcmp(argv[i], "--run") == 0 && i + 1 < argc) {
            only = (int)strtol(argv[++i], NULL, 10);
        } else {
            fprintf(stderr, "sealed_frames [--frames N] [--run 0|1|2] [--plant]\n");
            return 2;
        }
    }
    for (i = 0; i < 3; i += 1) {
        if (only >= 0 && only != i) {
            continue;
        }
        memset(&r, 0, sizeof r);
        r.frames = frames;
        r.plant = plant;
        measure(&r, kinds[i][0], kinds[i][1]);
        printf("%u workers, ledger and times %s: %ld frames, %ld evaluations with contacts, %ld without, %ld looks at a "
               "worker that had worked; %lu allocations, %lu frees\n", (unsigned)kinds[i][0],
               kinds[i][1] ? "on" : "off", frames, r.touching, r.apart, r.shared, r.allocated, r.freed);
        touching += r.touching;
        apart += r.apart;
        shared += r.shared;
        allocated += r.allocated;
        freed += r.freed;
    }
    printf("%ld with contacts, %ld without, %lu allocations, %lu frees\n", touching, apart, allocated, freed);
    return report_failures("sealed_frames");
}
