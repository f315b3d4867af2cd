/* Preloaded by ci/traps: every invalid operation, division by zero and overflow ends the program and tells where. */
#define _GNU_SOURCE
#include <execinfo.h>
#include <fenv.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

static void told(int number, siginfo_t *info, void *context)
{
    static const char name[] = "floating-point exception at:\n";
    void *frames[64];
    (void)number;
    (void)info;
    (void)context;
    if (write(STDERR_FILENO, name, sizeof name - 1) > 0) {
        backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
    }
    _exit(136);
}

__attribute__((constructor)) static void trap(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_sigaction = told;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGFPE, &action, NULL);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}
