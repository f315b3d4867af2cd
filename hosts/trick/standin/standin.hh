/* What a simulation needs of Trick, in the call order that Trick 25 documents (Executive-Scheduler.md,
 * Simulation-Definition-File.md and Integrator.md). It exists so that the models and the S_define of this folder can be
 * tested where Trick is not installed. It is no simulation environment. */
#ifndef STANDIN_HH
#define STANDIN_HH

#include "trick/exec_proto.h"
#include "trick/integrator_c_intf.h"
#include "trick/memorymanager_c_intf.h"
#include "trick/message_proto.h"
#include "trick/regula_falsi.h"

#include <functional>
#include <string>
#include <vector>

namespace Trick {

struct Job {
    std::string job_class;
    std::function<double()> call;
};

class SimObject {
  public:
    virtual ~SimObject() {}

    std::vector<Job> jobs;

  protected:
    void job(const char *job_class, std::function<double()> call) { jobs.push_back({job_class, std::move(call)}); }
};

/* The classic method of Runge and Kutta over a vector of numbers, one stage a call. */
class Integrator {
  public:
    explicit Integrator(size_t size) : state(size), start(size), rates(4, std::vector<double>(size)) {}

    int integrate();

    std::vector<double> state, start;
    std::vector<std::vector<double>> rates;
    double time = 0.0, dt = 0.0;
    int stage = 0;
};

enum Integrator_type { Runge_Kutta_4 };

/* The jobs of one or more simulation objects that are integrated together. */
class IntegLoop {
  public:
    IntegLoop(double cycle, SimObject &object);

    void getIntegrator(Integrator_type type, size_t size);
    void integrate(double end);

    double cycle;

  private:
    void step(double from, double dt);
    void dynamic_events(double from, double to);

    SimObject &object;
    Integrator *integrator = nullptr;
};

SimObject *&the_object();
IntegLoop *&the_loop();

} // namespace Trick

using Trick::Runge_Kutta_4;

/* Calls the jobs of a class, in the order of the S_define. */
double call_jobs(Trick::SimObject &object, const char *job_class);

#endif
