#include "standin.hh"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace {

Trick::Integrator *current;
std::map<void *, std::vector<unsigned char>> allocations;

} // namespace

/* --- integration -------------------------------------------------------------------------------------------------- */

int Trick::Integrator::integrate() {
    const double share[4] = {0.5, 0.5, 1.0, 0.0};
    if (stage == 0) {
        start = state;
    }
    for (size_t i = 0; i < state.size(); i++) {
        state[i] = stage < 3 ? start[i] + share[stage] * dt * rates[stage][i]
                             : start[i] + dt * ((rates[0][i] + 2.0 * (rates[1][i] + rates[2][i])) + rates[3][i]) / 6.0;
    }
    stage = (stage + 1) % 4;
    if (stage == 0) {
        time += dt;
    }
    return stage;
}

Trick::SimObject *&Trick::the_object() {
    static SimObject *object;
    return object;
}

Trick::IntegLoop *&Trick::the_loop() {
    static IntegLoop *loop;
    return loop;
}

Trick::IntegLoop::IntegLoop(double in_cycle, SimObject &in_object) : cycle(in_cycle), object(in_object) {
    the_object() = &in_object;
    the_loop() = this;
}

void Trick::IntegLoop::getIntegrator(Integrator_type, size_t size) {
    static Integrator made(size);
    integrator = current = &made;
}

double call_jobs(Trick::SimObject &object, const char *job_class) {
    double last = 0.0;
    for (const Trick::Job &job : object.jobs) {
        last = job.job_class == job_class ? job.call() : last;
    }
    return last;
}

/* From the present state over `dt`, which a dynamic event makes negative. */
void Trick::IntegLoop::step(double from, double dt) {
    integrator->time = from;
    integrator->dt = dt;
    do {
        call_jobs(object, "derivative");
    } while (call_jobs(object, "integration") != 0.0);
}

/* An event that says it lies `to_go` away is searched for by steps of that length, back and forth, until it says zero.
 * Then the rest of the cycle is integrated, in which there may be another. */
void Trick::IntegLoop::dynamic_events(double from, double to) {
    double at = to, to_go = call_jobs(object, "dynamic_event");
    if (!(to_go < 0.0)) {
        return;
    }
    while (to_go != 0.0) {
        step(at, to_go);
        at += to_go;
        to_go = call_jobs(object, "dynamic_event");
    }
    step(at, to - at);
    dynamic_events(from, to);
}

void Trick::IntegLoop::integrate(double end) {
    const double from = end - cycle;
    call_jobs(object, "pre_integration");
    step(from, cycle);
    for (const Job &job : object.jobs) {
        if (job.job_class == "dynamic_event") {
            dynamic_events(from, end);
            break;
        }
    }
    call_jobs(object, "post_integration");
}

/* --- Trick's C interface ------------------------------------------------------------------------------------------ */

extern "C" int integrate(void) { return current->integrate(); }
extern "C" double get_integ_time(void) { return current->time; }
extern "C" double get_integ_dt(void) { return current->dt; }
extern "C" int get_intermediate_step(void) { return current->stage; }
extern "C" void load_indexed_state(unsigned int i, double state) { current->state.at(i) = state; }
extern "C" void load_indexed_deriv(unsigned int i, double rate) { current->rates.at(current->stage).at(i) = rate; }
extern "C" double unload_indexed_state(unsigned int i) { return current->state.at(i); }

extern "C" int exec_terminate_with_return(int code, const char *file, int line, const char *message) {
    fprintf(stderr, "terminated: %s (%s:%d)\n", message, file, line);
    exit(code);
}

extern "C" int message_publish(int, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    return 0;
}

extern "C" void *TMM_declare_var_1d(const char *, int count) {
    std::vector<unsigned char> bytes(count);
    void *address = bytes.data();
    allocations[address] = std::move(bytes);
    return address;
}

extern "C" void TMM_delete_var_a(void *address) { allocations.erase(address); }

/* Bytes behind a checkpoint's pointer. */
const std::vector<unsigned char> &allocation(void *address) { return allocations.at(address); }

/* --- roots by false position -------------------------------------------------------------------------------------- */

extern "C" void reset_regula_falsi(double, REGULA_FALSI *search) { search->lower_set = search->upper_set = 0; }

extern "C" double regula_falsi(double now, REGULA_FALSI *search) {
    const bool below = search->error < 0.0, bracketed = search->lower_set && search->upper_set;
    if (bracketed && std::fabs(search->error) < search->error_tol) {
        return 0.0;
    }
    /* A crossing in the other sense is none: forget the side that it came from. */
    if (!bracketed && ((below && search->mode == Increasing) || (!below && search->mode == Decreasing))) {
        search->lower_set = search->upper_set = 0;
    }
    (below ? search->x_lower : search->x_upper) = search->error;
    (below ? search->t_lower : search->t_upper) = now;
    (below ? search->lower_set : search->upper_set) = 1;
    if (!search->lower_set || !search->upper_set) {
        return BIG_TGO;
    }
    return -search->error * (search->t_upper - search->t_lower) / (search->x_upper - search->x_lower);
}
