// count_steps.h - how many instructions a call takes: what a law of growth is checked with, instead of a clock.
//
// A child process runs the call one instruction at a time under its parent's eyes: some 3 us each. Whatever the call
// does to memory stays in the child. Linux only, and not under a sanitizer.
#ifndef FE_TESTS_COUNT_STEPS_H
#define FE_TESTS_COUNT_STEPS_H
#include <stdint.h>

#if defined(__linux__) && !defined(FE_SANITIZED)
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

static inline _Noreturn void be_counted(void (*call)(void *argument), void *argument)
{
    if (ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0) _exit(1);
    raise(SIGSTOP);
    call(argument);
    raise(SIGSTOP);
    _exit(0);
}

// -1: this machine does not count
static inline int64_t count_steps(void (*call)(void *argument), void *argument)
{
    int status = 0;
    pid_t child = fork();
    if (child == 0) be_counted(call, argument);
    if (child < 0 || waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) return -1;
    int64_t steps = 0;
    for (;;) {
        if (ptrace(PTRACE_SINGLESTEP, child, NULL, NULL) != 0) break;
        if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) break;
        if (WSTOPSIG(status) != SIGTRAP) break;
        ++steps;
    }
    int counted = WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP;
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    return counted ? steps : -1;
}
#else
static inline int64_t count_steps(void (*call)(void *argument), void *argument)
{
    (void)call, (void)argument;
    return -1;
}
#endif

#endif
