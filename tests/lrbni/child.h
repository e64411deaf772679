/* Accesses that stop the program, tried in a child process. */
#ifndef TESTS_LRBNI_CHILD_H
#define TESTS_LRBNI_CHILD_H

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/lrbni/case.h"

/* Access `number` of a test's own list, `off` bytes beside the alignment that it needs. */
typedef void access_fn(lrb_ctx *c, int number, int32_t off);

/** How a child process ends that makes the access: 0, or the signal that ended it. */
static inline int end_of_access(access_fn *access_at, lrb_ctx *c, int number, int32_t off)
{
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        signal(SIGABRT, SIG_DFL);
        if (!freopen("/dev/null", "w", stderr))
            _exit(3);
        access_at(c, number, off);
        _exit(0);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
}

#endif
