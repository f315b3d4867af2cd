/* The floating-point environment of the host: every call returns it as it was, its exception flags included; no trap fires;
 * the numbers are the same bits whatever the host has set, with workers and without, laws of the host's included. */
#define _GNU_SOURCE /* feenableexcept */
#include "check.h"
#include <fenv.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

enum { AS_USUAL, UPWARD, DOWNWARD, TOWARD_ZERO, FLUSHING, TRAPPING, ENVIRONMENTS };
static const char *const names[] = { "as usual", "upward", "downward", "toward zero", "flushing", "trapping" };

static int wanted = AS_USUAL;
static fenv_t usual;
/* Where a law is called; each is written by one thread at a time only where nobody looks. */
static volatile int law_saw_host;

static void enter(void)
{
    static const int rounding[] = { FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST, FE_TONEAREST };
    feclearexcept(FE_ALL_EXCEPT);
    fesetround(rounding[wanted]);
    if (wanted != TRAPPING) {
        /* A flag of the host's, which must be there after the call. With traps it would fire. */
        feraiseexcept(FE_DIVBYZERO);
    } else {
#if defined(__GLIBC__)
        feenableexcept(FE_ALL_EXCEPT);
#endif
    }
#if defined(__SSE2__)
    if (wanted == FLUSHING) {
        _mm_setcsr(_mm_getcsr() | 0x8040u);
    }
#endif
}

/* Returns 1 if the environment is as `enter` left it, and restores the default one. */
static int leave(void)
{
    static const int rounding[] = { FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST, FE_TONEAREST };
    int same = fegetround() == rounding[wanted];
    same = same && fetestexcept(FE_ALL_EXCEPT) == (wanted == TRAPPING ? 0 : FE_DIVBYZERO);
#if defined(__GLIBC__)
    same = same && fegetexcept() == (wanted == TRAPPING ? FE_ALL_EXCEPT : 0);
#endif
#if defined(__SSE2__)
    same = same && (_mm_getcsr() & 0x8040u) == (wanted == FLUSHING ? 0x8040u : 0u);
#endif
    fesetenv(&usual);
#if defined(__SSE2__)
    _mm_setcsr(0x1f80u); /* fesetenv() of MinGW leaves it as it is */
#endif
    return same;
}

/* A call in the host's environment. */
#define IN(call)                                            \
    do {                                                    \
        pong_status in_status_;                             \
        enter();                                            \
        in_status_ = (call);                                \
        if (!leave()) {                                     \
            fprintf(stderr, "environment: %s\n", names[wanted]); \
            TEST(!"the call " #call " leaves the environment as it was"); \
        }                                                   \
        expect(in_status_, PONG_STATUS_OK, "", #call, __FILE__, __LINE__); \
    } while (0)

/* Laws run in the environment of the engine, on every thread. This one rounds, divides by zero in both units of
 * x86, and leaves flags and a rounding mode behind. */
static double press(const pong_normal_input *in, void *user)
{
    volatile double third = in->depth / 3.0, nothing = 0.0, much;
    volatile long double wide = in->depth, none = 0.0L, large;
    (void)user;
    if (fegetround() != FE_TONEAREST) {
        law_saw_host = 1;
    }
    much = third / nothing;
    large = wide / none;
    fesetround(FE_UPWARD);
    return much > 0.0 && large > 0.0L ? in->stiffness * (3.0 * third) : 0.0;
}

#define SURFACE(normal) " surfaces: {\"felt\": (stiffness: 2e4, normal: " normal ", friction: Bristle(mu: 0.4))},\n"
#define HEAD(name, normal) "(format: \"pong-model\", version: 1, name: \"" name "\",\n" SURFACE(normal) \
    " root: (name: \"" name "\", surface: \"felt\", primitives: [\n"
#define MINE "Custom(name: \"mine\")"
/* Every kind that moves, and enough of them to be shared out. */
#define ROW(x) "  Point(name: \"p" #x "\", position: (0." #x ", 0.013, 0)),\n" \
    "  Sphere(name: \"s" #x "\", center: (0." #x ", 0.2, 0.029), radius: 0.03),\n" \
    "  Ellipsoid(name: \"e" #x "\", center: (0." #x ", -0.2, 0.019), semi_axes: (0.04, 0.03, 0.02)),\n" \
    "  LineSegment(name: \"l" #x "\", ends: ((0." #x ", 0.3, 0), (0." #x ", 0.35, 0))),\n" \
    "  Ray(name: \"r" #x "\", origin: (0." #x ", -0.3, 0.05), direction: (0, 0, -1), length: 0.051),\n"
static const char pad[] = HEAD("pad", "Linear(damping: 20)") ROW(01) ROW(11) ROW(13) ROW(21) ROW(23) ROW(31) ROW(33)
    ROW(41) ROW(43) " ]))";
static const char floor_of_all[] = HEAD("floor", "Linear(damping: 20)")
    "  Plane(name: \"plane\", normal: (0, 0, 1), offset: -0.0005),\n"
    "  Triangle(name: \"up\", vertices: ((-0.3, -0.4, 0), (0.5, -0.4, 0), (0, 0.4, 0.001))),\n"
    "  Triangle(name: \"down\", vertices: ((0.5, -0.4, 0), (0.6, 0.4, 0), (0, 0.4, 0.001))),\n"
    "  Sphere(name: \"dome\", center: (0.2, 0, -0.999), radius: 1),\n"
    "  Polyhedron(name: \"block\", vertices: [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 0), (1, -1, 0), "
    "(1, 1, 0), (-1, 1, 0)], faces: [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]),\n ]))";
static const char puck[] = HEAD("puck", MINE) "  Sphere(name: \"shell\", center: (0, 0, 0), radius: 0.1) ]))";
static const char table[] = HEAD("table", MINE) "  Plane(name: \"top\", normal: (0, 0, 1), offset: 0) ]))";

static unsigned long long hash_of(const void *bytes, size_t size, unsigned long long hash)
{
    const unsigned char *byte = bytes;
    for (; size > 0; size -= 1, byte += 1) {
        hash = (hash ^ *byte) * 1099511628211ULL;
    }
    return hash;
}

/* From the first call to the last. Hash of all wrenches. */
static unsigned long long run(unsigned workers)
{
    static const char *const texts[] = { pad, floor_of_all, puck, table };
    unsigned long long hash = 14695981039346656037ULL;
    pong_config config = pong_default_config();
    pong_world *world;
    pong_object_id objects[4];
    pong_interface_id roots[4];
    pong_state states[4];
    pong_wrench wrenches[4];
    size_t count, contacts = 0;
    int i, frame;
    config.workers = workers;
    config.oversubscribe = 1;
    config.keep_ledger = 1;
    IN(pong_create_world(&config, &world));
    IN(pong_register_normal_law(world, "mine", press, NULL, NULL));
    for (i = 0; i < 4; i += 1) {
        char name[2] = { (char)('a' + i), '\0' };
        pong_model_id model;
        IN(load_text(world, texts[i], &model));
        IN(pong_create_object(world, model, name, &objects[i]));
        IN(pong_find_interface(world, objects[i], "", &roots[i]));
        states[i] = pong_default_state();
    }
    IN(pong_pair_objects(world, objects[0], objects[1], NULL));
    IN(pong_pair_objects(world, objects[2], objects[3], NULL));
    IN(pong_seal(world, NULL));
    for (frame = 0; frame < 200; frame += 1) {
        int beat = frame % 40;
        states[0].position[0] = 1e-4 * frame;
        states[0].position[2] = 1e-3 - 1e-4 * (beat < 20 ? beat : 40 - beat);
        states[0].linear_velocity[0] = 0.1;
        states[0].linear_velocity[2] = beat < 20 ? -0.1 : 0.1;
        states[2].position[0] = 1e-4 * frame;
        states[2].position[2] = 0.1002 - 1e-5 * beat;
        IN(pong_set_states(world, roots, states, 4));
        IN(pong_step(world));
        IN(pong_get_wrenches(world, roots, PONG_REFERENCE_FRAME_COMMON, wrenches, 4));
        IN(pong_contact_count(world, &count));
        contacts += count;
        hash = hash_of(wrenches, sizeof wrenches, hash);
    }
    TEST(contacts > 5000);
    /* States whose result overflows are refused, without a trap and without a flag. */
    states[0].position[2] = -0.001;
    states[0].angular_velocity[0] = 1e100;
    states[0].linear_velocity[2] = -1e100;
    enter();
    (void)pong_set_states(world, roots, states, 4);
    (void)pong_step(world);
    TEST(leave());
    IN(pong_destroy_world(world));
    return hash;
}

int main(void)
{
    unsigned long long first;
    unsigned workers;
    fegetenv(&usual);
    first = run(0);
    for (workers = 0; workers < 2; workers += 1) {
        for (wanted = AS_USUAL; wanted < ENVIRONMENTS; wanted += 1) {
            unsigned long long hash = run(workers);
            if (hash != first) {
                fprintf(stderr, "%s, %u workers: %016llx, not %016llx\n", names[wanted], workers, hash, first);
                TEST(!"the same bits");
            }
        }
    }
    wanted = AS_USUAL;
    TEST(!law_saw_host);
    return report_failures("floating_point");
}
